//! A part of a line that is visible or hidden as a whole.

/// A part of a line that is visible or hidden as a whole, by its places on the image.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct Interval {
    pub from: f64,
    pub to: f64,
    pub is_visible: bool,
    /// Whether only background lies beside it: on the right and on the left, in its direction.
    pub background: [bool; 2],
}
