//! Rules for parts, and their text: `bolt*: color=red, line-width=2; material:steel*: ghost`.
//!
//! A rule is a pattern, a colon and settings, separated by commas; semicolons separate rules. A role stands alone: `ghost` is
//! `as=ghost`. Of several rules for one part, each setting is that of the last rule that has it.

use crate::choice::meant_or;
use crate::error::{Error, Result};
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::parts::style::{PartRole, PartStyle};
use crate::mesh::Pattern;
use crate::scene::Color;
use crate::settings::{HasSettings, Kind, OptionValue, Options, Problem, Value};

/// Rules for parts, the earlier ones below the later ones.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PartRules(pub Vec<PartRule>);

/// A style, and the pattern that names its parts.
#[derive(Debug, Clone, PartialEq)]
pub struct PartRule {
    /// The pattern: `bolt*` for parts and models, `material:steel*` for materials.
    pub pattern: Pattern,
    /// The style, named after the pattern.
    pub style: PartStyle,
}

/// The text for no rules.
const NONE: &str = "none";

impl PartRules {
    /// What separates rules.
    pub const BETWEEN: &'static str = "; ";

    /// Whether hidden lines of any part are drawn.
    pub fn draw_hidden(&self) -> bool {
        self.have(PartStyle::draws_hidden)
    }

    /// Whether any rule has a style like this.
    pub(in crate::lines) fn have(&self, is_such: impl Fn(&PartStyle) -> bool) -> bool {
        self.0.iter().any(|rule| is_such(&rule.style))
    }

    /// The patterns of parts with a role, and whether a section leaves them whole; none if it leaves no part whole.
    pub fn uncut(&self) -> Vec<(Pattern, bool)> {
        let of_role = |rule: &PartRule| Some((rule.pattern.clone(), rule.style.role? == PartRole::Uncut));
        let roles: Vec<(Pattern, bool)> = self.0.iter().filter_map(of_role).collect();
        if roles.iter().any(|(_, is_whole)| *is_whole) { roles } else { Vec::new() }
    }

    /// Refuses styles that the drawing cannot have.
    ///
    /// # Errors
    ///
    /// Those of [`DrawingSettings::check`].
    pub fn check(&self, drawing: &DrawingSettings) -> Result<()> {
        let named = |error: Error| Error::setting("part", error.to_string());
        self.0.iter().try_for_each(|rule| rule.style.drawing(drawing).check().map_err(named))
    }
}

impl PartRule {
    fn text(&self) -> String {
        let setting = |setting: &crate::settings::Setting<PartStyle>| {
            let value = setting.value(&self.style).filter(|value| !value.is_empty())?;
            Some(if setting.name == PartStyle::ROLE { value } else { format!("{}={value}", setting.name) })
        };
        let settings: Vec<String> = PartStyle::table().settings.iter().filter_map(setting).collect();
        format!("{}: {}", self.pattern.0, settings.join(", "))
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        let usage = || format!("{}: write PATTERN: SETTINGS, for instance bolt*: color=red, ghost", text.trim());
        // No setting holds a colon, but patterns may.
        let (pattern, settings) = text.rsplit_once(':').ok_or_else(usage)?;
        let pattern = pattern.trim();
        if pattern.is_empty() {
            return Err(usage().into());
        }
        let table = PartStyle::table();
        let mut options = Options::new();
        for setting in outside_parentheses(settings) {
            let (name, value) = setting.split_once('=').unwrap_or((PartStyle::ROLE, setting));
            let (name, value) = (name.trim(), value.trim());
            if value.is_empty() {
                return Err(usage().into());
            }
            if !table.has(name) {
                let names = table.settings.iter().map(|setting| setting.name);
                let names: Vec<&str> = names.filter(|name| *name != PartStyle::ROLE).collect();
                let otherwise = format!("choose {}, or ghost, occlude-only, uncut or solid alone", names.join(", "));
                return Err(
                    format!("{pattern}: a part has no setting {name}; {}", meant_or(name, &names, &otherwise)).into()
                );
            }
            if name == PartStyle::ROLE && Color::parse(value).is_ok() {
                let problem = format!("{pattern}: say color={value} for its lines, fill={value} for its surface");
                return Err(problem.into());
            }
            table
                .check(name, value)
                .map_err(|problem| format!("{pattern}: {setting}: {problem}", setting = setting.trim()))?;
            if options.insert(name.to_owned(), OptionValue::text(value)).is_some() {
                return Err(format!("{pattern}: {name} comes twice; leave one of them out").into());
            }
        }
        let style = PartStyle { name: pattern.to_owned(), ..PartStyle::from_options(&options)? };
        Ok(Self { pattern: Pattern(pattern.to_owned()), style })
    }
}

