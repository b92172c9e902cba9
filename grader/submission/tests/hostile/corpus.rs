//! Reads the corpus, and makes submissions of it.

use base::Workspace;
use files::file_tree::{self, Files};
use grader::build::BuildOutcome;
use grader::grade::GradeRequest;
use grader::workers::awake::Awake;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use submission::containment::Containment;
use submission::one::{GradedSubmission, GradingCourse, NotGraded, Options, grade_one};

/// A hostile submission: the reference's stage `intersect` with more code.
#[derive(Clone, Debug, Default)]
pub(crate) struct Case {
    pub(crate) name: String,
    /// The code of a module of its own.
    code: String,
    /// Code at the beginning of `test_triangle`.
    in_call: String,
    /// Part of what is said about it.
    pub(crate) says: Option<String>,
    /// What nothing may say about it: a sign that it got what it wanted.
    pub(crate) never: Option<String>,
    /// Part of what the compiler says if it is not scanned.
    pub(crate) unscanned: Option<String>,
    /// Its score: `less`, `all` or `any`.
    pub(crate) score: Option<String>,
}

/// The function that the code is called in.
const FUNCTION: &str = "pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {\n";

/// The end of the channel as safe code can get it.
const CHANNEL: &str = "use std::io::Write; use std::os::fd::AsFd; \
    let Ok(channel) = std::io::stdin().as_fd().try_clone_to_owned() else { return; }; \
    let mut channel = std::fs::File::from(channel);";

/// The cases of the file `name`.
pub(crate) fn cases(name: &str) -> Vec<Case> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/hostile/{name}.toml"));
    let text = std::fs::read_to_string(&path).expect("the corpus is readable");
    let table: toml::Table = text.parse().expect("the corpus is TOML");
    let list = table["case"].as_array().expect("it has cases");
    let cases = list.iter().map(|entry| {
        let text = |key: &str| entry.get(key).and_then(|value| value.as_str());
        let owned = |key: &str| text(key).map(ToString::to_string);
        let code = filled_in(text("code").expect("a case has code"));
        let runs = name == "run";
        Case {
            name: owned("name").expect("a case has a name"),
            in_call: match runs {
                true => CALL.to_string(),
                false => owned("in_call").unwrap_or_default(),
            },
            code: match runs {
                true => once(&code),
                false => code,
            },
            says: owned("says"),
            never: owned("never"),
            unscanned: owned("unscanned"),
            score: owned("score"),
        }
    });
    cases.collect()
}

/// The call of the function that [`once`] makes.
const CALL: &str = "crate::hostile::attack();";

/// A function that runs `code` when it is first called.
fn once(code: &str) -> String {
    format!(
        "use std::sync::atomic::{{AtomicBool, Ordering}};\nstatic DONE: AtomicBool = AtomicBool::new(false);\n#[allow(unreachable_code, unused_must_use)]\npub fn attack() {{ if DONE.swap(true, Ordering::SeqCst) {{ return; }} {code} }}"
    )
}

/// One function that makes all these attempts and prints which of them got out.
pub(crate) fn attempts_code(attempts: &[Case]) -> String {
    let mut body = String::from(
        "trait Outcome { fn got_out(&self) -> bool; }
        impl<T> Outcome for Option<T> { fn got_out(&self) -> bool { self.is_some() } }
        impl<T, E> Outcome for Result<T, E> { fn got_out(&self) -> bool { self.is_ok() } }\n",
    );
    for attempt in attempts {
        let _ = writeln!(
            body,
            "println!(\"{}: {{}}\", if ({}).got_out() {{ \"GOT OUT\" }} else {{ \"held\" }});",
            attempt.name, attempt.code
        );
    }
    once(&body)
}

/// The code with the paths of this machine.
fn filled_in(code: &str) -> String {
    let root = root();
    let home = std::env::var("HOME").unwrap_or("/root".into());
    let shared = root.join("target/submissions");
    let newest = std::fs::read_dir(&shared).ok().and_then(|entries| {
        let mut entries = entries.flatten().map(|entry| entry.path());
        entries.find(|path| path.join("complete").is_file())
    });
    let clean = newest.unwrap_or(shared);
    let paths = [
        ("{COURSE}", root.to_string_lossy().into_owned()),
        ("{CLEAN}", clean.to_string_lossy().into_owned()),
        ("{HOME}", home),
        ("{CHANNEL}", CHANNEL.to_string()),
    ];
    let code = paths.iter().fold(code.to_string(), |code, (name, text)| {
        code.replace(name, text)
    });
    MADE.iter()
        .fold(code, |code, (name, text)| match code.contains(name) {
            true => code.replace(name, &text()),
            false => code,
        })
}

/// A placeholder in the corpus, and what makes the code that it stands for.
type Made = (&'static str, fn() -> String);

/// Code that is too long to be written, or does not show when it is.
const MADE: [Made; 5] = [
    ("{LRM}", || "\u{200e}".into()),
    ("{ESC}", || "\u{1b}".into()),
    ("{RLO}", || "\u{202e}".into()),
    ("{NUL}", || "\0\u{1}".into()),
    ("{ERRORS}", || {
        each(0..10_000, |i| {
            format!("pub fn f{i}() -> u8 {{ \"a text that is no number\" }}\n")
        })
    }),
];

fn each(numbers: std::ops::Range<usize>, text: impl Fn(usize) -> String) -> String {
    numbers.map(text).collect()
}

fn root() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.canonicalize().expect("the workspace exists")
}

