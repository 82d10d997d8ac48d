//! The pixel under the pointer, explained by a drawing thread: the newest question follows the answer to the one before.

use crate::error::Result;
use crate::pixel::Explanation;
use crate::window::threads::job::Job;

/// A pixel to explain.
#[derive(Debug, Clone)]
pub(crate) struct PixelJob {
    /// The view with the side's drawing alone.
    pub view: Job,
    /// Right and down from the upper left corner of its picture.
    pub pixel: [u32; 2],
}

impl PixelJob {
    fn is_same(&self, other: &Self) -> bool {
        self.pixel == other.pixel && self.view.is_same(&other.view)
    }
}

/// The last question and the last answer.
#[derive(Debug, Default)]
pub struct PixelAnswer {
    asked: Option<PixelJob>,
    is_asking: bool,
    answer: Option<std::result::Result<Explanation, String>>,
}

impl PixelAnswer {
    /// The answer, or why there is none.
    pub(crate) fn answer(&self) -> Option<&std::result::Result<Explanation, String>> {
        self.answer.as_ref()
    }

    /// Whether a question is at work.
    pub(in crate::window) fn is_asking(&self) -> bool {
        self.is_asking
    }

    /// Returns the question to ask now, if it is a new one and none is at work.
    pub(in crate::window) fn next(&mut self, wanted: Option<PixelJob>) -> Option<PixelJob> {
        let Some(wanted) = wanted else {
            (self.asked, self.answer) = (None, None);
            return None;
        };
        if self.is_asking || self.asked.as_ref().is_some_and(|asked| asked.is_same(&wanted)) {
            return None;
        }
        (self.asked, self.is_asking) = (Some(wanted.clone()), true);
        Some(wanted)
    }

    /// Takes an answer.
    pub(in crate::window) fn take(&mut self, answer: Result<Explanation>) {
        self.is_asking = false;
        // Questions are dropped when the window closes its listing.
        self.answer = self.asked.is_some().then(|| answer.map_err(|error| error.to_string()));
    }

    /// Asks again, because shaders changed.
    pub(in crate::window) fn forget(&mut self) {
        self.asked = None;
    }
}
