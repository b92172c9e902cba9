//! The oracle's result, and how an answer is judged by it.

use super::big_float::BigFloat;

/// The class of code that an error bound is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KernelClass {
    /// Textbook formulas in plain `f64`: Möller-Trumbore, Plücker coordinates, plane and inside
    /// test, the quadratic formula, slabs. *Core* points are graded with these bounds.
    Textbook,
    /// A kernel for hard cases: Woop's shear, the sphere discriminant of Haines et al., Ize's box
    /// test. *Robust* points are graded with these bounds.
    Robust,
}

/// One value for each [`KernelClass`].
///
/// ```
/// use oracle::{KernelClass, PerKernel};
/// let bound = PerKernel::each(|kernel| match kernel {
///     KernelClass::Textbook => 8,
///     KernelClass::Robust => 2,
/// });
/// assert_eq!(*bound.get(KernelClass::Robust), 2);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PerKernel<T> {
    /// For textbook code.
    pub textbook: T,
    /// For robust code.
    pub robust: T,
}

impl<T> PerKernel<T> {
    /// Calls `of` for each kernel class.
    pub fn each(of: impl Fn(KernelClass) -> T) -> PerKernel<T> {
        PerKernel {
            textbook: of(KernelClass::Textbook),
            robust: of(KernelClass::Robust),
        }
    }

    /// Returns the value for one kernel class.
    pub fn get(&self, kernel: KernelClass) -> &T {
        match kernel {
            KernelClass::Textbook => &self.textbook,
            KernelClass::Robust => &self.robust,
        }
    }
}

/// The exact reason why a ray misses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Miss {
    /// A number of the ray or the shape is NaN: a miss by convention.
    NotANumber,
    /// A position or direction is infinite: a miss by convention for a triangle, which textbook code
    /// does not see; not specified for other shapes.
    NotFinite,
    /// The direction is 0: a miss by convention.
    ZeroDirection,
    /// `min_t > max_t`: the range is empty.
    EmptyRange,
    /// A triangle without area, or a sphere of negative radius: a miss by convention.
    Degenerate,
    /// The ray lies in the plane of the triangle: a miss by convention, even through the triangle.
    Coplanar,
    /// The line of the ray does not meet the shape, or it is parallel to the triangle's plane and
    /// not in it.
    LineMisses,
    /// The line meets the shape, but only at `t < min_t` or `t > max_t`.
    OutOfRange,
}

/// Whether a statement holds for all correct code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Certainty {
    Yes,
    No,
    /// It depends on rounding.
    Undecided,
}

impl Certainty {
    pub(super) fn exact(truth: bool) -> Certainty {
        if truth { Certainty::Yes } else { Certainty::No }
    }

    pub(super) fn and(self, other: Certainty) -> Certainty {
        match (self, other) {
            (Certainty::No, _) | (_, Certainty::No) => Certainty::No,
            (Certainty::Yes, Certainty::Yes) => Certainty::Yes,
            _ => Certainty::Undecided,
        }
    }

    /// Whether `min <= t <= max` for a `t` that is known up to `error`.
    pub(super) fn in_range(t: f64, error: f64, (min, max): (f64, f64)) -> Certainty {
        if t + error < min || t - error > max {
            return Certainty::No;
        }
        // An infinite end is always satisfied. The comparisons are written so that a NaN error
        // gives `Undecided`.
        let above = min == f64::NEG_INFINITY || t - error > min;
        let below = max == f64::INFINITY || t + error < max;
        if above && below {
            Certainty::Yes
        } else {
            Certainty::Undecided
        }
    }
}

/// A hit that scores.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The exact `t`, in lengths of the ray's direction.
    pub t: BigFloat,
    /// Largest difference of an answer that scores; infinite if rounding can change any digit.
    pub tolerance: f64,
}

/// The set of answers that score.
///
/// ```
/// use oracle::{Answers, BigFloat, Candidate, Judgement};
/// let answers = Answers {
///     hits: [
///         Some(Candidate {
///             t: BigFloat::new(2.0),
///             tolerance: 1e-12,
///         }),
///         None,
///     ],
///     miss: false,
/// };
/// assert_eq!(answers.judge(Some(2.0)), Judgement::Right { ulps: 0.0 });
/// assert!(matches!(answers.judge(Some(2.5)), Judgement::WrongT { .. }));
/// assert_eq!(Answers::MISS.judge(Some(2.0)), Judgement::FalseHit);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answers {
    /// Hits that score, the true or most likely one first.
    pub hits: [Option<Candidate>; 2],
    /// Whether "no hit" scores.
    pub miss: bool,
}