/// The texts between commas that are not within parentheses, which colours have.
fn outside_parentheses(text: &str) -> Vec<&str> {
    let mut depth = 0_i32;
    text.split(|letter: char| {
        depth += i32::from(letter == '(') - i32::from(letter == ')');
        letter == ',' && depth <= 0
    })
    .collect()
}

impl Value for PartRules {
    fn kind() -> Kind {
        Kind::Text { offered: &[], example: "*: color=#ff0000, line-width=3, classes=silhouette+crease; *: ghost" }
    }

    fn text(&self) -> String {
        match self.0.as_slice() {
            [] => NONE.to_owned(),
            rules => rules.iter().map(PartRule::text).collect::<Vec<_>>().join(Self::BETWEEN),
        }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        if text == NONE {
            return Ok(Self::default());
        }
        text.split(';')
            .filter(|rule| !rule.trim().is_empty())
            .map(PartRule::parse)
            .collect::<std::result::Result<_, _>>()
            .map(Self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::{Class, ClassSet};
    use crate::lines::parts::style::PartRole;

    fn rules(text: &str) -> std::result::Result<PartRules, String> {
        PartRules::parse(text).map_err(|problem| match problem {
            Problem::Text(text) => text,
            Problem::Refused(error) => error.to_string(),
        })
    }

    #[test]
    fn rules_are_read_and_written() {
        let text = "bolt*: color=#ff0000, line-width=2, classes=silhouette+crease, hidden=dashed, occlude-only; material:a: ghost";
        let read = rules(text).unwrap();
        assert_eq!(
            read.text(),
            "bolt*: color=#ff0000, line-width=2, classes=silhouette+crease, hidden=dashed, occlude-only; material:a: ghost"
        );
        let [bolts, steel] = &read.0[..] else { panic!("two rules") };
        assert_eq!(bolts.style.classes, Some(ClassSet::of(&[Class::Silhouette, Class::Crease])));
        assert_eq!((bolts.style.role, steel.style.role), (Some(PartRole::OccludeOnly), Some(PartRole::Ghost)));
        assert_eq!(steel.pattern, Pattern("material:a".to_owned()));
        assert_eq!(rules(&read.text()).unwrap(), read);
        assert_eq!(rules("a:b: color=rgb(255,0,0),as=solid;").unwrap(), rules("a:b: color=red, solid").unwrap());
        assert_eq!((rules("none").unwrap(), PartRules::default().text()), (PartRules::default(), NONE.to_owned()));
    }

    #[test]
    fn what_is_no_rule_is_refused_with_what_was_meant() {
        for (text, problem) in [
            ("bolt*", "write PATTERN: SETTINGS"),
            (": ghost", "write PATTERN: SETTINGS"),
            ("bolt*:", "write PATTERN: SETTINGS"),
            ("bolt*: colour=red", "bolt*: a part has no setting colour; did you mean color?"),
            ("bolt*: wobble=1", "a part has no setting wobble; choose color, fill, line-width"),
            ("bolt*: ghostt", "bolt*: ghostt: did you mean ghost?"),
            ("bolt*: color=redd", "a colour is a CSS name"),
            ("bolt*: red", "bolt*: say color=red for its lines, fill=red for its surface"),
            ("bolt*: ghost, solid", "bolt*: as comes twice"),
            ("bolt*: classes=creases", "did you mean crease?"),
            ("bolt*: crease-angle=200", "between 0 and 180"),
        ] {
            let refused = rules(text).unwrap_err();
            assert!(refused.contains(problem), "{text}: {refused}");
        }
    }

    proptest::proptest! {
        #[test]
        fn no_text_makes_the_reader_panic(text in "[a-z*:;,=()#0-9 -]{0,40}|\\PC*") {
            if let Ok(read) = rules(&text) {
                proptest::prop_assert_eq!(rules(&read.text()).unwrap(), read);
            }
        }
    }
}
