//! Triangulation of polygons: a fan for a convex polygon, otherwise ear clipping (G. Meisters,
//! "Polygons have ears", 1975).

use super::projection::{Projection, turn};
use kit::{Vec2, Vec3};

/// Maximum number of point-in-triangle tests for a file, about one or two seconds. The time of ear
/// clipping grows with the square of a polygon's size, in the worst case with its cube.
const MAX_TESTS: u64 = 200_000_000;

/// Counts the point-in-triangle tests over all polygons of a file.
#[derive(Debug, Default)]
pub(crate) struct TestCounter {
    tests: u64,
}

impl TestCounter {
    /// Counts `more` tests. An error if there are too many.
    pub(crate) fn count(&mut self, more: usize) -> Result<(), TooComplex> {
        self.tests += more as u64;
        if self.tests > MAX_TESTS {
            return Err(TooComplex);
        }
        Ok(())
    }
}

/// Error: the polygons of a file need more than [`MAX_TESTS`] tests.
#[derive(Debug)]
pub(crate) struct TooComplex;

/// The triangles of a polygon.
#[derive(Debug, PartialEq)]
pub(crate) struct Triangulation {
    /// Three corners each, as indices in the polygon, with the winding order of the polygon.
    pub(crate) triangles: Vec<[usize; 3]>,
    /// False if the polygon has no area or an intersection of its edges was detected, so that
    /// triangles may overlap. Not every intersection is detected.
    pub(crate) simple: bool,
}

/// Triangulates a polygon of at least 3 corners into `corners.len() - 2` triangles.
///
/// The polygon need not be planar: it is projected along its mean normal (Newell's method).
pub(crate) fn triangulate(
    corners: &[Vec3],
    counter: &mut TestCounter,
) -> Result<Triangulation, TooComplex> {
    let fan = |simple| Triangulation {
        triangles: (1..corners.len() - 1).map(|i| [0, i, i + 1]).collect(),
        simple,
    };
    if corners.len() == 3 {
        return Ok(fan(true));
    }
    let Some(projection) = Projection::of(corners) else {
        return Ok(fan(false));
    };
    let flat: Vec<Vec2> = corners.iter().map(|p| projection.apply(*p)).collect();
    if is_convex(&flat) {
        return Ok(fan(true));
    }
    clip_ears(&flat, counter)
}

/// Whether every corner is a strict left turn and the polygon winds around once.
fn is_convex(flat: &[Vec2]) -> bool {
    let n = flat.len();
    let left_turns = (0..n).all(|i| turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) > 0.0);
    // All corners of a star are also left turns, but some triangles of its fan are clockwise.
    left_turns && (1..n - 1).all(|i| turn(flat[0], flat[i], flat[i + 1]) > 0.0)
}

fn clip_ears(flat: &[Vec2], counter: &mut TestCounter) -> Result<Triangulation, TooComplex> {
    let mut remaining: Vec<usize> = (0..flat.len()).collect();
    let mut triangles = Vec::with_capacity(flat.len() - 2);
    let mut simple = true;
    let mut at = 0;
    let mut failures = 0;
    while remaining.len() > 3 {
        let n = remaining.len();
        let ear = [
            remaining[(at + n - 1) % n],
            remaining[at % n],
            remaining[(at + 1) % n],
        ];
        // After a full round without an ear the polygon is not simple: clips the corner anyway.
        let forced = failures >= n;
        if forced || is_ear(flat, &remaining, ear, counter)? {
            simple &= !forced;
            triangles.push(ear);
            remaining.remove(at % n);
            // Continues two corners further, which gives less thin triangles than clipping around
            // one corner.
            at = if at % n == n - 1 { 0 } else { at % n + 1 };
            failures = 0;
        } else {
            at = (at + 1) % n;
            failures += 1;
        }
    }
    // The last triangle of a self-intersecting polygon may be clockwise.
    let last = [remaining[0], remaining[1], remaining[2]];
    simple &= turn(flat[last[0]], flat[last[1]], flat[last[2]]) >= 0.0;
    triangles.push(last);
    Ok(Triangulation { triangles, simple })
}

