//! Rules on made-up numbers, and that no claim is without a place, a rule and a command.

use super::*;
use std::collections::BTreeSet;

fn all() -> Vec<Claim> {
    Text::ALL.into_iter().flat_map(claims).collect()
}

#[test]
fn every_claim_has_a_place_a_sentence_a_rule_and_a_command_and_no_two_share_an_id() {
    let all = all();
    let ids: BTreeSet<&str> = all.iter().map(|claim| claim.id).collect();
    assert_eq!(ids.len(), all.len());
    for claim in &all {
        let letter = claim.text.letter().to_ascii_lowercase();
        assert!(claim.id.starts_with(&format!("{letter}-")), "{}", claim.id);
        assert!(claim.line > 0 && !claim.section.is_empty(), "{}", claim.id);
        assert!(claim.says.ends_with('.') && !claim.says.contains('|') && !claim.rule.contains('|'), "{}", claim.id);
        assert!(!claim.rule.ends_with('.') && !claim.rule.is_empty(), "{}", claim.id);
        assert!(claim.command.starts_with("tinta ") || claim.command.starts_with("cargo "), "{}", claim.id);
    }
    for text in Text::ALL {
        let lines: Vec<u32> = claims(text).iter().map(|claim| claim.line).collect();
        assert!(lines.is_sorted(), "{text:?}: the claims are not in the text's order: {lines:?}");
    }
}

#[test]
fn a_rule_decides_and_a_number_that_is_none_decides_nothing() {
    let verdict = |holds, value| Finding::of(holds, vec![Number::new("x", value, "", 0)]).verdict;
    assert_eq!(verdict(true, 1.0), Verdict::Confirmed);
    assert_eq!(verdict(false, 1.0), Verdict::Refuted);
    for value in [f64::NAN, f64::INFINITY] {
        assert_eq!(verdict(true, value), Verdict::NotDecided);
    }
}

#[test]
fn numbers_are_written_with_their_unit_and_without_minus_nothing() {
    let written = |number: Number| number.to_string();
    assert_eq!(written(Number::share("found", 0.8504)), "found: 85.0 %");
    assert_eq!(written(Number::percent("gain", -0.3)), "gain: 0 %");
    assert_eq!(written(Number::percent("gain", -7.6)), "gain: -8 %");
    assert_eq!(written(Number::count("cases", 18)), "cases: 18");
}

#[test]
fn what_follows_from_section_5_is_not_decided_without_it() {
    let of_section_5 = all().into_iter().filter(|claim| matches!(claim.measure, Measure::Section5(_))).count();
    assert!(of_section_5 >= 9, "{of_section_5}");
}
