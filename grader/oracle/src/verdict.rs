//! What the oracle says, and how an answer is judged by it.

use super::real::Real;

/// Which code a bound of rounding errors is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// The formulas of a textbook in plain `f64`: Möller-Trumbore, Plücker coordinates, plane
    /// and inside test, the quadratic formula, slabs. *Core* points are judged by this.
    Textbook,
    /// A kernel made for hard cases: Woop's shear, the sphere discriminant of Haines et al.,
    /// Ize's boxes. *Robust* points are judged by this.
    Robust,
}

/// One value for each [`Kernel`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PerKernel<T> {
    /// For textbook code.
    pub textbook: T,
    /// For robust code.
    pub robust: T,
}

impl<T> PerKernel<T> {
    /// The value of `of` for each kernel.
    pub fn each(of: impl Fn(Kernel) -> T) -> PerKernel<T> {
        PerKernel {
            textbook: of(Kernel::Textbook),
            robust: of(Kernel::Robust),
        }
    }

    /// The value for one kernel.
    pub fn get(&self, kernel: Kernel) -> &T {
        match kernel {
            Kernel::Textbook => &self.textbook,
            Kernel::Robust => &self.robust,
        }
    }
}

/// Why a ray truly misses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Miss {
    /// A number of the ray or the shape is NaN: a miss by convention.
    NotANumber,
    /// A number is infinite where a place or direction is asked for; nothing is said about such rays.
    NotFinite,
    /// The direction is 0: a miss by convention.
    NoDirection,
    /// `min_t > max_t`: no `t` counts.
    EmptyRange,
    /// A triangle of no area, or a sphere of negative radius: a miss by convention.
    Degenerate,
    /// The ray runs inside the plane of the triangle: a miss by convention, even through the triangle.
    Coplanar,
    /// The line of the ray passes beside the shape, or parallel to the triangle's plane and off it.
    Beside,
    /// The line meets the shape, but only at `t < min_t` or `t > max_t`.
    OutOfRange,
}

/// Whether correct code is sure to find something true.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sure {
    Yes,
    No,
    /// It hangs on rounding.
    Open,
}

impl Sure {
    pub(super) fn exactly(truth: bool) -> Sure {
        if truth { Sure::Yes } else { Sure::No }
    }

    pub(super) fn and(self, other: Sure) -> Sure {
        match (self, other) {
            (Sure::No, _) | (_, Sure::No) => Sure::No,
            (Sure::Yes, Sure::Yes) => Sure::Yes,
            _ => Sure::Open,
        }
    }

    /// Whether `min <= t <= max` for a `t` that is known up to `error`.
    pub(super) fn in_range(t: f64, error: f64, (min, max): (f64, f64)) -> Sure {
        if t + error < min || t - error > max {
            return Sure::No;
        }
        // An infinite end is never in doubt. Written so that an error that is NaN leaves all open.
        let above = min == f64::NEG_INFINITY || t - error > min;
        let below = max == f64::INFINITY || t + error < max;
        if above && below {
            Sure::Yes
        } else {
            Sure::Open
        }
    }
}

/// A hit that scores.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// Where, in lengths of the ray's direction.
    pub t: Real,
    /// How far from it an answer may be; infinite where rounding decides everything.
    pub tolerance: f64,
}

/// The answers that score.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answers {
    /// Hits, the one that is true or likeliest first.
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

    /// Everything scores.
    pub const ANY: Answers = Answers {
        hits: [
            Some(Candidate {
                t: Real::ZERO,
                tolerance: f64::INFINITY,
            }),
            None,
        ],
        miss: true,
    };

    /// Whether more than one answer scores: the ray is undecidable in `f64`.
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

/// What an answer is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Judgement {
    /// The only answer there is, and close enough.
    Right {
        /// How far off, in units in the last place of the true `t`; 0 for a miss.
        ulps: f64,
    },
    /// The ray is undecidable in `f64`, and this is one of the answers that score.
    Either,
    /// There is no hit.
    FalseHit,
    /// There is a hit.
    FalseMiss,
    /// There is a hit, elsewhere.
    WrongT {
        /// How far off, in units in the last place of the true `t`.
        ulps: f64,
        /// How far off it may be, in the same unit.
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
            t: Real::new(t),
            tolerance,
        })
    }

    #[test]
    fn a_decided_hit_leaves_one_answer() {
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
    fn an_undecidable_hit_still_has_its_place() {
        let answers = Answers {
            hits: [hit(2.0, 1e-12), None],
            miss: true,
        };
        assert_eq!(answers.judge(Some(2.0)), Judgement::Either);
        assert_eq!(answers.judge(None), Judgement::Either);
        assert!(!answers.judge(Some(3.0)).scores());
    }

    #[test]
    fn a_decided_miss_scores_alone() {
        assert_eq!(Answers::MISS.judge(None), Judgement::Right { ulps: 0.0 });
        assert_eq!(Answers::MISS.judge(Some(1.0)), Judgement::FalseHit);
    }

    #[test]
    fn range_ends_within_the_error_are_open() {
        let range = (1.0, 2.0);
        assert_eq!(Sure::in_range(1.5, 0.1, range), Sure::Yes);
        assert_eq!(Sure::in_range(1.0, 0.0, range), Sure::Open);
        assert_eq!(Sure::in_range(0.5, 0.1, range), Sure::No);
        assert_eq!(Sure::in_range(0.5, f64::NAN, range), Sure::Open);
        let all = (f64::NEG_INFINITY, f64::INFINITY);
        assert_eq!(Sure::in_range(0.5, f64::INFINITY, all), Sure::Yes);
    }
}
