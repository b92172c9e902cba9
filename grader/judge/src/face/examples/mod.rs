//! Examples that students write before their code: an input, and the result that they expect.
//! [`verdict`] decides whether an example is right, [`Example::situations`] says which situations
//! of the task the example touches, [`Example::question`] asks code what the example asks.
//!
//! An example can be judged where a call has one right result, and where a handout can tell that a
//! result is right without the formula that computes it: the oracle knows it, or a law of
//! geometry or optics does.

mod by_hand;
mod camera;
mod rays;
mod specular;

pub use camera::CameraExample;
pub use rays::{Expectation, RayExample, Shape};
pub use specular::{SpecularExample, SpecularFunction};

use crate::face::cases;
use crate::tools::spec::Spec;
use crate::tools::tally::Aspect;

/// An example of a task.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Example {
    /// Of `part1.task2`.
    Camera(CameraExample),
    /// Of `part1.task3`, `part1.task4` or `part2.task2`.
    Ray(RayExample),
    /// Of `part4.task1`.
    Specular(SpecularExample),
}

/// The tasks whose examples can be judged.
pub const TASKS: [&str; 5] = [
    "part1.task2",
    "part1.task3",
    "part1.task4",
    "part2.task2",
    "part4.task1",
];

/// The situations of a task; `None` if examples of it cannot be judged.
pub fn situations_of(task: &str) -> Option<&'static [&'static str]> {
    match task {
        "part1.task2" => Some(camera::SITUATIONS),
        "part4.task1" => Some(specular::SITUATIONS),
        _ => rays::situations_of(task),
    }
}

/// What is wrong with an example: a sentence without its full stop. `None` if it is right.
pub fn verdict(example: &Example) -> Option<String> {
    match example {
        Example::Camera(of) => camera::verdict(of),
        Example::Ray(of) => rays::verdict(of),
        Example::Specular(of) => specular::verdict(of),
    }
}

/// What examples state about results.
const STATED: &[Aspect] = &[
    Aspect::HitOrMiss,
    Aspect::SampleOrNone,
    Aspect::T,
    Aspect::Interval,
    Aspect::Direction,
    Aspect::UnitLength,
    Aspect::SampledDirection,
];

impl Example {
    /// The key of its task.
    pub fn task(&self) -> &'static str {
        match self {
            Example::Camera(_) => "part1.task2",
            Example::Ray(of) => of.shape.task(),
            Example::Specular(_) => "part4.task1",
        }
    }

    /// The situations of its task that it touches.
    pub fn situations(&self) -> Vec<&'static str> {
        match self {
            Example::Camera(of) => of.situations(),
            Example::Ray(of) => of.situations(),
            Example::Specular(of) => of.situations(),
        }
    }

    /// The call of the example as a question to code, judged on what an example states. `None` if
    /// no case of the task has a call of this kind.
    pub fn question(&self) -> Option<Spec> {
        let work = match self {
            Example::Camera(of) => of.work(),
            Example::Ray(of) => of.work(),
            Example::Specular(of) => of.work(),
        };
        let kind = work.kind();
        let mut of_task = cases::all(0).into_iter();
        let like = of_task.find(|spec| spec.task == self.task() && spec.work.kind() == kind)?;
        Some(Spec {
            about_aspects: STATED,
            main_aspects: &[],
            ..like.with_work(work)
        })
    }
}
