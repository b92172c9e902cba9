//! After how many rays a tree that takes longer to build pays.

use super::TreeRow;
use serde::{Deserialize, Serialize};

/// When the time that a tree saves in tracing equals its additional build time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "when", rename_all = "snake_case")]
pub enum BreakEven {
    /// This is the tree that the others are compared with.
    Base,
    /// From the first ray on: it is faster to trace and no slower to build.
    Immediate,
    /// After a number of rays.
    After {
        /// The number for the median times.
        rays: f64,
        /// The number for the quartiles of building and tracing that favour the tree.
        at_least: f64,
        /// The number for the other quartiles.
        at_most: f64,
    },
    /// It is slower to trace.
    Never,
    /// The tracing times do not differ by more than their noise.
    WithinNoise,
}

impl BreakEven {
    /// Compares `tree` with `base`. The tracing time of `tree` is relative to that of `base`.
    pub(super) fn of(tree: &TreeRow, base: &TreeRow) -> BreakEven {
        let ratio = tree.trace.time.ratio;
        if tree.trace.time.ties_with_base() {
            return BreakEven::WithinNoise;
        }
        if ratio.median > 1.0 {
            return BreakEven::Never;
        }
        let (own, base_s) = (tree.build_s, base.build_s);
        if own.median <= base_s.median {
            return BreakEven::Immediate;
        }
        let ray_s = 1e-9 * base.trace.time.ns.median;
        let rays = |longer_s: f64, ratio: f64| longer_s.max(0.0) / (ray_s * (1.0 - ratio));
        BreakEven::After {
            rays: rays(own.median - base_s.median, ratio.median),
            at_least: rays(own.lower - base_s.upper, ratio.lower),
            at_most: rays(own.upper - base_s.lower, ratio.upper),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quartiles::Quartiles;
    use crate::timing::Timing;
    use crate::trees::{TraversalCost, WrongHits};

    fn quartiles([lower, median, upper]: [f64; 3]) -> Quartiles {
        Quartiles {
            lower,
            median,
            upper,
        }
    }

    fn tree(build_s: [f64; 3], ratio: [f64; 3]) -> TreeRow {
        let ratio = quartiles(ratio);
        TreeRow {
            name: String::new(),
            paper: String::new(),
            student: false,
            build_s: quartiles(build_s),
            nodes: None,
            trace: TraversalCost {
                time: Timing {
                    ns: ratio.scaled(1000.0),
                    ratio,
                },
                box_tests: 0.0,
                prim_tests: 0.0,
                ordinary: WrongHits { rays: 0, wrong: 0 },
                crafted: None,
            },
            break_even: BreakEven::Base,
        }
    }

    /// Compares a tree that takes this long to build with one that takes 1 s.
    fn compared(build_s: f64, ratio: [f64; 3]) -> BreakEven {
        BreakEven::of(&tree([build_s; 3], ratio), &tree([1.0; 3], [1.0; 3]))
    }

    #[test]
    fn a_faster_tree_breaks_even_within_its_error() {
        let BreakEven::After {
            rays,
            at_least,
            at_most,
        } = compared(3.0, [0.4, 0.5, 0.75])
        else {
            panic!("2 s longer to build, 500 ns saved in a ray");
        };
        assert!((rays - 4e6).abs() < 1.0);
        assert!((at_least - 2e6 / 0.6).abs() < 1.0 && (at_most - 8e6).abs() < 1.0);
        assert_eq!(compared(1.0, [0.9; 3]), BreakEven::Immediate);
    }

    #[test]
    fn the_error_of_the_build_times_counts() {
        let base = tree([0.5, 1.0, 2.5], [1.0; 3]);
        let BreakEven::After {
            at_least, at_most, ..
        } = BreakEven::of(&tree([2.0, 3.0, 4.0], [0.5; 3]), &base)
        else {
            panic!("2 s longer to build, 500 ns saved in a ray");
        };
        assert_eq!(at_least, 0.0);
        assert!((at_most - 7e6).abs() < 1.0);
    }

    #[test]
    fn a_slower_tree_never_breaks_even() {
        assert_eq!(compared(3.0, [1.1, 1.2, 1.3]), BreakEven::Never);
        assert_eq!(compared(0.5, [1.1, 1.2, 1.3]), BreakEven::Never);
    }

    #[test]
    fn a_difference_within_the_noise_decides_nothing() {
        assert_eq!(compared(3.0, [0.9, 0.97, 1.01]), BreakEven::WithinNoise);
        assert_eq!(compared(3.0, [0.98, 1.05, 1.1]), BreakEven::WithinNoise);
    }
}
