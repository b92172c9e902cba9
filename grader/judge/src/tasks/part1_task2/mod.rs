//! `part1.task2`: camera rays.

mod call;
pub(crate) mod cases;
pub(crate) mod judge;
mod lines;
mod repro;
mod simple;

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::colours;
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::Fields;
use crate::tools::tally::{Aspect, Tally};
use wire::kind;
use wire::work::{CameraWork, Ray, Xyz};

impl Check for kind::CameraRays {
    const MAIN: &'static [Aspect] = &[Aspect::Direction];

    fn calls(work: &CameraWork) -> usize {
        work.cameras.len() * work.sensor.len()
    }

    fn only_call(work: &CameraWork, call: usize) -> Option<CameraWork> {
        let points = work.sensor.len().max(1);
        Some(CameraWork {
            cameras: vec![*work.cameras.get(call / points)?],
            sensor: vec![*work.sensor.get(call % points)?],
        })
    }

    fn fits(work: &CameraWork, answers: &Vec<Ray>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
    }

    fn judge(
        tally: &mut Tally,
        _: &CaseContext<'_>,
        tier: Tier,
        work: &CameraWork,
        answers: &Vec<Ray>,
    ) {
        judge::rays(tally, tier, &work.cameras, &work.sensor, answers);
    }

    fn lines(work: &CameraWork, answers: &Vec<Ray>) -> Option<Content> {
        Some((Vec::new(), lines::rays(work, answers)))
    }

    fn input(work: &CameraWork, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &CameraWork, call: usize) -> Vec<&'static str> {
        call::circumstances(work, call)
    }

    fn exact(_: &CameraWork, _: bool, _: &[u32]) -> Option<Vec<Fields>> {
        None
    }

    fn shown(
        work: &CameraWork,
        _: Tier,
        _: bool,
        call: usize,
        answer: Option<&Vec<Ray>>,
    ) -> Option<ShownCall> {
        call::shown(work, call, answer)
    }

    fn overview(work: &CameraWork) -> String {
        call::overview(work)
    }

    fn repro(_: Tier, work: &CameraWork, call: usize) -> Option<String> {
        let camera = work.cameras.get(call.checked_div(work.sensor.len())?)?;
        Some(repro::ray(camera, work.sensor[call % work.sensor.len()]))
    }

    fn colours(answers: &Vec<Ray>) -> Option<Vec<Xyz>> {
        let rays = answers.iter();
        Some(rays.map(|ray| colours::direction(ray.d)).collect())
    }

    fn simple(_: &CameraWork) -> Vec<CameraWork> {
        simple::questions()
    }
}
