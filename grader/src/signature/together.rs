//! Compares a signature with those of two known mistakes that may be made together.

use super::{Cases, Signature, SignatureKey, codes_at};
use std::collections::BTreeSet;

impl Signature {
    /// How many of the values that `mistake` makes wrong are wrong here in the same way. Not
    /// counted are values that a crash or a wrong hit or miss hides here, nor hits and misses
    /// themselves: a miss is the same whatever causes the miss.
    pub fn shows(&self, mistake: &Signature) -> Alone {
        let mut shows = Alone::default();
        let sides = mistake.cases().iter();
        for (key, codes) in sides.filter(|(key, _)| !key.side.is_decision()) {
            let mine = codes_at(self.cases(), key);
            let hidden = Hiding::of(self.cases(), key);
            for (call, code) in codes.0.iter().enumerate() {
                let here = mine.get(call).copied().unwrap_or(0);
                if *code != 0 && !(here == 0 && hidden.at(call)) {
                    shows.of += 1;
                    shows.shown += usize::from(here == *code);
                }
            }
        }
        shows
    }

    /// How this signature agrees with that of code that makes two mistakes, `first` and `second`.
    /// If both make the same value wrong, it may be wrong in either way. If one of them causes a
    /// crash or a wrong hit or miss, other values need not be wrong there: a false hit changes the
    /// ray, but not if the other mistake is that hits change no ray.
    pub fn agreement_with_both(&self, first: &Signature, second: &Signature) -> Together {
        let mut together = Together::default();
        let of_tier = [self, first, second].map(|signature| match self.core.is_empty() {
            true => &signature.robust,
            false => &signature.core,
        });
        let keys: BTreeSet<&SignatureKey> = of_tier.iter().flat_map(|cases| cases.keys()).collect();
        for key in keys {
            let [student, one, other] = of_tier.map(|cases| codes_at(cases, key));
            let hiding = [of_tier[1], of_tier[2]].map(|cases| Hiding::of(cases, key));
            let is_hidden = |call| hiding.iter().any(|hiding| hiding.at(call));
            for call in 0..student.len().max(one.len()).max(other.len()) {
                let at = |codes: &[u16]| codes.get(call).copied().unwrap_or(0);
                let expected = [at(one), at(other)];
                let actual = at(student);
                for i in [0, 1] {
                    if expected[i] != 0 && expected[1 - i] == 0 && !(actual == 0 && is_hidden(call))
                    {
                        together.alone[i].of += 1;
                        together.alone[i].shown += usize::from(actual == expected[i]);
                    }
                }
                let explained = expected.contains(&actual);
                together.equal += usize::from(actual != 0 && explained);
                together.either += usize::from(match (actual, expected) {
                    (0, [0, 0]) => false,
                    (0, [_, 0] | [0, _]) => !is_hidden(call),
                    // If the two make the value wrong in different ways, together they may make it
                    // wrong in a third way: such a value is not counted.
                    (_, [a, b]) => actual == 0 || explained || a == b || a == 0 || b == 0,
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
    /// Values that are wrong, or that would be wrong if both mistakes were made.
    pub either: usize,
    /// For each of the two mistakes, the values that only this mistake makes wrong.
    pub alone: [Alone; 2],
}

/// The values that only one of two mistakes makes wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Alone {
    /// How many there are.
    pub of: usize,
    /// How many of them are also wrong in the compared signature (for a pair: in the same way).
    pub shown: usize,
}

impl Together {
    /// The fraction of all wrong values that are wrong in the same way.
    pub fn likeness(&self) -> f64 {
        self.equal as f64 / self.either.max(1) as f64
    }
}

/// The calls of one side of a case in which a mistake hides all others: after a crash, or after a
/// wrong hit or miss, nothing else is judged.
pub(super) struct Hiding<'a> {
    crashed: bool,
    /// Codes of wrong hits and misses, call by call.
    decisions: &'a [u16],
}

impl Hiding<'_> {
    pub(super) fn of<'a>(cases: &'a Cases, key: &SignatureKey) -> Hiding<'a> {
        let decisions = key.decisions().find_map(|key| cases.get(&key));
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
    fn a_false_hit_need_not_change_the_ray_if_hits_change_no_ray() {
        let false_hit = ("case decision", "4 2*e");
        let ray_after = |codes| ("case ray_after", codes);
        let unchanged = signature(&[ray_after("4*a")]);
        let outside = signature(&[false_hit, ray_after("4 2*b")]);
        let both = signature(&[false_hit, ray_after("4*a")]);
        let together = both.agreement_with_both(&unchanged, &outside);
        assert_eq!((together.equal, together.either), (6, 6));
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
