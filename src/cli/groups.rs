//! Options of the command line that hold several settings: `--page A4,margin=10mm` sets `page` and `margin`. Presets, recipes and
//! records know the settings alone.

use clap::{Arg, ArgAction};
use tinta::choice::{meant_or, nearest};
use tinta::request::Request;
use tinta::settings::{HasSettings, Kind, OptionValue, Setting, Table, with_mentions};

/// An option: the setting of its name, if there is one, and those inside it.
#[derive(Debug, Clone)]
pub(super) struct Group<T: 'static> {
    pub name: &'static str,
    pub plain: Option<&'static Setting<T>>,
    pub inside: Vec<&'static Setting<T>>,
}

/// Between an option's own help and that of the settings inside it.
pub(super) const ALSO: &str = "\n  ";

/// The value's placeholder of an option without a setting of its own.
pub(super) const HOLDING: &str = "NAME=VALUE";

/// The options of these settings, in their order; an option without a setting of its own has the place of the first inside it.
pub(super) fn groups<T>(settings: impl Iterator<Item = &'static Setting<T>>) -> Vec<Group<T>> {
    let mut groups: Vec<Group<T>> = Vec::new();
    for setting in settings {
        let name = setting.group.unwrap_or(setting.name);
        let place = groups.iter().position(|group| group.name == name).unwrap_or_else(|| {
            groups.push(Group { name, plain: None, inside: Vec::new() });
            groups.len() - 1
        });
        match setting.group {
            Some(_) => groups[place].inside.push(setting),
            None => groups[place].plain = Some(setting),
        }
    }
    groups
}

impl<T: Clone + Send + Sync + 'static> Group<T> {
    /// The heading that lists it.
    pub(super) fn heading(&self) -> &'static str {
        self.settings().next().map_or("", |setting| setting.heading)
    }

    /// Its settings.
    pub(super) fn settings(&self) -> impl Iterator<Item = &'static Setting<T>> {
        self.plain.into_iter().chain(self.inside.iter().copied())
    }

    /// The option of several settings.
    pub(super) fn arg(&self, table: &'static Table<T>) -> Arg {
        let default =
            |setting: &Setting<T>| setting.said_default.map_or_else(|| table.default_of(setting), str::to_owned);
        let said = |setting: &&Setting<T>| match setting.kind {
            Kind::Flag => format!("{}: {}", setting.name, setting.help),
            _ => format!("{}={}: {} ({})", setting.name, setting.value_name, setting.help, default(setting)),
        };
        let inside: Vec<String> = self.inside.iter().map(said).collect();
        let help = match self.plain {
            Some(plain) => [vec![format!("{} [default: {}]", plain.help, default(plain))], inside].concat().join(ALSO),
            None => format!("{}\n[default: each as in brackets]", inside.join("\n")),
        };
        let group = self.clone();
        let check = move |text: &str| group.checked(table, text).map(|()| text.to_owned());
        Arg::new(self.name)
            .long(self.name)
            .help(in_groups(&help))
            .hide_short_help(!self.settings().any(|setting| setting.is_common))
            .action(ArgAction::Append)
            .value_name(self.plain.map_or(HOLDING, |plain| plain.value_name))
            .value_parser(check)
            .allow_hyphen_values(true)
    }

    fn names(&self) -> Vec<&'static str> {
        self.inside.iter().map(|setting| setting.name).collect()
    }

    /// How the settings inside it are given.
    fn holding(&self) -> String {
        format!("write NAME=VALUE with one of {}", self.names().join(", "))
    }

    /// What a wrong value meant by its first `NAME=` that is near the name of a setting inside, or of a gone option.
    fn meant(&self, value: &str) -> Option<String> {
        let mut words = value.split(',').filter_map(|word| Some(word.split_once('=')?.0));
        words.find_map(|word| {
            Request::gone(word).or_else(|| Some(format!("did you mean {}?", nearest(word, &self.names())?)))
        })
    }

    /// Checks each value alone.
    fn checked(&self, table: &Table<T>, text: &str) -> Result<(), String> {
        self.split(text)?.into_iter().try_for_each(|(name, value)| match value {
            OptionValue::Text(value) => {
                let is_choice = self.plain.is_some_and(|plain| matches!(plain.kind, Kind::Choice(_)));
                let told = |problem: String| match name == self.name {
                    true if problem.ends_with('?') || !is_choice => problem,
                    true => format!("{problem}, or {}", self.holding()),
                    false => format!("{name}: {problem}"),
                };
                table.check(name, &value).map_err(|problem| self.meant(&value).unwrap_or_else(|| told(problem)))
            }
            _ => Ok(()),
        })
    }

    /// The settings that a text gives. A word that begins no setting continues the value before it: values may hold commas.
    pub(super) fn split(&self, text: &str) -> Result<Vec<(&'static str, OptionValue)>, String> {
        let mut given: Vec<(&'static str, OptionValue)> = Vec::new();
        for word in text.split(',') {
            let (name, value) = word.split_once('=').map_or((word, None), |(name, value)| (name, Some(value)));
            let of_name =
                |setting: &&&Setting<T>| setting.name == name && (setting.kind == Kind::Flag) == value.is_none();
            match (self.inside.iter().find(of_name), value, given.last_mut(), self.plain) {
                (Some(setting), Some(value), ..) => given.push((setting.name, OptionValue::text(value))),
                (Some(setting), None, ..) => given.push((setting.name, OptionValue::Switch(true))),
                (None, _, Some((_, OptionValue::Text(value))), _) => *value += &format!(",{word}"),
                (None, _, None, Some(plain)) => given.push((plain.name, OptionValue::text(word))),
                _ => return Err(meant_or(name, &self.names(), &self.holding())),
            }
        }
        Ok(given)
    }
}

