//! Writing a snapshot.

use super::light;
use super::line::{Line, Value};
use super::parse::Snapshot;
use wire::answer::{Hit, HitsAnswer, TraverseAnswer};
use wire::work::Ray;
use wire::{Answer, Work};

/// How many lines of a case have the question and the whole record.
pub const FULL_LINES: usize = 48;

/// How many nodes of a tree are written: a change of the recipe shows in the first ones, and in their number.
const TREE_LINES: usize = 512;

/// The text of the snapshot of `answer` to `work`; `None` for what is different every time (times).
pub fn write(work: &Work, answer: &Answer) -> Option<String> {
    let (totals, lines) = content(work, answer)?;
    let mut text = String::new();
    if !totals.is_empty() {
        let fields: Vec<String> = totals
            .iter()
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        text.push_str(&format!("# {}\n", fields.join(" ")));
    }
    let stride = lines.len().div_ceil(FULL_LINES).max(1);
    for (i, (short, full)) in lines.into_iter().enumerate() {
        let line = if i % stride == 0 { full } else { short };
        text.push_str(&format!(
            "{}\n",
            Line {
                call: u32::try_from(i).unwrap_or(u32::MAX),
                ..line
            }
        ));
    }
    Some(text)
}

/// What a snapshot of `answer` to `work` would say if every line had its question and the whole record.
pub fn full(work: &Work, answer: &Answer) -> Option<Snapshot> {
    let (totals, lines) = content(work, answer)?;
    let lines = (0..).zip(lines);
    Some(Snapshot {
        totals: Line {
            answer: totals,
            ..Line::default()
        },
        lines: lines
            .map(|(call, (_, full))| Line { call, ..full })
            .collect(),
    })
}

/// Names and values.
pub type Fields = Vec<(String, Value)>;

/// The short and the full form of a line.
pub(super) type Forms = (Line, Line);

fn content(work: &Work, answer: &Answer) -> Option<(Fields, Vec<Forms>)> {
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
            let nodes = answer.tree.nodes.iter().take(TREE_LINES);
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
