//! Describes what changed between two snapshots.

use super::line::{Line, Value};
use super::parse::Snapshot;
use crate::tools::plural;
use std::fmt;

/// The changes that a reviewer reads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// The difference of the numbers of calls.
    pub calls: usize,
    /// Answers that became `None`.
    pub now_none: usize,
    /// `None` that became an answer.
    pub now_some: usize,
    /// What an answer that is not `None` means in this case.
    meaning: Meaning,
    /// Hits of another primitive.
    pub primitive: usize,
    /// Hits of the same primitive with another `t`.
    pub t: usize,
    /// The largest difference of `t` in units in the last place.
    pub max_t_ulps: f64,
    /// Rows that differ in other fields only.
    pub other: usize,
    /// The names of these fields, in the order in which the first row with each of them has them.
    pub other_fields: Vec<String>,
    /// Whether the totals differ.
    pub totals: bool,
    /// Whether the hash of all rows differs.
    pub hash: bool,
    /// Numbers of the calls whose rows differ.
    pub differing: Vec<u32>,
    /// How many rows were compared and how many calls there are, if not every call has a row.
    pub sample: Option<(usize, usize)>,
}

/// What an answer that is not `None` means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Meaning {
    /// The ray hits.
    #[default]
    Hit,
    /// The path continues.
    Continues,
    /// There is a direction or a sample.
    Some,
}

impl Meaning {
    /// The meaning of the answers in such a row.
    fn of(answered: &Line) -> Meaning {
        match answered.answer.first().map(|(field, _)| field.as_str()) {
            Some("goes_on") => Meaning::Continues,
            Some("wi") => Meaning::Some,
            _ => Meaning::Hit,
        }
    }

    /// What calls do now that did not before, and the reverse.
    fn words(self) -> [&'static str; 2] {
        match self {
            Meaning::Hit => ["now hit", "now miss"],
            Meaning::Continues => ["now continue the path", "now end the path"],
            Meaning::Some => ["now return Some", "now return None"],
        }
    }
}

/// Compares two snapshots of the same case.
pub fn changes(old: &Snapshot, new: &Snapshot) -> Changes {
    let mut changes = Changes {
        calls: old.calls.abs_diff(new.calls),
        totals: old.totals != new.totals,
        hash: old.hash.zip(new.hash).is_some_and(|(old, new)| old != new),
        sample: (!old.is_whole()).then_some((old.lines.len(), old.calls)),
        ..Changes::default()
    };
    for old in &old.lines {
        let Some(new) = new.row(old.call) else {
            continue;
        };
        if old == new {
            continue;
        }
        changes.differing.push(new.call);
        match (old.is_miss(), new.is_miss()) {
            (false, true) => {
                changes.now_none += 1;
                changes.meaning = Meaning::of(old);
            }
            (true, false) => {
                changes.now_some += 1;
                changes.meaning = Meaning::of(new);
            }
            _ if old.number("prim") != new.number("prim") => changes.primitive += 1,
            _ => match (old.number("t"), new.number("t")) {
                (Some(a), Some(b)) if a != b => {
                    changes.t += 1;
                    changes.max_t_ulps = changes.max_t_ulps.max(ulps_between(a, b));
                }
                _ => {
                    changes.other += 1;
                    changes.add_fields(old, new);
                }
            },
        }
    }
    changes
}

/// The distance of two floats of the same sign in units in the last place; otherwise infinite.
fn ulps_between(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() || a.signum() != b.signum() {
        return f64::INFINITY;
    }
    a.to_bits().abs_diff(b.to_bits()) as f64
}

impl Changes {
    /// Adds the names of the fields in which two rows differ.
    fn add_fields(&mut self, old: &Line, new: &Line) {
        let named = |line: &Line, name: &str| -> Vec<Value> {
            let fields = line.fields().filter(|(field, _)| field == name);
            fields.map(|(_, value)| value.clone()).collect()
        };
        for (name, _) in old.fields().chain(new.fields()) {
            if named(old, name) != named(new, name) && !self.other_fields.contains(name) {
                self.other_fields.push(name.clone());
            }
        }
    }

    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        self.calls == 0 && self.differing.is_empty() && !self.totals && !self.hash
    }
}

impl fmt::Display for Changes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        let mut add = |count: usize, what: &str| {
            if count > 0 {
                parts.push(format!("{} {what}", plural(count, "call", "calls")));
            }
        };
        add(self.calls, "added or removed");
        let [now_some, now_none] = self.meaning.words();
        add(self.now_some, now_some);
        add(self.now_none, now_none);
        add(self.primitive, "changed primitive");
        add(self.t, "changed t");
        add(
            self.other,
            &format!("changed {}", self.other_fields.join(", ")),
        );
        if self.t > 0 {
            parts.push(format!("max Δt {} ulp", self.max_t_ulps));
        }
        if self.totals {
            parts.push("the totals changed".into());
        }
        if self.hash && self.differing.is_empty() {
            parts.push(match self.sample {
                Some(_) => "calls without a row changed".into(),
                None => "fields changed that only full rows have".into(),
            });
        }
        if parts.is_empty() {
            return f.write_str("nothing changed");
        }
        if let Some((rows, calls)) = self.sample
            && !self.differing.is_empty()
        {
            write!(f, "of the {rows} rows for {calls} calls: ")?;
        }
        f.write_str(&parts.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::super::parse;
    use super::*;

    #[test]
    fn each_kind_of_change_is_distinguished() {
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
    fn answers_without_hits_are_described_in_the_words_of_their_task() {
        let described =
            |old: &str, new: &str| changes(&parse(old).unwrap(), &parse(new).unwrap()).to_string();
        assert_eq!(
            described(
                "0: -> miss\n1: -> goes_on=(1,1,1)\n",
                "0: -> goes_on=(1,1,1)\n1: -> miss\n"
            ),
            "1 call now continue the path, 1 call now end the path"
        );
        assert_eq!(
            described("0: -> wi=(0,0,1) pdf=1\n", "0: -> miss\n"),
            "1 call now return None"
        );
    }

    #[test]
    fn fields_that_change_alone_are_named() {
        let old = parse("0: -> t=1 n=(0,0,1) uv=(0,1)\n1: -> t=2 n=(1,0,0) uv=(0,1)\n").unwrap();
        let new = parse("0: -> t=1 n=(0,1,0) uv=(0,1)\n1: -> t=2 n=(0,1,0) uv=(1,1)\n").unwrap();
        assert_eq!(changes(&old, &new).to_string(), "2 calls changed n, uv");
    }

    #[test]
    fn a_change_outside_the_sample_is_reported() {
        let sample = |hash: u32, t: u32| {
            let hash = format!("# calls=20 hash={hash:032x}\n");
            parse(&format!("{hash}0: -> t=1 prim=0\n7: -> t={t} prim=0\n")).unwrap()
        };
        let text = |new: &Snapshot| changes(&sample(1, 2), new).to_string();
        assert_eq!(text(&sample(1, 2)), "nothing changed");
        assert_eq!(text(&sample(2, 2)), "calls without a row changed");
        assert_eq!(
            text(&sample(2, 4)),
            "of the 2 rows for 20 calls: 1 call changed t, max Δt 4503599627370496 ulp"
        );
    }

    #[test]
    fn a_snapshot_does_not_differ_from_itself() {
        let text = "# box_tests=12\n0: o=(1,2,3) -> t=1 prim=0\n1: o=(NaN,2,3) -> t=NaN\n";
        let same = parse(text).unwrap();
        assert!(changes(&same, &parse(text).unwrap()).is_empty());
    }
}
