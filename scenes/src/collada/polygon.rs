//! Polygons to triangles: a fan where the polygon is convex, else by clipping ears
//! (G. Meisters, "Polygons have ears", 1975).

use kit::{Vec2, Vec3};

/// Most point-in-triangle tests for one file. Clipping ears takes a time that grows with the square
/// of a polygon's size, with its cube at worst; this is a second or two.
const MAX_TESTS: u64 = 200_000_000;

/// Counts the tests over all polygons of a file.
#[derive(Debug, Default)]
pub(super) struct Effort {
    tests: u64,
}

/// The polygons of a file are too large and too winding to be cut.
#[derive(Debug)]
pub(super) struct TooComplex;

/// The triangles of a polygon.
#[derive(Debug, PartialEq)]
pub(super) struct Cut {
    /// Three corners each, by their number in the polygon, in the polygon's own winding.
    pub(super) triangles: Vec<[usize; 3]>,
    /// False if the polygon has no area or was seen to cross itself, so that triangles may overlap. Not every
    /// crossing is seen.
    pub(super) simple: bool,
}

/// Cuts a polygon of at least 3 corners into `corners.len() - 2` triangles.
///
/// It need not be flat: it is looked at along its mean normal (Newell's).
pub(super) fn triangulate(corners: &[Vec3], effort: &mut Effort) -> Result<Cut, TooComplex> {
    let fan = |simple| Cut {
        triangles: (1..corners.len() - 1).map(|i| [0, i, i + 1]).collect(),
        simple,
    };
    if corners.len() == 3 {
        return Ok(fan(true));
    }
    let Some(flat) = project(corners) else {
        return Ok(fan(false));
    };
    if is_convex(&flat) {
        return Ok(fan(true));
    }
    clip_ears(&flat, effort)
}

/// The corners seen along the polygon's normal, so that it winds counter-clockwise; `None` if it has
/// no area.
fn project(corners: &[Vec3]) -> Option<Vec<Vec2>> {
    let size = corners.iter().fold(0.0, |size: f64, p| {
        size.max((*p - corners[0]).abs().max_element())
    });
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }
    // In units of its own size, so that nothing under- or overflows.
    let unit: Vec<Vec3> = corners.iter().map(|p| (*p - corners[0]) / size).collect();
    let next = |i: usize| unit[(i + 1) % unit.len()];
    let normal: Vec3 = (0..unit.len()).map(|i| unit[i].cross(next(i))).sum();
    let magnitude = normal.abs();
    if magnitude.max_element() == 0.0 {
        return None;
    }
    // Drop the coordinate in which the normal is longest, and keep the winding.
    let flat = unit.iter().map(|p| {
        if magnitude.z >= magnitude.x && magnitude.z >= magnitude.y {
            Vec2::new(p.x * normal.z.signum(), p.y)
        } else if magnitude.y >= magnitude.x {
            Vec2::new(p.z * normal.y.signum(), p.x)
        } else {
            Vec2::new(p.y * normal.x.signum(), p.z)
        }
    });
    Some(flat.collect())
}

/// Twice the signed area of the triangle `a b c`: positive if it winds counter-clockwise.
fn turn(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Whether every corner turns strictly left and the polygon goes round once.
fn is_convex(flat: &[Vec2]) -> bool {
    let n = flat.len();
    let left_turns = (0..n).all(|i| turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) > 0.0);
    // A star turns left everywhere too, but a fan over it has triangles that wind backwards.
    left_turns && (1..n - 1).all(|i| turn(flat[0], flat[i], flat[i + 1]) > 0.0)
}

fn clip_ears(flat: &[Vec2], effort: &mut Effort) -> Result<Cut, TooComplex> {
    let mut left: Vec<usize> = (0..flat.len()).collect();
    let mut triangles = Vec::with_capacity(flat.len() - 2);
    let mut simple = true;
    let mut at = 0;
    let mut failures = 0;
    while left.len() > 3 {
        let n = left.len();
        let ear = [left[(at + n - 1) % n], left[at % n], left[(at + 1) % n]];
        // After a full round without an ear the polygon is not simple: cut the corner anyway.
        let forced = failures >= n;
        if forced || is_ear(flat, &left, ear, effort)? {
            simple &= !forced;
            triangles.push(ear);
            left.remove(at % n);
            // Go on two corners further: triangles come out less thin than by cutting round one corner.
            at = if at % n == n - 1 { 0 } else { at % n + 1 };
            failures = 0;
        } else {
            at = (at + 1) % n;
            failures += 1;
        }
    }
    // What is left of a polygon that crosses itself may wind backwards.
    let last = [left[0], left[1], left[2]];
    simple &= turn(flat[last[0]], flat[last[1]], flat[last[2]]) >= 0.0;
    triangles.push(last);
    Ok(Cut { triangles, simple })
}

