//! Judges diffuse surfaces.

use super::cases::CORNERS;
use super::truth::{density, right, sampled_f};
use super::turns;
use crate::tools::aspects::chance::{self, MIN_ESTIMATES};
use crate::tools::aspects::hits::show;
use crate::tools::aspects::numbers::{self, same_colour};
use crate::tools::findings::{Aspect, Class, Findings, Message};
use kit::Vec3;
use wire::direct::{LambertAnswer, LambertProbe};
use wire::work::Xyz;

/// Relative error that is allowed: a few roundings, and a π with ten digits.
pub(crate) const BOUND: f64 = 1e-9;

/// Judges `lambert_f`, `lambert_pdf` and `lambert_sample`.
pub(crate) fn lambert(findings: &mut Findings, probes: &[LambertProbe], answers: &[LambertAnswer]) {
    for (call, (probe, answer)) in probes.iter().zip(answers).enumerate() {
        one(findings, call, probe, answer);
    }
    reaches_the_plane(findings, probes, answers);
    if probes.len() < MIN_ESTIMATES || !findings.is_written("lambert_sample", &[Aspect::Spread]) {
        return;
    }
    let mut random = probes.len();
    if let Some(begin) = turns::begin(probes) {
        turns::judge(findings, &probes[begin..], &answers[begin..]);
        random = begin;
    }
    for side in [1.0, -1.0] {
        let pairs = probes[..random].iter().zip(answers);
        let directions: Vec<Option<Vec3>> = pairs
            .filter(|(probe, _)| probe.wo[2] * side > 0.0)
            .map(|(_, answer)| answer.sample.map(|sample| sample.wi.into()))
            .collect();
        if directions.len() >= MIN_ESTIMATES {
            let density = density();
            let pdf = |w: Vec3| density((w.z * side).max(0.0));
            chance::spread(findings, &directions, pdf, "by the cosine to the normal");
        }
    }
}

/// A lower direction is near the plane of the surface. For numbers a rounding below 1 the height is
/// 1e-8.
const NEAR_THE_PLANE: f64 = 1e-5;

/// Judges that directions come down to the plane of the surface, if the numbers are at the corners
/// of the unit square: there, each map onto the hemisphere has a point of its rim.
fn reaches_the_plane(findings: &mut Findings, probes: &[LambertProbe], answers: &[LambertAnswer]) {
    let samples: Option<Vec<f64>> = answers
        .iter()
        .map(|answer| answer.sample.map(|sample| sample.wi[2].abs()))
        .collect();
    let has_corners = CORNERS.iter().all(|corner| {
        let mut numbers = probes.iter().map(|probe| probe.u);
        numbers.any(|u| u == *corner)
    });
    let Some(heights) = samples.filter(|_| has_corners) else {
        return;
    };
    let (call, lowest) = heights
        .into_iter()
        .enumerate()
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or_default();
    let class = (lowest > NEAR_THE_PLANE).then_some(Class::Named("none near the plane"));
    findings.judge_class(Aspect::SampledDirection, call, class, lowest, || {
        format!(
            "your result: the lowest direction has the height {lowest:?}; expected: directions come as near to the plane of the surface as numbers can. lambert_sample: u = {:?}",
            probes[call].u
        )
    });
}

/// Records the sampled directions whose distribution is not tested.
pub(crate) fn untested(
    findings: &mut Findings,
    probes: &[LambertProbe],
    answers: &[LambertAnswer],
) {
    let on_side = |side: f64| {
        probes
            .iter()
            .filter(|probe| probe.wo[2] * side > 0.0)
            .count()
    };
    let tested = [1.0, -1.0].map(|side| on_side(side) >= MIN_ESTIMATES);
    for (call, (probe, answer)) in probes.iter().zip(answers).enumerate() {
        let is_tested = tested[usize::from(probe.wo[2] < 0.0)];
        if answer.sample.is_some() && !is_tested {
            findings.not_judged(Aspect::SampledDirection, call, chance::TOO_FEW);
        }
    }
}

