//! One call in words and shown.

use crate::tools::call_text::{holding, point, ray_and, ray_circumstances};
use crate::tools::convert;
use crate::tools::shown::{ComparedNumber, ShownCall, ShownRay};
use crate::tools::snapshot::{Fields, Value};
use crate::tools::truth::expected::HitOrMiss;
use kit::{Aabb, Interval, Vec3};
use oracle::KernelClass;
use wire::work::{BoxWork, Ray};

pub(super) fn input(work: &BoxWork, call: usize) -> Option<String> {
    let probe = work.probes.get(call)?;
    let [min, max] = work.boxes.get(probe.shape as usize)?.map(point);
    Some(ray_and(
        &probe.ray,
        &format!("box min = {min}, max = {max}"),
    ))
}

pub(super) fn circumstances(work: &BoxWork, call: usize) -> Option<Vec<&'static str>> {
    let probe = work.probes.get(call)?;
    let corners = work.boxes[probe.shape as usize].map(Vec3::from);
    let of_box = of_box(corners, &probe.ray);
    Some([ray_circumstances(&probe.ray), of_box].concat())
}

fn of_box([min, max]: [Vec3; 2], ray: &Ray) -> Vec<&'static str> {
    let o = Vec3::from(ray.o);
    let inside = o.cmpge(min).all() && o.cmple(max).all();
    let center = 0.5 * (min + max) - o;
    holding(&[
        (inside, "the ray starts inside the box"),
        (!inside, "the ray starts outside the box"),
        (
            !inside && center.dot(Vec3::from(ray.d)) < 0.0,
            "the box lies behind the ray's origin",
        ),
        (min.cmpeq(max).any(), "the box is flat"),
    ])
}

/// The exact interval in which the ray is inside the box and in its range.
fn exact_ends(b: &Aabb, ray: &kit::Ray) -> Option<[f64; 2]> {
    let verdict = oracle::bbox(b, ray);
    let ends = verdict.ends.filter(|_| verdict.hits())?;
    Some([ends.0.to_f64(), ends.1.to_f64()])
}

/// The box and the ray of a call.
fn inputs(work: &BoxWork, call: usize) -> Option<(Aabb, kit::Ray)> {
    let probe = work.probes.get(call)?;
    let [min, max] = work.boxes.get(probe.shape as usize)?.map(Vec3::from);
    Some((Aabb { min, max }, convert::ray(&probe.ray)))
}

/// The right intervals of some calls, as fields.
pub(super) fn exact(work: &BoxWork, calls: &[u32]) -> Vec<Fields> {
    let of_call = |&call: &u32| {
        let ends = inputs(work, call as usize).and_then(|(b, ray)| exact_ends(&b, &ray));
        let inside = ends.map(|[enters, leaves]| Value::Range(enters, leaves));
        inside
            .map(|inside| ("inside".to_string(), inside))
            .into_iter()
            .collect()
    };
    calls.iter().map(of_call).collect()
}

pub(super) fn shown(
    work: &BoxWork,
    call: usize,
    answers: Option<&Vec<Option<[f64; 2]>>>,
) -> Option<ShownCall> {
    let (b, ray) = inputs(work, call)?;
    let yours = answers.and_then(|answers| answers.get(call));
    let expected = exact_ends(&b, &ray);
    let text = |ends: Option<[f64; 2]>| match ends {
        Some([enters, leaves]) => format!("[{enters:?}, {leaves:?}]"),
        None => "miss".to_owned(),
    };
    let scores = |ends: &Option<[f64; 2]>| {
        let interval = ends.map(|[min, max]| Interval { min, max });
        let verdict = oracle::bbox(&b, &ray);
        verdict.judge(KernelClass::Textbook, interval).scores()
    };
    Some(ShownCall::Ray(ShownRay {
        boxes: vec![b],
        decision: match expected {
            Some(_) => HitOrMiss::Hit,
            None => HitOrMiss::Miss,
        },
        expected: expected.into_iter().flatten().collect(),
        yours: yours.into_iter().flatten().flatten().copied().collect(),
        rows: vec![ComparedNumber {
            name: "interval",
            yours: yours.map(|ends| text(*ends)),
            expected: Some(text(expected)),
            is_right: yours.is_some_and(scores),
        }],
        ..ShownRay::new(ray)
    }))
}
