//! What the code in the workspace renders: the first half of `grader look part1.task3`. The command
//! `grader picture` is this half alone, and draws scene files (`preview`).

use super::subprogram;
use crate::build::BuildRoot;
use crate::course::{Course, Task};
use crate::grade::picture::{self, Rendered};
use crate::progress::next_task;
use crate::report::table::status_text;
use crate::report::terminal::Page;
use crate::score::Status;
use crate::workers::worker_set::WorkerSet;
use base::program::Exit;
use base::{GraderError, Workspace, keys, out, outln};
use clap::{Arg, ArgMatches, Command};
use judge::pictures::Differences;
use judge::plural;
use pictures::Image;
use pictures::terminal::{self, Colours};
use std::fmt::Write;
use std::io::IsTerminal;
use std::path::Path;

/// The option of `grader look` with which it only draws the picture.
pub(super) const NO_PAGE: &str = "no-page";

/// The program that draws scene files.
const PREVIEW: &str = "preview";

/// This half alone.
pub(super) const NAME: &str = "picture";

pub(super) fn command() -> Command {
    Command::new(NAME)
        .about("Renders the picture of a task, or a scene file of your own with your intersection tests")
        .arg(task_argument().value_name("TASK|SCENE").help(
            "The task, such as `part1.task3` [default: the next open task]; or a COLLADA, glTF, OBJ or PLY file",
        ))
}

/// The name of the argument that names one task.
pub(super) const TASK: &str = "task";

/// The argument that names one task.
pub fn task_argument() -> Arg {
    Arg::new(TASK)
        .value_name("TASK")
        .help("The task, such as `part1.task3` [default: the next open task]")
}

/// The task that [`task_argument`] names.
pub fn task_of<'a>(
    matches: &ArgMatches,
    workspace: &Workspace,
    course: &'a Course,
) -> Result<&'a Task, GraderError> {
    match matches.get_one::<String>(TASK) {
        Some(key) => one_task(course, key),
        None => next_task::or_last(workspace, course),
    }
}

fn one_task<'a>(course: &'a Course, key: &str) -> Result<&'a Task, GraderError> {
    match course.select(key)?.as_slice() {
        [task] if task.key == key => Ok(task),
        several => Err(GraderError::new(format!(
            "expected one task, such as `{}`, found `{key}`",
            several.first().map_or("part1.task1", |task| &task.key)
        ))),
    }
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    if let Some(scene) = matches
        .get_one::<String>(TASK)
        .filter(|what| is_scene(what))
    {
        // Before the program is built, which takes a minute the first time.
        std::fs::File::open(scene).map_err(|e| GraderError::file("read", Path::new(scene), e))?;
        return subprogram::run(PREVIEW, vec![scene.into()]);
    }
    // A picture gives no points: that it differs is no failure.
    Ok(match show(matches)?.yours {
        Ok(_) => Exit::Passed,
        Err(_) => Exit::Failed,
    })
}

/// Whether the argument of the command is a scene file, and no task.
fn is_scene(what: &str) -> bool {
    let extension = Path::new(what).extension().and_then(|end| end.to_str());
    let is_format = extension.is_some_and(|end| {
        let mut formats = ["dae", "gltf", "glb", "obj", "ply"].iter();
        formats.any(|format| format.eq_ignore_ascii_case(end))
    });
    is_format || Path::new(what).is_file()
}

/// Draws the picture for `grader look`. Returns whether the page comes next.
pub(super) fn look(matches: &ArgMatches) -> Result<bool, GraderError> {
    let rendered = show(matches)?;
    let compiles = !matches!(rendered.yours, Err(Status::DoesNotCompile));
    Ok(compiles && !matches.get_flag(NO_PAGE))
}

/// Renders the picture that `matches` name, writes it and prints it.
fn show(matches: &ArgMatches) -> Result<Rendered, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let task = task_of(matches, &workspace, &course)?;
    let whole_scene = judge::pictures::of(&task.key).is_some_and(|picture| picture.whole_scene);
    let root = BuildRoot::of(&workspace);
    let workers = WorkerSet::build(&root, &[&task.stage], whole_scene)?;
    let rendered = picture::render(&workspace, &course, task, &workers)?
        .ok_or_else(|| GraderError::new(format!("`{}` has no picture", task.key)))?;
    let path = rendered.write(&workspace)?;
    let drawn = in_terminal(&rendered.sheet());
    let colours = terminal::colours(|name| std::env::var(name).ok());
    let colours = colours.filter(|_| drawn.is_some());
    outln!("{}  {}", task.key, task.title);
    out!("{}", drawn.unwrap_or_default());
    out!("{}", legend(task, &rendered, colours));
    outln!("picture: {}", workspace.relative(&path).display());
    if rendered.yours.is_ok()
        && let Some((path, _)) = picture::write_lit(&workspace, &course, &[task], &workers)?
    {
        outln!("with light: {}", path.display());
    }
    Ok(rendered)
}

