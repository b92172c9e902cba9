//! `part3.task1`: diffuse surfaces.

mod call;
pub(crate) mod cases;
pub(crate) mod judge;
mod lines;
mod repro;
mod simple;
mod truth;
mod turns;

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{AxisMoves, LightMoves, Move, Symmetries};
use crate::tools::plural;
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::each;
use wire::direct::{LambertAnswer, LambertProbe};
use wire::kind;
use wire::light::BsdfSample;

/// The right density of the directions that a diffuse surface samples, by their cosine to the
/// normal: for drawings.
pub fn diffuse_density() -> impl Fn(f64) -> f64 {
    truth::density()
}

impl Check for kind::Lambert {
    const MAIN: &'static [Aspect] = &[
        Aspect::Bsdf,
        Aspect::Pdf,
        Aspect::SampledDirection,
        Aspect::Spread,
    ];

    fn calls(probes: &Vec<LambertProbe>) -> usize {
        probes.len()
    }

    fn only_call(probes: &Vec<LambertProbe>, call: usize) -> Option<Vec<LambertProbe>> {
        Some(vec![*probes.get(call)?])
    }

    fn fits(probes: &Vec<LambertProbe>, answers: &Vec<LambertAnswer>) -> Result<(), String> {
        one_each(Self::calls(probes), answers)
    }

    fn look_up_truth(probes: &Vec<LambertProbe>) {
        truth::density()(1.0);
        for probe in probes {
            truth::right(probe);
        }
    }

    fn symmetries(probes: &Vec<LambertProbe>) -> Symmetries {
        let channels = probes.iter().flat_map(|probe| probe.reflectance);
        Symmetries {
            axes: AxisMoves::AroundZ,
            light: LightMoves::of_channels(channels),
            ..Symmetries::default()
        }
    }

    fn moved(probes: &Vec<LambertProbe>, by: &Move) -> Vec<LambertProbe> {
        let each = probes.iter().map(|probe| LambertProbe {
            reflectance: by.light(probe.reflectance),
            wo: by.unit(probe.wo),
            wi: by.unit(probe.wi),
            u: probe.u,
        });
        each.collect()
    }

    /// A sampled direction stays: it depends on the numbers, which are not moved.
    fn moved_back(answers: &Vec<LambertAnswer>, back: &Move) -> Vec<LambertAnswer> {
        let each = answers.iter().map(|answer| LambertAnswer {
            f: back.light(answer.f),
            pdf: answer.pdf,
            sample: answer.sample.map(|sample| BsdfSample {
                f: back.light(sample.f),
                ..sample
            }),
        });
        each.collect()
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        probes: &Vec<LambertProbe>,
        answers: &Vec<LambertAnswer>,
    ) {
        judge::lambert(findings, probes, answers);
    }

    fn judge_rest(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        probes: &Vec<LambertProbe>,
        answers: &Vec<LambertAnswer>,
    ) {
        judge::untested(findings, probes, answers);
    }

    fn lines(probes: &Vec<LambertProbe>, answers: &Vec<LambertAnswer>) -> Option<Content> {
        Some((Vec::new(), each(probes, answers, lines::lambert)))
    }

    fn input(work: &Vec<LambertProbe>, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &Vec<LambertProbe>, call: usize) -> Option<Vec<&'static str>> {
        call::circumstances(work, call)
    }

    fn shown(
        work: &Vec<LambertProbe>,
        _: Tier,
        _: bool,
        call: usize,
        _: Option<&Vec<LambertAnswer>>,
    ) -> Option<ShownCall> {
        work.get(call).copied().map(ShownCall::Directions)
    }

    fn overview(work: &Vec<LambertProbe>) -> String {
        format!("{} of directions", plural(work.len(), "pair", "pairs"))
    }

    fn repro(_: Tier, probes: &Vec<LambertProbe>, call: usize) -> Option<String> {
        Some(repro::matte(probes.get(call)?))
    }

    /// The test makes one call, which shows nothing about statistics of many.
    fn repro_shows(aspect: Aspect) -> bool {
        !matches!(aspect, Aspect::Spread | Aspect::Mean)
    }

    fn simple(_: &Vec<LambertProbe>) -> Vec<Vec<LambertProbe>> {
        simple::questions()
    }
}
