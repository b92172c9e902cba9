//! Runs a case and returns its record.

use crate::stages::{Stages, linked};
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
    let raygen = || linked(&stages.raygen, "raygen");
    let intersect = || linked(&stages.intersect, "intersect");
    let bbox = || linked(&stages.bbox, "bbox");
    let bvh = || linked(&stages.bvh, "bvh");
    let direct = || linked(&stages.direct, "direct");
    let global = || linked(&stages.global, "global");
    let adaptive = || linked(&stages.adaptive, "adaptive");
    Ok(match work {
        Work::Pixels(work) => Answer::Pixels(raygen::pixels(raygen()?, work)),
        Work::CameraRays(work) => Answer::CameraRays(raygen::camera_rays(raygen()?, work)),

        Work::Triangles(work) => Answer::Triangles(intersect::triangles(intersect()?, work)),
        Work::Spheres(work) => Answer::Spheres(intersect::spheres(intersect()?, work)),
        Work::BruteForce(work) => Answer::BruteForce(intersect::brute_force(intersect()?, work)),

        Work::Boxes(work) => Answer::Boxes(bbox::boxes(bbox()?, work)),
        Work::Build(work) => Answer::Build(bvh::build(bvh()?, work)),
        Work::BuildGrowth(work) => {
            Answer::BuildGrowth(build_growth::time_builds(work, bvh()?.construct_bvh))
        }
        Work::Traverse(world) => Answer::Traverse(bvh::traverse(bvh()?, world)),
        Work::SceneHits(work) => Answer::SceneHits(meshes::scene_hits(stages.of_scenes()?, work)?),
        Work::Timing(timing) => Answer::Timing(meshes::time(stages.of_scenes()?, timing)?),
        Work::Visits(work) => Answer::Visits(visits::visits(stages.of_scenes()?, work)?),
        Work::TimeTest(timing) => Answer::TimeTest(timed::test(stages, timing)?),

        Work::Lambert(probes) => Answer::Lambert(direct::lambert(direct()?, probes)),
        Work::Direct(work) => Answer::Direct(direct::direct(direct()?, work)),

        Work::Specular(calls) => Answer::Specular(global::specular(global()?, calls)),
        Work::Paths(paths) => Answer::Paths(global::paths(global()?, paths)),
        Work::Roulette(work) => Answer::Roulette(global::roulette(global()?, work)),

        Work::Stop(calls) => Answer::Stop(adaptive::stop(adaptive()?, calls)),
        Work::SureStop(calls) => Answer::SureStop(adaptive::sure_stop(adaptive()?, calls)),
        Work::AdaptivePixels(pixels) => {
            Answer::AdaptivePixels(adaptive::pixels(adaptive()?, pixels))
        }

        Work::Picture(work) => Answer::Picture(picture::picture(stages, work)?),
    })
}
