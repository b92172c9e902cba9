//! The program behind `grader export SYSTEM --part N --out PATH`.

use base::program::{Exit, path_argument, run_commands, whole_number};
use base::{GraderError, Workspace, errln, folder_of, outln, write_whole};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};
use export::archive;
use export::choices::Choices;
use export::systems::{ExportedFile, System};
use grader::cli::course_systems::VISIBILITIES;
use grader::course::Course;
use judge::plural;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn command() -> Command {
    Command::new("export")
        .about("For instructors: writes what a course system needs to grade a part")
        .arg(
            Arg::new("system")
                .value_name("SYSTEM")
                .required(true)
                .value_parser(System::ALL.map(System::name))
                .help("The course system; `actions` is GitHub Actions without a course system"),
        )
        .arg(
            Arg::new("part")
                .long("part")
                .value_name("N")
                .required(true)
                .allow_negative_numbers(true)
                .value_parser(|value: &str| whole_number(value, 1, u32::MAX))
                .help("The part to grade"),
        )
        .arg(
            path_argument("out", "PATH")
                .required(true)
                .help("For gradescope the zip to write, else a new folder"),
        )
        .arg(
            Arg::new("hint")
                .long("hint")
                .value_name("LEVEL")
                .value_parser(["1", "2", "3", "4"])
                .default_value("2")
                .help("How much the report tells students: 1 the failed cases, 2 what is wrong, 3 the likely mistake, 4 where to look"),
        )
        .arg(
            Arg::new("visibility")
                .long("visibility")
                .value_name("WHEN")
                .value_parser(VISIBILITIES)
                .default_value(VISIBILITIES[0])
                .help("When students see the results in Gradescope"),
        )
        .arg(
            Arg::new("add-extra")
                .long("add-extra")
                .action(ArgAction::SetTrue)
                .help("Add extra credit to the total score, instead of only showing it"),
        )
        .arg(
            Arg::new("seed")
                .long("seed")
                .value_name("SEED")
                .allow_negative_numbers(true)
                .value_parser(|value: &str| whole_number(value, 0, u64::MAX))
                .help("Seed of the random inputs, the same for everyone"),
        )
        .arg(
            Arg::new("unsandboxed")
                .long("unsandboxed")
                .action(ArgAction::SetTrue)
                .help("Grade where the container has neither seccomp nor bubblewrap, too: code can read the solutions then"),
        )
        .arg(
            Arg::new("public")
                .long("public")
                .action(ArgAction::SetTrue)
                .conflicts_with_all(["seed", "unsandboxed"])
                .help("For prairielearn: an image without solutions, which grades as a handout does, for feedback"),
        )
        .arg(
            Arg::new("course")
                .long("course")
                .value_name("OWNER/NAME")
                .value_parser(repository)
                .help("The repository on GitHub with the handout of this part, for classroom50 and actions"),
        )
        .arg(
            Arg::new("ref")
                .long("ref")
                .value_name("REF")
                .default_value("main")
                .value_parser(reference)
                .help("The branch or tag of that repository"),
        )
}

/// Reads `OWNER/NAME`. It becomes part of scripts.
fn repository(value: &str) -> Result<String, String> {
    let is_name = |name: &str| {
        let is_allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
        !name.is_empty() && name.chars().all(is_allowed)
    };
    match value.split_once('/') {
        Some((owner, name)) if is_name(owner) && is_name(name) => Ok(value.to_owned()),
        _ => Err("expected OWNER/NAME, such as cs184/first-light".into()),
    }
}

/// Reads the name of a branch or tag. It becomes part of scripts.
fn reference(value: &str) -> Result<String, String> {
    let is_allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.' | '/');
    match !value.is_empty() && !value.starts_with('-') && value.chars().all(is_allowed) {
        true => Ok(value.to_owned()),
        false => Err("expected the name of a branch or a tag, such as main".into()),
    }
}

fn main() -> ExitCode {
    run_commands([(command(), run)])
}

fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let text = |name| matches.get_one::<String>(name).cloned();
    let name = text("system").unwrap_or_default();
    let system = System::ALL.into_iter().find(|system| system.name() == name);
    let system = system.ok_or_else(|| GraderError::new(format!("there is no system {name}")))?;
    let out: &PathBuf = matches.get_one("out").expect("clap requires it");
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let number: u32 = *matches.get_one("part").expect("clap requires it");
    course.select(&format!("part{number}"))?;
    let part = course.parts.iter().find(|part| part.number == number);
    let part = part.ok_or_else(|| GraderError::new(format!("the course has no part {number}")))?;
    let choices = Choices {
        what: format!("part{number}"),
        title: part.title.clone(),
        part: number,
        hint: text("hint").unwrap_or_default(),
        visibility: text("visibility").unwrap_or_default(),
        add_extra: matches.get_flag("add-extra"),
        seed: matches.get_one("seed").copied(),
        unsandboxed: matches.get_flag("unsandboxed"),
        public: matches.get_flag("public"),
        course: text("course"),
        reference: text("ref").unwrap_or_default(),
    };
    let files = match system {
        System::Gradescope if out.is_dir() => {
            return Err(GraderError::new(format!(
                "cannot write the package to {}: it is a folder. Name a file, such as autograder.zip",
                out.display()
            )));
        }
        system => system.files(&workspace, &choices)?,
    };
    match system {
        System::Gradescope => {
            let zip = archive::zip(&files)?;
            write_whole(out, &zip)?;
            let kilobytes = zip.len() / 1000;
            let count = plural(files.len(), "file", "files");
            outln!("{}: {count}, {kilobytes} kB", out.display());
        }
        _ => {
            write_folder(out, &files)?;
            let count = plural(files.len(), "file", "files");
            outln!("{}: {count}", out.display());
        }
    }
    let is_given = |flag: &&&str| matches.value_source(flag) == Some(ValueSource::CommandLine);
    for flag in system.unused_flags().iter().filter(is_given) {
        errln!("note: no effect: --{flag}: {name} does not use it");
    }
    outln!("{}", system.next_step(&choices));
    Ok(Exit::Passed)
}

/// Writes the files to the new folder `out`. On an error the folder does not exist.
fn write_folder(out: &Path, files: &[ExportedFile]) -> Result<(), GraderError> {
    let is_empty = || std::fs::read_dir(out).is_ok_and(|mut entries| entries.next().is_none());
    if out.exists() && !is_empty() {
        return Err(GraderError::new(format!(
            "cannot write to {}: it exists already. Name a folder that does not exist yet",
            out.display()
        )));
    }
    let temp = base::interrupt::temp_folder_in(folder_of(out)?)?;
    let complete = temp.path().join("export");
    for file in files {
        let path = complete.join(&file.path);
        files::file_tree::write(&path, &file.contents)?;
        if file.is_executable {
            make_executable(&path)?;
        }
    }
    // Not all systems can rename a folder to the name of an empty one.
    let _ = std::fs::remove_dir(out);
    std::fs::rename(&complete, out).map_err(|e| GraderError::file("write", out, e))
}

#[cfg(unix)]
fn make_executable(path: &Path) -> Result<(), GraderError> {
    let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    std::fs::set_permissions(path, mode).map_err(|e| GraderError::file("write", path, e))
}

#[cfg(not(unix))]
fn make_executable(_: &Path) -> Result<(), GraderError> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::program::{check_help, subprogram_command};

    #[test]
    fn the_stored_help_is_that_of_the_commands() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        check_help(subprogram_command([command()]), folder).unwrap();
    }

    #[test]
    fn what_becomes_part_of_a_script_is_checked() {
        command().debug_assert();
        assert_eq!(
            repository("cs184/first-light"),
            Ok("cs184/first-light".into())
        );
        for text in ["cs184", "/x", "a/b/c", "a/$(b)", "a/b c"] {
            assert!(repository(text).is_err(), "{text}");
        }
        for text in ["", "-x", "a b", "$(x)", "a\nb"] {
            assert!(reference(text).is_err(), "{text:?}");
        }
    }
}
