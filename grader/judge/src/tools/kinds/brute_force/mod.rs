//! Rays traced through a list of shapes: the cases of `part1.task3` and `part1.task4` with many
//! shapes.

mod call;
mod judge;
mod repro;
mod simple;

use crate::tools::aspects::hits;
use crate::tools::call_text::ray_circumstances;
use crate::tools::check::{CaseContext, Check, hits_fit};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{Move, Symmetries};
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::Fields;
use crate::tools::snapshot::lines::{self, each};
use crate::tools::truth::expected::Expected;
use crate::tools::truth::scene::of_each_ray;
use crate::tools::{Tier, colours, convert, truth};
use oracle::Shapes;
use wire::answer::HitsAnswer;
use wire::kind;
use wire::work::{BruteForceWork, Xyz};

impl Check for kind::BruteForce {
    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::T];

    fn calls(work: &BruteForceWork) -> usize {
        work.rays.len()
    }

    fn only_call(work: &BruteForceWork, call: usize) -> Option<BruteForceWork> {
        Some(BruteForceWork {
            rays: vec![*work.rays.get(call)?],
            ..work.clone()
        })
    }

    fn fits(work: &BruteForceWork, answer: &HitsAnswer) -> Result<(), String> {
        hits_fit(Self::calls(work), answer)
    }

    fn symmetries(work: &BruteForceWork) -> Symmetries {
        let triangles = work
            .triangles
            .iter()
            .flat_map(|[p0, p1, p2, ..]| [*p0, *p1, *p2]);
        let spheres = work
            .spheres
            .iter()
            .flat_map(|(center, radius)| [*center, [*radius; 3]]);
        Symmetries::of_space(triangles.chain(spheres), &work.rays)
    }

    fn moved(work: &BruteForceWork, by: &Move) -> BruteForceWork {
        BruteForceWork {
            triangles: work.triangles.iter().map(|t| by.triangle(t)).collect(),
            spheres: work.spheres.iter().map(|s| by.sphere(s)).collect(),
            rays: work.rays.iter().map(|ray| by.ray(ray)).collect(),
        }
    }

    fn moved_back(answer: &HitsAnswer, back: &Move) -> HitsAnswer {
        back.hits(answer)
    }

    fn expected(work: &BruteForceWork, tier: Tier, enclosed: bool) -> Vec<Expected> {
        let scene = convert::scene(&work.triangles, &work.spheres);
        let shapes = Shapes::new(scene.primitives());
        of_each_ray(&work.rays, |ray| {
            truth::first_of(tier, &shapes, &convert::ray(ray), enclosed)
        })
    }

    fn judge(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &BruteForceWork,
        answer: &HitsAnswer,
    ) {
        let function = match work.triangles.is_empty() {
            true => "intersect_sphere",
            false => "intersect_triangle",
        };
        if !findings.is_written(function, &hits::OF_A_RECORD) {
            return;
        }
        findings.count_for(function);
        let expected = case.expected(tier, || Self::expected(work, tier, case.enclosed));
        judge::brute_force(findings, &work.rays, expected, answer, case.enclosed);
    }

    fn judge_rest(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &BruteForceWork,
        answer: &HitsAnswer,
    ) {
        let expected = case.expected(tier, || Self::expected(work, tier, case.enclosed));
        judge::parameters(findings, &work.rays, expected, answer);
    }

    fn lines(work: &BruteForceWork, answer: &HitsAnswer) -> Option<Content> {
        let lines = each(&work.rays, &answer.hits, |ray, hit| {
            lines::hit(None, ray, hit.as_ref())
        });
        Some((Vec::new(), lines))
    }

    fn input(work: &BruteForceWork, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &BruteForceWork, call: usize) -> Option<Vec<&'static str>> {
        work.rays.get(call).map(ray_circumstances)
    }

    fn exact(work: &BruteForceWork, enclosed: bool, calls: &[u32]) -> Option<Vec<Fields>> {
        Some(call::exact(work, enclosed, calls))
    }

    fn shown(
        work: &BruteForceWork,
        tier: Tier,
        enclosed: bool,
        call: usize,
        answer: Option<&HitsAnswer>,
    ) -> Option<ShownCall> {
        call::shown(work, tier, enclosed, call, answer)
    }

    fn repro(tier: Tier, work: &BruteForceWork, call: usize) -> Option<String> {
        repro::first_of(tier, &work.triangles, &work.spheres, work.rays.get(call)?)
    }

    fn colours(answer: &HitsAnswer) -> Option<Vec<Xyz>> {
        let hits = answer.hits.iter().map(Option::as_ref);
        Some(hits.map(colours::hit).collect())
    }

    fn simple(work: &BruteForceWork) -> Vec<BruteForceWork> {
        match work.triangles.is_empty() {
            true => simple::spheres(),
            false => simple::triangles(),
        }
    }
}
