//! Axes permuted and turned round.

use wire::work::Xyz;

/// A permutation of the axes with signs: component `i` of the result is component `from[i]`, times
/// `signs[i]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axes {
    from: [usize; 3],
    signs: Xyz,
}

impl Axes {
    /// All axes as they are.
    pub(crate) const SAME: Axes = Axes {
        from: [0, 1, 2],
        signs: [1.0; 3],
    };

    /// `self` after `first`.
    fn after(self, first: Axes) -> Axes {
        Axes {
            from: self.from.map(|axis| first.from[axis]),
            signs: [0, 1, 2].map(|i| self.signs[i] * first.signs[self.from[i]]),
        }
    }

    /// The axes that undo these.
    pub(super) fn inverse(self) -> Axes {
        let mut inverse = Axes::SAME;
        for (i, &axis) in self.from.iter().enumerate() {
            inverse.from[axis] = i;
            inverse.signs[axis] = self.signs[i];
        }
        inverse
    }

    /// Whether the order of x and y is changed.
    pub(crate) fn swaps_xy(self) -> bool {
        self.from == [1, 0, 2]
    }

    /// Moves a vector. A zero keeps its sign: a student's own run has the same, and dividing by the
    /// other zero gives another infinity.
    pub(super) fn of(self, v: Xyz) -> Xyz {
        [0, 1, 2].map(|i| {
            let x = v[self.from[i]];
            if x == 0.0 { x } else { self.signs[i] * x }
        })
    }
}

/// Which axes a question may be moved to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum AxisMoves {
    /// None but its own.
    #[default]
    Fixed,
    /// Half turns around the axes. They keep the order in which sums over axes are rounded, and
    /// which side of a triangle is its front.
    HalfTurns,
    /// Permutations. They change the order of sums over axes, but not of minima and maxima.
    Permutations,
    /// Around z: x and y swapped, and turned round. `x² + y²` is the same.
    AroundZ,
    /// x and y swapped.
    SwapXy,
    /// x and y swapped, and half turns.
    SwapXyAndHalfTurns,
}

impl AxisMoves {
    /// All of them, the axes as they are first.
    pub(super) fn all(self) -> Vec<Axes> {
        let signs = |signs: Xyz| Axes {
            signs,
            ..Axes::SAME
        };
        let permuted = |from: [usize; 3]| Axes { from, ..Axes::SAME };
        let half_turns = [
            [1.0, 1.0, 1.0],
            [1.0, -1.0, -1.0],
            [-1.0, 1.0, -1.0],
            [-1.0, -1.0, 1.0],
        ]
        .map(signs);
        let xy = [[0, 1, 2], [1, 0, 2]].map(permuted);
        let both = |turns: &[Axes]| -> Vec<Axes> {
            let each = xy.iter();
            each.flat_map(|first| turns.iter().map(|turn| turn.after(*first)))
                .collect()
        };
        match self {
            AxisMoves::Fixed => vec![Axes::SAME],
            AxisMoves::HalfTurns => half_turns.to_vec(),
            AxisMoves::Permutations => {
                let pairs = (0..3)
                    .flat_map(|x| [0, 1, 2].map(|y| [x, y]))
                    .filter(|[x, y]| x != y);
                pairs.map(|[x, y]| permuted([x, y, 3 - x - y])).collect()
            }
            AxisMoves::AroundZ => {
                let of_y = |y: f64| [1.0, -1.0].map(|x| signs([x, y, 1.0]));
                both(&[1.0, -1.0].map(of_y).concat())
            }
            AxisMoves::SwapXy => xy.to_vec(),
            AxisMoves::SwapXyAndHalfTurns => both(&half_turns),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_move_of_axes_is_undone_by_its_inverse_and_comes_once() {
        for (moves, count) in [
            (AxisMoves::Fixed, 1),
            (AxisMoves::HalfTurns, 4),
            (AxisMoves::Permutations, 6),
            (AxisMoves::AroundZ, 8),
            (AxisMoves::SwapXy, 2),
            (AxisMoves::SwapXyAndHalfTurns, 8),
        ] {
            let all = moves.all();
            assert_eq!(all.len(), count, "{moves:?}");
            assert_eq!(all[0], Axes::SAME, "{moves:?}");
            let v = [3.0, -5.0, 7.0];
            for (i, axes) in all.iter().enumerate() {
                assert_eq!(axes.inverse().of(axes.of(v)), v, "{axes:?}");
                assert!(all[..i].iter().all(|other| other.of(v) != axes.of(v)));
            }
        }
    }

    #[test]
    fn a_zero_keeps_its_sign() {
        let turned = AxisMoves::HalfTurns.all()[3].of([0.0, -0.0, 2.0]);
        assert_eq!(turned.map(f64::to_bits), [0.0, -0.0, 2.0].map(f64::to_bits));
    }
}
