//! The answers of the exact oracle, as records that can be compared with golden and actual ones.

use judge::Tier;
use judge::cases::Spec;
use judge::expected::{Expected, ExpectedHit};
use judge::scene;
use judge::snapshot::{Fields, Value, record};
use judge::{convert, truth};
use kit::{Aabb, Primitive, Scene};
use wire::Work;
use wire::answer::Hit;
use wire::work::{BoxWork, BruteForceWork, Ray, SceneWork};

/// The right hit or interval for each of `calls`, without fields for a miss. `None` for work that
/// computes neither hits nor box intervals.
pub fn records(spec: &Spec, calls: &[u32]) -> Option<Vec<Fields>> {
    match &spec.work {
        Work::BruteForce(BruteForceWork {
            triangles,
            spheres,
            rays,
        }) => {
            let scene = convert::scene(triangles, spheres);
            Some(of_scene(spec, &scene, rays, calls))
        }
        Work::SceneHits(SceneWork {
            scene,
            rays,
            any_hit: false,
            ..
        }) => Some(of_scene(spec, &scene::load(scene), rays, calls)),
        Work::Triangles(work) => {
            let first = |&call: &u32| {
                let probe = &work.probes[call as usize];
                let triangle = convert::triangle(&work.triangles[probe.shape as usize]);
                of_shape(Primitive::Triangle(&triangle), &probe.ray)
            };
            Some(calls.iter().map(first).collect())
        }
        Work::Spheres(work) => {
            let first = |&call: &u32| {
                let probe = &work.probes[call as usize];
                let sphere = convert::sphere(&work.spheres[probe.shape as usize]);
                of_shape(Primitive::Sphere(&sphere), &probe.ray)
            };
            Some(calls.iter().map(first).collect())
        }
        Work::Boxes(BoxWork { boxes, probes }) => {
            let inside = |&call: &u32| {
                let probe = &probes[call as usize];
                let [min, max] = boxes[probe.shape as usize].map(Into::into);
                let verdict = oracle::bbox(&Aabb { min, max }, &convert::ray(&probe.ray));
                let ends = verdict.ends.filter(|_| verdict.hits());
                let inside =
                    ends.map(|(enters, leaves)| Value::Range(enters.to_f64(), leaves.to_f64()));
                inside.map(|inside| ("inside".to_string(), inside))
            };
            Some(
                calls
                    .iter()
                    .map(|call| inside(call).into_iter().collect())
                    .collect(),
            )
        }
        _ => None,
    }
}

/// The right hit of one shape. It has no number to compare.
fn of_shape(shape: Primitive<'_>, ray: &Ray) -> Fields {
    let first = truth::first_of(Tier::Robust, &[shape], &convert::ray(ray), false);
    let mut fields = fields(&first);
    fields.retain(|(name, _)| name != "prim");
    fields
}

fn of_scene(spec: &Spec, shapes: &Scene, rays: &[Ray], calls: &[u32]) -> Vec<Fields> {
    let shapes: Vec<Primitive<'_>> = shapes.primitives().collect();
    let first_of =
        |ray: &Ray| truth::first_of(Tier::Robust, &shapes, &convert::ray(ray), spec.enclosed);
    let chosen: Vec<Ray> = calls.iter().map(|&call| rays[call as usize]).collect();
    scene::of_each_ray(&chosen, |ray| fields(&first_of(ray)))
}

fn fields(expected: &Expected) -> Fields {
    let Some(ExpectedHit {
        prim,
        t,
        p,
        uv,
        n,
        ng,
        ..
    }) = expected.hits.first()
    else {
        return Fields::new();
    };
    let hit = Hit {
        t: *t,
        p: (*p).into(),
        n: n.unwrap_or_default().into(),
        ng: ng.unwrap_or_default().into(),
        uv: uv.map(|(uv, _)| uv.into()).unwrap_or_default(),
        prim: *prim,
    };
    // Fields that the oracle does not decide are not shown: a normal that may have any direction,
    // weights of a sphere.
    let is_decided = |name: &str| match name {
        "n" => n.is_some(),
        "ng" => ng.is_some(),
        "uv" => uv.is_some(),
        _ => true,
    };
    let mut fields = record(&hit);
    fields.retain(|(name, _)| is_decided(name));
    fields
}
