//! Simple rays: through a chosen point at a chosen `t`.

use super::complexity;
use wire::work::{Ray, Xyz};

/// Directions for rays through a shape, along +z or -z and slanted. [`permuted`] turns them.
pub(crate) const DIRECTIONS: [Xyz; 9] = [
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [0.0, 0.0, 2.0],
    [0.0, 0.0, -2.0],
    [0.0, 0.0, 0.5],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, -1.0],
    [-1.0, 1.0, 1.0],
    [1.0, 2.0, -2.0],
];

/// `v` with its axes moved on by `turn`: for 1, what was along z is along x.
pub(crate) fn permuted(v: Xyz, turn: usize) -> Xyz {
    [0, 1, 2].map(|axis| v[(axis + 3 - turn % 3) % 3])
}

/// The ray along `d` that is at the point `p` at `t`, with the range `min_t..=max_t`.
pub(crate) fn through(p: Xyz, d: Xyz, t: f64, [min_t, max_t]: [f64; 2]) -> Ray {
    Ray {
        // The sum of 0 removes the sign of a zero, which would only confuse.
        o: [0, 1, 2].map(|axis| p[axis] - t * d[axis] + 0.0),
        d,
        min_t,
        max_t,
    }
}

/// The ray's part of the complexity of a question.
pub(crate) fn complexity_of(ray: &Ray) -> u32 {
    let fields = ray.o.into_iter().chain(ray.d);
    complexity(fields.chain([ray.min_t, ray.max_t]))
}

/// Ranges around a hit at `t` that decide it by a margin: they contain `t`, end before it or start
/// behind it. No end is near `t`.
pub(crate) fn ranges(t: f64) -> Vec<[f64; 2]> {
    let open = [0.0, f64::INFINITY];
    let mut ranges = vec![
        open,
        [0.0, 0.5 * t.abs()],
        [0.0, t.abs() + 1.0],
        [t.abs() + 1.0, f64::INFINITY],
        [1.0, 5.0],
        [-5.0, -0.5],
        [-5.0, 5.0],
    ];
    ranges.retain(|range| range.iter().all(|end| (end - t).abs() >= 0.25));
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_is_at_its_point_at_t() {
        let ray = through([1.0, 1.0, 0.0], [0.0, 0.0, 2.0], 1.0, [0.0, 9.0]);
        assert_eq!(ray.o, [1.0, 1.0, -2.0]);
        assert_eq!(permuted([1.0, 2.0, 3.0], 1), [3.0, 1.0, 2.0]);
    }

    #[test]
    fn no_range_ends_at_the_hit() {
        for t in [1.0, 2.0, -1.0, 5.0] {
            assert!(ranges(t).len() >= 3, "{t}");
        }
        assert!(!ranges(1.0).contains(&[1.0, 5.0]));
    }
}
