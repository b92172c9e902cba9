//! Tests the page that `grader review` writes: its data, and in a browser a click on a pixel.

mod browser;
mod data;
mod webdriver;

use grader::workspace::Workspace;
use judge::Tier;
use judge::cases::{self, Spec};
use judge::snapshot::{Line, Snapshot, Value, parse};
use review::Review;
use review::case::Case;
use std::path::Path;
use wire::Answer;
use wire::answer::{Hit, HitsAnswer};

/// The pixels that [`changed_boxes`] changes: one beside the box, and two neighbours inside it.
const FALSE_HIT: [u32; 2] = [0, 0];
const FALSE_MISS: [u32; 2] = [32, 24];
const LATER_EXIT: [u32; 2] = [33, 24];

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in the course")
}

fn spec(task: &str, name: &str) -> Spec {
    let found = cases::all(0).into_iter().find(|spec| spec.is(task, name));
    found.expect("the case exists")
}

fn golden(spec: &Spec) -> Snapshot {
    let path = workspace().snapshot(spec.task, spec.name);
    let text = std::fs::read_to_string(path).expect("the golden exists");
    parse(&text).expect("it is a snapshot")
}

fn review(spec: &Spec, answer: &Answer) -> Review {
    let no_worker = Err("no worker is built for this test".into());
    let case = Case::of(&workspace(), spec, Tier::Robust, answer, &no_worker);
    Review {
        cases: vec![case.expect("the case can be compared")],
    }
}

/// The number of the call for a pixel.
fn call(spec: &Spec, [x, y]: [u32; 2]) -> usize {
    let [w, _] = spec.picture.expect("the case has a picture");
    (y * w + x) as usize
}

/// The case of a box's picture, with its golden answers except in three pixels.
fn changed_boxes() -> (Spec, Answer) {
    let spec = spec("part2.task2", "picture");
    let inside = |line: &Line| {
        line.get("inside").map(|value| match *value {
            Value::Range(enters, leaves) => [enters, leaves],
            _ => panic!("{line}"),
        })
    };
    let mut answers: Vec<_> = golden(&spec).lines.iter().map(inside).collect();
    answers[call(&spec, FALSE_HIT)] = Some([1.0, 2.0]);
    answers[call(&spec, FALSE_MISS)] = None;
    let [enters, leaves] = answers[call(&spec, LATER_EXIT)].expect("this pixel is inside the box");
    answers[call(&spec, LATER_EXIT)] = Some([enters, leaves + 1.0]);
    (spec, Answer::Boxes(answers))
}

/// The case of a mesh's picture, with its golden answers changed by `change`. All hits have the
/// same normal, because the golden stores only a few.
fn changed_mesh(change: impl Fn(&mut [Option<Hit>])) -> (Spec, Answer) {
    let spec = spec("part2.task3", "mesh_in_cornell_box");
    let hit = |line: &Line| {
        Some(Hit {
            t: line.number("t")?,
            p: [0.0; 3],
            n: [0.0, 0.0, 1.0],
            ng: [0.0, 0.0, 1.0],
            uv: [0.0; 2],
            prim: line.number("prim")? as u32,
        })
    };
    let mut hits: Vec<Option<Hit>> = golden(&spec).lines.iter().map(hit).collect();
    change(&mut hits);
    let answer = HitsAnswer {
        max_t: vec![f64::INFINITY; hits.len()],
        hits,
        box_tests: 0,
        prim_tests: 0,
    };
    (spec, Answer::SceneHits(answer))
}
