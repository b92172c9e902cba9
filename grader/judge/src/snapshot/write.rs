//! Writing a snapshot.

use super::hash::RowsHash;
use super::light;
use super::line::{Line, Value};
use super::parse::Snapshot;
use wire::answer::{Hit, HitsAnswer, TraverseAnswer};
use wire::work::Ray;
use wire::{Answer, Work};

/// A case of at most so many calls has a row for each.
pub const ALL_ROWS: usize = 640;

/// Any other case has at most so many rows.
const SAMPLED_ROWS: usize = 200;

/// So many rows of a case have the question and the whole record.
pub const FULL_ROWS: usize = 48;

/// The text of the snapshot of `answer` to `work`; `None` for what is different every time (times).
pub fn write(work: &Work, answer: &Answer) -> Option<String> {
    let (totals, forms) = content(work, answer)?;
    let calls = forms.len();
    let hash = hash(forms.iter().map(|(_, full)| full));
    let mut text = format!("# calls={calls} hash={hash}\n");
    if !totals.is_empty() {
        let fields: Vec<String> = totals
            .iter()
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        text.push_str(&format!("# {}\n", fields.join(" ")));
    }
    let rows: Vec<Forms> = forms.into_iter().step_by(row_stride(calls)).collect();
    let stride = rows.len().div_ceil(FULL_ROWS).max(1);
    for (i, (short, full)) in rows.into_iter().enumerate() {
        let row = if i % stride == 0 { full } else { short };
        text.push_str(&format!("{row}\n"));
    }
    Some(text)
}

/// Of how many calls one has a row. Odd where it is not 1: the sample is in all columns of a
/// picture whose width is a power of 2.
fn row_stride(calls: usize) -> usize {
    if calls <= ALL_ROWS {
        1
    } else {
        calls.div_ceil(SAMPLED_ROWS) | 1
    }
}

/// The hash of the text of `rows`.
fn hash<'a>(rows: impl Iterator<Item = &'a Line>) -> RowsHash {
    rows.fold(RowsHash::EMPTY, |hash, row| hash.then(&format!("{row}\n")))
}

/// The snapshot of `answer` to `work` with a row for every call, each with its question and the
/// whole record.
pub fn full(work: &Work, answer: &Answer) -> Option<Snapshot> {
    let (totals, forms) = content(work, answer)?;
    let lines: Vec<Line> = forms.into_iter().map(|(_, full)| full).collect();
    Some(Snapshot {
        calls: lines.len(),
        hash: Some(hash(lines.iter())),
        totals: Line {
            answer: totals,
            ..Line::default()
        },
        lines,
    })
}

/// The totals of a case and its rows, numbered.
fn content(work: &Work, answer: &Answer) -> Option<(Fields, Vec<Forms>)> {
    let (totals, mut forms) = answers(work, answer)?;
    for (call, (short, full)) in (0..).zip(&mut forms) {
        short.call = call;
        full.call = call;
    }
    Some((totals, forms))
}

/// Names and values.
pub type Fields = Vec<(String, Value)>;

/// The short and the full form of a row.
pub(super) type Forms = (Line, Line);

