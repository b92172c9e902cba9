//! Part 1, tasks 3 and 4: what a ray hits.

use kit::{Hit, PrimId, Ray, Sphere, Triangle, TriangleHit};

/// Task 3.
pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    kit::hole!("part1.task3", tri, ray)
}

/// Task 3.
pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    kit::hole!("part1.task3", tri, id, ray)
}

/// Task 4.
pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    kit::hole!("part1.task4", s, ray)
}

/// Task 4.
pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    kit::hole!("part1.task4", s, id, ray)
}
