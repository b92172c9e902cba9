//! The box tests of some rays of a picture.

use super::box_walk::{self, Step};
use base::GraderError;
use grader::workers::runner::{self, Worker};
use judge::cases::Spec;
use judge::convert;
use kit::Aabb;
use wire::work::{BoxWork, Node, NodeKind, Ray, VisitsWork, Xyz};
use wire::{Answer, Case, Outcome, Work};

/// Boxes, and for some calls which of them are tested.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoxTests {
    /// All boxes.
    pub boxes: Vec<TestedBox>,
    /// The box tests of each of the calls.
    pub walks: Vec<Vec<Step>>,
}

/// One box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestedBox {
    /// Its corners: `min`, then `max`.
    pub corners: [Xyz; 2],
    /// The depth of its node; 0 for the root.
    pub depth: u32,
    /// The number of primitives, if it is the box of a leaf.
    pub leaf: Option<u32>,
}

/// The box tests in some `calls` of `spec`: of the nodes of a BVH, or of single boxes. `hits` has
/// the `t` of the right hit of each call, if it is one. `None` if the case tests no boxes, or if the
/// worker `together` returns no answer.
pub fn of_case(
    spec: &Spec,
    answer: &Answer,
    together: &Result<Worker, String>,
    calls: &[u32],
    hits: &[Option<f64>],
) -> Result<Option<BoxTests>, GraderError> {
    match (&spec.work, answer, together) {
        (Work::Boxes(work), Answer::Boxes(intervals), _) => {
            Ok(Some(of_probes(work, intervals, calls)))
        }
        (Work::SceneHits(traced), _, Ok(together)) => {
            let rays: Vec<Ray> = calls
                .iter()
                .map(|&call| traced.rays[call as usize])
                .collect();
            let work = Work::Visits(VisitsWork {
                scene: traced.scene.clone(),
                tree: traced.tree.clone(),
                rays: rays.clone(),
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
            let walks = visits
                .rays
                .iter()
                .zip(&rays)
                .zip(hits)
                .map(|((visits, ray), hit)| {
                    let visits = visits.iter().map(|visit| (visit.node, visit.met));
                    let actual: Vec<(u32, bool)> = visits.collect();
                    let ray = convert::ray(ray);
                    let needed = box_walk::needed(&traced.tree, &ray, hit.unwrap_or(ray.max_t));
                    box_walk::beside(&needed, &actual)
                });
            Ok(Some(BoxTests {
                walks: walks.collect(),
                boxes: of_tree(&traced.tree.nodes),
            }))
        }
        _ => Ok(None),
    }
}

/// The tests of single boxes: one in each call.
fn of_probes(work: &BoxWork, intervals: &[Option<[f64; 2]>], calls: &[u32]) -> BoxTests {
    let mut tests = BoxTests::default();
    for (number, &call) in (0..).zip(calls) {
        let probe = &work.probes[call as usize];
        let corners = work.boxes[probe.shape as usize];
        let [min, max] = corners.map(Into::into);
        let verdict = oracle::bbox(&Aabb { min, max }, &convert::ray(&probe.ray));
        tests.boxes.push(without_tree(corners));
        tests.walks.push(vec![Step {
            number,
            needed: Some(verdict.hits()),
            actual: Some(intervals[call as usize].is_some()),
        }]);
    }
    tests
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
