//! pending
/// pending
#[derive(Debug)]
pub struct Invalid;
