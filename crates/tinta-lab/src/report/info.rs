//! What a report says of its run besides the rows, and the pictures on its page.

/// What a report says besides its rows.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ReportInfo {
    /// The command that made it, as typed.
    pub command: String,
    /// tinta's version.
    pub version: String,
    /// What is known of the machine: a name and a value each, such as "Processor".
    pub notes: Vec<(String, String)>,
    /// Pictures of the errors, in the order in which they are shown.
    pub pictures: Vec<ReportPicture>,
}

/// A picture on the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReportPicture {
    /// What is seen on it, besides the model.
    pub caption: String,
    /// The model it belongs to: shown when that model is chosen; `None`: always.
    pub model: Option<String>,
    /// The drawing that has these errors, a whole PNG file; `None` where it is not kept.
    pub drawing: Option<Vec<u8>>,
    /// The errors, a whole PNG file.
    pub png: Vec<u8>,
}
