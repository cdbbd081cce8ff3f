//! The interface, driven as people drive it: by pointer, keys and the accessibility tree; and the
//! movements of its camera.

mod cards;
mod compare;
mod contrast;
mod controls;
mod depth;
mod descent;
mod dive;
mod editor;
mod environment_map;
mod export;
mod favourites;
mod finder;
mod fit;
mod focus;
mod follow;
mod gallery;
mod gestures;
mod help;
mod hostile;
mod hybrids;
mod keyboard;
mod light_click;
mod light_handles;
mod looks;
mod mutate;
mod navigation;
mod orbit;
mod places;
mod screen_reader;
mod sections;
mod share;
mod stage;
mod steady;
mod timeline;
mod zoom;
