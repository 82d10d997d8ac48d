use super::*;
use std::collections::BTreeSet;
use tinta::glsl::SOURCES;

#[test]
fn every_setting_of_every_style_says_whose_its_default_is() {
    let table = Style::table();
    // No text has exact lines.
    for style in table.defaults.iter().filter(|style| !style.style_name().draws_lines()) {
        for setting in table.of(Some(style)) {
            assert!(
                setting.provenance.is_some(),
                "{} of {}: add .printed, .deduced or .ours",
                setting.name,
                style.name()
            );
        }
    }
}

#[test]
fn every_style_has_rows_and_each_is_a_phrase() {
    for (_, name) in StyleName::of_passes() {
        let rows = rows(Some(name));
        assert!(rows.len() > 2, "{name:?}");
        for row in rows {
            assert!(!row.why.is_empty() && !row.otherwise.is_empty(), "{row:?}");
            assert!(!row.why.ends_with('.') && !row.name.is_empty(), "{row:?}");
            assert!(row.whose == Whose::Ours || row.why.starts_with(['E', 'D', 'V']), "no text is named: {row:?}");
        }
    }
}

/// The numbers of a shader except 0 and 1, without suffixes, comments and the preprocessor's version lines.
fn numbers(source: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for line in source.lines() {
        let code = line.split("//").next().unwrap_or_default();
        if code.starts_with("#version") {
            continue;
        }
        let mut rest = code;
        while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
            let is_word = rest[..start].ends_with(|c: char| c.is_ascii_alphabetic() || c == '_');
            let from = &rest[start..];
            let end = from.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(from.len());
            let number = &from[..end];
            rest = &from[end..];
            // The end of a name may be digits and letters.
            if is_word {
                rest = rest.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || c == '_');
            } else if number.parse::<f64>().is_ok_and(|value| value != 0.0 && value != 1.0) {
                found.insert(number.to_owned());
            }
        }
    }
    found
}

#[test]
fn numbers_are_found_where_they_stand() {
    let source = "#version 120\n// 7\n#define F 0.2f // 9\nvec4 a1=texture2D(map,vec2(4*E,1.0)); float x=8.0+0.5;\n";
    assert_eq!(numbers(source), ["0.2", "0.5", "4", "8.0"].map(str::to_owned).into());
}

#[test]
fn every_number_of_every_shader_says_whose_it_is() {
    for (path, source) in SOURCES {
        let told: BTreeSet<String> = SHADERS
            .iter()
            .filter(|row| row.path == *path)
            .flat_map(|row| row.numbers.iter().map(|number| (*number).to_owned()))
            .collect();
        assert_eq!(numbers(source), told, "{path}, in src/provenance/shaders.rs");
    }
    for row in SHADERS {
        assert!(SOURCES.iter().any(|(path, _)| *path == row.path), "{} is no shader", row.path);
    }
}

#[test]
fn the_page_has_every_row_and_every_shaders_numbers() {
    let page = page();
    let lines: Vec<&str> = page.lines().collect();
    for row in rows(None) {
        let line = format!(
            "| {} | {} | {} | {} | {} |",
            cell(&row.name),
            cell(&row.value),
            names(&row),
            cell(row.why),
            cell(row.otherwise)
        );
        let at = lines.iter().position(|other| *other == line).unwrap_or_else(|| panic!("{line} is not there"));
        let heading_before = lines[..at].iter().rev().find_map(|line| line.strip_prefix("## "));
        assert_eq!(heading_before, Some(heading(row.whose)), "{line}");
    }
    for row in SHADERS {
        let start = format!("| `glsl/{}` | {} | {} |", row.path, row.numbers.join(", "), row.provenance.whose.name());
        assert!(lines.iter().any(|line| line.starts_with(&start)), "{start} is not there");
    }
    let tables = lines.iter().filter(|line| line.starts_with("| ")).count();
    assert_eq!(tables, rows(None).len() + SHADERS.len() + 4, "and nothing else but the headings of the tables");
}

#[test]
fn the_document_counts_the_rows_of_every_style() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/texts/errata.md");
    let document = std::fs::read_to_string(path).unwrap();
    let document = document.split_whitespace().collect::<Vec<_>>().join(" ");
    for (name, style) in StyleName::of_passes() {
        let rows = rows(Some(style));
        let [printed, deduced, ours] = [Whose::Printed, Whose::Deduced, Whose::Ours]
            .map(|whose| rows.iter().filter(|row| row.whose == whose).count());
        let counts = format!("`{name}` {printed}, {deduced}, {ours}");
        let is_there = [";", " ("].iter().any(|end| document.contains(&format!("{counts}{end}")));
        assert!(is_there, "docs/texts/errata.md: {counts}");
    }
}
