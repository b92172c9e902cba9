//! Runs a case and returns its record.

use crate::stages::Stages;
use crate::{
    adaptive, bbox, build_growth, bvh, direct, global, intersect, meshes, picture, raygen,
};
use crate::{timed, visits};
use wire::{Answer, Case, Record, Work};

/// Runs case number `index` on the linked stages.
pub fn run(stages: &Stages, index: u32, case: &Case) -> Record {
    harness::run(index, case, |work| dispatch(stages, work))
}

/// Calls the stage of `work`.
fn dispatch(stages: &Stages, work: &Work) -> Result<Answer, String> {
    Ok(match work {
        Work::Pixels(work) => Answer::Pixels(raygen::pixels(stages.raygen()?, work)),
        Work::CameraRays(work) => Answer::CameraRays(raygen::camera_rays(stages.raygen()?, work)),

        Work::Triangles(work) => Answer::Triangles(intersect::triangles(stages.intersect()?, work)),
        Work::Spheres(work) => Answer::Spheres(intersect::spheres(stages.intersect()?, work)),
        Work::BruteForce(work) => {
            Answer::BruteForce(intersect::brute_force(stages.intersect()?, work))
        }

        Work::Boxes(work) => Answer::Boxes(bbox::boxes(stages.bbox()?, work)),
        Work::Build(work) => Answer::Build(bvh::build(stages.bvh()?, work)),
        Work::BuildGrowth(work) => {
            Answer::BuildGrowth(build_growth::time_builds(work, stages.bvh()?.construct_bvh))
        }
        Work::Traverse(world) => Answer::Traverse(bvh::traverse(stages.bvh()?, world)),
        Work::SceneHits(work) => Answer::SceneHits(meshes::scene_hits(stages.of_scenes()?, work)?),
        Work::Timing(timing) => Answer::Timing(meshes::time(stages.of_scenes()?, timing)?),
        Work::Visits(work) => Answer::Visits(visits::visits(stages.of_scenes()?, work)?),
        Work::TimeTest(timing) => Answer::TimeTest(timed::test(stages, timing)?),

        Work::Lambert(probes) => Answer::Lambert(direct::lambert(stages.direct()?, probes)),
        Work::Direct(work) => Answer::Direct(direct::direct(stages.direct()?, work)),

        Work::Specular(calls) => Answer::Specular(global::specular(stages.global()?, calls)),
        Work::Paths(paths) => Answer::Paths(global::paths(stages.global()?, paths)),
        Work::Roulette(work) => Answer::Roulette(global::roulette(stages.global()?, work)),

        Work::Stop(calls) => Answer::Stop(adaptive::stop(stages.adaptive()?, calls)),
        Work::SureStop(calls) => Answer::SureStop(adaptive::sure_stop(stages.adaptive()?, calls)),
        Work::AdaptivePixels(pixels) => {
            Answer::AdaptivePixels(adaptive::pixels(stages.adaptive()?, pixels))
        }

        Work::Picture(work) => Answer::Picture(picture::picture(stages, work)?),
    })
}
