//! The kinds of work: each with its question and its answer, in one list.
//!
//! A new kind is one entry here. The worker runs it (`worker/src/run.rs`), and the crate `judge`
//! has a check for it.

use crate::adaptive::{AdaptiveAnswer, AdaptivePixel, StopAnswer, StopCall};
use crate::answer::{
    BuildAnswer, BuildGrowthAnswer, HitsAnswer, PixelAnswer, SphereAnswer, TimingAnswer,
    TraverseAnswer, TriangleAnswer, VisitsAnswer,
};
use crate::direct::{DirectAnswer, DirectWork, LambertAnswer, LambertProbe};
use crate::global::{PathAnswer, RouletteWork, ScriptedPath, SpecularAnswer, SpecularCall};
use crate::picture::{PictureAnswer, PictureWork};
use crate::work::{
    BoxWork, BruteForceWork, BuildGrowthWork, BuildWork, CameraWork, PixelWork, Ray, SceneWork,
    ScriptedWorld, SphereWork, TestTiming, TimingWork, TriangleWork, VisitsWork, Xyz,
};
use serde::{Deserialize, Serialize};

/// Defines [`Work`] and [`Answer`], with a variant of the same name for each kind.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident($question:ty) -> $answer:ty;)*) => {
        /// What the worker does in a case: a kind of work and its question.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        pub enum Work {
            $($(#[$doc])* $kind($question),)*
        }

        /// The results of the student's code: for most kinds of work, one entry per call.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        pub enum Answer {
            $(
                #[doc = concat!("The answer to [`Work::", stringify!($kind), "`].")]
                $kind($answer),
            )*
        }

        impl Work {
            /// The name of the kind.
            pub fn kind(&self) -> &'static str {
                match self {
                    $(Work::$kind(_) => stringify!($kind),)*
                }
            }
        }

        impl Answer {
            /// The name of the kind of work that it belongs to.
            pub fn kind(&self) -> &'static str {
                match self {
                    $(Answer::$kind(_) => stringify!($kind),)*
                }
            }
        }
    };
}

kinds! {
    /// Call `raytrace_pixel` with a camera and a world that record their calls.
    Pixels(PixelWork) -> Vec<PixelAnswer>;
    /// Call `generate_ray` for every camera and every sensor point.
    CameraRays(CameraWork) -> Vec<Ray>;
    /// Call `test_triangle` and `intersect_triangle` for every probe.
    Triangles(TriangleWork) -> Vec<TriangleAnswer>;
    /// Call `test_sphere` and `intersect_sphere` for every probe.
    Spheres(SphereWork) -> Vec<SphereAnswer>;
    /// Call `intersect_*` for every ray with all primitives in order, with the same ray for all of
    /// them.
    BruteForce(BruteForceWork) -> HitsAnswer;
    /// Call `intersect_bbox` for every probe.
    Boxes(BoxWork) -> Vec<Option<[f64; 2]>>;
    /// Call `construct_bvh`, twice.
    Build(BuildWork) -> BuildAnswer;
    /// Time `construct_bvh` over ever more primitives.
    BuildGrowth(BuildGrowthWork) -> BuildGrowthAnswer;
    /// Call `intersect_bvh` or `occludes_bvh` in a world whose test results are given.
    Traverse(ScriptedWorld) -> Vec<TraverseAnswer>;
    /// Trace rays through a scene with all of the student's stages and a given tree.
    SceneHits(SceneWork) -> HitsAnswer;
    /// Time the student's tree and the student's brute force.
    Timing(TimingWork) -> TimingAnswer;
    /// Time one of the student's intersection tests: seconds of each round.
    TimeTest(TestTiming) -> Vec<f64>;
    /// Trace the closest hits of rays through a scene, and record which boxes of its tree are
    /// tested.
    Visits(VisitsWork) -> VisitsAnswer;
    /// Call `lambert_f`, `lambert_pdf` and `lambert_sample` for every probe.
    Lambert(Vec<LambertProbe>) -> Vec<LambertAnswer>;
    /// Estimate direct light in a world that records the traced rays.
    Direct(DirectWork) -> Vec<DirectAnswer>;
    /// Call the functions of mirrors and glass.
    Specular(Vec<SpecularCall>) -> Vec<SpecularAnswer>;
    /// Call `estimate_radiance` for paths whose surfaces and samples are given.
    Paths(Vec<ScriptedPath>) -> Vec<PathAnswer>;
    /// Call `play_roulette` for each path and each number. The answer is the new throughput.
    Roulette(RouletteWork) -> Vec<Option<Xyz>>;
    /// Call `has_converged`.
    Stop(Vec<StopCall>) -> Vec<StopAnswer>;
    /// Call `has_surely_converged` with a plain rule whose result is given.
    SureStop(Vec<StopCall>) -> Vec<StopAnswer>;
    /// Call `raytrace_pixel_adaptive` with samples that are given.
    AdaptivePixels(Vec<AdaptivePixel>) -> Vec<AdaptiveAnswer>;
    /// Render the picture of a task.
    Picture(PictureWork) -> PictureAnswer;
}
