//! A recorded ray as a Rust test, with the exact answer.

use judge::{Tier, repro};
use kit::{PrimId, Primitive, Ray, Scene, Vec3};
use oracle::{KernelClass, may_touch};
use pathtracer::replay::{RayRecord, Test};
use wire::Work;
use wire::work::{BoxWork, BruteForceWork, Probe, SphereWork, TriangleWork, Xyz};

/// A test, and the stage whose `tests` folder it belongs to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RayTest {
    /// The name of the stage.
    pub stage: String,
    /// The file.
    pub text: String,
}

/// The test that a ray hits what it hits exactly, among the primitives that its line comes near.
/// The error says why there is none.
pub fn of_ray(scene: &Scene, record: &RayRecord) -> Result<RayTest, String> {
    let mut work = BruteForceWork {
        triangles: Vec::new(),
        spheres: Vec::new(),
        rays: vec![wire_ray(&record.ray)],
    };
    for (id, primitive) in (0..).map(PrimId).zip(scene.primitives()) {
        if record.skip != Some(id) && may_touch(&primitive, &record.ray, KernelClass::Textbook) {
            push(&mut work, &primitive);
        }
    }
    file(
        "intersect",
        &Work::BruteForce(work),
        "The closest hit of a ray of a replay, among the primitives near its line.",
    )
    .ok_or_else(|| {
        "No short test: many shapes are near this ray, or more than one answer is right: select a test of the ray"
            .to_owned()
    })
}

/// The test of a single box or primitive test of a ray.
pub fn of_test(scene: &Scene, record: &RayRecord, test: &Test) -> Result<RayTest, String> {
    let with_max_t = |max_t| {
        let ray = Ray {
            max_t,
            ..record.ray
        };
        vec![Probe {
            shape: 0,
            ray: wire_ray(&ray),
        }]
    };
    let (stage, work) = match test {
        Test::Box { bounds, max_t, .. } => {
            let boxes = vec![[bounds.min.into(), bounds.max.into()]];
            let probes = with_max_t(*max_t);
            ("bbox", Work::Boxes(BoxWork { boxes, probes }))
        }
        Test::Primitive { prim, max_t, .. } => {
            let probes = with_max_t(*max_t);
            let mut one = BruteForceWork {
                triangles: Vec::new(),
                spheres: Vec::new(),
                rays: Vec::new(),
            };
            push(&mut one, &scene.primitive(*prim));
            let (triangles, spheres) = (one.triangles, one.spheres);
            let work = if spheres.is_empty() {
                Work::Triangles(TriangleWork {
                    triangles,
                    probes,
                    by_record: false,
                })
            } else {
                Work::Spheres(SphereWork { spheres, probes })
            };
            ("intersect", work)
        }
    };
    file(stage, &work, "A test of a ray of a replay.")
        .ok_or_else(|| "No test: correct code may answer either way here".to_owned())
}

fn file(stage: &'static str, work: &Work, about: &str) -> Option<RayTest> {
    let test = repro::of_work(work, Tier::Core, 0, about, "ray_of_a_replay")?;
    Some(RayTest {
        stage: stage.to_owned(),
        text: format!("//! A ray that was saved in the window.\n\n{test}"),
    })
}

fn push(work: &mut BruteForceWork, primitive: &Primitive<'_>) {
    let xyz = |v: Vec3| -> Xyz { v.into() };
    match primitive {
        Primitive::Triangle(t) => {
            work.triangles
                .push([t.p0, t.p1, t.p2, t.n0, t.n1, t.n2].map(xyz));
        }
        Primitive::Sphere(s) => work.spheres.push((xyz(s.center), s.radius)),
    }
}

/// A ray in the messages between grader and worker.
fn wire_ray(ray: &Ray) -> wire::work::Ray {
    wire::work::Ray {
        o: ray.o.into(),
        d: ray.d.into(),
        min_t: ray.min_t,
        max_t: ray.max_t,
    }
}
