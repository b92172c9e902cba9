//! Polygons with holes: connects each hole with the boundary, which gives one polygon.
//!
//! The connection is a pair of edges, there and back (D. Eberly, "Triangulation by ear clipping",
//! 2002, section 3): from the rightmost corner of the hole to a corner of the boundary that is
//! visible from there. The rightmost hole is connected first, so that no other hole is in between.

use super::polygon::{TestCounter, TooComplex};
use super::projection::{Projection, turn};
use kit::{Vec2, Vec3};
use std::cmp::Ordering;
use std::ops::Range;

/// A boundary with its holes connected.
#[derive(Debug, PartialEq)]
pub(super) struct Boundary {
    /// The corners in order, as indices of the points.
    pub(super) corners: Vec<usize>,
    /// Number of holes that could not be connected: they are not inside.
    pub(super) ignored: usize,
}

/// Connects holes with the boundary. The boundary is the first `outline` points, each hole a range
/// of the others.
pub(super) fn connect(
    points: &[Vec3],
    outline: usize,
    holes: &[Range<usize>],
    counter: &mut TestCounter,
) -> Result<Boundary, TooComplex> {
    let mut boundary = Boundary {
        corners: (0..outline).collect(),
        ignored: 0,
    };
    let Some(projection) = Projection::of(&points[..outline]) else {
        boundary.ignored = holes.len();
        return Ok(boundary);
    };
    let flat: Vec<Vec2> = points.iter().map(|p| projection.apply(*p)).collect();
    let mut rings: Vec<Vec<usize>> = holes
        .iter()
        .map(|hole| from_the_rightmost(&flat, hole.clone()))
        .collect();
    let right_to_left = |a: &Vec<usize>, b: &Vec<usize>| flat[b[0]].x.total_cmp(&flat[a[0]].x);
    rings.sort_by(right_to_left);
    for ring in rings {
        match visible_corner(&flat, &boundary.corners, flat[ring[0]], counter)? {
            Some(at) => {
                let (corner, first) = (boundary.corners[at], ring[0]);
                // A hole that touches the boundary in this corner needs no connection.
                let touches = flat[corner] == flat[first];
                let there = if touches { &ring[1..] } else { &ring[..] };
                let back = if touches { None } else { Some(first) };
                let detour = there.iter().copied().chain(back).chain([corner]);
                boundary.corners.splice(at + 1..at + 1, detour);
            }
            None => boundary.ignored += 1,
        }
    }
    Ok(boundary)
}

/// The corners of a hole, clockwise, the rightmost first.
fn from_the_rightmost(flat: &[Vec2], hole: Range<usize>) -> Vec<usize> {
    let mut ring: Vec<usize> = hole.collect();
    let n = ring.len();
    let area: f64 = (0..n)
        .map(|i| flat[ring[i]].perp_dot(flat[ring[(i + 1) % n]]))
        .sum();
    if area > 0.0 {
        ring.reverse();
    }
    let x = |i: &usize| flat[ring[*i]].x;
    let rightmost = (0..n).max_by(|i, j| x(i).total_cmp(&x(j)));
    ring.rotate_left(rightmost.unwrap_or(0));
    ring
}

/// The nearest corner of the boundary, not to the left of `from`, that is visible from there: its
/// position in the boundary.
fn visible_corner(
    flat: &[Vec2],
    boundary: &[usize],
    from: Vec2,
    counter: &mut TestCounter,
) -> Result<Option<usize>, TooComplex> {
    let corner = |at: usize| flat[boundary[at % boundary.len()]];
    let mut candidates: Vec<usize> = (0..boundary.len())
        .filter(|at| corner(*at).x >= from.x)
        .collect();
    let distance = |at: usize| corner(at).distance_squared(from);
    let nearer = |a: &usize, b: &usize| -> Ordering { distance(*a).total_cmp(&distance(*b)) };
    candidates.sort_by(nearer);
    for at in candidates {
        counter.count(boundary.len())?;
        let to = corner(at);
        let neighbours = [corner(at + boundary.len() - 1), corner(at + 1)];
        let is_blocked =
            || (0..boundary.len()).any(|i| touches(corner(i), corner(i + 1), from, to));
        if faces(neighbours[0], to, neighbours[1], from) && !is_blocked() {
            return Ok(Some(at));
        }
    }
    Ok(None)
}

/// Whether `p` is on the inner side of the boundary at the corner `b`, between `a` and `c`.
fn faces(a: Vec2, b: Vec2, c: Vec2, p: Vec2) -> bool {
    let (left_of_ab, left_of_bc) = (turn(a, b, p) >= 0.0, turn(b, c, p) >= 0.0);
    if turn(a, b, c) > 0.0 {
        left_of_ab && left_of_bc
    } else {
        left_of_ab || left_of_bc
    }
}

