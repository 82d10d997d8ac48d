//! A part of a line that is seen or hidden as a whole.

/// A part of a line that is seen or hidden as a whole, by its places on the image.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct Interval {
    pub from: f64,
    pub to: f64,
    pub is_visible: bool,
    /// On which sides there is nothing but background, on the right and on the left as it runs.
    pub background: [bool; 2],
}
