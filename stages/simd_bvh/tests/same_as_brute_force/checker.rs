//! Checks the trees of a scene against brute force.

use bvh::{construct_bvh, intersect_bvh};
use kit::{
    Aabb, Bvh, Hit, Interval, PixelSampler, PrimId, Primitive, Ray, Scene, Sphere, Triangle,
    TriangleHit, Vec3, World, warp,
};
use lanes::instruction_sets;
use simd_bvh::{Level, StreamMemory, Subset, TestCounts, WideBvh};

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
    closest(scene.len(), ray, skip, |id, ray| exact(scene, id, ray))
}

/// The closest hit that `test` finds with one of `count` primitives.
fn closest(
    count: usize,
    ray: &Ray,
    skip: Option<PrimId>,
    test: impl Fn(PrimId, &Ray) -> Option<TriangleHit>,
) -> Option<(PrimId, TriangleHit)> {
    (0..count as u32)
        .map(PrimId)
        .filter(|&id| skip != Some(id))
        .filter_map(|id| Some((id, test(id, ray)?)))
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
    /// The number of hits with primitives that are apart, which the other primitives do not have.
    pub(crate) left_out: usize,
    /// Rays that were checked alone and are still to be checked together, and their hits.
    rays: Vec<(Ray, Option<PrimId>)>,
    expected: Vec<Option<(PrimId, TriangleHit)>>,
    /// The number of times that rays were checked together.
    groups: usize,
    memory: StreamMemory,
}

/// The numbers of rays that are checked together, in turns: around the number that the tree traces
/// together, which is a power of two, and far from it.
const GROUP_SIZES: [usize; 9] = [1, 63, 64, 2, 65, 7, 129, 33, 300];

type Bits = Option<(PrimId, [u64; 3])>;

fn bits(hit: Option<(PrimId, TriangleHit)>) -> Bits {
    hit.map(|(id, hit)| (id, [hit.t, hit.b1, hit.b2].map(f64::to_bits)))
}

impl Checker {
    pub(crate) fn new(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Checker {
        let tree = WideBvh::build(&triangles, &spheres);
        Checker::of_tree(tree, triangles, spheres)
    }

    /// A scene with large primitives that are apart from the tree.
    pub(crate) fn apart(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Checker {
        let tree = WideBvh::build_apart(&triangles, &spheres);
        assert!(!tree.apart().is_empty(), "no primitive is apart");
        Checker::of_tree(tree, triangles, spheres)
    }

    fn of_tree(tree: WideBvh, triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Checker {
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
            left_out: 0,
            rays: Vec::new(),
            expected: Vec::new(),
            groups: 0,
            memory: StreamMemory::default(),
        }
    }

    /// A large scene, checked against the tree of stage `bvh`.
    pub(crate) fn large(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Checker {
        let checker = Checker::new(triangles, spheres);
        let mut checker = checker;
        checker.binary = Some(construct_bvh(&checker.scene.primitive_bounds(), 4));
        checker
    }

    pub(crate) fn check(&mut self, ray: &Ray, skip: Option<PrimId>) {
        let mut expected = match &self.binary {
            Some(tree) => through_binary_tree(tree, &self.scene, ray, skip),
            None => brute_force(&self.scene, ray, skip),
        };
        self.hits += usize::from(expected.is_some());
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
        self.rays.push((*ray, skip));
        self.expected.push(expected);
        if self.rays.len() == GROUP_SIZES[self.groups % GROUP_SIZES.len()] {
            self.check_together();
        }
    }

    /// Checks the primitives that are not apart: what a ray hits is the closest of them, or of all.
    fn check_inner(&mut self, rays: &[(Ray, Option<PrimId>)]) {
        let (_, tree) = &self.trees[0];
        if tree.apart().is_empty() {
            return;
        }
        let inner = |id: PrimId, ray: &Ray| {
            let is_inner = tree.apart().binary_search(&id).is_err();
            exact(&self.scene, id, ray).filter(|_| is_inner)
        };
        let expected = rays
            .iter()
            .zip(&self.expected)
            .map(|((ray, skip), of_all)| {
                [
                    bits(closest(self.scene.len(), ray, *skip, inner)),
                    bits(*of_all),
                ]
            });
        let expected: Vec<[Bits; 2]> = expected.collect();
        let exact = &mut |id, ray: &Ray| exact(&self.scene, id, ray);
        let (mut hits, mut occluded) = (Vec::new(), Vec::new());
        for (level, tree) in &self.trees {
            let (memory, counts) = (&mut self.memory, &mut TestCounts::default());
            tree.closest_each(Subset::Inner, rays, exact, memory, counts, &mut hits);
            tree.occluded_each(Subset::Inner, rays, exact, memory, counts, &mut occluded);
            for (i, expected) in expected.iter().enumerate() {
                assert!(expected.contains(&bits(hits[i])), "{level:?} {:?}", rays[i]);
                let any = expected.map(|hit| hit.is_some());
                assert!(any.contains(&occluded[i]), "{level:?} {:?}", rays[i]);
                self.left_out += usize::from(hits[i].is_none() && any[1]);
            }
        }
    }

    /// Checks the last rays again, all together.
    fn check_together(&mut self) {
        let rays = std::mem::take(&mut self.rays);
        self.check_inner(&rays);
        let expected: Vec<Bits> = self.expected.drain(..).map(bits).collect();
        let any: Vec<bool> = expected.iter().map(Option::is_some).collect();
        let exact = &mut |id, ray: &Ray| exact(&self.scene, id, ray);
        let memory = &mut self.memory;
        // What is in them is replaced.
        let (mut hits, mut occluded) = (vec![None; 3], vec![true; 3]);
        let mut all_counts = Vec::new();
        for (level, tree) in &self.trees {
            let mut counts = TestCounts::default();
            tree.closest_each(Subset::All, &rays, exact, memory, &mut counts, &mut hits);
            tree.occluded_each(
                Subset::All,
                &rays,
                exact,
                memory,
                &mut counts,
                &mut occluded,
            );
            let found: Vec<Bits> = hits.iter().copied().map(bits).collect();
            assert_eq!(found, expected, "{level:?} {rays:?}");
            assert_eq!(occluded, any, "{level:?} {rays:?}");
            all_counts.push(counts);
            let mut one_by_one = TestCounts::default();
            for ray in rays.chunks(1) {
                tree.closest_each(Subset::All, ray, exact, memory, &mut one_by_one, &mut hits);
                tree.occluded_each(
                    Subset::All,
                    ray,
                    exact,
                    memory,
                    &mut one_by_one,
                    &mut occluded,
                );
            }
            all_counts.push(one_by_one);
        }
        assert!(
            all_counts.iter().all(|counts| *counts == all_counts[0]),
            "the counts depend on the instruction set or the group: {all_counts:?}"
        );
        self.groups += 1;
    }
}

impl Drop for Checker {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            self.check_together();
        }
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
