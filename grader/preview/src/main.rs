//! `grader picture SCENE.dae`: a scene file, drawn with the student's intersection tests.
//!
//! The worker that grades `intersect` renders the picture, so nothing large is compiled. Without a
//! tree each ray tests what its tile of the film may show ([`tiles`]).

mod tiles;

use base::program::{Exit, run_to_exit_code};
use base::{GraderError, Workspace, errln, out, outln, write_whole};
use grader::build::BuildRoot;
use grader::cli::picture::{in_terminal, without_picture};
use grader::course::Course;
use grader::grade::picture::answers_of;
use grader::score::Status;
use grader::workers::worker_set::WorkerSet;
use kit::{FilmSize, Scene};
use pictures::{light, png};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use wire::picture::PictureAnswer;

/// The stage whose functions draw.
const STAGE: &str = "intersect";

/// The size of the picture.
const FILM: FilmSize = FilmSize { w: 640, h: 480 };

fn main() -> ExitCode {
    run_to_exit_code(|| match std::env::args_os().nth(1) {
        Some(file) => run(Path::new(&file)),
        None => Err(GraderError::new("expected a scene file")),
    })
}

fn run(file: &Path) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let loaded = scenes::load(file).map_err(|why| GraderError::new(why.to_string()))?;
    for warning in &loaded.warnings {
        errln!("{warning}");
    }
    let scene = &loaded.scene;
    // A triangle is missing before a sphere is: its task comes first.
    let (task, count) = match (scene.triangles.len(), scene.spheres.len()) {
        (0, 0) => {
            return Err(GraderError::new(format!(
                "{} has no surface",
                file.display()
            )));
        }
        (0, spheres) => ("part1.task4", judge::plural(spheres, "sphere", "spheres")),
        (triangles, 0) => (
            "part1.task3",
            judge::plural(triangles, "triangle", "triangles"),
        ),
        (triangles, spheres) => (
            "part1.task3",
            format!(
                "{} and {}",
                judge::plural(triangles, "triangle", "triangles"),
                judge::plural(spheres, "sphere", "spheres")
            ),
        ),
    };
    let root = BuildRoot::of(&workspace);
    let workers = WorkerSet::build(&root, &[STAGE], false)?;
    let rendered = match workers.workers(STAGE) {
        None => Err(Status::DoesNotCompile),
        Some(of_stage) => {
            let start = Instant::now();
            let tiles = tiles::of(scene, FILM, task).ok_or_else(|| too_large(file, scene))?;
            let answers = answers_of(&course, &tiles.pictures, &of_stage.stage)?;
            let answers: Result<Vec<PictureAnswer>, Status> = answers.into_iter().collect();
            answers.map(|answers| (tiles.whole(&answers), tiles, start.elapsed()))
        }
    };
    let (answer, tiles, time) = match rendered {
        Ok(rendered) => rendered,
        Err(status) => {
            outln!("{}", without_picture(&status, task));
            return Ok(Exit::Failed);
        }
    };
    let lit = light::lit(&tiles.work, &answer)
        .ok_or_else(|| GraderError::new("the picture has other panels than expected"))?;
    let path = workspace.for_students(&name_of(file))?;
    write_whole(&path, &png::encode(&lit))?;
    out!("{}", in_terminal(&lit).unwrap_or_default());
    outln!(
        "{count}, {:.1} s; shape and depth, without the scene's lights and colours",
        time.as_secs_f64()
    );
    outln!("picture: {}", workspace.relative(&path).display());
    Ok(Exit::Passed)
}

/// The name of the picture of a scene file: no task's picture has it.
fn name_of(file: &Path) -> String {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    PathBuf::from(format!("yours_{stem}.png"))
        .display()
        .to_string()
}

fn too_large(file: &Path, scene: &Scene) -> GraderError {
    GraderError::new(format!(
        "{} has {} surfaces, too many for a picture without a tree. Once Part 2 is written: cargo run --release -p \
         pathtracer -- -f picture.png {}",
        file.display(),
        scene.len(),
        file.display()
    ))
}
