//! Compares the share of a task's picture that a mistake spoils with the share of the core points
//! that it loses.

use super::run::{Kind, VersionsWorker};
use base::{GraderError, Workspace};
use grader::course::{Course, Task};
use grader::grade::picture;
use judge::pictures::{Differences, TaskPicture};
use judge::{Tier, cases};
use pictures::Image;
use pictures::difference::{Mark, compare};
use rayon::prelude::*;

/// A mistake that spoils more of the picture than this should lose more of the points.
pub const SHARE: f64 = 1.0 / 3.0;

/// What a mutant spoils and loses.
#[derive(Clone, Debug)]
pub struct Proportion {
    /// The mutant.
    pub mutant: String,
    /// The share of wrong pixels, of the panels in which another choice is a mistake; 1 if it
    /// renders no picture.
    pub wrong: f64,
    /// The share of the core points that it loses.
    pub lost: f64,
}

impl Proportion {
    /// Whether the mutant loses too few points.
    pub fn loses_too_little(&self) -> bool {
        self.wrong > SHARE && self.lost < SHARE
    }
}

/// Grades each mutant of `task` in the core cases and renders its picture. Of a task without a
/// picture there is nothing to compare.
pub fn of_task(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
) -> Result<Vec<Proportion>, GraderError> {
    let Some(picture) = judge::pictures::of(&task.key) else {
        return Ok(Vec::new());
    };
    let versions = VersionsWorker::of_mutants(workspace, course, task)?;
    let render = |version| {
        let built = versions.workers(version).whole_scene;
        let worker = built.map_err(|_| GraderError::new("the worker cannot be run"))?;
        picture::rendered_by(course, &picture, &worker)
    };
    let right = render(0)?.map_err(|status| {
        GraderError::new(format!("the reference renders no picture ({status:?})"))
    })?;
    let specs = cases::of(&task.key, 0);
    let mut core = task.clone();
    core.cases.retain(|entry| entry.tier == Tier::Core);
    let mutants = versions.versions.par_iter().enumerate();
    mutants
        .filter(|(_, (_, kind))| matches!(kind, Kind::Mutant(_)))
        .map(|(version, (name, _))| {
            let result = versions.grade_one(&core, &specs, version, None)?.result;
            let yours = render(version)?;
            Ok(Proportion {
                mutant: name.clone(),
                wrong: yours.map_or(1.0, |yours| share_of_wrong(&picture, &right, &yours)),
                lost: 1.0 - result.score / result.max_score,
            })
        })
        .collect()
}

/// The share of pixels that are wrong, whatever is chosen.
fn share_of_wrong(picture: &TaskPicture, right: &Image, yours: &Image) -> f64 {
    let panels = picture.panels.iter();
    let judged = panels.filter(|panel| panel.differences != Differences::Choice);
    let [w, h] = picture.work.size;
    let pixels = judged.count() * (w * h) as usize;
    let counts = compare(picture, right, yours).counts;
    let marks = counts.iter().flatten();
    let wrong: usize = marks
        .filter(|(mark, _)| *mark != Mark::Choice)
        .map(|(_, count)| count)
        .sum();
    wrong as f64 / pixels.max(1) as f64
}
