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
use judge::plural;
use kit::{FilmSize, Scene};
use pictures::{light, png};
use scenes::Loaded;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use tiles::Tiles;
use wire::picture::PictureAnswer;

/// The stage whose functions draw.
const STAGE: &str = "intersect";

/// The size of the picture.
const FILM: FilmSize = FilmSize { w: 640, h: 480 };

fn main() -> ExitCode {
    let Some(file) = std::env::args_os().nth(1).map(PathBuf::from) else {
        return run_to_exit_code(|| Err(GraderError::new("expected a scene file")));
    };
    match scenes::load(&file) {
        Ok(loaded) => run_to_exit_code(|| run(&file, &loaded)),
        Err(why) => {
            errln!("{why}");
            ExitCode::from(2)
        }
    }
}

fn run(file: &Path, loaded: &Loaded) -> Result<Exit, GraderError> {
    for warning in &loaded.warnings {
        errln!("{warning}");
    }
    if let Some(note) = loaded.smoothed_note() {
        errln!(
            "note: {note}. To keep facets, give the file normals, or an OBJ file the line `s off`"
        );
    }
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let Question { task, count, tiles } = Question::of(file, &loaded.scene, FILM)?;
    let root = BuildRoot::of(&workspace);
    let workers = WorkerSet::build(&root, &[STAGE], false)?;
    let start = Instant::now();
    let drawn = match workers.workers(STAGE) {
        None => Err(Status::DoesNotCompile),
        Some(of_stage) => answers_of(&course, &tiles.pictures, &of_stage.stage)?
            .into_iter()
            .collect(),
    };
    let answers: Vec<PictureAnswer> = match drawn {
        Ok(answers) => answers,
        Err(Status::NotAttempted) => {
            outln!("{task} is not written yet, and the picture needs it.");
            return Ok(Exit::Failed);
        }
        Err(status) => {
            outln!("{}", without_picture(&status, task));
            return Ok(Exit::Failed);
        }
    };
    let time = start.elapsed();
    let lit = light::lit(&tiles.work, &tiles.whole(&answers))
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

/// What the worker is asked to draw a scene file.
struct Question {
    /// The task whose function is missing, if one is: that of triangles comes first.
    task: &'static str,
    /// What the scene consists of.
    count: String,
    tiles: Tiles,
}

impl Question {
    /// The question about the `scene` of `file`.
    fn of(file: &Path, scene: &Scene, film: FilmSize) -> Result<Question, GraderError> {
        let triangles = plural(scene.triangles.len(), "triangle", "triangles");
        let spheres = plural(scene.spheres.len(), "sphere", "spheres");
        let (task, count) = match (scene.triangles.len(), scene.spheres.len()) {
            (0, _) => ("part1.task4", spheres),
            (_, 0) => ("part1.task3", triangles),
            _ => ("part1.task3", format!("{triangles} and {spheres}")),
        };
        let tiles = tiles::of(scene, film, task).ok_or_else(|| too_large(file, &count))?;
        Ok(Question { task, count, tiles })
    }
}

/// The name of the picture of a scene file: no task's picture has it.
fn name_of(file: &Path) -> String {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    format!("yours_{stem}.png")
}

fn too_large(file: &Path, count: &str) -> GraderError {
    GraderError::new(format!(
        "{0} has {count}, too many for a picture without a tree. Once Part 2 is written: cargo run --release -p \
         pathtracer -- -f picture.png {0}",
        file.display()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::pictures::TaskPicture;
    use kit::Triangle;
    use pictures::Image;
    use wire::picture::Subject;
    use wire::{Answer, Outcome};

    const SMALL: FilmSize = FilmSize { w: 64, h: 48 };

    /// A square in front of the camera, without a lamp: a COLLADA file.
    const WITHOUT_LAMP: &str = r##"<COLLADA><library_geometries><geometry id="g"><mesh>
        <source id="p"><float_array id="a" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common>
        <accessor source="#a" count="4" stride="3"/></technique_common></source>
        <vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="2">
        <input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry>
        </library_geometries><library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>
        </visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"##;

    /// A triangle in front of the camera: a glTF file in one piece.
    fn glb() -> Vec<u8> {
        let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36}],
            "bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,
            "count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}]}"#;
        let json = format!("{json:<width$}", width = json.len().next_multiple_of(4));
        let positions: [f32; 9] = [0., 0., 0., 1., 0., 0., 1., 1., 0.];
        let bytes: Vec<u8> = positions.iter().flat_map(|x| x.to_le_bytes()).collect();
        let number = |n: usize| (n as u32).to_le_bytes();
        let head = [
            b"glTF",
            &number(2)[..],
            &number(28 + json.len() + bytes.len()),
        ];
        let chunks = [
            &number(json.len())[..],
            b"JSON",
            json.as_bytes(),
            &number(bytes.len()),
            b"BIN\0",
            &bytes,
        ];
        [head.concat(), chunks.concat()].concat()
    }

    fn file(name: &str, bytes: impl AsRef<[u8]>) -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("it is written");
        (folder, path)
    }

    fn question(path: &Path, scene: &Scene) -> Question {
        Question::of(path, scene, SMALL).expect("it can be drawn")
    }

    /// What the stages in this checkout answer to a picture; `None` in a handout.
    fn answer(picture: &TaskPicture) -> Option<PictureAnswer> {
        match worker::run(0, &picture.spec().case()).outcome {
            Outcome::Answered(Answer::Picture(answer)) => Some(answer),
            Outcome::NotAttempted { .. } => None,
            outcome => panic!("{outcome:?}"),
        }
    }

    /// The picture of a file, if the stages are written; and the share of its pixels that show a
    /// surface. Each pixel is that of a picture in which each ray tests every shape.
    fn drawn(path: &Path) -> Option<(Image, f64)> {
        let scene = scenes::load(path).expect("it can be read").scene;
        let tiles = question(path, &scene).tiles;
        let answers: Vec<_> = tiles.pictures.iter().map(answer).collect::<Option<_>>()?;
        let whole = tiles.whole(&answers);
        let mut work = tiles.work.clone();
        let Subject::Shapes {
            triangles, spheres, ..
        } = &mut work.subject
        else {
            panic!("it shows shapes");
        };
        let vectors = |t: &Triangle| [t.p0, t.p1, t.p2, t.n0, t.n1, t.n2].map(|v| v.to_array());
        triangles.extend(scene.triangles.iter().map(vectors));
        spheres.extend(
            scene
                .spheres
                .iter()
                .map(|s| (s.center.to_array(), s.radius)),
        );
        let plain = TaskPicture {
            work,
            ..tiles.pictures[0].clone()
        };
        assert_eq!(answer(&plain), Some(whole.clone()));
        let hits = whole.panels[1]
            .iter()
            .filter(|distance| distance[0] > 0.0)
            .count();
        let share = hits as f64 / whole.panels[1].len() as f64;
        Some((light::lit(&tiles.work, &whole)?, share))
    }

    #[test]
    fn scenes_are_drawn_with_and_without_lamps() {
        let own = |name| {
            Path::new(env!("CARGO_MANIFEST_DIR"))
                .join("../../scenes/dae")
                .join(name)
        };
        let (_dae, without_lamp) = file("square.dae", WITHOUT_LAMP);
        let (_glb, glb) = file("A triangle.GLB", glb());
        for (path, count) in [
            (own("spheres.dae"), "spheres"),
            (own("stairs_sky.dae"), "240 triangles and 2 spheres"),
            (without_lamp, "2 triangles"),
            (glb, "1 triangle"),
        ] {
            let scene = scenes::load(&path).expect("it can be read").scene;
            let question = question(&path, &scene);
            assert!(question.count.ends_with(count), "{}", question.count);
            let Some((picture, share)) = drawn(&path) else {
                return;
            };
            assert_eq!(picture.size(), [SMALL.w, SMALL.h]);
            assert!(share > 0.1, "{}: {share}", path.display());
        }
    }

    #[test]
    fn a_file_that_cannot_be_drawn_is_named_and_not_built_for() {
        let message = |path: &Path| scenes::load(path).unwrap_err().to_string();
        assert!(message(Path::new("nowhere/house.dae")).contains("nowhere/house.dae"));
        let whole = glb();
        for (name, bytes) in [
            ("half.glb", &whole[..whole.len() / 2]),
            ("half.dae", &WITHOUT_LAMP.as_bytes()[..400]),
            ("empty.dae", b""),
            ("nothing.dae", b"<COLLADA/>"),
            ("empty.obj", b""),
            ("a.txt", b"a house"),
        ] {
            let (_folder, path) = file(name, bytes);
            assert!(message(&path).contains(name), "{name}: {}", message(&path));
        }
    }
}
