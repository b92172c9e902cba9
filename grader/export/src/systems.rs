//! What each course system gets.

use crate::choices::Choices;
use crate::course_files;
use crate::templates::{self, Template};
use base::{GraderError, Workspace};
use grader::course::Course;
use handout::Handout;
use std::path::PathBuf;
use std::process::Command;

/// A course system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// Gradescope: a zip with the course.
    Gradescope,
    /// Classroom 50: an autograder that fetches the handout.
    Classroom50,
    /// GitHub Actions: a workflow that fetches the handout.
    Actions,
    /// PrairieLearn: an image with the course, and a question.
    PrairieLearn,
}

/// A file that is exported.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedFile {
    /// Its path below the folder or the root of the zip.
    pub path: PathBuf,
    /// Its contents.
    pub contents: Vec<u8>,
    /// Whether it is run.
    pub is_executable: bool,
}

impl System {
    /// All systems.
    pub const ALL: [System; 4] = [
        System::Gradescope,
        System::Classroom50,
        System::Actions,
        System::PrairieLearn,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            System::Gradescope => "gradescope",
            System::Classroom50 => "classroom50",
            System::Actions => "actions",
            System::PrairieLearn => "prairielearn",
        }
    }

    /// Whether it grades in the student's repository, with a handout from GitHub.
    pub fn needs_handout(self) -> bool {
        matches!(self, System::Classroom50 | System::Actions)
    }

    /// The flags of the command that change nothing in its files.
    pub fn unused_flags(self) -> &'static [&'static str] {
        match self {
            System::Gradescope => &["course", "public", "ref"],
            System::PrairieLearn => &["course", "ref", "visibility"],
            System::Classroom50 | System::Actions => &["public", "unsandboxed", "visibility"],
        }
    }

    /// What to do with the exported files.
    pub fn next_step(self, choices: &Choices) -> &'static str {
        match self {
            System::Gradescope => {
                "Upload the zip under `Configure Autograder`. It contains the solutions: do not give it to students."
            }
            System::Classroom50 => {
                "Copy autograder.py to CLASSROOM/autograders/ASSIGNMENT/ of your repository `classroom50`, and register the assignment with `--runtime runtime.json`. It grades outside the sandbox and with seed 0, and a student's code can write its result: it is for feedback. Grade with `cargo grader class`."
            }
            System::Actions => {
                "Copy first-light.yml to .github/workflows/ of the repository that students start from."
            }
            System::PrairieLearn if choices.public => {
                "Build and push image/Dockerfile, write the image's name into info.json, and copy `questions` to your course. The image contains no solutions, so anybody may read it. It grades outside the sandbox and with seed 0, and a student's code can write its result: it is for feedback. Grade with `cargo grader class`."
            }
            System::PrairieLearn => {
                "Build and push image/Dockerfile, write the image's name into info.json, and copy `questions` to your course. The image contains the solutions: keep it private. PrairieLearn's own servers ask for a public image: `--public` makes one without solutions, for feedback."
            }
        }
    }

    fn templates(self) -> &'static [Template] {
        match self {
            System::Gradescope => &templates::GRADESCOPE,
            System::Classroom50 => &templates::CLASSROOM50,
            System::Actions => &templates::ACTIONS,
            System::PrairieLearn => &templates::PRAIRIELEARN,
        }
    }

    /// Where the course's own files are, if they are exported.
    fn course_folder(self) -> Option<&'static str> {
        match self {
            System::Gradescope => Some("course"),
            System::PrairieLearn => Some("image/course"),
            System::Classroom50 | System::Actions => None,
        }
    }

    /// The files for grading `choices` with this system.
    pub fn files(
        self,
        workspace: &Workspace,
        choices: &Choices,
    ) -> Result<Vec<ExportedFile>, GraderError> {
        let course = Course::read(workspace)?;
        let mut exported = Vec::new();
        let mut programs = Vec::new();
        if let Some(folder) = self.course_folder() {
            // The handout of Part 1 is the one that contains no solution of any part.
            let files = match choices.public && self == System::PrairieLearn {
                true => Handout::carve(workspace, 1)?.files,
                false => course_files::of(workspace)?,
            };
            programs = course_files::programs(&files);
            exported.extend(files.into_iter().map(|(path, contents)| ExportedFile {
                path: PathBuf::from(folder).join(path),
                contents,
                is_executable: false,
            }));
        }
        let values = self.values(&course, choices, &programs)?;
        exported.extend(self.templates().iter().map(|template| ExportedFile {
            path: templates::fill(template.path, &values).into(),
            contents: templates::fill(template.text, &values).into_bytes(),
            is_executable: template.is_executable,
        }));
        exported.sort_by(|a, b| a.path.cmp(&b.path));
        Ok(exported)
    }

    fn values(
        self,
        course: &Course,
        choices: &Choices,
        programs: &[&str],
    ) -> Result<Vec<(&'static str, String)>, GraderError> {
        let packages: Vec<String> = programs
            .iter()
            .map(|name| format!("--package {name}"))
            .collect();
        let mut options = choices.options();
        let unsandboxed = match choices.unsandboxed {
            true => " --unsandboxed",
            false => "",
        };
        if self.course_folder().is_some() && !choices.public {
            options.push_str(unsandboxed);
        }
        if self == System::Gradescope {
            options.push_str(&format!(" --visibility {}", choices.visibility));
        }
        let repository = match (&choices.course, self.needs_handout()) {
            (Some(repository), _) => repository.clone(),
            (None, false) => String::new(),
            (None, true) => {
                return Err(GraderError::new(format!(
                    "expected `--course OWNER/NAME`, the repository with the handout of {}: {} takes the grader from there",
                    choices.what,
                    self.name()
                )));
            }
        };
        let image = match choices.public {
            true => templates::PUBLIC_IMAGE,
            false => templates::FULL_IMAGE,
        };
        // First, since these values contain names of others.
        let mut values: Vec<_> = image.map(|(name, text)| (name, text.to_owned())).into();
        values.extend([
            ("what", choices.what.clone()),
            ("title", choices.title.clone()),
            ("options", options),
            ("unsandboxed", unsandboxed.to_owned()),
            ("packages", packages.join(" ")),
            ("stages", course.stages().join(" ")),
            ("toolchain", toolchain()?),
            ("course", repository),
            ("reference", choices.reference.clone()),
            // A UUID of version 4 in its layout; each part has its own.
            (
                "uuid",
                format!("f1257116-87f1-4257-8116-{:012x}", choices.part),
            ),
        ]);
        Ok(values)
    }
}

/// The version of the toolchain that runs the export: containers use the same.
fn toolchain() -> Result<String, GraderError> {
    let output = Command::new(base::child_processes::cargo())
        .arg("--version")
        .output();
    let output = output.map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let version = text.split_whitespace().nth(1).map(str::to_owned);
    version.ok_or_else(|| GraderError::new(format!("cargo --version printed {text:?}")))
}
