// BEGIN SOLUTION(part6.task1)
//! Checks the trees of a scene against brute force.

use bvh::{construct_bvh, intersect_bvh};
use kit::{
    Aabb, Bvh, Hit, Interval, PixelSampler, PrimId, Primitive, Ray, Scene, Sphere, Triangle,
    TriangleHit, Vec3, World, warp,
};
use lanes::instruction_sets;
use simd_bvh::{Level, TestCounts, WideBvh};

/// The scalar kernels: intersects `ray` with primitive `id`.
pub(crate) fn exact(scene: &Scene, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
    match scene.primitive(id) {
        Primitive::Triangle(t) => intersect::test_triangle(t, ray),
        Primitive::Sphere(s) => intersect::test_sphere(s, ray).map(|t| TriangleHit {
            t,
            b1: 0.0,
            b2: 0.0,
        }),
    }
}

/// The closest hit; at equal `t` the one with the lowest id.
fn brute_force(scene: &Scene, ray: &Ray, skip: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
    (0..scene.len() as u32)
        .map(PrimId)
        .filter(|&id| skip != Some(id))
        .filter_map(|id| Some((id, exact(scene, id, ray)?)))
        .reduce(|a, b| if b.1.t < a.1.t { b } else { a })
}

/// The closest hit by the tree of stage `bvh`.
fn through_binary_tree(
    tree: &Bvh,
    scene: &Scene,
    ray: &Ray,
    skip: Option<PrimId>,
) -> Option<(PrimId, TriangleHit)> {
    let mut world = Kernels { scene, skip };
    let hit = intersect_bvh(tree, &mut { *ray }, &mut world)?;
    let weights = TriangleHit {
        t: hit.t,
        b1: hit.uv.x,
        b2: hit.uv.y,
    };
    Some((hit.prim, weights))
}

struct Kernels<'a> {
    scene: &'a Scene,
    skip: Option<PrimId>,
}

impl World for Kernels<'_> {
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        bbox::intersect_bbox(b, ray)
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        if self.skip == Some(id) {
            return None;
        }
        match self.scene.primitive(id) {
            Primitive::Triangle(t) => intersect::intersect_triangle(t, id, ray),
            Primitive::Sphere(s) => intersect::intersect_sphere(s, id, ray),
        }
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        self.skip != Some(id) && exact(self.scene, id, ray).is_some()
    }
}

pub(crate) struct Checker {
    pub(crate) scene: Scene,
    /// The tree at each level of [`instruction_sets`].
    trees: Vec<(Level, WideBvh)>,
    /// For scenes that are too large for brute force: the tree of stage `bvh`.
    binary: Option<Bvh>,
    /// The number of rays that hit.
    pub(crate) hits: usize,
}

impl Checker {
    pub(crate) fn new(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Checker {
        let tree = WideBvh::build(&triangles, &spheres);
        Checker {
            scene: Scene {
                triangles,
                spheres,
                ..Scene::default()
            },
            trees: instruction_sets()
                .into_iter()
                .map(|level| (level, tree.clone().at_level(level)))
                .collect(),
            binary: None,
            hits: 0,
        }
    }

    /// A large scene, checked against the tree of stage `bvh`.
    pub(crate) fn large(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Checker {
        let checker = Checker::new(triangles, spheres);
        Checker {
            binary: Some(construct_bvh(&checker.scene.primitive_bounds(), 4)),
            ..checker
        }
    }

    pub(crate) fn check(&mut self, ray: &Ray, skip: Option<PrimId>) {
        let mut expected = match &self.binary {
            Some(tree) => through_binary_tree(tree, &self.scene, ray, skip),
            None => brute_force(&self.scene, ray, skip),
        };
        self.hits += usize::from(expected.is_some());
        let bits = |hit: Option<(PrimId, TriangleHit)>| {
            hit.map(|(id, hit)| (id, [hit.t, hit.b1, hit.b2].map(f64::to_bits)))
        };
        let exact = &mut |id, ray: &Ray| exact(&self.scene, id, ray);
        let mut all_counts = Vec::new();
        for (level, tree) in &self.trees {
            let mut counts = TestCounts::default();
            let hit = tree.closest(ray, skip, exact, &mut counts);
            if self.binary.is_some() && bits(hit) != bits(expected) {
                // The trees disagree: brute force decides. The slack of the tree of stage `bvh` is
                // relative to `t`, so among hits with a `t` near 0 it may miss the lowest.
                let brute = brute_force(&self.scene, ray, skip);
                expected = brute;
            }
            assert_eq!(bits(hit), bits(expected), "{level:?} {ray:?}");
            let any = tree.occluded(ray, skip, exact, &mut counts);
            assert_eq!(any, expected.is_some(), "{level:?} {ray:?}");
            all_counts.push(counts);
        }
        assert!(
            all_counts.iter().all(|counts| *counts == all_counts[0]),
            "the counts depend on the instruction set: {all_counts:?}"
        );
    }
}

/// Random numbers, points and directions from a fixed seed.
pub(crate) struct Random(PixelSampler);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(PixelSampler::new(0, 0, seed))
    }

    pub(crate) fn one(&mut self) -> f64 {
        self.0.next_1d()
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.one() * n as f64) as usize
    }

    /// A point in the cube from -1 to 1.
    pub(crate) fn point(&mut self) -> Vec3 {
        let p = self.0.next_2d();
        2.0 * Vec3::new(p.x, p.y, self.one()) - 1.0
    }

    pub(crate) fn direction(&mut self) -> Vec3 {
        warp::uniform_sphere(self.0.next_2d())
    }

    /// A vertex, a point on an edge or a point inside: where hits are hardest to decide.
    pub(crate) fn on(&mut self, t: &Triangle) -> Vec3 {
        let s = self.one();
        match self.below(4) {
            0 => t.p0,
            1 => t.p0 + s * (t.p1 - t.p0),
            2 => t.p1 + s * (t.p2 - t.p1),
            _ => t.p0 + 0.5 * s * (t.p1 - t.p0) + 0.5 * (1.0 - s) * (t.p2 - t.p0),
        }
    }
}
// END SOLUTION(part6.task1)