impl Answers {
    /// Only "no hit" scores.
    pub const MISS: Answers = Answers {
        hits: [None; 2],
        miss: true,
    };

    /// Every answer scores.
    pub const ANY: Answers = Answers {
        hits: [
            Some(Candidate {
                t: BigFloat::ZERO,
                tolerance: f64::INFINITY,
            }),
            None,
        ],
        miss: true,
    };

    /// Whether more than one answer scores, which means that the ray is undecidable in `f64`.
    pub fn undecidable(&self) -> bool {
        let hits = self.hits.iter().flatten().count();
        hits + usize::from(self.miss) > 1
    }

    /// Judges an answer: the `t` of a hit, or `None` for a miss.
    pub fn judge(&self, answer: Option<f64>) -> Judgement {
        let Some(t) = answer else {
            return match (self.miss, self.undecidable()) {
                (true, true) => Judgement::Either,
                (true, false) => Judgement::Right { ulps: 0.0 },
                (false, _) => Judgement::FalseMiss,
            };
        };
        let mut worst = Judgement::FalseHit;
        for candidate in self.hits.iter().flatten() {
            let ulps = candidate.t.ulps(t);
            let bound = candidate.tolerance / candidate.t.ulp();
            let is_free = candidate.tolerance == f64::INFINITY && !t.is_nan();
            let is_close = (t - candidate.t.to_f64()).abs() <= candidate.tolerance;
            if is_free || is_close || ulps <= 1.0 {
                return match self.undecidable() {
                    true => Judgement::Either,
                    false => Judgement::Right { ulps },
                };
            }
            if worst == Judgement::FalseHit {
                worst = Judgement::WrongT { ulps, bound };
            }
        }
        worst
    }
}

/// The result of judging an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Judgement {
    /// The only correct answer, and `t` is within the tolerance.
    Right {
        /// Error of `t` in units in the last place of the true value; 0 for a miss.
        ulps: f64,
    },
    /// The ray is undecidable in `f64`, and this answer is one of those that score.
    Either,
    /// The answer is a hit; the ray misses.
    FalseHit,
    /// The answer is a miss; the ray hits.
    FalseMiss,
    /// The ray hits, but `t` is outside the tolerance.
    WrongT {
        /// Error of `t` in units in the last place of the true value.
        ulps: f64,
        /// The tolerance, in the same unit.
        bound: f64,
    },
}

impl Judgement {
    /// Whether the answer scores.
    pub fn scores(&self) -> bool {
        matches!(self, Judgement::Right { .. } | Judgement::Either)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hit(t: f64, tolerance: f64) -> Option<Candidate> {
        Some(Candidate {
            t: BigFloat::new(t),
            tolerance,
        })
    }

    #[test]
    fn only_the_hit_scores_on_a_decided_hit() {
        let answers = Answers {
            hits: [hit(2.0, 1e-12), None],
            miss: false,
        };
        assert_eq!(answers.judge(Some(2.0)), Judgement::Right { ulps: 0.0 });
        assert!(answers.judge(Some(2.0 + 1e-13)).scores());
        assert!(matches!(answers.judge(Some(2.1)), Judgement::WrongT { ulps, .. } if ulps > 1e14));
        assert!(!answers.judge(Some(f64::NAN)).scores());
        assert_eq!(answers.judge(None), Judgement::FalseMiss);
    }

    #[test]
    fn t_is_still_judged_on_an_undecidable_hit() {
        let answers = Answers {
            hits: [hit(2.0, 1e-12), None],
            miss: true,
        };
        assert_eq!(answers.judge(Some(2.0)), Judgement::Either);
        assert_eq!(answers.judge(None), Judgement::Either);
        assert!(!answers.judge(Some(3.0)).scores());
    }

    #[test]
    fn only_the_miss_scores_on_a_decided_miss() {
        assert_eq!(Answers::MISS.judge(None), Judgement::Right { ulps: 0.0 });
        assert_eq!(Answers::MISS.judge(Some(1.0)), Judgement::FalseHit);
    }

    #[test]
    fn range_ends_within_the_error_are_undecided() {
        let range = (1.0, 2.0);
        assert_eq!(Certainty::in_range(1.5, 0.1, range), Certainty::Yes);
        assert_eq!(Certainty::in_range(1.0, 0.0, range), Certainty::Undecided);
        assert_eq!(Certainty::in_range(0.5, 0.1, range), Certainty::No);
        assert_eq!(
            Certainty::in_range(0.5, f64::NAN, range),
            Certainty::Undecided
        );
        let all = (f64::NEG_INFINITY, f64::INFINITY);
        assert_eq!(Certainty::in_range(0.5, f64::INFINITY, all), Certainty::Yes);
    }
}
