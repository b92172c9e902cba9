//! What changed between two snapshots, in words.

use super::parse::Snapshot;
use crate::plural;
use std::fmt;

/// The changes that a reviewer is told of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// Calls that only one of the two has.
    pub calls: usize,
    /// Hits that became misses.
    pub now_miss: usize,
    /// Misses that became hits.
    pub now_hit: usize,
    /// Hits of another primitive.
    pub primitive: usize,
    /// Hits of the same primitive with another `t`.
    pub t: usize,
    /// The largest difference of `t` in units in the last place.
    pub max_t_ulps: f64,
    /// Lines whose other figures differ.
    pub other: usize,
    /// Whether the totals differ.
    pub totals: bool,
    /// Numbers of the calls that differ.
    pub differing: Vec<u32>,
}

/// Compares two snapshots of the same case.
pub fn changes(old: &Snapshot, new: &Snapshot) -> Changes {
    let mut changes = Changes {
        calls: old.lines.len().abs_diff(new.lines.len()),
        totals: old.totals != new.totals,
        ..Changes::default()
    };
    for (old, new) in old.lines.iter().zip(&new.lines) {
        if old == new {
            continue;
        }
        changes.differing.push(new.call);
        match (old.is_miss(), new.is_miss()) {
            (false, true) => changes.now_miss += 1,
            (true, false) => changes.now_hit += 1,
            _ if old.number("prim") != new.number("prim") => changes.primitive += 1,
            _ => match (old.number("t"), new.number("t")) {
                (Some(a), Some(b)) if a != b => {
                    changes.t += 1;
                    changes.max_t_ulps = changes.max_t_ulps.max(ulps_between(a, b));
                }
                _ => changes.other += 1,
            },
        }
    }
    changes
}

/// How many floats apart two floats of the same sign are; infinite otherwise.
fn ulps_between(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() || a.signum() != b.signum() {
        return f64::INFINITY;
    }
    a.to_bits().abs_diff(b.to_bits()) as f64
}

impl Changes {
    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        *self == Changes::default()
    }
}

impl fmt::Display for Changes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut said = Vec::new();
        let mut say = |count: usize, what: &str| {
            if count > 0 {
                said.push(format!("{} {what}", plural(count, "call", "calls")));
            }
        };
        say(self.calls, "added or removed");
        say(self.now_hit, "now hit");
        say(self.now_miss, "now miss");
        say(self.primitive, "changed primitive");
        say(self.t, "changed t");
        say(self.other, "changed otherwise");
        if self.t > 0 {
            said.push(format!("max Δt {} ulp", self.max_t_ulps));
        }
        if self.totals {
            said.push("the totals changed".into());
        }
        if said.is_empty() {
            return f.write_str("nothing changed");
        }
        f.write_str(&said.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::super::parse;
    use super::*;

    #[test]
    fn each_kind_of_change_is_told_apart() {
        let old =
            parse("0: -> t=1 prim=0\n1: -> t=2 prim=1\n2: -> miss\n3: -> t=1 prim=3\n").unwrap();
        let new = parse(
            "0: -> t=1.0000000000000002 prim=0\n1: -> miss\n2: -> t=5 prim=0\n3: -> t=1 prim=4\n",
        )
        .unwrap();
        let changes = changes(&old, &new);
        assert_eq!(
            changes.to_string(),
            "1 call now hit, 1 call now miss, 1 call changed primitive, 1 call changed t, max Δt 1 ulp"
        );
        assert_eq!(changes.differing, [0, 1, 2, 3]);
    }

    #[test]
    fn a_snapshot_does_not_differ_from_itself() {
        let text = "# box_tests=12\n0: o=(1,2,3) -> t=1 prim=0\n1: o=(NaN,2,3) -> t=NaN\n";
        let same = parse(text).unwrap();
        assert!(changes(&same, &parse(text).unwrap()).is_empty());
    }
}