/// The totals of a case and its rows, not yet numbered.
fn answers(work: &Work, answer: &Answer) -> Option<(Fields, Vec<Forms>)> {
    let lines = match (work, answer) {
        (Work::Pixels(pixels), Answer::Pixels(answers)) => {
            let each = pixels.pixels.iter().zip(answers);
            each.map(|(pixel, answer)| {
                let question = vec![field("pixel", vector(&pixel.map(f64::from)))];
                let short = vec![
                    number("samples", f64::from(answer.samples)),
                    field("radiance", vector(&answer.radiance)),
                ];
                let mut full = short.clone();
                full.extend(
                    answer
                        .points
                        .iter()
                        .take(4)
                        .map(|point| field("at", vector(point))),
                );
                forms(question, short, full)
            })
            .collect()
        }
        (Work::CameraRays { cameras, sensor }, Answer::CameraRays(rays)) => {
            let questions = (0..cameras.len())
                .flat_map(|camera| sensor.iter().map(move |point| (camera, point)));
            let each = questions.zip(rays);
            each.map(|((camera, point), ray)| {
                let question = vec![
                    number("camera", camera as f64),
                    field("sensor", vector(point)),
                ];
                forms(question, vec![field("d", vector(&ray.d))], ray_fields(ray))
            })
            .collect()
        }
        (Work::Triangles { probes, .. }, Answer::Triangles(answers)) => {
            let each = probes.iter().zip(answers);
            each.map(|(probe, answer)| {
                hit_forms(Some(probe.shape), &probe.ray, answer.hit.as_ref())
            })
            .collect()
        }
        (Work::Spheres { probes, .. }, Answer::Spheres(answers)) => {
            let each = probes.iter().zip(answers);
            each.map(|(probe, answer)| {
                hit_forms(Some(probe.shape), &probe.ray, answer.hit.as_ref())
            })
            .collect()
        }
        (Work::BruteForce { rays, .. }, Answer::Hits(answer)) => hits(rays, answer),
        (Work::SceneHits { rays, any_hit, .. }, Answer::Hits(answer)) => {
            let lines = if *any_hit {
                blocked(rays, answer)
            } else {
                hits(rays, answer)
            };
            return Some((counts(answer), lines));
        }
        (Work::Boxes { probes, .. }, Answer::Boxes(answers)) => {
            let each = probes.iter().zip(answers);
            each.map(|(probe, answer)| {
                let interval: Fields = answer
                    .iter()
                    .map(|&[min, max]| field("inside", Value::Range(min, max)))
                    .collect();
                forms(
                    question(Some(probe.shape), &probe.ray),
                    interval.clone(),
                    interval,
                )
            })
            .collect()
        }
        (Work::Build { .. }, Answer::Build(answer)) => {
            let nodes = answer.tree.nodes.iter();
            let lines = nodes
                .map(|node| {
                    let below = match node.kind {
                        wire::work::NodeKind::Interior { left, right } => {
                            field("children", vector(&[left, right].map(f64::from)))
                        }
                        wire::work::NodeKind::Leaf { first, count } => {
                            field("leaf", vector(&[first, count].map(f64::from)))
                        }
                    };
                    let [min, max] = node.bounds;
                    let full = vec![
                        below.clone(),
                        field("min", vector(&min)),
                        field("max", vector(&max)),
                    ];
                    forms(Vec::new(), vec![below], full)
                })
                .collect();
            let totals = vec![number("nodes", answer.tree.nodes.len() as f64)];
            return Some((totals, lines));
        }
        (Work::Traverse(world), Answer::Traverse(answers)) => {
            let each = world.rays.iter().zip(answers);
            each.map(|(scripted, answer)| traverse_forms(&scripted.ray, answer))
                .collect()
        }
        _ => light::lines(work, answer)?,
    };
    Some((Vec::new(), lines))
}

fn hits(rays: &[Ray], answer: &HitsAnswer) -> Vec<Forms> {
    let each = rays.iter().zip(&answer.hits);
    each.map(|(ray, hit)| hit_forms(None, ray, hit.as_ref()))
        .collect()
}

fn blocked(rays: &[Ray], answer: &HitsAnswer) -> Vec<Forms> {
    let each = rays.iter().zip(&answer.hits);
    each.map(|(ray, hit)| {
        let blocked: Fields = hit.iter().map(|_| number("blocked", 1.0)).collect();
        forms(question(None, ray), blocked.clone(), blocked)
    })
    .collect()
}

fn counts(answer: &HitsAnswer) -> Fields {
    vec![
        number("box_tests", answer.box_tests as f64),
        number("prim_tests", answer.prim_tests as f64),
    ]
}

fn hit_forms(shape: Option<u32>, ray: &Ray, hit: Option<&Hit>) -> Forms {
    let Some(hit) = hit else {
        return forms(question(shape, ray), Vec::new(), Vec::new());
    };
    let full = record(hit);
    forms(question(shape, ray), full[..2].to_vec(), full)
}

