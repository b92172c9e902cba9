//! From a case to its record.

#[cfg(any(feature = "intersect", feature = "bbox"))]
use crate::timed;
use wire::work::Shapes;
use wire::{Answer, Case, Record, Work};

/// Runs case number `index` on the linked stages.
pub fn run(index: u32, case: &Case) -> Record {
    harness::run(index, case, dispatch)
}

/// What this worker answers to work for a stage that it was built without.
#[allow(dead_code, reason = "a worker with every stage never says this")]
fn not_linked(stage: &str) -> Result<Answer, String> {
    Err(format!("this worker was built without the stage `{stage}`"))
}

fn dispatch(work: &Work) -> Result<Answer, String> {
    match work {
        #[cfg(feature = "raygen")]
        Work::Pixels(pixels) => Ok(Answer::Pixels(crate::raygen::pixels(pixels))),
        #[cfg(feature = "raygen")]
        Work::CameraRays { cameras, sensor } => Ok(Answer::CameraRays(crate::raygen::camera_rays(
            cameras, sensor,
        ))),
        #[cfg(not(feature = "raygen"))]
        Work::Pixels(_) | Work::CameraRays { .. } => not_linked("raygen"),

        #[cfg(feature = "intersect")]
        Work::Triangles { triangles, probes } => Ok(Answer::Triangles(
            crate::intersect::triangles(triangles, probes),
        )),
        #[cfg(feature = "intersect")]
        Work::Spheres { spheres, probes } => {
            Ok(Answer::Spheres(crate::intersect::spheres(spheres, probes)))
        }
        #[cfg(feature = "intersect")]
        Work::BruteForce {
            triangles,
            spheres,
            rays,
        } => Ok(Answer::Hits(crate::intersect::brute_force(
            triangles, spheres, rays,
        ))),
        #[cfg(not(feature = "intersect"))]
        Work::Triangles { .. } | Work::Spheres { .. } | Work::BruteForce { .. } => {
            not_linked("intersect")
        }

        #[cfg(feature = "bbox")]
        Work::Boxes { boxes, probes } => Ok(Answer::Boxes(crate::bbox::boxes(boxes, probes))),
        #[cfg(not(feature = "bbox"))]
        Work::Boxes { .. } => not_linked("bbox"),

        #[cfg(feature = "bvh")]
        Work::Build {
            bounds,
            max_leaf_size,
        } => Ok(Answer::Build(crate::bvh::build(bounds, *max_leaf_size))),
        #[cfg(feature = "bvh")]
        Work::Traverse(world) => Ok(Answer::Traverse(crate::bvh::traverse(world))),
        #[cfg(not(feature = "bvh"))]
        Work::Build { .. } | Work::Traverse(_) => not_linked("bvh"),

        Work::TimeTest(timing) => match &timing.shapes {
            #[cfg(feature = "intersect")]
            Shapes::Triangles(triangles) => Ok(timed::triangles(triangles, timing)),
            #[cfg(feature = "intersect")]
            Shapes::Spheres(spheres) => Ok(timed::spheres(spheres, timing)),
            #[cfg(not(feature = "intersect"))]
            Shapes::Triangles(_) | Shapes::Spheres(_) => not_linked("intersect"),
            #[cfg(feature = "bbox")]
            Shapes::Boxes(boxes) => Ok(timed::boxes(boxes, timing)),
            #[cfg(not(feature = "bbox"))]
            Shapes::Boxes(_) => not_linked("bbox"),
        },

        #[cfg(feature = "direct")]
        Work::Lambert(probes) => Ok(Answer::Lambert(crate::direct::lambert(probes))),
        #[cfg(feature = "direct")]
        Work::Direct(work) => Ok(Answer::Direct(crate::direct::direct(work))),
        #[cfg(not(feature = "direct"))]
        Work::Lambert(_) | Work::Direct(_) => not_linked("direct"),

        #[cfg(feature = "global")]
        Work::Specular(calls) => Ok(Answer::Specular(crate::global::specular(calls))),
        #[cfg(feature = "global")]
        Work::Paths(paths) => Ok(Answer::Paths(crate::global::paths(paths))),
        #[cfg(feature = "global")]
        Work::Roulette(work) => Ok(Answer::Roulette(crate::global::roulette(work))),
        #[cfg(not(feature = "global"))]
        Work::Specular(_) | Work::Paths(_) | Work::Roulette(_) => not_linked("global"),

        #[cfg(feature = "adaptive")]
        Work::Stop(calls) => Ok(Answer::Stop(crate::adaptive::stop(calls))),
        #[cfg(feature = "adaptive")]
        Work::SureStop(calls) => Ok(Answer::Stop(crate::adaptive::sure_stop(calls))),
        #[cfg(feature = "adaptive")]
        Work::AdaptivePixels(pixels) => Ok(Answer::AdaptivePixels(crate::adaptive::pixels(pixels))),
        #[cfg(not(feature = "adaptive"))]
        Work::Stop(_) | Work::SureStop(_) | Work::AdaptivePixels(_) => not_linked("adaptive"),

        #[cfg(feature = "meshes")]
        Work::SceneHits {
            scene,
            tree,
            rays,
            any_hit,
        } => crate::meshes::scene_hits(scene, tree, rays, *any_hit).map(Answer::Hits),
        #[cfg(feature = "meshes")]
        Work::Timing(timing) => crate::meshes::time(timing).map(Answer::Timing),
        #[cfg(feature = "meshes")]
        Work::Visits { scene, tree, rays } => {
            crate::visits::visits(scene, tree, rays).map(Answer::Visits)
        }
        #[cfg(not(feature = "meshes"))]
        Work::SceneHits { .. } | Work::Timing(_) | Work::Visits { .. } => not_linked("meshes"),
    }
}
