//! `part1.task2`: camera rays.

mod call;
pub(crate) mod cases;
pub(crate) mod judge;
mod lines;
mod repro;
mod simple;
mod truth;

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::colours;
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{AxisMoves, Move, Symmetries, most_if_ordinary};
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use wire::kind;
use wire::work::{Camera, CameraWork, Ray, Xyz};

/// The rotation of a camera that looks along -z with y up.
const UNROTATED: [Xyz; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

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

    /// The axes of the film are swapped together with those of the camera and of the world, so that
    /// a camera without a rotation stays one. It is not turned: code that forgets the rotation has
    /// its points for such a camera.
    fn symmetries(work: &CameraWork) -> Symmetries {
        let is_rotated = |camera: &Camera| camera.c2w != UNROTATED;
        let numbers = work.cameras.iter().flat_map(|camera| {
            let [x, y, z] = camera.pos;
            [x, y, z, camera.n_clip, camera.f_clip]
        });
        Symmetries {
            axes: match work.cameras.iter().all(is_rotated) {
                true => AxisMoves::SwapXyAndHalfTurns,
                false => AxisMoves::SwapXy,
            },
            lengths: most_if_ordinary(2, numbers),
            ..Symmetries::default()
        }
    }

    fn moved(work: &CameraWork, by: &Move) -> CameraWork {
        let is_swapped = by.axes().swaps_xy();
        let cameras = work.cameras.iter().map(|camera| {
            let [mut right, mut up, back] = camera.c2w.map(|axis| by.unit(axis));
            let (mut h_fov, mut v_fov) = (camera.h_fov, camera.v_fov);
            if is_swapped {
                std::mem::swap(&mut right, &mut up);
                std::mem::swap(&mut h_fov, &mut v_fov);
            }
            Camera {
                pos: by.point(camera.pos),
                c2w: [right, up, back],
                h_fov,
                v_fov,
                n_clip: by.length(camera.n_clip),
                f_clip: by.length(camera.f_clip),
            }
        });
        let sensor = work.sensor.iter().map(|&[u, v]| match is_swapped {
            true => [v, u],
            false => [u, v],
        });
        CameraWork {
            cameras: cameras.collect(),
            sensor: sensor.collect(),
        }
    }

    fn moved_back(answers: &Vec<Ray>, back: &Move) -> Vec<Ray> {
        answers.iter().map(|ray| back.ray(ray)).collect()
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        tier: Tier,
        work: &CameraWork,
        answers: &Vec<Ray>,
    ) {
        judge::rays(findings, tier, &work.cameras, &work.sensor, answers);
    }

    fn lines(work: &CameraWork, answers: &Vec<Ray>) -> Option<Content> {
        Some((Vec::new(), lines::rays(work, answers)))
    }

    fn input(work: &CameraWork, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &CameraWork, call: usize) -> Option<Vec<&'static str>> {
        call::circumstances(work, call)
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

    fn look_up_truth(work: &CameraWork) {
        for camera in &work.cameras {
            for point in &work.sensor {
                truth::direction(camera, *point);
            }
        }
    }

    fn simple(_: &CameraWork) -> Vec<CameraWork> {
        simple::questions()
    }
}