/// The fields of a hit; the first two are its main figures.
pub fn record(hit: &Hit) -> Fields {
    vec![
        number("t", hit.t),
        number("prim", f64::from(hit.prim)),
        field("uv", vector(&hit.uv)),
        field("p", vector(&hit.p)),
        field("n", vector(&hit.n)),
        field("ng", vector(&hit.ng)),
    ]
}

fn traverse_forms(ray: &Ray, answer: &TraverseAnswer) -> Forms {
    let mut fields: Fields = Vec::new();
    if let Some((t, prim)) = answer.hit {
        fields.extend([number("t", t), number("prim", f64::from(prim))]);
    }
    fields.extend([
        number("box_tests", f64::from(answer.box_tests)),
        number("prim_tests", f64::from(answer.prim_tests)),
    ]);
    forms(question(None, ray), fields.clone(), fields)
}

fn question(shape: Option<u32>, ray: &Ray) -> Fields {
    let shape = shape.map(|shape| number("shape", f64::from(shape)));
    shape.into_iter().chain(ray_fields(ray)).collect()
}

fn ray_fields(ray: &Ray) -> Fields {
    vec![
        field("o", vector(&ray.o)),
        field("d", vector(&ray.d)),
        field("range", Value::Range(ray.min_t, ray.max_t)),
    ]
}

pub(super) fn forms(question: Fields, short: Fields, full: Fields) -> Forms {
    (
        Line {
            answer: short,
            ..Line::default()
        },
        Line {
            question,
            answer: full,
            ..Line::default()
        },
    )
}

pub(super) fn field(name: &str, value: Value) -> (String, Value) {
    (name.to_string(), value)
}

pub(super) fn number(name: &str, number: f64) -> (String, Value) {
    field(name, Value::Number(number))
}

pub(super) fn vector(numbers: &[f64]) -> Value {
    Value::Vector(numbers.to_vec())
}

#[cfg(test)]
mod tests {
    use super::super::{changes, parse};
    use super::*;
    use wire::work::Probe;

    fn boxes(calls: usize) -> (Work, Vec<Option<[f64; 2]>>) {
        let ray = Ray {
            o: [0.0; 3],
            d: [0.0, 0.0, 1.0],
            min_t: 0.0,
            max_t: f64::INFINITY,
        };
        let work = Work::Boxes {
            boxes: vec![[[0.0; 3], [1.0; 3]]],
            probes: vec![Probe { shape: 0, ray }; calls],
        };
        let answers = (0..calls).map(|call| (call % 3 > 0).then_some([call as f64, 1e9]));
        (work, answers.collect())
    }

    #[test]
    fn a_large_case_has_a_sample_of_its_rows() {
        for (calls, rows) in [(640, 640), (641, 129), (19_200, 198)] {
            let (work, answers) = boxes(calls);
            let snapshot = parse(&write(&work, &Answer::Boxes(answers)).unwrap()).unwrap();
            assert_eq!((snapshot.calls, snapshot.lines.len()), (calls, rows));
            let full = snapshot.lines.iter().filter(|row| !row.question.is_empty());
            assert!((30..=FULL_ROWS).contains(&full.count()));
        }
    }

    #[test]
    fn every_bit_of_every_answer_is_in_the_hash() {
        let (work, answers) = boxes(3000);
        let snapshot = |answers: &Vec<_>| {
            parse(&write(&work, &Answer::Boxes(answers.clone())).unwrap()).unwrap()
        };
        let golden = snapshot(&answers);
        for call in [1, 1000, 2999] {
            let mut other = answers.clone();
            other[call] = match other[call] {
                Some([from, to]) => Some([from, to.next_up()]),
                None => Some([0.0, 0.0]),
            };
            assert!(changes(&golden, &snapshot(&other)).hash, "call {call}");
        }
    }

    #[test]
    fn full_has_the_hash_that_is_written() {
        let (work, answers) = boxes(700);
        let answer = Answer::Boxes(answers);
        let full = full(&work, &answer).unwrap();
        let written = parse(&write(&work, &answer).unwrap()).unwrap();
        assert!(full.is_whole());
        assert_eq!((full.calls, full.hash), (written.calls, written.hash));
    }
}
