//! `part1.task3`: triangles.

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
use kit::Triangle;
use wire::answer::TriangleAnswer;
use wire::kind;
use wire::work::{TriangleWork, Xyz};

impl Check for kind::Triangles {
    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::T];

    fn calls(work: &TriangleWork) -> usize {
        work.probes.len()
    }

    fn only_call(work: &TriangleWork, call: usize) -> Option<TriangleWork> {
        Some(TriangleWork {
            triangles: work.triangles.clone(),
            probes: vec![*work.probes.get(call)?],
            by_record: work.by_record,
        })
    }

    fn fits(work: &TriangleWork, answers: &Vec<TriangleAnswer>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
    }

    fn symmetries(work: &TriangleWork) -> Symmetries {
        let points = work
            .triangles
            .iter()
            .flat_map(|[p0, p1, p2, ..]| [p0, p1, p2]);
        let rays = work.probes.iter().map(|probe| &probe.ray);
        Symmetries::of_space(points.copied(), rays)
    }

    fn moved(work: &TriangleWork, by: &Move) -> TriangleWork {
        TriangleWork {
            triangles: work.triangles.iter().map(|t| by.triangle(t)).collect(),
            probes: work.probes.iter().map(|probe| by.probe(probe)).collect(),
            by_record: work.by_record,
        }
    }

    fn moved_back(answers: &Vec<TriangleAnswer>, back: &Move) -> Vec<TriangleAnswer> {
        let each = answers.iter().map(|answer| TriangleAnswer {
            test: answer.test.map(|[t, b1, b2]| [back.t(t), b1, b2]),
            hit: answer.hit.map(|hit| back.hit(&hit)),
            ray_after: back.ray(&answer.ray_after),
        });
        each.collect()
    }

    fn expected(work: &TriangleWork, tier: Tier, _: bool) -> Vec<Expected> {
        let triangles: Vec<Triangle> = work.triangles.iter().map(convert::triangle).collect();
        let of = work.probes.iter().map(|probe| {
            let triangle = &triangles[probe.shape as usize];
            truth::triangle(tier, probe.shape, triangle, &convert::ray(&probe.ray))
        });
        of.collect()
    }

    fn judge(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &TriangleWork,
        answers: &Vec<TriangleAnswer>,
    ) {
        let expected = case.expected(tier, || Self::expected(work, tier, case.enclosed));
        judge::triangles(findings, work, expected, answers);
    }

    fn lines(work: &TriangleWork, answers: &Vec<TriangleAnswer>) -> Option<Content> {
        let lines = each(&work.probes, answers, |probe, answer| {
            lines::hit(Some(probe.shape), &probe.ray, answer.hit.as_ref())
        });
        Some((Vec::new(), lines))
    }

    fn input(work: &TriangleWork, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &TriangleWork, call: usize) -> Option<Vec<&'static str>> {
        call::circumstances(work, call)
    }

    fn exact(work: &TriangleWork, _: bool, calls: &[u32]) -> Option<Vec<Fields>> {
        Some(call::exact(work, calls))
    }

    fn shown(
        work: &TriangleWork,
        tier: Tier,
        _: bool,
        call: usize,
        answer: Option<&Vec<TriangleAnswer>>,
    ) -> Option<ShownCall> {
        call::shown(work, tier, call, answer)
    }

    fn overview(work: &TriangleWork) -> String {
        plural(work.triangles.len(), "triangle", "triangles")
    }

    fn repro(tier: Tier, work: &TriangleWork, call: usize) -> Option<String> {
        repro::triangle(tier, work, work.probes.get(call)?)
    }

    fn colours(answers: &Vec<TriangleAnswer>) -> Option<Vec<Xyz>> {
        let hits = answers.iter().map(|answer| answer.hit.as_ref());
        Some(hits.map(colours::hit).collect())
    }

    fn vary(work: &mut TriangleWork, change: &mut dyn FnMut(Number, &mut f64)) {
        for [a, b, c, normals @ ..] in &mut work.triangles {
            for p in [a, b, c] {
                numbers::point(p, Number::Length, change);
            }
            for n in normals {
                numbers::point(n, Number::Normal, change);
            }
        }
        numbers::rays(&mut work.probes, change);
    }

    fn simple(work: &TriangleWork) -> Vec<TriangleWork> {
        simple::questions(work.by_record)
    }
}
