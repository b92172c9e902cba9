//! The table of `--explain`: which effects a scene calls for, why, and how many operations they
//! take.

use kit::effects::{Cause, EffectCounts, Requirement, Setting};

/// The largest number of causes that are named for an effect; the others are counted.
const MAX_NAMED: usize = 4;

/// One line an effect: whether it is called for, the operations `counted`, the operations if all
/// effects are `forced` on (`None` if these were not counted), and what calls for the effect.
pub(crate) fn table(
    requirements: &[Requirement],
    counted: &EffectCounts,
    forced: Option<&EffectCounts>,
) -> String {
    let mut table = format!(
        "{:<16} {:<10} {:>12} {:>12}  {:<18}  because",
        "Effect", "called for", "counted", "if forced on", "operations"
    );
    for requirement in requirements {
        let effect = requirement.effect;
        let causes: Vec<String> = requirement.causes.iter().map(describe).collect();
        let line = format!(
            "\n{:<16} {:<10} {:>12} {:>12}  {:<18}  {}",
            effect.name(),
            if requirement.is_called_for() {
                "yes"
            } else {
                "no"
            },
            counted.of(effect),
            forced.map_or("?".to_owned(), |forced| forced.of(effect).to_string()),
            effect.operation(),
            abbreviate(&causes)
        );
        table += line.trim_end();
    }
    table
}

/// A cause as the table names it: a setting by its flag.
fn describe(cause: &Cause) -> String {
    match cause {
        Cause::Object(name) => format!("object {name}"),
        Cause::Light(name) => format!("light {name}"),
        Cause::Setting(Setting::MaxDepth(depth)) => format!("flag -m {depth}"),
        Cause::Setting(Setting::LensRadius(_)) => "flag --lens-radius".to_owned(),
        Cause::Setting(Setting::Environment) => "flag -e".to_owned(),
    }
}

/// The first few causes. A name that several objects share, such as instances of one node, is
/// printed once.
fn abbreviate(causes: &[String]) -> String {
    let mut named: Vec<(&str, usize)> = Vec::new();
    let mut others = 0;
    for cause in causes {
        let is_full = named.len() == MAX_NAMED;
        match named.iter_mut().find(|(name, _)| name == cause) {
            Some((_, times)) => *times += 1,
            None if is_full => others += 1,
            None => named.push((cause, 1)),
        }
    }
    let named = named.iter().map(|&(name, times)| match times {
        1 => name.to_owned(),
        _ => format!("{name} ({times} times)"),
    });
    let list = named.collect::<Vec<_>>().join(", ");
    match others {
        0 => list,
        _ => format!("{list} and {others} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn causes(names: &[&str]) -> Vec<String> {
        names.iter().map(|&name| name.to_owned()).collect()
    }

    #[test]
    fn few_causes_are_all_named() {
        assert_eq!(abbreviate(&[]), "");
        assert_eq!(
            abbreviate(&causes(&["light a", "object b"])),
            "light a, object b"
        );
    }

    #[test]
    fn many_causes_are_abbreviated() {
        let names = ["a", "b", "a", "c", "d", "e", "f", "e", "a"];
        assert_eq!(
            abbreviate(&causes(&names)),
            "a (3 times), b, c, d and 3 more"
        );
    }

    #[test]
    fn settings_are_named_by_their_flags() {
        let flags = [
            (Setting::MaxDepth(6), "flag -m 6"),
            (Setting::LensRadius(0.5), "flag --lens-radius"),
            (Setting::Environment, "flag -e"),
        ];
        for (setting, flag) in flags {
            assert_eq!(describe(&Cause::Setting(setting)), flag);
        }
    }
}
