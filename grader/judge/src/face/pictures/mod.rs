//! The picture of each task: what students see of their code. It scores nothing.
//!
//! A picture shows what the task is about, with as few other tasks as possible, and is chosen so
//! that the task's usual mistakes are visible in it. `golden/TASK/task.png` is the reference's.

mod scenes;

use crate::tools::spec::Spec;
use wire::kind;
use wire::picture::{PictureWork, Subject};

/// The picture of a task.
#[derive(Clone, Debug)]
pub struct TaskPicture {
    /// Key of the task.
    pub task: &'static str,
    /// The panels from top to bottom.
    pub panels: &'static [PanelKind],
    /// Whether the worker that links all intersection stages renders it.
    pub whole_scene: bool,
    /// What the worker renders.
    pub work: PictureWork,
}

/// What a panel shows, and so how two of them are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanelKind {
    /// What it shows, in a few words.
    pub about: &'static str,
    /// What a difference means.
    pub differences: Differences,
    /// Whether the colours are bytes already: no tone curve is applied.
    pub plain: bool,
    /// The number of steps between black and white. Pictures with noise have few, because 256 of
    /// them are mostly noise and take much space.
    pub steps: u8,
}

/// What the differences of a panel mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Differences {
    /// Black is a miss; another colour is another normal.
    Normals,
    /// Black is a miss; another brightness is another distance.
    Distances,
    /// Any other colour is a difference.
    Values,
    /// Random numbers were drawn: single pixels may differ, the means of blocks of pixels may not.
    Noise,
    /// Another picture can be as right: for example that of another tree.
    Choice,
}

const fn panel(about: &'static str, differences: Differences) -> PanelKind {
    let steps = match differences {
        Differences::Noise => 15,
        _ => 255,
    };
    PanelKind {
        about,
        differences,
        plain: false,
        steps,
    }
}

const fn plain(about: &'static str, differences: Differences) -> PanelKind {
    PanelKind {
        plain: true,
        ..panel(about, differences)
    }
}

const fn coarse(about: &'static str, differences: Differences, steps: u8) -> PanelKind {
    PanelKind {
        steps,
        ..panel(about, differences)
    }
}

impl TaskPicture {
    /// The same view with twice as many columns and rows, if it shows shapes: their normals and
    /// distances are all that light needs.
    pub fn to_be_lit(&self) -> Option<TaskPicture> {
        let mut large = self.clone();
        let Subject::Shapes { view, .. } = &mut large.work.subject else {
            return None;
        };
        for step in [&mut view.right, &mut view.up] {
            *step = step.map(|coordinate| 0.5 * coordinate);
        }
        large.work.size = large.work.size.map(|count| 2 * count);
        Some(large)
    }

    /// The picture as a case for a worker: it has the picture's name and no points.
    pub fn spec(&self) -> Spec {
        Spec::new::<kind::Picture>(
            self.task,
            NAME,
            "The picture of the task, which gives no points.",
            self.work.clone(),
        )
    }

    /// Width and height of the whole picture.
    pub fn size(&self) -> [u32; 2] {
        let [w, h] = self.work.size;
        [w, h * self.work.panels]
    }
}

/// The name of each task's picture, in `golden/TASK/`.
pub const NAME: &str = "task";

/// Width and height of the panels.
const SIZE: [u32; 2] = [320, 240];

/// The picture of `task`; `None` if there is no such task.
pub fn of(task: &str) -> Option<TaskPicture> {
    use Differences::{Choice, Distances, Noise, Normals, Values};
    let (task, panels, subject): (_, &'static [PanelKind], _) = match task {
        "part1.task1" => (
            "part1.task1",
            const {
                &[
                    coarse("1 sample per pixel", Values, 15),
                    panel("16 samples per pixel", Noise),
                ]
            },
            Subject::SampleLoop {
                samples: vec![1, 16],
            },
        ),
        "part1.task2" => (
            "part1.task2",
            const {
                &[plain(
                    "directions of rays, a line every 10 degrees, the horizon in black",
                    Values,
                )]
            },
            Subject::CameraRays(scenes::turned_camera()),
        ),
        "part1.task3" => (
            "part1.task3",
            const { &[plain("normals", Normals), panel("distances", Distances)] },
            scenes::cut_ring(),
        ),
        "part1.task4" => (
            "part1.task4",
            const { &[plain("normals", Normals), panel("distances", Distances)] },
            scenes::spheres(),
        ),
        "part2.task1" => (
            "part2.task1",
            const {
                &[
                    panel("a colour for each leaf", Choice),
                    panel("depth of the leaves, boxes of the top", Choice),
                ]
            },
            scenes::leaves(),
        ),
        "part2.task2" => (
            "part2.task2",
            const {
                &[
                    panel("distance at which a box is entered", Distances),
                    panel("length inside of all boxes", Values),
                ]
            },
            scenes::boxes(),
        ),
        "part2.task3" => (
            "part2.task3",
            const {
                &[
                    plain("normals", Normals),
                    panel("tests of boxes and triangles per ray", Choice),
                ]
            },
            scenes::traversal(),
        ),
        "part3.task1" => (
            "part3.task1",
            const {
                &[
                    panel("a lit ball and the inside of a lit bowl", Values),
                    panel("lambert_pdf and the directions of lambert_sample", Values),
                ]
            },
            Subject::Lambert,
        ),
        "part3.task2" => (
            "part3.task2",
            const { &[panel("light by hemisphere sampling", Noise)] },
            scenes::hemisphere(),
        ),
        "part3.task3" => (
            "part3.task3",
            const { &[panel("light by sampling the lights", Noise)] },
            scenes::lights(),
        ),
        "part4.task1" => (
            "part4.task1",
            const {
                &[
                    panel("a mirror ball and a glass ball", Values),
                    panel("fresnel_dielectric (4 bands) and refract (2)", Values),
                ]
            },
            Subject::Specular,
        ),
        "part4.task2" => (
            "part4.task2",
            const { &[coarse("direct and indirect light", Noise, 12)] },
            scenes::paths(),
        ),
        "part4.task3" => (
            "part4.task3",
            const {
                &[
                    panel(
                        "result by throughput (right) and u (up): 1, 3, 4, 9 bounces",
                        Values,
                    ),
                    panel(
                        "top: mean over all u; bottom: throughput (unbiased: no seam)",
                        Values,
                    ),
                ]
            },
            Subject::Roulette {
                bounces: vec![1, 3, 4, 9],
            },
        ),
        "part5.task1" => (
            "part5.task1",
            const {
                &[
                    panel("radiance", Noise),
                    plain("samples: blue few, red all", Noise),
                ]
            },
            scenes::adaptive(),
        ),
        "part5.task2" => (
            "part5.task2",
            const {
                &[
                    panel("light that is rarer to the left", Noise),
                    plain("samples: blue few, red all", Noise),
                ]
            },
            Subject::RareLight {
                ns_aa: 384,
                batch: 32,
                tolerance: 0.25,
            },
        ),
        _ => return None,
    };
    Some(TaskPicture {
        task,
        panels,
        whole_scene: matches!(subject, Subject::Traversal { .. }),
        work: PictureWork {
            size: SIZE,
            panels: panels.len() as u32,
            subject,
        },
    })
}