fn one(findings: &mut Findings, call: usize, probe: &LambertProbe, answer: &LambertAnswer) {
    for aspect in [Aspect::Bsdf, Aspect::Pdf, Aspect::SampleOrNone] {
        findings.expect(aspect);
    }
    let (wo, wi) = (Vec3::from(probe.wo), Vec3::from(probe.wi));
    let input = || format!("wo = {}, wi = {}", show(wo), show(wi));
    let share = sampled_f(probe.reflectance);
    // |cos θ| of a direction on the side of the viewer; 0 on the other side and in the plane of the
    // surface.
    let cosine_of = |wi: Vec3| if wo.z * wi.z > 0.0 { wi.z.abs() } else { 0.0 };
    let (right_f, right_pdf) = right(probe);
    if findings.is_written("lambert_f", &[Aspect::Bsdf]) {
        findings.count_for("lambert_f");
        findings.answers_of("lambert_f");
        numbers::colour(
            findings,
            Aspect::Bsdf,
            call,
            answer.f,
            right_f,
            BOUND,
            || {
                format!(
                    "lambert_f: reflectance = {:?}, {}",
                    probe.reflectance,
                    input()
                )
            },
        );
    }
    if findings.is_written("lambert_pdf", &[Aspect::Pdf]) {
        findings.count_for("lambert_pdf");
        findings.answers_of("lambert_pdf");
        let (aspect, pdf) = (Aspect::Pdf, answer.pdf);
        numbers::number(findings, aspect, call, pdf, right_pdf, BOUND, || {
            format!("lambert_pdf: {}", input())
        });
    }
    let of_a_sample = [
        Aspect::SampleOrNone,
        Aspect::SampledDirection,
        Aspect::SampleRecord,
    ];
    if !findings.is_written("lambert_sample", &of_a_sample) {
        return;
    }
    findings.count_for("lambert_sample");
    findings.answers_of("lambert_sample");
    let sample_input = || format!("lambert_sample: wo = {}, u = {:?}", show(wo), probe.u);
    let Some(sample) = answer.sample else {
        let class = (wo.z != 0.0).then_some(Class::FalseMiss);
        findings.judge_class(Aspect::SampleOrNone, call, class, 1.0, || {
            Message::new("your result: None; expected: a sample".into()).asked(sample_input())
        });
        return;
    };
    let class = (wo.z == 0.0).then_some(Class::FalseHit);
    findings.judge_class(Aspect::SampleOrNone, call, class, 1.0, || {
        Message::new("your result: a sample; expected: None".into())
            .because(", since wo lies in the plane of the surface".into())
            .asked(sample_input())
    });
    if wo.z == 0.0 {
        return;
    }
    findings.expect(Aspect::SampledDirection);
    findings.expect(Aspect::SampleRecord);
    let drawn_wi = Vec3::from(sample.wi);
    let off = (drawn_wi.length() - 1.0).abs();
    let class = if off.is_nan() || off > BOUND {
        Some(Class::WrongLength)
    } else {
        (cosine_of(drawn_wi) == 0.0).then_some(Class::OtherSide)
    };
    findings.judge_class(Aspect::SampledDirection, call, class, off, || {
        Message::new(format!(
            "your result: wi = {} of length {}; expected: a unit vector on the side of wo",
            show(drawn_wi),
            drawn_wi.length()
        ))
        .compares([drawn_wi.length()], [1.0])
        .asked(sample_input())
    });
    // The same mistake gives other numbers for other sampled directions, so known mistakes have a
    // name.
    let f = sample.f;
    let cosine = cosine_of(drawn_wi);
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let known_mistakes = [
        ("f times the cosine", share.map(|channel| channel * cosine)),
        ("f over the cosine", share.map(|channel| channel / cosine)),
        ("f without pi", probe.reflectance),
        ("f without the reflectance", sampled_f([1.0; 3])),
    ];
    let is = |right: Xyz| same_colour(f, right, BOUND);
    let named = known_mistakes
        .iter()
        .find(|(_, wrong)| is(*wrong) && !is(share))
        .map(|(name, _)| Class::Named(name));
    if named.is_some() {
        findings.judge_class(Aspect::SampleRecord, call, named, 1.0, || {
            Message::new(format!("your result: f = {f:?}; expected: {share:?}"))
                .compares(f, share)
                .asked(sample_input())
        });
    } else {
        numbers::colour(
            findings,
            Aspect::SampleRecord,
            call,
            f,
            share,
            BOUND,
            || format!("f of {}", sample_input()),
        );
    }
    let density = density();
    let right = density(cosine);
    // Near the horizon the density may be computed from a more precise cosine than wi.z.
    let bound = BOUND + 1e-15 / right.max(1e-300);
    let known_mistakes = [
        ("pdf 1", 1.0),
        ("pdf of uniform directions", density(0.5)),
        ("pdf without pi", cosine),
        ("pdf of the sine", density(sine)),
        ("pdf of both angles", right * sine),
        ("pdf of an angle", 2.0 * cosine * sine),
        ("pdf of wo", density(wo.z.abs())),
        ("pdf negative", -right),
    ];
    let pdf = sample.pdf;
    let named = known_mistakes
        .iter()
        .find(|(_, wrong)| (pdf - wrong).abs() <= BOUND && (right - wrong).abs() > bound)
        .map(|(name, _)| Class::Named(name));
    if named.is_some() {
        findings.judge_class(Aspect::SampleRecord, call, named, 1.0, || {
            Message::new(format!(
                "your result: pdf = {pdf:?} for wi = {}; expected: {right:?}",
                show(drawn_wi)
            ))
            .compares([pdf], [right])
            .asked(sample_input())
        });
    } else {
        numbers::number(
            findings,
            Aspect::SampleRecord,
            call,
            pdf,
            right,
            bound,
            || format!("pdf of {}", sample_input()),
        );
    }
    let usable = sample.pdf > 0.0 && !sample.delta;
    findings.judge(Aspect::SampleRecord, call, usable, 1.0, || {
        Message::new(format!(
            "your result: pdf = {}, delta = {}; expected: a pdf above 0, and delta = false for a diffuse surface",
            sample.pdf, sample.delta
        ))
        .asked(sample_input())
    });
}
