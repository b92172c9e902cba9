//! The box tests of the rays of a picture.

use grader::error::GraderError;
use grader::runner::{self, Worker};
use judge::cases::Spec;
use serde::Serialize;
use std::collections::HashMap;
use wire::work::{BoxWork, Node, NodeKind, Probe, VisitsWork, Xyz};
use wire::{Answer, Case, Outcome, Work};

/// Boxes, and for each pixel which of them were tested.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BoxTests {
    /// All boxes.
    pub boxes: Vec<TestedBox>,
    /// For each call its box tests in order: 2 * (index of the box), plus 1 if the ray hits the
    /// box.
    pub tests: Vec<Vec<u32>>,
}

/// One box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TestedBox {
    /// Its corners: `min`, then `max`.
    pub corners: [Xyz; 2],
    /// The depth of its node; 0 for the root.
    pub depth: u32,
    /// The number of primitives, if it is the box of a leaf.
    pub leaf: Option<u32>,
}

/// The box tests in the calls of `spec`: of the nodes of a BVH, or of single boxes. `None` if the
/// case tests no boxes, or if the worker `together` returns no answer.
pub fn of_case(
    spec: &Spec,
    answer: &Answer,
    together: &Result<Worker, String>,
) -> Result<Option<BoxTests>, GraderError> {
    match (&spec.work, answer, together) {
        (Work::Boxes(BoxWork { boxes, probes }), Answer::Boxes(intervals), _) => {
            Ok(Some(of_probes(boxes, probes, intervals)))
        }
        (Work::SceneHits(traced), _, Ok(together)) => {
            let work = Work::Visits(VisitsWork {
                scene: traced.scene.clone(),
                tree: traced.tree.clone(),
                rays: traced.rays.clone(),
            });
            let case = Case {
                work,
                ..spec.case()
            };
            let run = runner::run(together, &[case])?;
            let outcome = run.endings.first().and_then(|ending| ending.outcome());
            let Some(Outcome::Answered(Answer::Visits(visits))) = outcome else {
                return Ok(None);
            };
            let tests = visits.rays.iter().map(|visits| {
                let visits = visits.iter();
                visits
                    .map(|visit| 2 * visit.node + u32::from(visit.met))
                    .collect()
            });
            Ok(Some(BoxTests {
                boxes: of_tree(&traced.tree.nodes),
                tests: tests.collect(),
            }))
        }
        _ => Ok(None),
    }
}

/// The tests of single boxes. Equal boxes are listed once.
fn of_probes(shapes: &[[Xyz; 2]], probes: &[Probe], intervals: &[Option<[f64; 2]>]) -> BoxTests {
    let mut boxes = Vec::new();
    let mut number_of = HashMap::new();
    let numbers: Vec<u32> = shapes
        .iter()
        .map(|&corners| {
            let next = number_of.len() as u32;
            let key = corners.map(|corner| corner.map(f64::to_bits));
            *number_of.entry(key).or_insert_with(|| {
                boxes.push(without_tree(corners));
                next
            })
        })
        .collect();
    let tests = probes.iter().zip(intervals);
    let tests = tests.map(|(probe, interval)| {
        vec![2 * numbers[probe.shape as usize] + u32::from(interval.is_some())]
    });
    BoxTests {
        tests: tests.collect(),
        boxes,
    }
}

fn without_tree(corners: [Xyz; 2]) -> TestedBox {
    TestedBox {
        corners,
        depth: 0,
        leaf: None,
    }
}

/// The boxes of the nodes with their depths. In a malformed tree (a cycle), nodes may keep depth 0.
fn of_tree(nodes: &[Node]) -> Vec<TestedBox> {
    let mut boxes: Vec<TestedBox> = nodes.iter().map(|node| without_tree(node.bounds)).collect();
    for (i, node) in nodes.iter().enumerate() {
        match node.kind {
            NodeKind::Leaf { count, .. } => boxes[i].leaf = Some(count),
            NodeKind::Interior { left, right } => {
                // In the course's trees, children have larger indices than their parents.
                let depth = boxes[i].depth + 1;
                for child in [left, right].map(|child| child as usize) {
                    if child > i && child < boxes.len() {
                        boxes[child].depth = depth;
                    }
                }
            }
        }
    }
    boxes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_count_from_the_root_and_cycles_end() {
        let node = |kind| Node {
            bounds: [[0.0; 3], [1.0; 3]],
            kind,
        };
        let leaf = |count| node(NodeKind::Leaf { first: 0, count });
        let inner = |left, right| node(NodeKind::Interior { left, right });
        let tree = [inner(1, 4), inner(2, 3), leaf(1), leaf(2), leaf(3)];
        let boxes = of_tree(&tree);
        let depths: Vec<u32> = boxes.iter().map(|b| b.depth).collect();
        assert_eq!(depths, [0, 1, 2, 2, 1]);
        assert_eq!((boxes[0].leaf, boxes[3].leaf), (None, Some(2)));
        assert_eq!(of_tree(&[inner(0, 9)]).len(), 1);
    }
}
