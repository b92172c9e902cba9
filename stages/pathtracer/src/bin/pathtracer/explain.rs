//! Which effects a scene calls for, by what, and what they take.

use kit::effects::{Call, EffectCounts};

/// As many causes of an effect are told by name; of the others, how many there are.
const NAMED: usize = 4;

/// A line an effect: whether it is called for, how many operations were `counted`, how many there are if all effects are
/// `forced` on (unknown if that was not counted), and by what it is called for.
pub(crate) fn table(
    calls: &[Call],
    counted: &EffectCounts,
    forced: Option<&EffectCounts>,
) -> String {
    let mut table = format!(
        "{:<16} {:<10} {:>12} {:>12}  {:<18}  because",
        "Effect", "called for", "counted", "if forced on", "operations"
    );
    for call in calls {
        let effect = call.effect;
        let line = format!(
            "\n{:<16} {:<10} {:>12} {:>12}  {:<18}  {}",
            effect.name(),
            if call.is_called_for() { "yes" } else { "no" },
            counted.of(effect),
            forced.map_or("?".to_owned(), |forced| forced.of(effect).to_string()),
            effect.operation(),
            in_short(&call.because)
        );
        table += line.trim_end();
    }
    table
}

/// The first few causes. Objects that share a name, as instances of one node do, are told once.
fn in_short(causes: &[String]) -> String {
    let mut named: Vec<(&str, usize)> = Vec::new();
    let mut others = 0;
    for cause in causes {
        let is_room = named.len() < NAMED;
        match named.iter_mut().find(|(name, _)| name == cause) {
            Some((_, times)) => *times += 1,
            None if is_room => named.push((cause, 1)),
            None => others += 1,
        }
    }
    let named = named.iter().map(|&(name, times)| match times {
        1 => name.to_owned(),
        _ => format!("{name} ({times} times)"),
    });
    let told = named.collect::<Vec<_>>().join(", ");
    match others {
        0 => told,
        _ => format!("{told} and {others} more"),
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
        assert_eq!(in_short(&[]), "");
        assert_eq!(
            in_short(&causes(&["light a", "object b"])),
            "light a, object b"
        );
    }

    #[test]
    fn many_causes_are_told_in_short() {
        let names = ["a", "b", "a", "c", "d", "e", "f", "e", "a"];
        assert_eq!(in_short(&causes(&names)), "a (3 times), b, c, d and 3 more");
    }
}