/// The largest width of a picture in the terminal, in columns.
const COLUMNS: usize = 80;

/// A picture as text, if stdout is a terminal with colours.
pub fn in_terminal(picture: &Image) -> Option<String> {
    let is_terminal = std::io::stdout().is_terminal();
    let columns = Page::of_stdout().width.min(COLUMNS);
    let variable = |name: &str| std::env::var(name).ok();
    is_terminal
        .then(|| terminal::shown(picture, columns as u32, variable, keys::device_attributes))?
}

/// What the three pictures are, and what differs.
fn legend(task: &Task, rendered: &Rendered, colours: Option<Colours>) -> String {
    let mut text = String::from("Left: expected. Middle: yours. Right: where yours differs.\n");
    let counts = match &rendered.yours {
        Ok((_, comparison)) => &comparison.counts,
        Err(status) => {
            let _ = writeln!(text, "{}", without_picture(status, &task.key));
            return text;
        }
    };
    for (kind, marks) in rendered.picture.panels.iter().zip(counts) {
        let _ = write!(text, "  {}:", kind.about);
        if marks.is_empty() {
            text.push_str(match kind.differences {
                Differences::Noise => " as expected on average; single pixels are not compared\n",
                _ => " as expected\n",
            });
            continue;
        }
        text.push('\n');
        for (mark, count) in marks {
            let pixels = plural(*count, "pixel", "pixels");
            let chip = colours.map_or(String::new(), |colours| {
                terminal::chip(mark.colour(), colours) + " "
            });
            let _ = writeln!(text, "    {chip}{}, {pixels}", mark.label());
        }
    }
    text
}

/// Why there is no picture, and what to do.
pub fn without_picture(status: &Status, task: &str) -> String {
    match status {
        Status::NotAttempted => {
            format!("{task} is not written yet: this is the picture that it makes.")
        }
        Status::Needs(other) if other.starts_with("part") => {
            format!("Your picture needs {other}, which is not written yet.")
        }
        Status::Needs(other) => format!("Your picture needs {other}."),
        Status::DoesNotCompile => {
            "Your code does not compile: the compiler's messages are above.".into()
        }
        status => format!(
            "Your code rendered no picture: {}. `cargo grader {task}` says more.",
            status_text(status)
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::of_this_checkout;
    use pictures::difference::compare;

    #[test]
    fn scene_files_are_no_tasks() {
        for scene in ["house.dae", "../a b/House.GLB", "x.obj", "Cargo.toml"] {
            assert!(is_scene(scene), "{scene}");
        }
        for other in ["part1.task3", "part1", "house", "src"] {
            assert!(!is_scene(other), "{other}");
        }
    }

    #[test]
    fn a_part_is_not_a_task() {
        let (_, course) = of_this_checkout();
        let error = one_task(&course, "part2").expect_err("a part");
        assert_eq!(
            error.to_string(),
            "expected one task, such as `part2.task1`, found `part2`"
        );
    }

    #[test]
    fn the_legend_names_what_differs_in_each_panel() {
        let (_, course) = of_this_checkout();
        let task = one_task(&course, "part1.task3").expect("a task");
        let picture = judge::pictures::of("part1.task3").expect("it has a picture");
        let golden = Image::filled(picture.size(), [90; 3]);
        let mut yours = golden.clone();
        yours.set(5, 5, [0; 3]);
        yours.set(6, 5, [91; 3]);
        let comparison = compare(&picture, &golden, &yours);
        let rendered = Rendered {
            picture,
            golden,
            yours: Ok((yours, comparison)),
        };
        let text = legend(task, &rendered, None);
        assert!(
            text.ends_with(
                "  normals:\n    black where there is a surface, 1 pixel\n    another normal, 1 pixel\n  distances: as expected\n"
            ),
            "{text}"
        );
        assert!(!text.contains('\x1b'), "{text}");
        let in_terminal = legend(task, &rendered, Some(Colours::True));
        assert!(in_terminal.contains('\x1b'), "{in_terminal}");
    }
}
