//! The picture of a task: renders it with the student's code, and compares it with the golden.

use crate::course::{Course, Task};
use crate::grade;
use crate::score::Status;
use crate::workers::runner::{self, Worker};
use crate::workers::worker_set::WorkerSet;
use base::{GraderError, Workspace, write_whole};
use judge::pictures::{NAME, TaskPicture};
use pictures::difference::{Comparison, compare};
use pictures::{Image, light, png, sheet, tone};
use std::path::PathBuf;
use wire::Answer;
use wire::picture::PictureAnswer;

/// The picture of a task beside its golden.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// What it shows.
    pub picture: TaskPicture,
    /// The reference's picture.
    pub golden: Image,
    /// The picture of the code in the workspace, and how it differs; or why there is none.
    pub yours: Result<(Image, Comparison), Status>,
}

impl Rendered {
    /// Golden, yours and their difference beside each other. What there is not is black.
    pub fn sheet(&self) -> Image {
        let none = Image::filled(self.golden.size(), [0; 3]);
        let (yours, difference) = match &self.yours {
            Ok((yours, comparison)) => (yours, &comparison.difference),
            Err(_) => (&none, &none),
        };
        sheet::beside(&[&self.golden, yours, difference])
    }

    /// Writes [`Rendered::sheet`] to `target/first-light` and returns the path of the file.
    pub fn write(&self, workspace: &Workspace) -> Result<PathBuf, GraderError> {
        let path = workspace.for_students(&format!("{}.png", file_stem(self.picture.task)))?;
        write_whole(&path, &png::encode(&self.sheet()))?;
        Ok(path)
    }
}

/// The name of a task in the names of files: `part1_task3`.
pub fn file_stem(task: &str) -> String {
    task.replace('.', "_")
}

/// Renders the picture of `task` with one of `workers`; `None` if the task has no picture.
pub fn render(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    workers: &WorkerSet,
) -> Result<Option<Rendered>, GraderError> {
    let Some(picture) = judge::pictures::of(&task.key) else {
        return Ok(None);
    };
    let golden = golden(workspace, &picture)?;
    let yours = of_code(course, task, &picture, workers)?.map(|yours| {
        let comparison = compare(&picture, &golden, &yours);
        (yours, comparison)
    });
    Ok(Some(Rendered {
        picture,
        golden,
        yours,
    }))
}

fn golden(workspace: &Workspace, picture: &TaskPicture) -> Result<Image, GraderError> {
    let path = workspace.golden_picture(picture.task, NAME);
    let golden = png::read(&path).map_err(|e| GraderError::file("read", &path, e))?;
    let ([w, h], found) = (picture.size(), golden.size());
    if found == [w, h] {
        return Ok(golden);
    }
    Err(GraderError::new(format!(
        "{} has {} x {} pixels, expected {w} x {h}. Copy it again from the handout",
        path.display(),
        found[0],
        found[1]
    )))
}

/// The picture of the code that `workers` link, or why there is none.
pub fn of_code(
    course: &Course,
    task: &Task,
    picture: &TaskPicture,
    workers: &WorkerSet,
) -> Result<Result<Image, Status>, GraderError> {
    let Some(of_stage) = workers.workers(&task.stage) else {
        return Ok(Err(Status::DoesNotCompile));
    };
    let worker = match (picture.whole_scene, of_stage.whole_scene) {
        (false, _) => of_stage.stage,
        (true, Ok(worker)) => worker,
        (true, Err(broken)) => {
            let needs = format!("{broken}, which does not compile");
            return Ok(Err(Status::Needs(needs)));
        }
    };
    rendered_by(course, picture, &worker)
}

/// The picture of the code that `worker` links, or why there is none.
pub fn rendered_by(
    course: &Course,
    picture: &TaskPicture,
    worker: &Worker,
) -> Result<Result<Image, Status>, GraderError> {
    let answer = answer_of(course, picture, worker)?;
    Ok(answer.map(|answer| tone::compose(picture, &answer)))
}

/// What `worker` answers to the question of a picture, or why it does not.
fn answer_of(
    course: &Course,
    picture: &TaskPicture,
    worker: &Worker,
) -> Result<Result<PictureAnswer, Status>, GraderError> {
    let answer = answers_of(course, std::slice::from_ref(picture), worker)?.pop();
    answer.ok_or_else(|| GraderError::new("the worker returned no picture"))
}

/// What `worker` answers to the questions of `pictures`, or why it does not.
pub fn answers_of(
    course: &Course,
    pictures: &[TaskPicture],
    worker: &Worker,
) -> Result<Vec<Result<PictureAnswer, Status>>, GraderError> {
    let cases: Vec<_> = pictures.iter().map(|it| it.spec().case()).collect();
    let endings = runner::run(worker, &cases)?.endings.into_iter().map(Ok);
    let answers = pictures.iter().zip(endings).map(|(picture, ending)| {
        Ok(match grade::answered(picture.task, &ending, course)? {
            Ok(Answer::Picture(answer)) => Ok(answer.clone()),
            Ok(_) => Err(Status::Failed),
            Err(status) => Err(status),
        })
    });
    answers.collect()
}

/// The file, among what the grader writes, of the last task's picture with light.
const LIT: &str = "yours.png";

/// Renders the picture of the last of the complete `tasks` that shows shapes, with light, and
/// writes it. Returns the file below the workspace's root folder, and the picture.
pub fn write_lit(
    workspace: &Workspace,
    course: &Course,
    tasks: &[&Task],
    workers: &WorkerSet,
) -> Result<Option<(PathBuf, Image)>, GraderError> {
    let pictures = tasks.iter().rev().filter_map(|task| {
        let picture = judge::pictures::of(&task.key)?.to_be_lit()?;
        Some((picture, workers.workers(&task.stage)?))
    });
    for (picture, of_stage) in pictures {
        let answer = answer_of(course, &picture, &of_stage.stage)?;
        let Some(lit) = answer
            .ok()
            .and_then(|answer| light::lit(&picture.work, &answer))
        else {
            continue;
        };
        let path = workspace.for_students(LIT)?;
        write_whole(&path, &png::encode(&lit))?;
        let inside = path.strip_prefix(workspace.root()).unwrap_or(&path);
        return Ok(Some((inside.to_path_buf(), lit)));
    }
    Ok(None)
}

/// Renders and writes the pictures of `tasks`. Returns the keys of those that show something, and
/// their paths below the workspace's root folder: the others are not written yet, or end in a
/// panic. Grading does not depend on pictures, so a task without a golden one is left out.
pub fn write_all(
    workspace: &Workspace,
    course: &Course,
    tasks: &[&Task],
    workers: &WorkerSet,
) -> Result<Vec<(String, PathBuf)>, GraderError> {
    let mut written = Vec::new();
    for task in tasks {
        if !workspace.golden_picture(&task.key, NAME).is_file() {
            continue;
        }
        let rendered = render(workspace, course, task, workers)?;
        if let Some(rendered) = rendered.filter(|rendered| rendered.yours.is_ok()) {
            let path = rendered.write(workspace)?;
            let inside = path.strip_prefix(workspace.root()).unwrap_or(&path);
            written.push((task.key.clone(), inside.to_path_buf()));
        }
    }
    Ok(written)
}
