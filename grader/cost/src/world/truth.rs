//! The exact answers, by the oracle.

use super::case::{Answers, Case, RayAnswer};
use kit::{Aabb, Primitive, Ray, Triangle};
use oracle::{BigFloat, KernelClass, may_touch};
use rayon::prelude::*;
use std::cmp::Ordering;

/// The closest hit of each ray, and the number of points at which the ray crosses the mesh:
/// triangles that share the point count once. Triangles with a NaN are never hit.
pub(super) fn answers(case: &Case) -> Answers {
    let triangles = case.triangles();
    let bounds: Vec<Aabb> = triangles.iter().map(Triangle::bounds).collect();
    let of_ray = |ray: &Ray| {
        let crossing = |id: usize| {
            let triangle = &triangles[id];
            let may_touch = may_touch(&Primitive::Triangle(triangle), ray, KernelClass::Robust);
            let verdict = may_touch.then(|| oracle::triangle(triangle, ray))?;
            let t = verdict.crossing.as_ref()?.t;
            verdict.hits().then_some((t, id))
        };
        let beside = (0..triangles.len()).filter(|id| may_contain(&bounds[*id], ray));
        let mut hits: Vec<(BigFloat, usize)> = beside.filter_map(crossing).collect();
        hits.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(Ordering::Equal));
        let nearest = hits.first().map(|(t, id)| (t.to_f64(), *id as f64));
        let (t, triangle) = nearest.unwrap_or((f64::INFINITY, -1.0));
        hits.dedup_by(|a, b| a.0 == b.0);
        let count = hits.len() as f64;
        RayAnswer { t, triangle, count }
    };
    Answers {
        seconds: 0.0,
        rays: case.rays.par_iter().map(of_ray).collect(),
    }
}

/// Whether the ray stays between the planes of the box that are parallel to it: most rays of the
/// hard cases are parallel to an axis. Nothing is rounded.
pub(crate) fn may_contain(bounds: &Aabb, ray: &Ray) -> bool {
    let is_between = |axis| bounds.min[axis] <= ray.o[axis] && ray.o[axis] <= bounds.max[axis];
    (0..3).all(|axis| ray.d[axis] != 0.0 || is_between(axis))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::COLUMNS;

    /// What the text of each column says of its rays.
    #[test]
    fn every_ray_hits() {
        for column in &COLUMNS {
            let case = column.case(1, 40);
            let found = answers(&case).rays;
            assert!(
                found.iter().all(|answer| answer.t.is_finite()),
                "{}",
                column.name
            );
            assert!(case.rays.len() == 40);
        }
    }

    #[test]
    fn more_rays_begin_with_the_same() {
        for column in &COLUMNS {
            let [few, many] = [3, 8].map(|rays| column.case(2, rays).rays);
            assert_eq!(few, many[..3], "{}", column.name);
        }
    }

    /// A ray through an edge of a closed mesh has two points on it, not three or four triangles.
    #[test]
    fn points_are_counted_and_not_triangles() {
        let parity = COLUMNS.iter().find(|column| column.name == "parity");
        let case = parity.expect("the column").case(1, 40);
        assert!(answers(&case).rays.iter().all(|answer| answer.count == 2.0));
    }
}
