//! Slices: the division of a list's jobs among runs.

use crate::error::ParseError;
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// One of `count` parts of a list: every count-th job, beginning with the number-th. Slices cost about the same even where costs
/// change along the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Slice {
    /// How many parts there are, 1 to 100,000.
    pub count: u32,
    /// Its number, from 1.
    pub number: u32,
}

impl Slice {
    /// All jobs.
    pub const WHOLE: Self = Self { count: 1, number: 1 };

    /// Most parts.
    pub(crate) const MOST: u32 = 100_000;

    /// Whether the job at this place of the list, from 0, is in this slice.
    pub(crate) fn has(self, place: usize) -> bool {
        place as u64 % u64::from(self.count) == u64::from(self.number) - 1
    }

    /// The file in the batch's folder that its entries go to.
    pub(crate) fn file_name(self) -> String {
        format!("batch-{}-of-{}.jsonl", self.number, self.count)
    }

    /// The slice of a file of this name.
    pub(crate) fn of_file_name(name: &str) -> Option<Self> {
        let (number, count) = name.strip_prefix("batch-")?.strip_suffix(".jsonl")?.split_once("-of-")?;
        let slice: Self = format!("{number}/{count}").parse().ok()?;
        (slice.file_name() == name).then_some(slice)
    }
}

impl FromStr for Slice {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        let numbers = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((number, count)) if (1..=count).contains(&number) && count <= Self::MOST => Ok(Self { count, number }),
            _ => Err(format!("give K/N, such as 3/8, with K from 1 to N and N up to {}", Self::MOST).into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_job_is_in_exactly_one_slice() {
        for count in 1..=8 {
            let slices = (1..=count).map(|number| Slice { count, number });
            for place in 0..100 {
                assert_eq!(slices.clone().filter(|slice| slice.has(place)).count(), 1, "{place} of {count}");
            }
            for slice in slices {
                assert!((0..100).filter(|place| slice.has(*place)).count().abs_diff(100 / count as usize) <= 1);
                assert_eq!(Slice::of_file_name(&slice.file_name()), Some(slice));
            }
        }
    }

    #[test]
    fn slices_are_written_as_k_of_n() {
        assert_eq!("3/8".parse(), Ok(Slice { count: 8, number: 3 }));
        for text in ["0/8", "9/8", "3", "3/0", "-1/8", "a/b", "1/100001", "", "1/8/2"] {
            assert!(text.parse::<Slice>().is_err(), "{text}");
        }
        for name in ["batch-list.jsonl", "batch-01-of-8.jsonl", "batch-9-of-8.jsonl", "batch-1-of-8.json"] {
            assert_eq!(Slice::of_file_name(name), None, "{name}");
        }
    }
}
