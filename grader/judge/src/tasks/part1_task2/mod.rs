//! `part1.task2`: camera rays.

pub(crate) mod cases;
pub(crate) mod judge;
mod lines;
mod repro;

use crate::Tier;
use crate::cases::Spec;
use crate::check::{Check, Content, one_each};
use crate::picture;
use crate::tally::{Aspect, Tally};
use wire::work::{CameraWork, Ray, Xyz};

/// `generate_ray`, called for every camera and for each of them with every sensor point.
pub(crate) struct CameraRays;

impl Check for CameraRays {
    type Question = CameraWork;
    type Answer = Vec<Ray>;

    const MAIN: &'static [Aspect] = &[Aspect::Direction];

    fn calls(work: &CameraWork) -> usize {
        work.cameras.len() * work.sensor.len()
    }

    fn fits(work: &CameraWork, answers: &Vec<Ray>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
    }

    fn judge(tally: &mut Tally, _: &Spec, tier: Tier, work: &CameraWork, answers: &Vec<Ray>) {
        judge::rays(tally, tier, &work.cameras, &work.sensor, answers);
    }

    fn lines(work: &CameraWork, answers: &Vec<Ray>) -> Option<Content> {
        Some((Vec::new(), lines::rays(work, answers)))
    }

    fn repro(_: Tier, work: &CameraWork, call: usize) -> Option<String> {
        let camera = work.cameras.get(call.checked_div(work.sensor.len())?)?;
        Some(repro::ray(camera, work.sensor[call % work.sensor.len()]))
    }

    fn colours(answers: &Vec<Ray>) -> Option<Vec<Xyz>> {
        let rays = answers.iter();
        Some(rays.map(|ray| picture::direction(ray.d)).collect())
    }
}
