//! Damage of JSON that stays JSON: what a reader of bytes never gets to.

use crate::Random;
use serde_json::{Value, json};

/// Replaces, removes or repeats a value somewhere in `value`, once or several times.
pub fn damage_json(value: &mut Value, random: &mut Random) {
    for _ in 0..=random.below(3) {
        damage_one(value, random);
    }
}

fn damage_one(value: &mut Value, random: &mut Random) {
    // Deeper values are more.
    let goes_deeper = random.below(8) > 0;
    match value {
        Value::Object(fields) if goes_deeper && !fields.is_empty() => {
            let name = fields
                .keys()
                .nth(random.below(fields.len()))
                .cloned()
                .unwrap_or_default();
            if random.below(12) == 0 {
                fields.remove(&name);
            } else if let Some(inside) = fields.get_mut(&name) {
                damage_one(inside, random);
            }
        }
        Value::Array(values) if goes_deeper && !values.is_empty() => {
            let at = random.below(values.len());
            match random.below(12) {
                0 => drop(values.remove(at)),
                1 => values.push(values[at].clone()),
                _ => damage_one(&mut values[at], random),
            }
        }
        other => *other = random.pick(&replacements()).clone(),
    }
}

/// Values at which readers go wrong: the ends of numbers, texts that are obeyed, other types.
fn replacements() -> [Value; 20] {
    [
        json!(null),
        json!(true),
        json!(0),
        json!(-1),
        json!(u64::MAX),
        json!(i64::MIN),
        json!(0.1),
        json!(-0.0),
        json!(1e308),
        json!(-1e308),
        json!(5e-324),
        json!(""),
        json!("part1.task3"),
        json!("\u{1b}[2J\u{202e}\r\n\0"),
        json!("</script><script>"),
        json!("../../../etc/passwd"),
        json!("x".repeat(10_000)),
        json!([]),
        json!({}),
        json!([[[[{ "a": [null] }]]]]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damage_changes_nearly_always_something_and_is_the_same_for_the_same_seed() {
        let whole = json!({ "a": [1, 2, { "b": "text" }], "c": 0.5 });
        let damaged = |seed| {
            let mut value = whole.clone();
            damage_json(&mut value, &mut Random::new(seed));
            value
        };
        let all: Vec<Value> = (0..100).map(damaged).collect();
        assert_eq!(all, (0..100).map(damaged).collect::<Vec<_>>());
        let changed = all.iter().filter(|value| **value != whole).count();
        assert!(changed > 90, "{changed}");
    }
}
