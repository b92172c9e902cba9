//! Two mistakes at once.

use super::{Cases, Signature, SignatureKey};
use std::collections::BTreeSet;

impl Signature {
    /// How this signature agrees with that of code which makes two mistakes, `first` and `second`.
    /// If both mistakes make the same value wrong, the value may show either of them. Where one
    /// mistake causes a miss or a crash, the other may not show.
    pub fn agreement_with_both(&self, first: &Signature, second: &Signature) -> Together {
        let mut together = Together::default();
        let of_tier = [self, first, second].map(|signature| match self.core.is_empty() {
            true => &signature.robust,
            false => &signature.core,
        });
        let keys: BTreeSet<&SignatureKey> = of_tier.iter().flat_map(|cases| cases.keys()).collect();
        for key in keys {
            let [student, one, other] = of_tier.map(|cases| {
                let codes = cases.get(key);
                codes.map_or(&[][..], |codes| &codes.0)
            });
            let hidden_by = [of_tier[2], of_tier[1]].map(|cases| Hiding::of(cases, key));
            for call in 0..student.len().max(one.len()).max(other.len()) {
                let at = |codes: &[u16]| codes.get(call).copied().unwrap_or(0);
                let made = [at(one), at(other)];
                let seen = at(student);
                for i in [0, 1] {
                    if made[i] != 0 && made[1 - i] == 0 && !(seen == 0 && hidden_by[i].at(call)) {
                        together.alone[i].of += 1;
                        together.alone[i].shown += usize::from(seen == made[i]);
                    }
                }
                let explained = made.contains(&seen);
                together.equal += usize::from(seen != 0 && explained);
                together.either += usize::from(match (seen, made) {
                    (0, [0, 0]) => false,
                    (0, [_, 0]) => !hidden_by[0].at(call),
                    (0, [0, _]) => !hidden_by[1].at(call),
                    // If both mistakes make this value wrong, the result may equal neither of them.
                    (_, [a, b]) => seen == 0 || explained || a == b || a == 0 || b == 0,
                });
            }
        }
        together
    }
}

/// How a signature agrees with those of two mistakes together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Together {
    /// Values that are wrong in the same way as with one of the two mistakes.
    pub equal: usize,
    /// Values that are wrong, or would be wrong if both mistakes are made.
    pub either: usize,
    /// The values that only the first makes wrong, and those that only the second makes wrong.
    pub alone: [Alone; 2],
}

/// Values that only one of two mistakes makes wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Alone {
    /// How many there are.
    pub of: usize,
    /// How many of them are wrong in that way.
    pub shown: usize,
}

impl Together {
    /// Share of all wrong values that are wrong in the same way.
    pub fn likeness(&self) -> f64 {
        self.equal as f64 / self.either.max(1) as f64
    }
}

/// What keeps another mistake from showing in a side of a case.
pub(super) struct Hiding<'a> {
    crashed: bool,
    /// Codes of wrong hits and misses: nothing else is judged there.
    decisions: &'a [u16],
}

impl Hiding<'_> {
    pub(super) fn of<'a>(cases: &'a Cases, key: &SignatureKey) -> Hiding<'a> {
        let decisions = key.hit_or_miss().and_then(|key| cases.get(&key));
        Hiding {
            crashed: cases.contains_key(&key.crash()),
            decisions: decisions.map_or(&[], |codes| &codes.0),
        }
    }

    pub(super) fn at(&self, call: usize) -> bool {
        self.crashed || self.decisions.get(call).is_some_and(|code| *code != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::signature;
    use super::*;

    #[test]
    fn two_mistakes_explain_what_neither_does_alone() {
        let of = |codes| signature(&[("case t", codes)]);
        let (first, second) = (of("1 2*a 1*b"), of("3 1*d 2*f"));
        let both = of("1 2*a 1*c 2*f").agreement_with_both(&first, &second);
        let alone = |shown, of| Alone { of, shown };
        assert_eq!(
            both,
            Together {
                equal: 4,
                either: 4,
                alone: [alone(2, 2), alone(2, 2)]
            }
        );
        let not_made = of("1 2*a 1*b").agreement_with_both(&first, &second);
        assert_eq!(not_made.alone[1], alone(0, 2));
        assert!(not_made.likeness() < 1.0);
    }

    #[test]
    fn a_miss_hides_what_else_is_wrong() {
        let decision = ("case decision", "1 1*e");
        let both = signature(&[("case t", "1*a"), decision]);
        let [t, miss] = [("case t", "2*a"), decision].map(|side| signature(&[side]));
        let together = both.agreement_with_both(&t, &miss);
        assert!((together.likeness() - 1.0).abs() < 1e-12);
    }
}
