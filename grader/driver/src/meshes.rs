//! Traces rays through whole scenes with all of the student's stages.

use crate::bvh::kit_tree;
use crate::convert;
use crate::stages::OfScenes;
use kit::{Aabb, Hit, Interval, PrimId, Primitive, Ray, Scene, Vec2, Vec3, World};
use meshes::{MeshKind, cornell_with, generate};
use std::hint::black_box;
use std::time::{Duration, Instant};
use wire::answer::{HitsAnswer, TimingAnswer};
use wire::work::{SceneSource, SceneWork, TimingWork};

/// Traces the rays through the scene by its tree.
pub(crate) fn scene_hits(stages: OfScenes<'_>, work: &SceneWork) -> Result<HitsAnswer, String> {
    let scene = load(&work.scene)?;
    let tree = kit_tree(&work.tree);
    let mut world = SceneWorld::new(stages, &scene);
    let answers = harness::each_call(&work.rays, |_, ray| {
        world.limit_tests_of_ray();
        let mut ray = convert::ray(ray);
        let hit = if work.any_hit {
            (stages.bvh.occludes_bvh)(&tree, &ray, &mut world).then_some(ANY_HIT)
        } else {
            (stages.bvh.intersect_bvh)(&tree, &mut ray, &mut world)
        };
        (hit.as_ref().map(convert::wire_hit), ray.max_t)
    });
    let (hits, max_t) = answers.into_iter().unzip();
    Ok(HitsAnswer {
        hits,
        max_t,
        box_tests: world.box_tests,
        prim_tests: world.prim_tests,
    })
}

/// The recorded hit of an any-hit query.
const ANY_HIT: Hit = Hit {
    t: 0.0,
    p: Vec3::ZERO,
    n: Vec3::Z,
    ng: Vec3::Z,
    uv: Vec2::ZERO,
    prim: PrimId(0),
};

pub(crate) fn load(source: &SceneSource) -> Result<Scene, String> {
    match source {
        SceneSource::Triangles(triangles) => Ok(Scene {
            triangles: triangles.iter().map(convert::triangle).collect(),
            ..Scene::default()
        }),
        SceneSource::Generated(name, triangles) => {
            let kind: MeshKind = name.parse()?;
            Ok(Scene {
                triangles: generate(kind, *triangles as usize),
                ..Scene::default()
            })
        }
        SceneSource::InCornellBox(name, triangles) => {
            let kind: MeshKind = name.parse()?;
            Ok(cornell_with(generate(kind, *triangles as usize)))
        }
    }
}

/// A scene whose boxes and primitives are tested with the stages `bbox` and `intersect`; it counts
/// the tests.
pub(crate) struct SceneWorld<'a> {
    stages: OfScenes<'a>,
    scene: &'a Scene,
    box_tests: u64,
    prim_tests: u64,
    /// The counts of box tests and of primitive tests before the ray; `None` if they are not
    /// limited.
    before_ray: Option<(u64, u64)>,
}

impl<'a> SceneWorld<'a> {
    pub(crate) fn new(stages: OfScenes<'a>, scene: &'a Scene) -> SceneWorld<'a> {
        SceneWorld {
            stages,
            scene,
            box_tests: 0,
            prim_tests: 0,
            before_ray: None,
        }
    }

    /// The number of tests of boxes and primitives so far.
    pub(crate) fn tests(&self) -> u64 {
        self.box_tests + self.prim_tests
    }

    /// Limits the tests of the ray that follows: one that is tested forever ends the case.
    fn limit_tests_of_ray(&mut self) {
        self.before_ray = Some((self.box_tests, self.prim_tests));
    }

    #[inline]
    fn count_box_test(&mut self) {
        if let Some((before, _)) = self.before_ray {
            harness::limit_calls("hit_box", self.box_tests - before, one_ray);
        }
        self.box_tests += 1;
    }

    #[inline]
    fn count_prim_test(&mut self, function: &'static str) {
        if let Some((_, before)) = self.before_ray {
            harness::limit_calls(function, self.prim_tests - before, one_ray);
        }
        self.prim_tests += 1;
    }
}

fn one_ray() -> String {
    "one ray through a scene".into()
}

impl World for SceneWorld<'_> {
    #[inline]
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        self.count_box_test();
        (self.stages.bbox.intersect_bbox)(b, ray)
    }

    #[inline]
    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        self.count_prim_test("hit_prim");
        match self.scene.primitive(id) {
            Primitive::Triangle(triangle) => {
                (self.stages.intersect.intersect_triangle)(triangle, id, ray)
            }
            Primitive::Sphere(sphere) => (self.stages.intersect.intersect_sphere)(sphere, id, ray),
        }
    }

    #[inline]
    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        self.count_prim_test("blocked");
        match self.scene.primitive(id) {
            Primitive::Triangle(triangle) => {
                (self.stages.intersect.test_triangle)(triangle, ray).is_some()
            }
            Primitive::Sphere(sphere) => (self.stages.intersect.test_sphere)(sphere, ray).is_some(),
        }
    }
}