/// Whether the edge `a b` touches the segment from `p` to `q`, other than in these two points.
fn touches(a: Vec2, b: Vec2, p: Vec2, q: Vec2) -> bool {
    if [a, b].iter().any(|end| *end == p || *end == q) {
        return false;
    }
    let apart = |[a, b]: [f64; 2], [p, q]: [f64; 2]| a.max(b) < p.min(q) || p.max(q) < a.min(b);
    if apart([a.x, b.x], [p.x, q.x]) || apart([a.y, b.y], [p.y, q.y]) {
        return false;
    }
    let opposite = |x: f64, y: f64| (x <= 0.0 && y >= 0.0) || (x >= 0.0 && y <= 0.0);
    opposite(turn(p, q, a), turn(p, q, b)) && opposite(turn(a, b, p), turn(a, b, q))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collada::polygon::triangulate;
    use kit::math;
    use proptest::prelude::*;

    /// Twice the signed areas of the triangles of an outline in the plane z = 0 with holes, and the
    /// number of holes that were ignored.
    fn areas(rings: &[Vec<(f64, f64)>]) -> (Vec<f64>, usize) {
        let mut points = Vec::new();
        let mut ranges = Vec::new();
        for ring in rings {
            let first = points.len();
            points.extend(ring.iter().map(|(x, y)| Vec3::new(*x, *y, 0.0)));
            ranges.push(first..points.len());
        }
        let counter = &mut TestCounter::default();
        let boundary = connect(&points, rings[0].len(), &ranges[1..], counter).expect("few tests");
        let corners: Vec<Vec3> = boundary.corners.iter().map(|i| points[*i]).collect();
        let result = triangulate(&corners, counter).expect("few tests");
        let area =
            |[a, b, c]: [usize; 3]| (corners[b] - corners[a]).cross(corners[c] - corners[a]).z;
        (
            result.triangles.into_iter().map(area).collect(),
            boundary.ignored,
        )
    }

    fn square(x: f64, y: f64, side: f64) -> Vec<(f64, f64)> {
        vec![(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
    }

    /// Checks that no triangle is clockwise, and the sum of the areas.
    fn assert_covers(rings: &[Vec<(f64, f64)>], area: f64) {
        let (areas, ignored) = areas(rings);
        assert_eq!(ignored, 0);
        assert!(areas.iter().all(|area| *area >= 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f64>() / 2.0 - area).abs() < 1e-9 * area);
    }

    #[test]
    fn holes_are_left_out_whatever_their_winding_order() {
        let hole = square(1.0, 1.0, 1.0);
        let reversed: Vec<_> = hole.iter().rev().copied().collect();
        assert_covers(&[square(0.0, 0.0, 3.0), hole], 8.0);
        assert_covers(&[square(0.0, 0.0, 3.0), reversed], 8.0);
    }

    #[test]
    fn aligned_holes_and_holes_that_touch_are_left_out() {
        let windows =
            (0..9).map(|i| square(f64::from(i % 3 * 2 + 1), f64::from(i / 3 * 2 + 1), 1.0));
        let rings: Vec<_> = [square(0.0, 0.0, 7.0)].into_iter().chain(windows).collect();
        assert_covers(&rings, 40.0);
        // The hole has a corner on the outline.
        let touching = vec![(3.0, 0.0), (2.0, 1.0), (1.0, 0.5)];
        let area = ring_area(&touching).abs();
        assert_covers(&[square(0.0, 0.0, 3.0), touching], 9.0 - area);
    }

    #[test]
    fn connections_do_not_cross_the_boundary() {
        // The nearest corner to the right of the hole is the tip (5.8, 5), behind a wall.
        let wall = [(1.0, 0.0), (5.5, 9.8), (5.6, 0.0)];
        let tip = [(10.0, 4.9), (5.8, 5.0), (10.0, 5.1)];
        let mut outline = vec![(0.0, 0.0)];
        outline.extend(wall);
        outline.push((10.0, 0.0));
        outline.extend(tip);
        outline.extend([(10.0, 10.0), (0.0, 10.0)]);
        let hole = vec![(3.2, 5.0), (2.5, 5.5), (2.4, 4.8)];
        let area = ring_area(&outline) - ring_area(&hole);
        assert_covers(&[outline, hole], area);
    }

    #[test]
    fn holes_outside_are_ignored() {
        let (areas, ignored) = areas(&[square(0.0, 0.0, 1.0), square(5.0, 0.0, 1.0)]);
        assert_eq!((areas.iter().sum::<f64>(), ignored), (2.0, 1));
    }

    /// A star-shaped ring around a point.
    fn star(center: (f64, f64), radii: &[f64]) -> Vec<(f64, f64)> {
        let angle = |i: usize| i as f64 / radii.len() as f64 * std::f64::consts::TAU;
        let point = |(i, r): (usize, &f64)| {
            (
                center.0 + r * math::cos(angle(i)),
                center.1 + r * math::sin(angle(i)),
            )
        };
        radii.iter().enumerate().map(point).collect()
    }

    fn ring_area(ring: &[(f64, f64)]) -> f64 {
        let next = |i: usize| ring[(i + 1) % ring.len()];
        let cross = |i: usize| ring[i].0 * next(i).1 - ring[i].1 * next(i).0;
        (0..ring.len()).map(cross).sum::<f64>() / 2.0
    }

    proptest! {
        /// A concave outline with concave holes on a grid inside.
        #[test]
        fn triangles_cover_all_but_the_holes(
            outline in prop::collection::vec(5.0..9.0_f64, 8..40),
            holes in prop::collection::vec(prop::collection::vec(0.1..0.95_f64, 3..12), 0..9),
        ) {
            let mut rings = vec![star((0.0, 0.0), &outline)];
            for (i, radii) in holes.iter().enumerate() {
                let (column, row) = (i as f64 % 3.0 - 1.0, (i / 3) as f64 - 1.0);
                rings.push(star((1.9 * column, 1.9 * row), radii));
            }
            let expected = ring_area(&rings[0]) - rings[1..].iter().map(|r| ring_area(r)).sum::<f64>();
            let (areas, ignored) = areas(&rings);
            prop_assert_eq!(ignored, 0);
            let size: f64 = areas.iter().map(|area| area.abs()).sum::<f64>() / 2.0;
            prop_assert!((size - expected).abs() < 1e-9 * expected, "{} {}", size, expected);
        }
    }
}