/// The sources of the reference's `stage`.
pub(crate) fn reference(stage: &str) -> Files {
    let src = root().join("stages").join(stage).join("src");
    let paths = file_tree::workspace_paths(&src).expect("the stage is readable");
    let read = |path: PathBuf| {
        let contents = std::fs::read(src.join(&path)).expect("it is readable");
        (path, contents)
    };
    paths.into_iter().map(read).collect()
}

impl Case {
    /// A submission that calls the function `attack` of this code.
    pub(crate) fn with_code(code: &str) -> Case {
        Case::with_call(code, CALL)
    }

    /// A submission with this code, and `in_call` at the beginning of `test_triangle`.
    pub(crate) fn with_call(code: &str, in_call: &str) -> Case {
        Case {
            code: code.to_string(),
            in_call: in_call.to_string(),
            ..Case::default()
        }
    }

    /// The files of the stage.
    pub(crate) fn files(&self) -> Files {
        let mut files = reference("intersect");
        // Attributes of the crate.
        let (attribute, code) = match self.code.strip_prefix("#![") {
            Some(rest) => rest.split_once(']').expect("an attribute ends"),
            None => ("", self.code.as_str()),
        };
        let mut change = |path: &str, change: &dyn Fn(&str) -> String| {
            let contents = files.entry(path.into()).or_default();
            let text = String::from_utf8(contents.clone()).expect("sources are UTF-8");
            let changed = change(&text);
            assert_ne!(changed, text, "{path} has no place for it");
            *contents = changed.into_bytes();
        };
        change("lib.rs", &|text| {
            let start = match attribute {
                "" => String::new(),
                attribute => format!("#![{attribute}]\n"),
            };
            format!("{start}{text}\n#[allow(dead_code, missing_docs)]\npub mod hostile;\n")
        });
        change("triangle.rs", &|text| match self.in_call.as_str() {
            "" => format!("{text}\n"),
            call => text.replace(FUNCTION, &format!("{FUNCTION}{call}\n")),
        });
        change("hostile.rs", &|_| format!("{code}\n"));
        files
    }
}

/// The strongest containment of this machine, those with less, and none.
pub(crate) fn levels() -> Vec<Containment> {
    let workspace = Workspace::above(&root()).expect("this is the course");
    let strongest = Containment::choose(&workspace, false).expect("there is one");
    let mut levels = strongest.levels();
    levels.push(Containment::None);
    levels
}

/// The course that all submissions are graded against.
pub(crate) struct Class(GradingCourse);

impl Class {
    pub(crate) fn open() -> Class {
        let workspace = Workspace::above(&root()).expect("this is the course");
        Class::with(Containment::choose(&workspace, false).expect("there is one"))
    }

    pub(crate) fn with(containment: Containment) -> Class {
        let workspace = Workspace::above(&root()).expect("this is the course");
        Class(GradingCourse::open(&workspace, containment).expect("it can be built"))
    }

    /// The same with another program in place of the compiler.
    pub(crate) fn with_compiler(program: &Path) -> Class {
        let Class(course) = Class::open();
        Class(course.with_compiler(program))
    }

    /// Builds the worker without scanning the files. It has to end at `end`.
    pub(crate) fn build(&self, files: &Files, end: Option<Awake>) -> BuildOutcome {
        let folder = self
            .0
            .clean()
            .with_stages(&[("intersect", files)], end)
            .expect("it is written");
        let built = folder.build_root().build_worker(&["intersect"]);
        built.expect("cargo runs")
    }

    /// Grades part1.task3 of a submission with these files.
    pub(crate) fn grade(&self, files: &Files, seed: u64) -> Result<GradedSubmission, NotGraded> {
        self.grade_stage("intersect", files, "part1.task3", seed)
    }

    /// Grades a task of a submission with these files of its stage.
    pub(crate) fn grade_stage(
        &self,
        stage: &str,
        files: &Files,
        task: &str,
        seed: u64,
    ) -> Result<GradedSubmission, NotGraded> {
        let folder = tempfile::tempdir().expect("there is a folder for it");
        for (path, contents) in files {
            let path = folder
                .path()
                .join("stages")
                .join(stage)
                .join("src")
                .join(path);
            file_tree::write(&path, contents).expect("it can be written");
        }
        self.grade_task(folder.path(), task, seed)
    }

    fn grade_task(
        &self,
        folder: &Path,
        task: &str,
        seed: u64,
    ) -> Result<GradedSubmission, NotGraded> {
        let request = GradeRequest {
            what: task.into(),
            seed,
        };
        let options = Options {
            pictures: false,
            request,
            together: false,
        };
        grade_one(&self.0, folder, &options)
    }

    /// What one submission does, the next does not notice.
    pub(crate) fn still_grades_the_reference(&self) {
        let graded = self
            .grade(&reference("intersect"), 1)
            .expect("it is graded");
        let scores = graded.report.scores;
        assert_eq!(scores.score, scores.max_score);
        assert_eq!(scores.robust_score, scores.robust_max_score);
    }
}
