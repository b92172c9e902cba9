//! The kinds of work: each with its question and its answer, in one list.
//!
//! A new kind is one entry here. The worker runs it (`driver/src/run.rs`), and the crate `judge`
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

/// A kind of work, as a type: its question and its answer, and where they are in [`Work`] and
/// [`Answer`]. The types are in [`kind`].
pub trait Kind: 'static {
    /// The input of the work.
    type Question: Clone;

    /// The result of the work.
    type Answer: Clone;

    /// The work with this question.
    fn work(question: Self::Question) -> Work;

    /// The question of `work`; `None` if it is of another kind.
    fn question(work: &Work) -> Option<&Self::Question>;

    /// The typed answer in `answer`; `None` if it is to work of another kind.
    fn answer(answer: &Answer) -> Option<&Self::Answer>;

    /// The answer in the form that is sent.
    fn answered(answer: Self::Answer) -> Answer;
}

/// The answers to all calls of a work, as far as they can be compared with each other.
trait AllCalls {
    /// Whether there are several, and all are the same.
    fn are_equal(&self) -> bool {
        false
    }
}

impl<T: PartialEq> AllCalls for Vec<T> {
    fn are_equal(&self) -> bool {
        self.len() > 1 && self.windows(2).all(|pair| pair[0] == pair[1])
    }
}

impl AllCalls for HitsAnswer {}
impl AllCalls for BuildAnswer {}
impl AllCalls for BuildGrowthAnswer {}
impl AllCalls for TimingAnswer {}
impl AllCalls for VisitsAnswer {}
impl AllCalls for PictureAnswer {}

/// Defines [`Work`] and [`Answer`], with a variant of the same name for each kind, the types in
/// [`kind`], and the list [`each_kind!`](crate::each_kind).
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

            /// Whether the answers to all of several calls are the same.
            pub fn is_the_same_for_all_calls(&self) -> bool {
                match self {
                    $(Answer::$kind(answer) => answer.are_equal(),)*
                }
            }
        }

        /// Calls a macro with the names of all kinds: for a `match` that a new kind extends by itself.
        #[macro_export]
        macro_rules! each_kind {
            ($then:ident) => {
                $then! { $($kind)* }
            };
        }

        /// A type for each kind of work, with the name of its variant.
        pub mod kind {
            use super::*;

            $(
                $(#[$doc])*
                #[derive(Clone, Copy, Debug)]
                pub struct $kind;

                impl Kind for $kind {
                    type Question = $question;
                    type Answer = $answer;

                    fn work(question: $question) -> Work {
                        Work::$kind(question)
                    }

                    fn question(work: &Work) -> Option<&$question> {
                        match work {
                            Work::$kind(question) => Some(question),
                            _ => None,
                        }
                    }

                    fn answer(answer: &Answer) -> Option<&$answer> {
                        match answer {
                            Answer::$kind(answer) => Some(answer),
                            _ => None,
                        }
                    }

                    fn answered(answer: $answer) -> Answer {
                        Answer::$kind(answer)
                    }
                }
            )*
        }
    };
}

kinds! {
    /// Call `raytrace_pixel` with a camera and a world that record their calls.
    Pixels(PixelWork) -> Vec<PixelAnswer>;
    /// Call `generate_ray` for every camera and every sensor point.
    CameraRays(CameraWork) -> Vec<Ray>;
    /// Call `test_triangle`, and `intersect_triangle` or `record_triangle`, for every probe.
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
