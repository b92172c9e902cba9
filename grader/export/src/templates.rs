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

/// The image of PrairieLearn.
pub const PRAIRIELEARN_IMAGE: [Template; 2] = [
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
];

/// The image of PrairieLearn without solutions.
pub const PRAIRIELEARN_PUBLIC_IMAGE: [Template; 2] = [
    Template {
        path: "image/Dockerfile",
        text: include_str!("../templates/prairielearn/public/Dockerfile"),
        is_executable: false,
    },
    Template {
        path: "image/grade.sh",
        text: include_str!("../templates/prairielearn/public/grade.sh"),
        is_executable: true,
    },
];

/// The question of PrairieLearn. Its folder is named after the part.
pub const PRAIRIELEARN_QUESTION: [Template; 2] = [
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

/// Replaces each `{name}` of `values` in `text`.
pub fn fill(text: &str, values: &[(&str, String)]) -> String {
    let mut filled = text.to_owned();
    for (name, value) in values {
        filled = filled.replace(&format!("{{{name}}}"), value);
    }
    filled
}