/// A sentence with each `--margin 3mm` as the command line takes it: `--page margin=3mm`.
pub(super) fn in_groups(sentence: &str) -> String {
    with_mentions(sentence, |before, name, rest| {
        // Within a file's name it is no option.
        let is_option =
            (before.is_empty() || before.ends_with([' ', '(', '`'])) && !rest.starts_with(['/', '\\', '.', '_']);
        let setting = Request::table().settings.iter().find(|setting| is_option && setting.name == name)?;
        let group = setting.group?;
        let word = rest.strip_prefix([' ', '=']).and_then(|rest| rest.split([' ', ';', ':', ')', ']']).next());
        // At the beginning stands the value that is wrong, before what is wrong with it.
        let is_wrong = |word: &str| ["", "tinta: "].contains(&before) && rest[1 + word.len()..].starts_with(':');
        let is_value = |word: &&str| {
            let is_plain = !matches!(setting.kind, Kind::Flag | Kind::File) && !word.is_empty();
            is_plain && (is_wrong(word) || Request::table().check(name, word.trim_end_matches(',')).is_ok())
        };
        Some(match word.filter(is_value) {
            Some(word) => format!("--{group} {name}={word}{}", &rest[1 + word.len()..]),
            None => format!("--{group} {name}{rest}"),
        })
    })
}

/// What an option that is inside another is now; `None` for any other name.
pub(super) fn inside_now(name: &str) -> Option<String> {
    let setting = Request::table().settings.iter().find(|setting| setting.name == name)?;
    let group = setting.group?;
    let value = if setting.kind == Kind::Flag { String::new() } else { format!("={}", setting.value_name) };
    // Many programs mean a sheet by it.
    let sheet = if name == "paper" { ", or --page A4 for a sheet of paper" } else { "" };
    Some(format!("{name} is inside an option; write --{group} {name}{value}{sheet}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(group: &str, text: &str) -> Result<Vec<(&'static str, OptionValue)>, String> {
        let groups = groups(Request::table().of(None).into_iter());
        groups.iter().find(|of| of.name == group).unwrap().split(text)
    }

    #[test]
    fn values_are_split_at_the_names_of_settings_alone() {
        let text = OptionValue::text;
        assert_eq!(split("page", "A4,margin=1cm"), Ok(vec![("page", text("A4")), ("margin", text("1cm"))]));
        let lights = vec![("light-1", text("1,-2,3")), ("light-2", text("0,0,1"))];
        assert_eq!(split("light", "light-1=1,-2,3,light-2=0,0,1"), Ok(lights));
        assert!(split("grain", "densty=3").unwrap_err().contains("did you mean density?"));
    }

    #[test]
    fn sentences_name_settings_as_the_command_line_takes_them() {
        for (plain, said) in [
            ("--margin 3km: give a length", "--page margin=3km: give a length"),
            ("--margin: give a length", "--page margin: give a length"),
            ("--tone-light has no effect on lines", "--light tone-light has no effect on lines"),
            ("--light-1 and --light-2: they are equal", "--light light-1 and --light light-2: they are equal"),
            ("leave out --lasting-creases, or --tones 2", "leave out --crease-angle lasting-creases, or --tones 2"),
            ("a -- b --no-such", "a -- b --no-such"),
            ("/a--near/b --near.obj: gone", "/a--near/b --near.obj: gone"),
        ] {
            assert_eq!(in_groups(plain), said);
        }
    }
}
