//! Examples that students write before their code: an input, and the result that they expect.
//! [`verdict`] decides whether an example is right, [`Example::situations`] says which situations
//! of the task the example touches, [`Example::question`] asks code what the example asks.
//!
//! An example can be judged where a call has one right result, and where a handout can tell that a
//! result is right without the formula that computes it: the oracle knows it, or a law of
//! geometry or optics does.

mod by_hand;
mod camera;
mod pixel;
mod rays;
mod specular;

pub use camera::CameraExample;
pub use pixel::PixelExample;
pub use rays::{Expectation, RayExample, Shape};
pub use specular::{SpecularExample, SpecularFunction};

use crate::face::cases;
use crate::tools::findings::Aspect;
use crate::tools::spec::Spec;

/// An example of a task.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Example {
    /// Of `part1.task1`.
    Pixel(PixelExample),
    /// Of `part1.task2`.
    Camera(CameraExample),
    /// Of `part1.task3`, `part1.task4` or `part2.task2`.
    Ray(RayExample),
    /// Of `part4.task1`.
    Specular(SpecularExample),
}

/// The tasks whose examples can be judged.
pub const TASKS: [&str; 6] = [
    "part1.task1",
    "part1.task2",
    "part1.task3",
    "part1.task4",
    "part2.task2",
    "part4.task1",
];

/// Why examples of a task cannot be judged: a clause without its full stop. `None` if they can.
pub fn why_not(task: &str) -> Option<&'static str> {
    if situations_of(task).is_some() {
        return None;
    }
    Some(match task {
        "part2.task1" => "many trees are right, and the grader judges whether yours is one of them",
        "part2.task3" => {
            "a call needs a tree with boxes and hits, which is longer to write than to traverse"
        }
        "part3.task2" | "part3.task3" | "part4.task2" => {
            "an estimate depends on random numbers, so a single call has no single right result"
        }
        _ => "only the formula that you write tells the right result, and a handout lacks it",
    })
}

/// The situations of a task; `None` if examples of it cannot be judged.
pub fn situations_of(task: &str) -> Option<&'static [&'static str]> {
    match task {
        "part1.task1" => Some(pixel::SITUATIONS),
        "part1.task2" => Some(camera::SITUATIONS),
        "part4.task1" => Some(specular::SITUATIONS),
        _ => rays::situations_of(task),
    }
}

/// What is wrong with an example: a sentence without its full stop. `None` if it is right.
pub fn verdict(example: &Example) -> Option<String> {
    match example {
        Example::Pixel(of) => pixel::verdict(of),
        Example::Camera(of) => camera::verdict(of),
        Example::Ray(of) => rays::verdict(of),
        Example::Specular(of) => specular::verdict(of),
    }
}

/// What examples state about results.
const STATED: &[Aspect] = &[
    Aspect::Placement,
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
            Example::Pixel(_) => "part1.task1",
            Example::Camera(_) => "part1.task2",
            Example::Ray(of) => of.shape.task(),
            Example::Specular(_) => "part4.task1",
        }
    }

    /// The situations of its task that it touches.
    pub fn situations(&self) -> Vec<&'static str> {
        match self {
            Example::Pixel(of) => of.situations(),
            Example::Camera(of) => of.situations(),
            Example::Ray(of) => of.situations(),
            Example::Specular(of) => of.situations(),
        }
    }

    /// The call of the example as a question to code, judged on what an example states. `None` if
    /// no case of the task has a call of this kind.
    pub fn question(&self) -> Option<Spec> {
        let work = match self {
            Example::Pixel(of) => of.work(),
            Example::Camera(of) => of.work(),
            Example::Ray(of) => of.work(),
            Example::Specular(of) => of.work(),
        };
        let kind = work.kind();
        let mut of_task = cases::of(self.task(), 0).into_iter();
        let like = of_task.find(|spec| spec.work.kind() == kind)?;
        Some(Spec {
            about_aspects: STATED,
            main_aspects: &[],
            ..like.with_work(work)
        })
    }
}
