//! The page that `grader review` writes: its data, and in a browser the click on a pixel.

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

/// The pixels of the picture of a box that [`spoilt_boxes`] changes: beside the box, in it, and next to that.
const FALSE_HIT: [u32; 2] = [0, 0];
const FALSE_MISS: [u32; 2] = [32, 24];
const LATER: [u32; 2] = [33, 24];

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in the course")
}

fn spec(task: &str, name: &str) -> Spec {
    let found = cases::all(0).into_iter().find(|spec| spec.is(task, name));
    found.expect("the case is there")
}

fn golden(spec: &Spec) -> Snapshot {
    let path = workspace().snapshot(spec.task, spec.name);
    let text = std::fs::read_to_string(path).expect("the golden is there");
    parse(&text).expect("it is a snapshot")
}

fn review(spec: &Spec, answer: &Answer) -> Review {
    let nobody = Err("no worker is built for this test".into());
    let case = Case::of(&workspace(), spec, Tier::Robust, answer, &nobody);
    Review {
        cases: vec![case.expect("it can be compared")],
    }
}

/// The call that makes a pixel.
fn call(spec: &Spec, [x, y]: [u32; 2]) -> usize {
    let [w, _] = spec.picture.expect("it makes a picture");
    (y * w + x) as usize
}

/// The picture of a box, as its golden has it but for three pixels.
fn spoilt_boxes() -> (Spec, Answer) {
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
    let [enters, leaves] = answers[call(&spec, LATER)].expect("it is in the middle");
    answers[call(&spec, LATER)] = Some([enters, leaves + 1.0]);
    (spec, Answer::Boxes(answers))
}

/// The picture of a mesh, each hit with a normal of its own (goldens keep few), spoilt by `spoil`.
fn spoilt_mesh(spoil: impl Fn(&mut [Option<Hit>])) -> (Spec, Answer) {
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
    spoil(&mut hits);
    let answer = HitsAnswer {
        max_t: vec![f64::INFINITY; hits.len()],
        hits,
        box_tests: 0,
        prim_tests: 0,
    };
    (spec, Answer::SceneHits(answer))
}
