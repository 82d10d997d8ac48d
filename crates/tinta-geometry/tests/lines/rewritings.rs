//! A surface that is written in another way has the same lines.
//!
//! Every rewriting below changes a model's file, but not its surface. The drawing must keep its visible length per
//! class and every visible segment.

mod crossing;
mod known;
mod model;
mod rules;

use crate::same::difference;
use crate::support::families::FAMILIES;
use crate::support::lines::{lines, scenes_wanted};
use crate::support::random_scenes::random_scene;
use crate::support::shapes::Random;
use crossing::CROSSINGS;
use model::Model;
use rules::{OF_POLYGONS, REWRITINGS};

/// The kinds of random scenes without a family.
const RANDOM: usize = 4;

const KINDS: usize = FAMILIES.len() + CROSSINGS.len() + RANDOM;

/// A scene of one of the kinds, numbered across all of them.
fn scene(number: usize, random: &mut Random) -> (String, Model) {
    let kind = number % KINDS;
    match FAMILIES.iter().chain(&CROSSINGS).nth(kind) {
        Some((name, make)) => ((*name).to_owned(), Model::of(&make(random))),
        None => {
            let kind = kind + RANDOM - KINDS;
            (format!("random scenes {kind}"), Model::of(&random_scene(kind as u32, random)))
        }
    }
}

/// Rewrites one scene by a chain of rules and returns the differences.
fn failure(seed: u64, number: usize, chain: &[usize]) -> Option<String> {
    let mut random = Random::seeded(seed);
    let (name, model) = scene(number, &mut random);
    let expected = lines(&model.scene());
    let mut rewritten = model.clone();
    for rule in chain {
        rewritten = (REWRITINGS[*rule].rewrite)(rewritten, &mut random);
    }
    let actual = lines(&rewritten.scene());
    let difference = difference(&expected, &actual, rewritten.is_mirrored)?;
    model.keep(&format!("{seed}-before"));
    rewritten.keep(&format!("{seed}-after"));
    let rules: Vec<&str> = chain.iter().map(|rule| REWRITINGS[*rule].name).collect();
    Some(format!("{name}, seed {seed}, scene {number}, rules {chain:?} ({}): {difference}", rules.join(", ")))
}

fn check(cases: impl IntoIterator<Item = (u64, usize, Vec<usize>)>) {
    let (mut count, mut failures) = (0, Vec::new());
    for (seed, number, chain) in cases {
        count += 1;
        failures.extend(failure(seed, number, &chain));
    }
    println!("{} of {count} scenes differ", failures.len());
    let failed = failures.len();
    failures.truncate(40);
    assert!(failures.is_empty(), "{failed} of {count} scenes differ: {failures:#?}");
}

fn chains(count: u64) -> impl Iterator<Item = (u64, usize, Vec<usize>)> {
    (1..=count).map(|seed| {
        let mut random = Random::seeded(seed ^ 0xC4A1);
        let rule = |_| (random.number() * REWRITINGS.len() as f64) as usize;
        let mut chain: Vec<usize> = (0..3).map(rule).collect();
        chain.sort_by_key(|rule| *rule == OF_POLYGONS);
        (seed, seed as usize, chain)
    })
}

#[test]
fn every_rewriting_leaves_the_lines_of_every_family_as_they_are() {
    check((0..KINDS).flat_map(|number| (0..REWRITINGS.len()).map(move |rule| (7 + number as u64, number, vec![rule]))));
}

#[test]
fn chains_of_three_rewritings_leave_the_lines_as_they_are_briefly() {
    check(chains(scenes_wanted().unwrap_or(120)));
}

#[test]
fn from_very_far_away_perspective_is_parallel_projection() {
    let mut failures = Vec::new();
    for seed in 1..=96 {
        let mut random = Random::seeded(seed);
        let (name, model) = scene(seed as usize, &mut random);
        // Random triangles intersect at such small angles that a millionth of the distance matters.
        if name == "random scenes 3" {
            continue;
        }
        // Along no axis, because a face that is edge-on in parallel projection is not edge-on in perspective.
        let direction = random.direction();
        let [parallel, far] = [model.parallel_from(direction), model.perspective_from(direction)];
        let difference = difference(&lines(&parallel.scene()), &lines(&far.scene()), false);
        if difference.is_some() {
            parallel.keep(&format!("{seed}-before"));
            far.keep(&format!("{seed}-after"));
        }
        failures.extend(difference.map(|difference| format!("{name}, seed {seed}: {difference}")));
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
#[ignore = "exhaustive: 2,000 scenes, or as many as TINTA_LINE_SCENES says"]
fn chains_of_three_rewritings_leave_the_lines_of_many_scenes_as_they_are() {
    check(chains(scenes_wanted().unwrap_or(2000)));
}
