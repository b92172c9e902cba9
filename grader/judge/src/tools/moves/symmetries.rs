//! The exact symmetries of a question, and which of them a seed draws.

use super::Move;
use super::axes::AxisMoves;
use crate::tools::questions::probes::ProbeRng;
use wire::work::{Ray, Xyz};

/// The largest power of two by which light is multiplied.
const MOST_LIGHT: usize = 6;

/// Numbers beyond this and its inverse, infinities aside, are not multiplied: code that squares
/// and multiplies them may overflow.
const ORDINARY: f64 = (1_u64 << 60) as f64;

/// Which exact symmetries a question has: moves that change no rounding of any textbook's code, and
/// as few answers of code with a typical mistake as possible.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Symmetries {
    /// The axes of space.
    pub(crate) axes: AxisMoves,
    /// The largest power of two by which all lengths may be multiplied; 0 for none. Where axes
    /// move, too, it is small: code with a constant of its own, such as the largest distance that
    /// counts, should have nearly the same points.
    pub(crate) lengths: usize,
    /// The same for the directions of rays.
    pub(crate) speeds: usize,
    /// The light that may be multiplied.
    pub(crate) light: LightMoves,
    /// Whether the colour channels may be permuted.
    pub(crate) channels: bool,
    /// The number of primitives that may be numbered in another order.
    pub(crate) primitives: usize,
}

/// Which factors light may have.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum LightMoves {
    /// None.
    #[default]
    Fixed,
    /// One for all channels: luminances are computed. The brightest light of the question.
    Same(f64),
    /// One for each channel. The brightest light of the question.
    EachChannel(f64),
}

impl LightMoves {
    /// One factor for all of `light`; none if all of it is black.
    pub(crate) fn of(light: impl IntoIterator<Item = f64>) -> LightMoves {
        match light.into_iter().fold(0.0, f64::max) {
            brightest if brightest > 0.0 => LightMoves::Same(brightest),
            _ => LightMoves::Fixed,
        }
    }

    /// A factor for each channel of `light`; none if all of it is black.
    pub(crate) fn of_channels(light: impl IntoIterator<Item = f64>) -> LightMoves {
        match LightMoves::of(light) {
            LightMoves::Same(brightest) => LightMoves::EachChannel(brightest),
            fixed => fixed,
        }
    }
}

impl Symmetries {
    /// Those of rays and of shapes that `points` describe.
    pub(crate) fn of_space<'a>(
        points: impl IntoIterator<Item = Xyz>,
        rays: impl IntoIterator<Item = &'a Ray>,
    ) -> Symmetries {
        let rays = rays.into_iter().flat_map(ray_numbers);
        Symmetries {
            axes: AxisMoves::HalfTurns,
            lengths: most_if_ordinary(1, points.into_iter().flatten().chain(rays)),
            ..Symmetries::default()
        }
    }

    /// Draws a move, never the one that changes nothing if there is another.
    pub(crate) fn draw(&self, rng: &mut ProbeRng) -> Move {
        let power = |rng: &mut ProbeRng, most| 2.0_f64.powi(1 + rng.below(most) as i32);
        let factor = |rng: &mut ProbeRng, most| match most {
            0 => 1.0,
            most => power(rng, most),
        };
        let length = factor(rng, self.lengths);
        let speed = factor(rng, self.speeds);
        // Light stays on its side of 1, where code that clamps it has its mistake.
        let gain = |rng: &mut ProbeRng, brightest: f64| match brightest > 1.0 {
            true => power(rng, MOST_LIGHT),
            false => 1.0 / power(rng, MOST_LIGHT),
        };
        let light: Xyz = match self.light {
            LightMoves::Fixed => [1.0; 3],
            LightMoves::Same(brightest) => [gain(rng, brightest); 3],
            LightMoves::EachChannel(brightest) => [0; 3].map(|_| gain(rng, brightest)),
        };
        let is_multiplied = length != 1.0 || speed != 1.0 || light != [1.0; 3];
        let all = self.axes.all();
        let first = usize::from(!is_multiplied && all.len() > 1);
        let axes = all[first + rng.below(all.len() - first)];
        let channels = match self.channels {
            true => rng.one_of(&CHANNELS),
            false => [0, 1, 2],
        };
        Move {
            axes,
            length,
            speed,
            light,
            channels,
            order: shuffled(self.primitives, rng),
        }
    }
}

