//! The files of course systems, with `{names}` for what differs from course to course.

/// A file that is part of this program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Template {
    /// Its path in what is exported.
    pub path: &'static str,
    /// Its text, with names in braces.
    pub text: &'static str,
    /// Whether it is run.
    pub is_executable: bool,
}

/// The scripts of Gradescope's package.
pub const GRADESCOPE: [Template; 2] = [
    Template {
        path: "setup.sh",
        text: include_str!("../templates/gradescope/setup.sh"),
        is_executable: true,
    },
    Template {
        path: "run_autograder",
        text: include_str!("../templates/gradescope/run_autograder"),
        is_executable: true,
    },
];

/// The autograder of Classroom 50, and its `runtime` block.
pub const CLASSROOM50: [Template; 2] = [
    Template {
        path: "autograder.py",
        text: include_str!("../templates/classroom50/autograder.py"),
        is_executable: true,
    },
    Template {
        path: "runtime.json",
        text: include_str!("../templates/classroom50/runtime.json"),
        is_executable: false,
    },
];

/// The workflow of GitHub Actions.
pub const ACTIONS: [Template; 1] = [Template {
    path: "first-light.yml",
    text: include_str!("../templates/actions/first-light.yml"),
    is_executable: false,
}];

/// The image and the question of PrairieLearn. The question's folder is named after the part.
pub const PRAIRIELEARN: [Template; 4] = [
    Template {
        path: "image/Dockerfile",
        text: include_str!("../templates/prairielearn/Dockerfile"),
        is_executable: false,
    },
    Template {
        path: "image/grade.sh",
        text: include_str!("../templates/prairielearn/grade.sh"),
        is_executable: true,
    },
    Template {
        path: "questions/first_light_{what}/info.json",
        text: include_str!("../templates/prairielearn/info.json"),
        is_executable: false,
    },
    Template {
        path: "questions/first_light_{what}/question.html",
        text: include_str!("../templates/prairielearn/question.html"),
        is_executable: false,
    },
];

/// How an image grades: what differs between one with solutions and one without. These texts have
/// names in braces, too.
pub type Image = [(&'static str, &'static str); 4];

/// The image with the whole course, which grades a submission in the sandbox. It is not built if
/// the reference loses points there.
pub const FULL_IMAGE: Image = [
    (
        "contents",
        "the solutions: use a private repository of the registry",
    ),
    (
        "prepare",
        "cargo build --release --locked {packages} \\\n \
         && ./target/release/submission {what} --submission .{unsandboxed} --write prairielearn=/tmp/results.json",
    ),
    ("take_stages", ""),
    (
        "grade",
        "./target/release/submission {what} --submission \"$submission\"",
    ),
];

/// The image with a handout, whose stages a submission replaces. Exit code 1 while it is built says
/// that nothing is written yet.
pub const PUBLIC_IMAGE: Image = [
    ("contents", "what students have: the handout of Part 1"),
    (
        "prepare",
        "{ cargo grader {what} {options} --write prairielearn=/tmp/results.json || [ $? -eq 1 ]; }",
    ),
    (
        "take_stages",
        include_str!("../templates/prairielearn/take_stages.sh"),
    ),
    ("grade", "cargo grader {what}"),
];

/// Replaces each `{name}` of `values` in `text`.
pub fn fill(text: &str, values: &[(&str, String)]) -> String {
    let mut filled = text.to_owned();
    for (name, value) in values {
        filled = filled.replace(&format!("{{{name}}}"), value);
    }
    filled
}
