//! The boxes that the rays of a picture ask for.

use grader::error::GraderError;
use grader::runner::{self, Worker};
use judge::cases::Spec;
use serde::Serialize;
use std::collections::HashMap;
use wire::work::{BoxWork, Node, NodeKind, Probe, VisitsWork, Xyz};
use wire::{Answer, Case, Outcome, Work};

/// Boxes, and for each pixel which of them were asked for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Boxes {
    /// All boxes.
    pub boxes: Vec<Boxed>,
    /// For each call what it asked for, in order: twice the box's index, and 1 more if the ray meets it.
    pub asked: Vec<Vec<u32>>,
}

/// One box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Boxed {
    /// Its corners: `min`, then `max`.
    pub corners: [Xyz; 2],
    /// Levels below the root of its tree.
    pub depth: u32,
    /// Primitives in it, if it is a leaf's.
    pub leaf: Option<u32>,
}

/// The boxes that the calls of `spec` ask for: of a tree those of its nodes, of a single box the box itself. `None`
/// for what asks for none, or where `together` does not come back with an answer.
pub fn asked_for(
    spec: &Spec,
    answer: &Answer,
    together: &Result<Worker, String>,
) -> Result<Option<Boxes>, GraderError> {
    match (&spec.work, answer, together) {
        (Work::Boxes(BoxWork { boxes, probes }), Answer::Boxes(met), _) => {
            Ok(Some(of_probes(boxes, probes, met)))
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
            let asked = visits.rays.iter().map(|visits| {
                let visits = visits.iter();
                visits
                    .map(|visit| 2 * visit.node + u32::from(visit.met))
                    .collect()
            });
            Ok(Some(Boxes {
                boxes: of_tree(&traced.tree.nodes),
                asked: asked.collect(),
            }))
        }
        _ => Ok(None),
    }
}

/// Single boxes, each with its rays. Boxes that are equal count once.
fn of_probes(shapes: &[[Xyz; 2]], probes: &[Probe], met: &[Option<[f64; 2]>]) -> Boxes {
    let mut boxes = Vec::new();
    let mut number_of = HashMap::new();
    let numbers: Vec<u32> = shapes
        .iter()
        .map(|&corners| {
            let next = number_of.len() as u32;
            let key = corners.map(|corner| corner.map(f64::to_bits));
            *number_of.entry(key).or_insert_with(|| {
                boxes.push(alone(corners));
                next
            })
        })
        .collect();
    let asked = probes.iter().zip(met);
    let asked = asked
        .map(|(probe, met)| vec![2 * numbers[probe.shape as usize] + u32::from(met.is_some())]);
    Boxes {
        asked: asked.collect(),
        boxes,
    }
}

fn alone(corners: [Xyz; 2]) -> Boxed {
    Boxed {
        corners,
        depth: 0,
        leaf: None,
    }
}

/// The nodes' boxes with their depths. A tree that is none (a node below itself) keeps depths of 0.
fn of_tree(nodes: &[Node]) -> Vec<Boxed> {
    let mut boxes: Vec<Boxed> = nodes.iter().map(|node| alone(node.bounds)).collect();
    for (i, node) in nodes.iter().enumerate() {
        match node.kind {
            NodeKind::Leaf { count, .. } => boxes[i].leaf = Some(count),
            NodeKind::Interior { left, right } => {
                // The course's trees number children after their parents.
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
    fn depths_count_from_the_root_and_a_loop_ends() {
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
