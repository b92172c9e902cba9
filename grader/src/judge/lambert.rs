//! Judging matte surfaces.

use super::chance::{self, MANY};
use super::hits::show;
use super::numbers::{self, same_colour};
use super::tally::{Aspect, Class, Tally};
use kit::Vec3;
use std::f64::consts::PI;
use wire::direct::{LambertAnswer, LambertProbe};

/// A handful of roundings, and room for a π with ten digits.
const BOUND: f64 = 1e-9;

/// Judges the three functions.
pub(super) fn lambert(tally: &mut Tally, probes: &[LambertProbe], answers: &[LambertAnswer]) {
    for (call, (probe, answer)) in probes.iter().zip(answers).enumerate() {
        one(tally, call, probe, answer);
    }
    if probes.len() < MANY {
        return;
    }
    for side in [1.0, -1.0] {
        let pairs = probes.iter().zip(answers);
        let directions: Vec<Option<Vec3>> = pairs
            .filter(|(probe, _)| probe.wo[2] * side > 0.0)
            .map(|(_, answer)| answer.sample.map(|sample| sample.wi.into()))
            .collect();
        if directions.len() >= MANY {
            let density = |w: Vec3| (w.z * side).max(0.0) / PI;
            chance::spread(tally, &directions, density, "by the cosine to the normal");
        }
    }
}

fn one(tally: &mut Tally, call: usize, probe: &LambertProbe, answer: &LambertAnswer) {
    for aspect in [Aspect::Bsdf, Aspect::Pdf, Aspect::Decision] {
        tally.expect(aspect);
    }
    let (wo, wi) = (Vec3::from(probe.wo), Vec3::from(probe.wi));
    let asked = || format!("wo = {}, wi = {}", show(wo), show(wi));
    let share = probe.reflectance.map(|rho| rho / PI);
    // How much of it is on the side of the viewer: 0 below and in the plane of the surface.
    let seen = |wi: Vec3| if wo.z * wi.z > 0.0 { wi.z.abs() } else { 0.0 };
    let right = if seen(wi) > 0.0 { share } else { [0.0; 3] };
    numbers::colour(tally, Aspect::Bsdf, call, answer.f, right, BOUND, || {
        format!(
            "lambert_f: reflectance = {:?}, {}",
            probe.reflectance,
            asked()
        )
    });
    let right = seen(wi) / PI;
    numbers::number(tally, Aspect::Pdf, call, answer.pdf, right, BOUND, || {
        format!("lambert_pdf: {}", asked())
    });

    let drawn = || format!("lambert_sample: wo = {}, u = {:?}", show(wo), probe.u);
    let Some(sample) = answer.sample else {
        let class = (wo.z != 0.0).then_some(Class::FalseMiss);
        tally.judge_class(Aspect::Decision, call, class, 1.0, || {
            format!("there is no sample, and should be one. {}", drawn())
        });
        return;
    };
    let class = (wo.z == 0.0).then_some(Class::FalseHit);
    tally.judge_class(Aspect::Decision, call, class, 1.0, || {
        format!(
            "there is a sample; in the plane of the surface nothing leaves. {}",
            drawn()
        )
    });
    if wo.z == 0.0 {
        return;
    }
    tally.expect(Aspect::SampledDirection);
    tally.expect(Aspect::SampleRecord);
    let drawn_wi = Vec3::from(sample.wi);
    let off = (drawn_wi.length() - 1.0).abs();
    let class = if off.is_nan() || off > BOUND {
        Some(Class::WrongLength)
    } else {
        (seen(drawn_wi) == 0.0).then_some(Class::Negated)
    };
    tally.judge_class(Aspect::SampledDirection, call, class, off, || {
        format!(
            "wi = {} has length {}; right is a unit vector on the side of wo. {}",
            show(drawn_wi),
            drawn_wi.length(),
            drawn()
        )
    });
    // Whoever draws other directions makes the same mistake in other numbers: the kind has a name.
    let with_cosine = share.map(|channel| channel * seen(drawn_wi));
    if same_colour(sample.f, with_cosine, BOUND) && !same_colour(sample.f, share, BOUND) {
        let class = Class::Named("f times the cosine");
        tally.judge_class(Aspect::SampleRecord, call, Some(class), 1.0, || {
            let f = sample.f;
            format!("f = {f:?}, right is {share:?}. f of {}", drawn())
        });
    } else {
        let (aspect, f) = (Aspect::SampleRecord, sample.f);
        numbers::colour(tally, aspect, call, f, share, BOUND, || {
            format!("f of {}", drawn())
        });
    }
    let right = seen(drawn_wi) / PI;
    // Near the horizon the sample may know its height better than its z says.
    let bound = BOUND + 1e-15 / right.max(1e-300);
    let fixed = [(1.0, "pdf 1"), (0.5 / PI, "pdf of uniform directions")];
    let fixed = fixed
        .iter()
        .find(|(pdf, _)| (sample.pdf - pdf).abs() <= BOUND && (right - pdf).abs() > bound);
    if let Some((_, name)) = fixed {
        let class = Some(Class::Named(name));
        tally.judge_class(Aspect::SampleRecord, call, class, 1.0, || {
            let pdf = sample.pdf;
            format!("pdf = {pdf:?}, right is {right:?}. {}", drawn())
        });
    } else {
        let (aspect, pdf) = (Aspect::SampleRecord, sample.pdf);
        numbers::number(tally, aspect, call, pdf, right, bound, || {
            format!("pdf of {}", drawn())
        });
    }
    let usable = sample.pdf > 0.0 && !sample.delta;
    tally.judge(Aspect::SampleRecord, call, usable, 1.0, || {
        format!(
            "pdf = {}, delta = {}; a sample that is drawn has a density above 0, and a matte surface no delta. {}",
            sample.pdf,
            sample.delta,
            drawn()
        )
    });
}
