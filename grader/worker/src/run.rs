//! Runs a case and returns its record.

use wire::{Answer, Case, Record, Work};

/// Runs case number `index` on the linked stages.
pub fn run(index: u32, case: &Case) -> Record {
    harness::run(index, case, dispatch)
}

/// Calls the stage of `work`.
fn dispatch(work: &Work) -> Result<Answer, String> {
    Ok(match work {
        #[cfg(feature = "raygen")]
        Work::Pixels(work) => Answer::Pixels(crate::raygen::pixels(work)),
        #[cfg(feature = "raygen")]
        Work::CameraRays(work) => Answer::CameraRays(crate::raygen::camera_rays(work)),

        #[cfg(feature = "intersect")]
        Work::Triangles(work) => Answer::Triangles(crate::intersect::triangles(work)),
        #[cfg(feature = "intersect")]
        Work::Spheres(work) => Answer::Spheres(crate::intersect::spheres(work)),
        #[cfg(feature = "intersect")]
        Work::BruteForce(work) => Answer::BruteForce(crate::intersect::brute_force(work)),

        #[cfg(feature = "bbox")]
        Work::Boxes(work) => Answer::Boxes(crate::bbox::boxes(work)),
        #[cfg(feature = "bvh")]
        Work::Build(work) => Answer::Build(crate::bvh::build(work)),
        #[cfg(feature = "bvh")]
        Work::BuildGrowth(work) => Answer::BuildGrowth(crate::build_growth::build(work)),
        #[cfg(feature = "bvh")]
        Work::Traverse(world) => Answer::Traverse(crate::bvh::traverse(world)),
        #[cfg(feature = "meshes")]
        Work::SceneHits(work) => Answer::SceneHits(crate::meshes::scene_hits(work)?),
        #[cfg(feature = "meshes")]
        Work::Timing(timing) => Answer::Timing(crate::meshes::time(timing)?),
        #[cfg(feature = "meshes")]
        Work::Visits(work) => Answer::Visits(crate::visits::visits(work)?),
        #[cfg(any(feature = "intersect", feature = "bbox"))]
        Work::TimeTest(timing) => Answer::TimeTest(crate::timed::test(timing)?),

        #[cfg(feature = "direct")]
        Work::Lambert(probes) => Answer::Lambert(crate::direct::lambert(probes)),
        #[cfg(feature = "direct")]
        Work::Direct(work) => Answer::Direct(crate::direct::direct(work)),

        #[cfg(feature = "global")]
        Work::Specular(calls) => Answer::Specular(crate::global::specular(calls)),
        #[cfg(feature = "global")]
        Work::Paths(paths) => Answer::Paths(crate::global::paths(paths)),
        #[cfg(feature = "global")]
        Work::Roulette(work) => Answer::Roulette(crate::global::roulette(work)),

        #[cfg(feature = "adaptive")]
        Work::Stop(calls) => Answer::Stop(crate::adaptive::stop(calls)),
        #[cfg(feature = "adaptive")]
        Work::SureStop(calls) => Answer::SureStop(crate::adaptive::sure_stop(calls)),
        #[cfg(feature = "adaptive")]
        Work::AdaptivePixels(pixels) => Answer::AdaptivePixels(crate::adaptive::pixels(pixels)),

        #[cfg(any(
            feature = "raygen",
            feature = "intersect",
            feature = "bbox",
            feature = "bvh",
            feature = "direct",
            feature = "global",
            feature = "adaptive"
        ))]
        Work::Picture(work) => Answer::Picture(crate::picture::picture(work)?),

        #[allow(
            unreachable_patterns,
            reason = "a worker with every stage has an arm for each kind"
        )]
        other => {
            return Err(format!(
                "this worker was built without the stage for work of the kind {}",
                other.kind()
            ));
        }
    })
}