/// Time limit of the first pass of the rays through a tree. If it takes longer, only the rays so
/// far are traced in all passes.
const TREE_TIME: Duration = Duration::from_millis(700);

/// The number of rays between two readings of the clock.
const BATCH: usize = 64;

/// Times construction, the tree and brute force in alternation, so that a change of the machine's
/// speed affects all of them. Each timed pass of rays follows an untimed one: construction and
/// brute force leave other data in the caches.
pub(crate) fn time(stages: OfScenes<'_>, timing: &TimingWork) -> Result<TimingAnswer, String> {
    let scene = load(&timing.scene)?;
    let bounds = scene.primitive_bounds();
    let mut rays: Vec<Ray> = timing.rays.iter().map(convert::ray).collect();
    let mut answer = TimingAnswer {
        primitives: scene.len() as u64,
        build_s: Vec::new(),
        tree_s: Vec::new(),
        tree_rays: 0,
        brute_s: Vec::new(),
        brute_rays: 0,
        box_tests: 0,
        prim_tests: 0,
        differing_hits: 0,
        tree_hits: 0,
    };
    let sample = evenly(&rays, timing.brute_force_rays as usize);
    answer.brute_rays = sample.len() as u64;
    for round in 0..timing.rounds {
        let started = Instant::now();
        let tree = (stages.bvh.construct_bvh)(&bounds, timing.max_leaf_size as usize);
        answer.build_s.push(started.elapsed().as_secs_f64());

        let mut world = SceneWorld::new(stages, &scene);
        if round == 0 {
            rays.truncate(count(stages, &tree, &rays, &mut world, &mut answer));
            let through_tree = sample
                .iter()
                .map(|ray| (stages.bvh.intersect_bvh)(&tree, &mut { *ray }, &mut world));
            let differs = through_tree.zip(&sample).filter(|(hit, ray)| {
                hit.as_ref().map(|hit| hit.t) != brute_force(stages, &scene, ray).map(|hit| hit.t)
            });
            answer.differing_hits = differs.count() as u64;
        }
        answer.tree_s.push(time_second_pass(|| {
            for (done, ray) in rays.iter().enumerate() {
                harness::call(done);
                black_box((stages.bvh.intersect_bvh)(&tree, &mut { *ray }, &mut world));
            }
        }));
        answer.brute_s.push(time_second_pass(|| {
            for ray in &sample {
                black_box(brute_force(stages, &scene, ray));
            }
        }));
    }
    Ok(answer)
}

/// Runs a pass twice and returns the seconds of the second time.
fn time_second_pass(mut pass: impl FnMut()) -> f64 {
    pass();
    let started = Instant::now();
    pass();
    started.elapsed().as_secs_f64()
}

/// Counts hits and tests of the rays through the tree, until [`TREE_TIME`] is over. Returns the
/// number of rays.
fn count(
    stages: OfScenes<'_>,
    tree: &kit::Bvh,
    rays: &[Ray],
    world: &mut SceneWorld,
    answer: &mut TimingAnswer,
) -> usize {
    let started = Instant::now();
    let mut done = 0;
    for batch in rays.chunks(BATCH) {
        for ray in batch {
            harness::call(done);
            done += 1;
            let hit = (stages.bvh.intersect_bvh)(tree, &mut { *ray }, world);
            answer.tree_hits += u64::from(hit.is_some());
        }
        if started.elapsed() > TREE_TIME {
            break;
        }
    }
    answer.tree_rays = done as u64;
    answer.box_tests = world.box_tests;
    answer.prim_tests = world.prim_tests;
    done
}

/// `count` of the rays, at regular intervals.
fn evenly(rays: &[Ray], count: usize) -> Vec<Ray> {
    let count = count.min(rays.len());
    (0..count).map(|i| rays[i * rays.len() / count]).collect()
}

/// The closest hit, by testing every primitive in order.
fn brute_force(stages: OfScenes<'_>, scene: &Scene, ray: &Ray) -> Option<Hit> {
    let mut ray = *ray;
    let mut closest = None;
    for (triangle, id) in scene.triangles.iter().zip((0..).map(PrimId)) {
        closest = (stages.intersect.intersect_triangle)(triangle, id, &mut ray).or(closest);
    }
    closest
}
