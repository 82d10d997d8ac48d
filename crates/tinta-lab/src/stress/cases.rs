//! The cases, as data.

mod case;
mod depth;
mod faults;
mod files;
mod inputs;
mod mixes;
mod pictures;
mod scale;
mod thresholds;
mod topology;
mod turntable;

pub(super) use case::side_px;
pub use case::{Case, Check, Content, Demand, Drawing, Group, Study, Work};

/// All cases in the groups' order; `seed` decides the `mixes` random ones.
pub fn cases(seed: u64, mixes: usize) -> Vec<Case> {
    let still =
        [scale::cases(), depth::cases(), topology::cases(), thresholds::cases(), pictures::cases(), inputs::cases()];
    let others = [mixes::cases(seed, mixes), turntable::cases(), files::cases(), faults::cases()];
    [still.concat(), others.concat()].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_more_than_sixty_cases_with_names_of_their_own_in_every_group() {
        let all = cases(0, 20);
        assert!(all.len() >= 60, "{}", all.len());
        let mut names: Vec<&str> = all.iter().map(|case| case.name.as_str()).collect();
        names.sort_unstable();
        names.windows(2).for_each(|pair| assert_ne!(pair[0], pair[1]));
        use Group::{Depth, Faults, Files, Inputs, Mixes, Pictures, Scale, Thresholds, Topology, Turns};
        for group in [Scale, Depth, Topology, Thresholds, Pictures, Inputs, Mixes, Turns, Files, Faults] {
            assert!(all.iter().any(|case| case.group == group), "{group:?}");
        }
    }

    #[test]
    fn the_mixes_follow_from_the_seed() {
        let text = |seed| format!("{:?}", mixes::cases(seed, 5));
        assert_eq!(text(3), text(3));
        assert_ne!(text(3), text(4));
    }
}
