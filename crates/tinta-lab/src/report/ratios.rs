//! Several machines: how much longer each takes for the same setting.

use super::settings::{Clock, Machine, setting_key, short_names};
use crate::measure::Row;
use std::collections::{BTreeMap, BTreeSet};

/// A setting's times on each machine.
pub(super) struct Ratio {
    /// The setting's short name.
    pub(super) name: String,
    /// Models measured on every machine that has the setting.
    pub(super) models: usize,
    /// Geometric mean over those models of the median time by the machine's [`Clock`], milliseconds; `None` if not measured.
    pub(super) times_ms: Vec<Option<f64>>,
}

impl Ratio {
    /// Time on a machine over time on the first.
    pub(super) fn to_first(&self, machine: usize) -> Option<f64> {
        Some(self.times_ms.get(machine).copied()?? / self.times_ms.first().copied()??)
    }
}

/// Settings that at least two of the machines have.
pub(super) fn ratios(machines: &[Machine<'_>]) -> Vec<Ratio> {
    let all: Vec<&Row> = machines.iter().flat_map(|machine| machine.rows.iter().copied()).collect();
    let names = short_names(&all);
    let mut order = Vec::new();
    let mut times: BTreeMap<_, Vec<BTreeMap<&str, f64>>> = BTreeMap::new();
    for (number, machine) in machines.iter().enumerate() {
        let clock = Clock::of(&machine.rows);
        for row in machine.rows.iter().filter(|row| row.time.median_ms > 0.0) {
            let key = setting_key(row);
            let of_setting = times.entry(key).or_insert_with(|| {
                order.push(key);
                vec![BTreeMap::new(); machines.len()]
            });
            of_setting[number].insert(&row.model, clock.times_of(row)[1]);
        }
    }
    let ratio = |key| {
        let times = &times[key];
        let measured = || times.iter().filter(|of_machine| !of_machine.is_empty());
        let first: BTreeSet<&str> = measured().next()?.keys().copied().collect();
        let shared: Vec<&str> =
            first.into_iter().filter(|model| measured().all(|of_machine| of_machine.contains_key(model))).collect();
        if shared.is_empty() || measured().count() < 2 {
            return None;
        }
        let mean = |of_machine: &BTreeMap<&str, f64>| {
            let logarithms = shared.iter().map(|model| of_machine.get(model).map(|time| time.ln()));
            Some((logarithms.sum::<Option<f64>>()? / shared.len() as f64).exp())
        };
        Some(Ratio { name: names[key].clone(), models: shared.len(), times_ms: times.iter().map(mean).collect() })
    };
    order.iter().filter_map(ratio).collect()
}