/// Whether the triangle turns left and no other corner lies in it.
fn is_ear(
    flat: &[Vec2],
    left: &[usize],
    ear: [usize; 3],
    effort: &mut Effort,
) -> Result<bool, TooComplex> {
    let [a, b, c] = ear.map(|i| flat[i]);
    let turns_left = turn(a, b, c) > 0.0;
    effort.tests += if turns_left { left.len() as u64 } else { 1 };
    if effort.tests > MAX_TESTS {
        return Err(TooComplex);
    }
    if !turns_left {
        return Ok(false);
    }
    let inside = |p: Vec2| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    let is_corner = |p: Vec2| p == a || p == b || p == c;
    Ok(!left
        .iter()
        .any(|i| inside(flat[*i]) && !is_corner(flat[*i])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::math;
    use proptest::prelude::*;

    fn cut(corners: &[Vec3]) -> Cut {
        triangulate(corners, &mut Effort::default()).expect("a small polygon")
    }

    /// Twice the vector area of triangles.
    fn doubled_areas(corners: &[Vec3], cut: &Cut) -> Vec<Vec3> {
        let area =
            |[a, b, c]: &[usize; 3]| (corners[*b] - corners[*a]).cross(corners[*c] - corners[*a]);
        cut.triangles.iter().map(area).collect()
    }

    fn flat(points: &[(f64, f64)]) -> Vec<Vec3> {
        points.iter().map(|(x, y)| Vec3::new(*x, *y, 0.0)).collect()
    }

    #[test]
    fn convex_polygons_become_fans() {
        let square = flat(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        assert_eq!(
            cut(&square),
            Cut {
                triangles: vec![[0, 1, 2], [0, 2, 3]],
                simple: true
            }
        );
    }

    #[test]
    fn a_corner_on_an_edge_leaves_no_flat_triangle() {
        // A fan from the first corner would have one without area: 0, 1, 2 lie on a line.
        let square = flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        let cut = cut(&square);
        assert!(cut.simple);
        assert!(doubled_areas(&square, &cut).iter().all(|area| area.z > 0.0));
    }

    #[test]
    fn polygons_that_cross_themselves_still_give_all_triangles() {
        let star = (0..5).map(|i| f64::from(i) * 2.0 * std::f64::consts::TAU / 5.0);
        let star: Vec<_> = star
            .map(|angle| (math::cos(angle), math::sin(angle)))
            .collect();
        assert_eq!(cut(&flat(&star)).triangles.len(), 3);
        let bow = cut(&flat(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 1.0)]));
        assert_eq!((bow.triangles.len(), bow.simple), (2, false));
    }

    #[test]
    fn polygons_without_area_are_not_simple() {
        assert!(!cut(&flat(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0)])).simple);
        assert!(!cut(&[Vec3::ONE; 6]).simple);
    }

    #[test]
    fn a_spiral_is_cut_without_overlap() {
        let arm = |radius: f64, i: i32| {
            let angle = 0.3 * f64::from(i);
            let r = radius + 0.1 * f64::from(i);
            (r * math::cos(angle), r * math::sin(angle))
        };
        let outer = (0..60).map(|i| arm(1.0, i));
        let inner = (0..60).rev().map(|i| arm(0.5, i));
        let spiral = flat(&outer.chain(inner).collect::<Vec<_>>());
        let cut = cut(&spiral);
        assert!(cut.simple);
        let areas = doubled_areas(&spiral, &cut);
        let sign = areas[0].z.signum();
        assert!(areas.iter().all(|area| area.z * sign > 0.0));
    }

    proptest! {
        /// Star-shaped polygons, concave as a rule, turned any way in space.
        #[test]
        fn triangles_cover_the_polygon_once(
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
            let cut = cut(&corners);
            prop_assert!(cut.simple);
            prop_assert_eq!(cut.triangles.len(), n - 2);
            // Every triangle winds as the polygon does, and their areas add up to the polygon's.
            let whole: Vec3 = (0..n).map(|i| corners[i].cross(corners[(i + 1) % n])).sum();
            let areas = doubled_areas(&corners, &cut);
            for area in &areas {
                prop_assert!(area.dot(whole) > 0.0);
            }
            let sum: Vec3 = areas.iter().sum();
            prop_assert!(sum.distance(whole) <= 1e-12 * whole.length());
        }
    }
}
