// BEGIN SOLUTION(part6.task1)
//! A scene and its trees, held against asking every primitive.

use bvh::{construct_bvh, intersect_bvh};
use kit::{
    Aabb, Bvh, Hit, Interval, PixelSampler, PrimId, Primitive, Ray, Scene, Sphere, Triangle,
    TriangleHit, Vec3, World, warp,
};
use simd_bvh::{Level, WideBvh, Work};

/// The plain kernels: where `ray` meets primitive `id`.
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

/// The lowest `t`, of equal ones that with the lowest id.
fn brute_force(scene: &Scene, ray: &Ray, left: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
    (0..scene.len() as u32)
        .map(PrimId)
        .filter(|&id| left != Some(id))
        .filter_map(|id| Some((id, exact(scene, id, ray)?)))
        .reduce(|a, b| if b.1.t < a.1.t { b } else { a })
}

/// What the tree of stage `bvh` says.
fn through_plain(
    tree: &Bvh,
    scene: &Scene,
    ray: &Ray,
    left: Option<PrimId>,
) -> Option<(PrimId, TriangleHit)> {
    let mut world = Kernels { scene, left };
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
    left: Option<PrimId>,
}

impl World for Kernels<'_> {
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        bbox::intersect_bbox(b, ray)
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        if self.left == Some(id) {
            return None;
        }
        match self.scene.primitive(id) {
            Primitive::Triangle(t) => intersect::intersect_triangle(t, id, ray),
            Primitive::Sphere(s) => intersect::intersect_sphere(s, id, ray),
        }
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        self.left != Some(id) && exact(self.scene, id, ray).is_some()
    }
}

/// The instruction sets of this machine.
fn levels() -> Vec<Level> {
    let mut levels = vec![Level::new(), Level::baseline()];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(Level::new().as_avx2().map(Level::Avx2));
        levels.extend(Level::new().as_sse4_2().map(Level::Sse4_2));
    }
    levels
}

pub(crate) struct Checked {
    pub(crate) scene: Scene,
    /// The tree at each level of [`levels`].
    trees: Vec<(Level, WideBvh)>,
    /// For scenes that are too large to ask every primitive: the plain tree, which says the same.
    plain: Option<Bvh>,
    /// How many rays hit.
    pub(crate) hits: usize,
}

impl Checked {
    pub(crate) fn new(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Checked {
        let tree = WideBvh::build(&triangles, &spheres);
        Checked {
            scene: Scene {
                triangles,
                spheres,
                ..Scene::default()
            },
            trees: levels()
                .into_iter()
                .map(|level| (level, tree.clone().at_level(level)))
                .collect(),
            plain: None,
            hits: 0,
        }
    }

    /// A large scene, held against the tree of stage `bvh`.
    pub(crate) fn large(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Checked {
        let checked = Checked::new(triangles, spheres);
        Checked {
            plain: Some(construct_bvh(&checked.scene.primitive_bounds(), 4)),
            ..checked
        }
    }

    pub(crate) fn check(&mut self, ray: &Ray, left: Option<PrimId>) {
        let mut wanted = match &self.plain {
            Some(tree) => through_plain(tree, &self.scene, ray, left),
            None => brute_force(&self.scene, ray, left),
        };
        self.hits += usize::from(wanted.is_some());
        let bits = |hit: Option<(PrimId, TriangleHit)>| {
            hit.map(|(id, hit)| (id, [hit.t, hit.b1, hit.b2].map(f64::to_bits)))
        };
        let exact = &mut |id, ray: &Ray| exact(&self.scene, id, ray);
        let mut works = Vec::new();
        for (level, tree) in &self.trees {
            let mut work = Work::default();
            let hit = tree.closest(ray, left, exact, &mut work);
            if self.plain.is_some() && bits(hit) != bits(wanted) {
                // Two trees, two answers. (The plain one's slack is relative to t: among hits whose t is 0 but for
                // rounding errors it may miss the lowest.)
                let brute = brute_force(&self.scene, ray, left);
                wanted = brute;
            }
            assert_eq!(bits(hit), bits(wanted), "{level:?} {ray:?}");
            let any = tree.occluded(ray, left, exact, &mut work);
            assert_eq!(any, wanted.is_some(), "{level:?} {ray:?}");
            works.push(work);
        }
        assert!(
            works.iter().all(|work| *work == works[0]),
            "what is counted does not depend on the machine: {works:?}"
        );
    }
}

/// Points and directions from a fixed seed.
pub(crate) struct Numbers(PixelSampler);

impl Numbers {
    pub(crate) fn new(seed: u64) -> Numbers {
        Numbers(PixelSampler::new(0, 0, seed))
    }

    pub(crate) fn one(&mut self) -> f64 {
        self.0.next_1d()
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.one() * n as f64) as usize
    }

    /// In the cube from -1 to 1.
    pub(crate) fn point(&mut self) -> Vec3 {
        let p = self.0.next_2d();
        2.0 * Vec3::new(p.x, p.y, self.one()) - 1.0
    }

    pub(crate) fn direction(&mut self) -> Vec3 {
        warp::uniform_sphere(self.0.next_2d())
    }

    /// A corner, a point on an edge or one inside: where rays are told apart with most difficulty.
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
