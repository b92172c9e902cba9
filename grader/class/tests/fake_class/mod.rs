//! A class whose units are graded by a shell script instead of a compiler: it copies results that
//! were made before, by a temporary file and a rename as the program does.

use class::collect::{Options, points};
use class::hash;
use class::out::Out;
use class::plan::Plan;
use class::tables;
use grader::report::HintLevel;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A class in a temporary folder.
pub(crate) struct FakeClass {
    pub(crate) folder: PathBuf,
    pub(crate) plan: Plan,
}

/// What the fake grader does besides copying.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Behaviour {
    /// Nothing.
    Fine,
    /// So many processes of a run end; the others wait until the run has ended.
    Only(usize),
    /// The first attempts of each unit fail, so many of them.
    FailsFirst(u32),
}

impl FakeClass {
    /// Makes a class of so many submissions in `folder`, each with another result. Two of them are
    /// the same submission.
    pub(crate) fn new(folder: &Path, submissions: usize) -> FakeClass {
        let key = |i: usize| hash::of([format!("unit {}", i.min(submissions - 2))]);
        let planned = (0..submissions).map(|i| {
            json!({
                "name": format!("student{i:02}"), "file": format!("student{i:02}.zip"),
                "unit": { "submission": key(i), "key": key(i), "notes": [] },
            })
        });
        let mut planned: Vec<Value> = planned.collect();
        planned.push(json!({ "name": "zz", "file": "zz", "unreadable": "is empty" }));
        let plan = json!({
            "version": 2,
            "settings": { "what": "part1", "seed": 7, "limits": "contained", "revision": null, "course": { "the grader": "0" } },
            "tasks": [{ "key": "part1.task1", "title": "A <task>", "stage": "raygen", "cases": [
                { "name": "a_case", "tier": "core", "points": 10.0 }, { "name": "b_case", "tier": "robust", "points": 2.0 },
            ] }],
            "submissions": planned,
        });
        let made = folder.join("made");
        std::fs::create_dir_all(&made).expect("a folder");
        for i in 0..submissions - 1 {
            let text = serde_json::to_string(&result(&key(i), i)).expect("JSON");
            std::fs::write(made.join(key(i)), text).expect("a file");
        }
        FakeClass {
            folder: folder.to_path_buf(),
            plan: serde_json::from_value(plan).expect("a plan"),
        }
    }

    /// A new folder of results with the plan in it.
    pub(crate) fn out(&self, name: &str) -> Out {
        let out = Out::create(&self.folder.join(name)).expect("a folder");
        self.plan.store(&out.plan()).expect("a plan");
        out
    }

    /// The process that grades a unit.
    pub(crate) fn command(&self, out: &Out, key: &str, behaviour: Behaviour) -> Command {
        let (most, failures) = match behaviour {
            Behaviour::Fine => (String::new(), 0),
            Behaviour::Only(most) => (most.to_string(), 0),
            Behaviour::FailsFirst(failures) => (String::new(), failures),
        };
        let places = out.join(format!("places{}", std::process::id()));
        let script = "set -e
            echo >> \"$3.tries\"
            if [ $(wc -l < \"$3.tries\") -le $5 ]; then echo 'error: the disk is full' >&2; exit 2; fi
            if [ -n \"$4\" ]; then
                place=0; mkdir -p \"$6\"
                until mkdir \"$6/$place\" 2> /dev/null; do
                    place=$((place + 1))
                    # The pipe is closed when whoever started this is gone.
                    if [ $place -ge $4 ]; then cat > /dev/null; exit 1; fi
                done
            fi
            cp \"$1\" \"$2.$$\"; mv \"$2.$$\" \"$2\"";
        let mut command = Command::new("sh");
        command
            .args(["-c", script, "sh"])
            .arg(self.folder.join("made").join(key))
            .arg(out.unit(key))
            .arg(out.join(key))
            .arg(most)
            .arg(failures.to_string())
            .arg(places);
        command
    }

    /// Writes the tables and returns all their bytes.
    pub(crate) fn tables(&self, out: &Out) -> BTreeMap<PathBuf, Vec<u8>> {
        self.tables_with(out, &Options::default())
    }

    /// The same, with what the teacher decided or knows.
    pub(crate) fn tables_with(&self, out: &Out, options: &Options) -> BTreeMap<PathBuf, Vec<u8>> {
        tables::write(out, self.plan.clone(), HintLevel::Remedy, options).expect("tables");
        let names = ["gradebook.csv", "class.html", "lecture.html"];
        let mut files = names.map(|name| out.join(name)).to_vec();
        let pages = std::fs::read_dir(out.join("students")).expect("pages");
        files.extend(pages.map(|page| page.expect("a page").path()));
        let read = files.into_iter().map(|path| {
            let bytes = std::fs::read(&path).expect("a table");
            (
                path.strip_prefix(out.path())
                    .expect("it is in OUT")
                    .to_path_buf(),
                bytes,
            )
        });
        read.collect()
    }
}

/// What a student may make a report say: markup, and what terminals and readers obey.
pub(crate) const HOSTILE: &str = "</p><script>\u{1b}[2J\r\u{202e}08 fo 08\u{9b}31m";

/// One student in two makes one of two mistakes.
fn diagnosis(i: usize) -> Value {
    let (name, says) = match i % 4 {
        0 => (
            "one_sample_for_all",
            "uses one random place for all samples of a pixel",
        ),
        1 => ("sizes_swapped", "divides x by the height"),
        _ => return Value::Null,
    };
    json!({ "mistakes": [name], "description": says, "says": format!("your answers equal those of code that {says}: on 9 of 9 calls"),
            "hint": "Look.", "certainty": "likely" })
}

/// The simplest call of unit number `i`.
fn simplest(i: usize) -> Value {
    json!({ "case": "a_case", "aspect": "radiance", "input": format!("N = {i}"), "result": "your result: 0; expected: 1",
            "drawing": { "svg": HOSTILE, "caption": HOSTILE } })
}

/// The unit whose case reaches code that is not written yet.
const UNFINISHED: usize = 7;

/// The result of unit number `i`.
fn result(key: &str, i: usize) -> Value {
    let score = (i % 11) as f64;
    let case = json!({
        "name": "a_case", "tier": "core", "score": score, "max_score": 10.0,
        "status": if i == UNFINISHED { "not_attempted" } else { "failed" },
        "about": format!("earns {} points", points(score)), "findings": [], "reductions": [HOSTILE], "detail": HOSTILE,
    });
    let task = json!({
        "key": "part1.task1", "title": "A <task>", "score": score, "max_score": 10.0,
        "robust_score": 0.0, "robust_max_score": 2.0, "status": "failed", "stage": "raygen", "cases": [case],
        "diagnosis": diagnosis(i), "simplest": simplest(i), "worst_as_test": HOSTILE, "regularities": [HOSTILE],
    });
    json!({
        "key": key, "submission": key, "course": "0", "what": "part1", "seed": 7,
        "outcome": "graded", "pictures": { "part1.task1": "picture" },
        "earned": { "part1.task1": { "a_case": score / 10.0, "b_case": 0.0 } },
        "wrong_answers": {}, "endless_cases": {}, "sources": {},
        "took": { "seconds": 1.0, "cpu_seconds": 1.0 },
        "report": {
            "score": score, "max_score": 10.0, "robust_score": 0.0, "robust_max_score": 2.0,
            "compiler": HOSTILE, "printed": HOSTILE, "tasks": [task],
        },
    })
}
