//! Compares the pages with the options of the command line.

use super::*;

fn whole() -> Command {
    let mut whole = Program::default().command_line().disable_help_subcommand(true);
    whole.build();
    whole
}

#[test]
fn every_command_has_a_page_and_every_long_option_is_on_it_with_its_help() {
    let (whole, pages) = (whole(), pages(&Program::default()));
    assert_eq!(pages.len(), whole.get_subcommands().count() + 1);
    let mut options = 0;
    for command in whole.get_subcommands() {
        let file = format!("tinta-{}.1", command.get_name());
        let page = &pages.iter().find(|page| page.file == file).expect(&file).text;
        for arg in command.get_arguments().filter(|arg| !arg.is_hide_set()) {
            let Some(long) = arg.get_long() else { continue };
            let name = format!("\\-\\-{}", long.replace('-', "\\-"));
            let rest = page.lines().skip_while(|line| !line.contains(&format!("\\fB{name}\\fR"))).nth(1);
            let help = rest.unwrap_or_else(|| panic!("{file} has no --{long}"));
            let first: String = arg.get_help().unwrap().to_string().chars().take_while(|c| c.is_alphabetic()).collect();
            assert!(help.starts_with(&first) && !first.is_empty(), "{file} --{long}: {help:?}");
            options += 1;
        }
    }
    assert!(options > 150, "only {options} options");
}

#[test]
fn every_page_has_its_sections_and_the_programs_own_names_all_others() {
    let pages = pages(&Program::default());
    for Page { file, text } in &pages {
        for section in ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS"] {
            assert_eq!(text.matches(&format!("\n.SH {section}\n")).count(), 1, "{file}: {section}");
        }
        if file != "tinta.1" {
            let name = file.trim_end_matches(".1").replace('-', "\\-");
            assert!(pages[0].text.contains(&format!("{name}(1)")), "tinta.1 does not name {file}");
        }
    }
}
