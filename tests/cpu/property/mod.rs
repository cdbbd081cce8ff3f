//! What holds for every scene and for every text: documents, links, history, paths.

mod document;
mod history;
mod link;
mod looks;
mod path;
