//! One thing that the program contains, with its licence.

/// A package, a library or a font.
pub struct Item {
    /// Name and version.
    pub name: String,
    /// Its licence expression, as its authors wrote it.
    pub license: String,
    /// The licences that are taken of it.
    pub taken: Vec<String>,
    /// What a reader must know beside the licence, such as where the source is.
    pub note: Option<String>,
    /// Texts of licences and notices.
    pub texts: Vec<String>,
}
