//! `part1.task4`: spheres.

mod call;
pub(crate) mod cases;
pub(crate) mod judge;
mod repro;
mod simple;

use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{Move, Symmetries};
use crate::tools::plural;
use crate::tools::shown::ShownCall;
use crate::tools::simple::numbers::{self, Number};
use crate::tools::snapshot::Content;
use crate::tools::snapshot::Fields;
use crate::tools::snapshot::lines::{self, each};
use crate::tools::truth::expected::Expected;
use crate::tools::{Tier, colours, convert, truth};
use kit::Sphere;
use wire::answer::SphereAnswer;
use wire::kind;
use wire::work::{SphereWork, Xyz};

impl Check for kind::Spheres {
    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::T];

    fn calls(work: &SphereWork) -> usize {
        work.probes.len()
    }

    fn only_call(work: &SphereWork, call: usize) -> Option<SphereWork> {
        Some(SphereWork {
            spheres: work.spheres.clone(),
            probes: vec![*work.probes.get(call)?],
        })
    }

    fn fits(work: &SphereWork, answers: &Vec<SphereAnswer>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
    }

    fn symmetries(work: &SphereWork) -> Symmetries {
        let spheres = work.spheres.iter();
        let points = spheres.flat_map(|(center, radius)| [*center, [*radius; 3]]);
        Symmetries::of_space(points, work.probes.iter().map(|probe| &probe.ray))
    }

    fn moved(work: &SphereWork, by: &Move) -> SphereWork {
        SphereWork {
            spheres: work.spheres.iter().map(|s| by.sphere(s)).collect(),
            probes: work.probes.iter().map(|probe| by.probe(probe)).collect(),
        }
    }

    fn moved_back(answers: &Vec<SphereAnswer>, back: &Move) -> Vec<SphereAnswer> {
        let each = answers.iter().map(|answer| SphereAnswer {
            test: answer.test.map(|t| back.t(t)),
            hit: answer.hit.map(|hit| back.hit(&hit)),
            ray_after: back.ray(&answer.ray_after),
        });
        each.collect()
    }

    fn expected(work: &SphereWork, tier: Tier, _: bool) -> Vec<Expected> {
        let spheres: Vec<Sphere> = work.spheres.iter().map(convert::sphere).collect();
        let of = work.probes.iter().map(|probe| {
            let sphere = &spheres[probe.shape as usize];
            truth::sphere(tier, probe.shape, sphere, &convert::ray(&probe.ray))
        });
        of.collect()
    }

    fn judge(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &SphereWork,
        answers: &Vec<SphereAnswer>,
    ) {
        let expected = case.expected(tier, || Self::expected(work, tier, case.enclosed));
        judge::spheres(findings, &work.probes, expected, answers);
    }

    fn lines(work: &SphereWork, answers: &Vec<SphereAnswer>) -> Option<Content> {
        let lines = each(&work.probes, answers, |probe, answer| {
            lines::hit(Some(probe.shape), &probe.ray, answer.hit.as_ref())
        });
        Some((Vec::new(), lines))
    }

    fn input(work: &SphereWork, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &SphereWork, call: usize) -> Option<Vec<&'static str>> {
        call::circumstances(work, call)
    }

    fn exact(work: &SphereWork, _: bool, calls: &[u32]) -> Option<Vec<Fields>> {
        Some(call::exact(work, calls))
    }

    fn shown(
        work: &SphereWork,
        tier: Tier,
        _: bool,
        call: usize,
        answer: Option<&Vec<SphereAnswer>>,
    ) -> Option<ShownCall> {
        call::shown(work, tier, call, answer)
    }

    fn overview(work: &SphereWork) -> String {
        plural(work.spheres.len(), "sphere", "spheres")
    }

    fn repro(tier: Tier, work: &SphereWork, call: usize) -> Option<String> {
        repro::sphere(tier, &work.spheres, work.probes.get(call)?)
    }

    fn colours(answers: &Vec<SphereAnswer>) -> Option<Vec<Xyz>> {
        let hits = answers.iter().map(|answer| answer.hit.as_ref());
        Some(hits.map(colours::hit).collect())
    }

    fn vary(work: &mut SphereWork, change: &mut dyn FnMut(Number, &mut f64)) {
        for (center, radius) in &mut work.spheres {
            numbers::point(center, Number::Length, change);
            change(Number::Length, radius);
        }
        numbers::rays(&mut work.probes, change);
    }

    fn simple(_: &SphereWork) -> Vec<SphereWork> {
        simple::questions()
    }
}
