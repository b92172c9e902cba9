//! A scene as a ray meets it: every test is counted.

use kit::{Aabb, Hit, Interval, PrimId, Primitive, Ray, Scene, TriangleHit, World};
use simd_bvh::Work;
use std::iter::Sum;
use std::ops::Add;

/// How often what was done. Each thread counts for itself and the counts are added up: they are exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Rays traced.
    pub rays: u64,
    /// Ray/box tests.
    pub box_tests: u64,
    /// Ray/primitive tests.
    pub prim_tests: u64,
}

impl Counters {
    /// Adds what a walk through the wide tree took.
    #[inline]
    pub fn add_work(&mut self, work: Work) {
        self.box_tests += work.box_tests;
        self.prim_tests += work.prim_tests;
    }
}

impl Add for Counters {
    type Output = Counters;
    fn add(self, other: Counters) -> Counters {
        Counters {
            rays: self.rays + other.rays,
            box_tests: self.box_tests + other.box_tests,
            prim_tests: self.prim_tests + other.prim_tests,
        }
    }
}

impl Sum for Counters {
    fn sum<I: Iterator<Item = Counters>>(counters: I) -> Counters {
        counters.fold(Counters::default(), Add::add)
    }
}

/// The boxes and primitives of a scene, asked through the stages `bbox` and `intersect`.
#[derive(Clone, Debug)]
pub struct SceneWorld<'a> {
    scene: &'a Scene,
    /// The primitive that the ray at hand has just left and cannot meet again; it is passed over.
    pub left: Option<PrimId>,
    /// What was asked so far.
    pub counters: Counters,
}

impl<'a> SceneWorld<'a> {
    /// A world that has not been asked anything yet.
    pub fn new(scene: &'a Scene) -> SceneWorld<'a> {
        SceneWorld {
            scene,
            left: None,
            counters: Counters::default(),
        }
    }

    /// Where `ray` meets primitive `id` in its range, if it does; a sphere's weights are 0. Does not count.
    #[inline]
    pub fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
        match self.scene.primitive(id) {
            Primitive::Triangle(triangle) => intersect::test_triangle(triangle, ray),
            Primitive::Sphere(sphere) => intersect::test_sphere(sphere, ray).map(|t| TriangleHit {
                t,
                b1: 0.0,
                b2: 0.0,
            }),
        }
    }

    /// The record of what [`SceneWorld::test`] found; shortens the ray to it. Does not count.
    #[inline]
    pub fn record(&self, id: PrimId, ray: &mut Ray, hit: TriangleHit) -> Option<Hit> {
        match self.scene.primitive(id) {
            Primitive::Triangle(triangle) => {
                Some(intersect::record_triangle(triangle, id, ray, hit))
            }
            Primitive::Sphere(sphere) => {
                // The same kernel on the same ray: the same hit.
                ray.max_t = hit.t;
                intersect::intersect_sphere(sphere, id, ray)
            }
        }
    }
}

impl World for SceneWorld<'_> {
    // Always: only inside the traversal's loop is it plain that `1/d` stays the same from box to box.
    #[inline(always)]
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        self.counters.box_tests += 1;
        bbox::intersect_bbox(b, ray)
    }

    #[inline]
    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        if self.left == Some(id) {
            return None;
        }
        self.counters.prim_tests += 1;
        match self.scene.primitive(id) {
            Primitive::Triangle(triangle) => intersect::intersect_triangle(triangle, id, ray),
            Primitive::Sphere(sphere) => intersect::intersect_sphere(sphere, id, ray),
        }
    }

    #[inline]
    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        if self.left == Some(id) {
            return false;
        }
        self.counters.prim_tests += 1;
        self.test(id, ray).is_some()
    }
}