/// Whether the triangle is a left turn and contains no other corner.
fn is_ear(
    flat: &[Vec2],
    remaining: &[usize],
    ear: [usize; 3],
    counter: &mut TestCounter,
) -> Result<bool, TooComplex> {
    let [a, b, c] = ear.map(|i| flat[i]);
    let turns_left = turn(a, b, c) > 0.0;
    counter.count(if turns_left { remaining.len() } else { 1 })?;
    if !turns_left {
        return Ok(false);
    }
    let inside = |p: Vec2| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    let is_corner = |p: Vec2| p == a || p == b || p == c;
    Ok(!remaining
        .iter()
        .any(|i| inside(flat[*i]) && !is_corner(flat[*i])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::math;
    use proptest::prelude::*;

    fn triangulated(corners: &[Vec3]) -> Triangulation {
        triangulate(corners, &mut TestCounter::default()).expect("the polygon is small")
    }

    /// Twice the area vectors of the triangles.
    fn doubled_areas(corners: &[Vec3], triangulation: &Triangulation) -> Vec<Vec3> {
        let area =
            |[a, b, c]: &[usize; 3]| (corners[*b] - corners[*a]).cross(corners[*c] - corners[*a]);
        triangulation.triangles.iter().map(area).collect()
    }

    fn flat(points: &[(f64, f64)]) -> Vec<Vec3> {
        points.iter().map(|(x, y)| Vec3::new(*x, *y, 0.0)).collect()
    }

    #[test]
    fn convex_polygons_become_fans() {
        let square = flat(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        assert_eq!(
            triangulated(&square),
            Triangulation {
                triangles: vec![[0, 1, 2], [0, 2, 3]],
                simple: true
            }
        );
    }

    #[test]
    fn corner_on_an_edge_gives_no_degenerate_triangle() {
        // A fan from the first corner would have a triangle without area: 0, 1, 2 are collinear.
        let square = flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        let result = triangulated(&square);
        assert!(result.simple);
        assert!(
            doubled_areas(&square, &result)
                .iter()
                .all(|area| area.z > 0.0)
        );
    }

    #[test]
    fn self_intersecting_polygons_give_all_triangles() {
        let star: Vec<_> = (0..5)
            .map(|i| f64::from(i) * 2.0 * std::f64::consts::TAU / 5.0)
            .map(|angle| (math::cos(angle), math::sin(angle)))
            .collect();
        assert_eq!(triangulated(&flat(&star)).triangles.len(), 3);
        let bow = triangulated(&flat(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 1.0)]));
        assert_eq!((bow.triangles.len(), bow.simple), (2, false));
    }

    #[test]
    fn polygons_without_area_are_not_simple() {
        let line = flat(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0)]);
        assert!(!triangulated(&line).simple);
        assert!(!triangulated(&[Vec3::ONE; 6]).simple);
    }

    #[test]
    fn spiral_is_triangulated_without_overlap() {
        let arm = |radius: f64, i: i32| {
            let angle = 0.3 * f64::from(i);
            let r = radius + 0.1 * f64::from(i);
            (r * math::cos(angle), r * math::sin(angle))
        };
        let outer = (0..60).map(|i| arm(1.0, i));
        let inner = (0..60).rev().map(|i| arm(0.5, i));
        let spiral = flat(&outer.chain(inner).collect::<Vec<_>>());
        let result = triangulated(&spiral);
        assert!(result.simple);
        let areas = doubled_areas(&spiral, &result);
        let sign = areas[0].z.signum();
        assert!(areas.iter().all(|area| area.z * sign > 0.0));
    }

    proptest! {
        /// Star-shaped polygons, mostly concave, with any orientation in space.
        #[test]
        fn triangles_cover_the_polygon_exactly_once(
            radii in prop::collection::vec(0.2..1.0_f64, 4..40),
            turn in prop::array::uniform3(-1.0..1.0_f64),
            scale in 1e-6..1e6_f64,
            backwards: bool,
        ) {
            let n = radii.len();
            let up = (Vec3::from(turn) + Vec3::new(0.0, 0.0, 2.0)).normalize();
            let right = up.any_orthonormal_vector();
            let ahead = up.cross(right);
            let mut corners: Vec<Vec3> = radii
                .iter()
                .enumerate()
                .map(|(i, r)| (i as f64 / n as f64 * std::f64::consts::TAU, scale * r))
                .map(|(angle, r)| r * math::cos(angle) * right + r * math::sin(angle) * ahead)
                .collect();
            if backwards {
                corners.reverse();
            }
            let result = triangulated(&corners);
            prop_assert!(result.simple);
            prop_assert_eq!(result.triangles.len(), n - 2);
            // Every triangle has the winding order of the polygon, and the areas add up to that of
            // the polygon.
            let whole: Vec3 = (0..n).map(|i| corners[i].cross(corners[(i + 1) % n])).sum();
            let areas = doubled_areas(&corners, &result);
            for area in &areas {
                prop_assert!(area.dot(whole) > 0.0);
            }
            let sum: Vec3 = areas.iter().sum();
            prop_assert!(sum.distance(whole) <= 1e-12 * whole.length());
        }
    }
}