/// The orders of the channels that leave none in its place: two equal channels still show them.
const CHANNELS: [[usize; 3]; 2] = [[1, 2, 0], [2, 0, 1]];

/// The numbers below `count` in a random order, without the one order that changes nothing.
pub(crate) fn shuffled(count: usize, rng: &mut ProbeRng) -> Vec<u32> {
    let mut order: Vec<u32> = (0..count as u32).collect();
    for i in (1..count).rev() {
        order.swap(i, rng.below(i + 1));
    }
    if order.is_sorted() {
        order.reverse();
    }
    order
}

/// `most` if all `numbers` can be multiplied by a power of two, whatever is computed from them, and
/// one of them changes; else 0.
pub(crate) fn most_if_ordinary(most: usize, numbers: impl IntoIterator<Item = f64>) -> usize {
    let mut changes = 0;
    for x in numbers {
        let size = x.abs();
        if x == 0.0 || !size.is_finite() {
            continue;
        }
        if !(1.0 / ORDINARY..=ORDINARY).contains(&size) {
            return 0;
        }
        changes = most;
    }
    changes
}

/// All numbers of a ray.
pub(crate) fn ray_numbers(ray: &Ray) -> [f64; 8] {
    let ([ox, oy, oz], [dx, dy, dz]) = (ray.o, ray.d);
    [ox, oy, oz, dx, dy, dz, ray.min_t, ray.max_t]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawn_move_changes_something_and_its_inverse_undoes_it() {
        let mut rng = ProbeRng::new("moves", 1);
        let all = [
            Symmetries {
                axes: AxisMoves::HalfTurns,
                ..Symmetries::default()
            },
            Symmetries {
                lengths: 3,
                ..Symmetries::default()
            },
            Symmetries {
                light: LightMoves::EachChannel(0.5),
                ..Symmetries::default()
            },
            Symmetries {
                channels: true,
                ..Symmetries::default()
            },
            Symmetries {
                primitives: 2,
                ..Symmetries::default()
            },
        ];
        for symmetries in all {
            for _ in 0..100 {
                let drawn = symmetries.draw(&mut rng);
                assert!(!drawn.is_identity(), "{symmetries:?}");
                assert_eq!(drawn.inverse().inverse(), drawn);
                let there = drawn.light(drawn.direction(drawn.point([1.0, -2.0, 3.0])));
                let back = drawn.inverse();
                let here = back.point(back.direction(back.light(there)));
                assert_eq!(here, [1.0, -2.0, 3.0], "{drawn:?}");
            }
        }
        assert!(Symmetries::default().draw(&mut rng).is_identity());
    }

    #[test]
    fn light_stays_on_its_side_of_1() {
        let mut rng = ProbeRng::new("light", 1);
        for (brightest, brighter) in [(0.5, false), (1.0, false), (1.5, true)] {
            let symmetries = Symmetries {
                light: LightMoves::Same(brightest),
                ..Symmetries::default()
            };
            for _ in 0..50 {
                let factor = symmetries.draw(&mut rng).light([1.0; 3])[0];
                assert_eq!(factor > 1.0, brighter, "{factor}");
            }
        }
    }

    #[test]
    fn extreme_numbers_and_zeros_are_not_multiplied() {
        let ordinary = [0.0, -1e-9, 1e9, f64::INFINITY, f64::NAN];
        assert_eq!(most_if_ordinary(3, ordinary), 3);
        assert_eq!(most_if_ordinary(3, [0.0, f64::INFINITY]), 0);
        assert_eq!(most_if_ordinary(3, [1.0, 1e-30]), 0);
        assert_eq!(most_if_ordinary(3, [f64::MAX]), 0);
    }
}
