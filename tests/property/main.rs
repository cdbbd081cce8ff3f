//! What holds for every scene and for every text: documents, links, history.

mod document;
mod history;
mod link;
mod scenes;
