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
    use kit::Vec3;

    fn case_of(name: &str, rays: usize) -> Case {
        let column = COLUMNS.iter().find(|column| column.name == name);
        column.expect("the column").case(1, rays)
    }

    fn hits(case: &Case) -> Vec<bool> {
        let answers = answers(case).rays;
        answers.iter().map(|answer| answer.t.is_finite()).collect()
    }

    /// What the text of each column says of its rays.
    #[test]
    fn every_ray_hits_but_those_beside() {
        for column in &COLUMNS {
            let expected = [column.name != "beside"; 40];
            assert_eq!(hits(&column.case(1, 40)), expected, "{}", column.name);
        }
    }

    /// Rays pass the mesh so far away that rounding cannot make a hit: they also miss it when it is
    /// larger by 2^-20. And they pass it so closely that they hit when it is larger by 1/128.
    #[test]
    fn rays_beside_miss_by_little_and_by_more_than_is_rounded() {
        let case = case_of("beside", 200);
        let centre = 2.0 * Vec3::Z;
        let larger = |factor: f64| {
            let mut case = case.clone();
            let positions = &mut case.mesh.positions;
            positions
                .iter_mut()
                .for_each(|p| *p += factor * (*p - centre));
            hits(&case)
        };
        assert_eq!(larger(2_f64.powi(-20)), [false; 200]);
        assert_eq!(larger(2_f64.powi(-7)), [true; 200]);
    }

    /// No test of a triangle hits, in any precision, and no tree.
    #[test]
    fn kernels_miss_what_they_pass() {
        let case = case_of("beside", 500);
        let triangles = case.triangles();
        for kernel in kernels::triangles() {
            let hit = |ray: &&Ray| triangles.iter().any(|t| kernel.answer(t, ray).is_some());
            let hits = case.rays.iter().filter(hit).count();
            assert_eq!(hits, 0, "{}, {:?}", kernel.info.name, kernel.precision);
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
        let case = case_of("parity", 40);
        assert!(answers(&case).rays.iter().all(|answer| answer.count == 2.0));
    }
}
