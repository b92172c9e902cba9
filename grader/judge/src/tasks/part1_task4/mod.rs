//! `part1.task4`: spheres.

pub(crate) mod cases;
pub(crate) mod judge;
mod repro;

use crate::cases::Spec;
use crate::check::{Check, Content, one_each};
use crate::expected::Expected;
use crate::snapshot::lines::{self, each};
use crate::tally::{Aspect, Tally};
use crate::{Tier, convert, picture, truth};
use kit::Sphere;
use wire::answer::SphereAnswer;
use wire::work::{SphereWork, Xyz};

/// `test_sphere` and `intersect_sphere`, both called for each probe.
pub(crate) struct Spheres;

impl Check for Spheres {
    type Question = SphereWork;
    type Answer = Vec<SphereAnswer>;

    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::T];

    fn calls(work: &SphereWork) -> usize {
        work.probes.len()
    }

    fn fits(work: &SphereWork, answers: &Vec<SphereAnswer>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
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
        tally: &mut Tally,
        spec: &Spec,
        tier: Tier,
        work: &SphereWork,
        answers: &Vec<SphereAnswer>,
    ) {
        let expected = spec.expected_cache.of_shapes(spec, tier);
        judge::spheres(tally, &work.probes, expected, answers);
    }

    fn judge_rest(
        tally: &mut Tally,
        _: &Spec,
        _: Tier,
        work: &SphereWork,
        answers: &Vec<SphereAnswer>,
    ) {
        judge::parameters(tally, &work.probes, answers);
    }

    fn lines(work: &SphereWork, answers: &Vec<SphereAnswer>) -> Option<Content> {
        let lines = each(&work.probes, answers, |probe, answer| {
            lines::hit(Some(probe.shape), &probe.ray, answer.hit.as_ref())
        });
        Some((Vec::new(), lines))
    }

    fn repro(tier: Tier, work: &SphereWork, call: usize) -> Option<String> {
        repro::sphere(tier, &work.spheres, work.probes.get(call)?)
    }

    fn colours(answers: &Vec<SphereAnswer>) -> Option<Vec<Xyz>> {
        let hits = answers.iter().map(|answer| answer.hit.as_ref());
        Some(hits.map(picture::hit).collect())
    }
}
