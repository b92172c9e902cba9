//! The scene as one ray sees it: boxes and primitives to test, with every test counted.

use kit::{Aabb, Hit, Interval, PrimId, Primitive, Ray, Scene, TriangleHit, World};
use simd_bvh::TestCounts;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Sub};

/// How many rays were traced and what they tested. Each tile has its own counters; their sum is
/// exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Rays traced.
    pub rays: u64,
    /// Those of them that find the light of lamps at their edges, beside those of the paths.
    pub lamp_rays: u64,
    /// Those of them between the surfaces of different paths.
    pub reuse_rays: u64,
    /// Ray/box tests.
    pub box_tests: u64,
    /// Ray/primitive tests.
    pub prim_tests: u64,
}

impl Add for Counters {
    type Output = Counters;
    fn add(self, other: Counters) -> Counters {
        Counters {
            rays: self.rays + other.rays,
            lamp_rays: self.lamp_rays + other.lamp_rays,
            reuse_rays: self.reuse_rays + other.reuse_rays,
            box_tests: self.box_tests + other.box_tests,
            prim_tests: self.prim_tests + other.prim_tests,
        }
    }
}

impl Sub for Counters {
    type Output = Counters;
    /// What was counted since `before`.
    fn sub(self, before: Counters) -> Counters {
        Counters {
            rays: self.rays - before.rays,
            lamp_rays: self.lamp_rays - before.lamp_rays,
            reuse_rays: self.reuse_rays - before.reuse_rays,
            box_tests: self.box_tests - before.box_tests,
            prim_tests: self.prim_tests - before.prim_tests,
        }
    }
}

impl AddAssign for Counters {
    #[inline]
    fn add_assign(&mut self, other: Counters) {
        *self = *self + other;
    }
}

impl AddAssign<TestCounts> for Counters {
    /// Adds the tests of a traversal of the wide tree.
    #[inline]
    fn add_assign(&mut self, tests: TestCounts) {
        self.box_tests += tests.box_tests;
        self.prim_tests += tests.prim_tests;
    }
}

impl Sum for Counters {
    fn sum<I: Iterator<Item = Counters>>(counters: I) -> Counters {
        counters.fold(Counters::default(), Add::add)
    }
}

/// Intersects `ray` with primitive `id` of `scene`, in the ray's range. A sphere's weights are 0.
#[inline]
pub fn test_primitive(scene: &Scene, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
    match scene.primitive(id) {
        Primitive::Triangle(triangle) => intersect::test_triangle(triangle, ray),
        Primitive::Sphere(sphere) => intersect::test_sphere(sphere, ray).map(|t| TriangleHit {
            t,
            b1: 0.0,
            b2: 0.0,
        }),
    }
}

/// Records a hit that [`test_primitive`] found, and shortens the ray to it.
#[inline]
pub fn record_hit(scene: &Scene, id: PrimId, ray: &mut Ray, hit: TriangleHit) -> Option<Hit> {
    match scene.primitive(id) {
        Primitive::Triangle(triangle) => Some(intersect::record_triangle(triangle, id, ray, hit)),
        Primitive::Sphere(sphere) => {
            // The same kernel on the same ray finds the same hit.
            ray.max_t = hit.t;
            intersect::intersect_sphere(sphere, id, ray)
        }
    }
}

/// The [`World`] of one ray: tests boxes and primitives with the stages `bbox` and `intersect`.
#[derive(Clone, Debug)]
pub struct SceneWorld<'a> {
    scene: &'a Scene,
    /// The primitive that the ray leaves and cannot hit again.
    skip: Option<PrimId>,
    /// The tests of this ray.
    counters: Counters,
}

impl<'a> SceneWorld<'a> {
    /// The world of a ray that never hits primitive `skip`.
    #[inline]
    pub fn new(scene: &'a Scene, skip: Option<PrimId>) -> SceneWorld<'a> {
        SceneWorld {
            scene,
            skip,
            counters: Counters::default(),
        }
    }

    /// The tests so far.
    #[inline]
    pub fn counters(&self) -> Counters {
        self.counters
    }
}

impl World for SceneWorld<'_> {
    // Always inlined: only inside the traversal's loop can the compiler see that `1/d` is the same
    // for every box.
    #[inline(always)]
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        self.counters.box_tests += 1;
        bbox::intersect_bbox(b, ray)
    }

    #[inline]
    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        if self.skip == Some(id) {
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
        if self.skip == Some(id) {
            return false;
        }
        self.counters.prim_tests += 1;
        test_primitive(self.scene, id, ray).is_some()
    }
}
