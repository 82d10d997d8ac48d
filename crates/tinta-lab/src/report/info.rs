//! A report's information about its run besides the rows, and the pictures on its page.

/// A report's information besides its rows.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ReportInfo {
    /// The command that made it, as typed.
    pub command: String,
    /// Pictures of the errors, in the order shown.
    pub pictures: Vec<ReportPicture>,
}

/// A picture on the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReportPicture {
    /// Its contents, besides the model.
    pub caption: String,
    /// The model it belongs to: shown when that model is chosen; `None`: always.
    pub model: Option<String>,
    /// The drawing with these errors, a whole PNG file; `None` if it was not kept.
    pub drawing: Option<Vec<u8>>,
    /// The errors, a whole PNG file.
    pub png: Vec<u8>,
}
