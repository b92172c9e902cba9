//! A ray through a given tree: what the stage's traversal tested, and where it leaves the truth.

use super::child_order::{ChildOrder, child_orders};
use crate::truth::{Parting, check_ray};
use driver::bvh::{TraverseScript, kit_tree, nodes_by_box};
use judge::convert;
use judge::scene;
use kit::{Aabb, Bvh, NodeKind, PrimId, Ray, Scene};
use pathtracer::replay::{Outcome, RayRecord, Test, Visit, record_ray};
use pathtracer::{RayRole, SceneWorld};
use wire::work::{SceneSource, ScriptedRay, ScriptedWorld, Tree};

/// A traversal, recorded.
#[derive(Clone, Debug)]
pub struct VisitCase {
    /// The scene; empty where the results of all tests are given.
    pub scene: Scene,
    /// The tree.
    pub tree: Bvh,
    /// The ray and its tests.
    pub record: RayRecord,
    /// What it hits exactly; for a shadow ray the nearest that blocks it.
    pub right: Option<(PrimId, f64)>,
    /// The first event that is wrong.
    pub parting: Option<Parting>,
    /// The nodes of which the ray enters both children. Empty for a shadow ray, for which any order
    /// is as good.
    pub orders: Vec<ChildOrder>,
}

impl VisitCase {
    /// The first node whose farther child was visited before the nearer one.
    pub fn wrong_order(&self) -> Option<&ChildOrder> {
        self.orders.iter().find(|order| !order.is_nearer_first())
    }

    /// The index of the first test that differs from a right traversal's, nearer children first.
    pub fn first_difference(&self) -> Option<usize> {
        let wrong = self.parting.as_ref().and_then(|parting| parting.test);
        let order = self
            .wrong_order()
            .and_then(|order| order.visited[0].first_test);
        wrong.into_iter().chain(order).min()
    }

    /// The box around the first difference; `None` if there is none.
    pub fn place_of_difference(&self) -> Option<Aabb> {
        let bounds = |node: u32| self.tree.nodes.get(node as usize).map(|node| node.bounds);
        let order = self.wrong_order().and_then(|order| bounds(order.node));
        let test = self.parting.as_ref().and_then(|parting| parting.test);
        let test = test.and_then(|test| match self.record.tests.get(test)? {
            Test::Box { bounds, .. } => Some(*bounds),
            Test::Primitive { prim, .. } => {
                let index = prim.0 as usize;
                (index < self.scene.len()).then(|| self.scene.primitive(*prim).bounds())
            }
        });
        test.or(order)
    }

    /// Traces ray `call` of a case whose scene is traced with all stages.
    pub fn in_scene(
        source: &SceneSource,
        tree: &Tree,
        ray: &wire::work::Ray,
        any_hit: bool,
    ) -> VisitCase {
        let scene = scene::load(source);
        let tree = kit_tree(tree);
        let ray = convert::ray(ray);
        let world = SceneWorld::new(&scene, None);
        let record = record_ray(&tree, &ray, any_hit, world, &bbox::intersect_bbox);
        let primitives: Vec<kit::Primitive<'_>> = scene.primitives().collect();
        let truth = check_ray(&primitives, &record);
        VisitCase {
            orders: orders(&tree, &record),
            tree,
            record,
            right: truth.right,
            parting: truth.parting,
            scene,
        }
    }

    /// Traverses the tree of `world` with one of its rays.
    pub fn in_script(world: &ScriptedWorld, scripted: &ScriptedRay) -> VisitCase {
        let tree = kit_tree(&world.tree);
        let node_of = nodes_by_box(&tree);
        let ray = convert::ray(&scripted.ray);
        // Another script: tests that only show what is behind a hit do not count.
        let uncounted = TraverseScript::new(scripted, &node_of, &tree);
        let record = record_ray(
            &tree,
            &ray,
            world.any_hit,
            TraverseScript::new(scripted, &node_of, &tree),
            &|b, ray| uncounted.interval(b, ray),
        );
        let right = right_hit(scripted, &ray);
        let parting = parting(&tree, &record, right);
        VisitCase {
            orders: orders(&tree, &record),
            scene: Scene::default(),
            tree,
            record,
            right,
            parting,
        }
    }
}

/// The orders that matter: those of a ray that looks for its closest hit.
fn orders(tree: &Bvh, record: &RayRecord) -> Vec<ChildOrder> {
    match record.role {
        RayRole::Shadow => Vec::new(),
        _ => child_orders(tree, record),
    }
}

/// The nearest primitive in the range of the ray.
fn right_hit(scripted: &ScriptedRay, ray: &Ray) -> Option<(PrimId, f64)> {
    let hits = (0..).map(PrimId).zip(&scripted.prims);
    hits.filter_map(|(id, t)| Some((id, t.filter(|&t| ray.in_range(t))?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The first event that is wrong in a world whose tests are all right.
fn parting(tree: &Bvh, record: &RayRecord, right: Option<(PrimId, f64)>) -> Option<Parting> {
    let repeated = record.tests.iter().enumerate().find_map(|(i, test)| {
        let Test::Primitive { prim, .. } = test else {
            return None;
        };
        let is_same = |other: &Test| matches!(other, Test::Primitive { prim: p, .. } if p == prim);
        let before = record.tests[..i].iter().any(is_same);
        before.then(|| Parting {
            test: Some(i),
            sentence: format!("primitive {} is tested a second time", prim.0),
        })
    });
    let answer = match record.outcome {
        Outcome::Hit(hit) => Some(format!("primitive {} at t = {:?}", hit.prim.0, hit.t)),
        Outcome::Blocked => Some("blocked".to_owned()),
        Outcome::Miss | Outcome::Unblocked => None,
    };
    let is_right = match (record.outcome, right) {
        (Outcome::Hit(hit), Some((_, t))) => hit.t == t,
        (Outcome::Blocked, right) => right.is_some(),
        (Outcome::Miss | Outcome::Unblocked, right) => right.is_none(),
        (Outcome::Hit(_), None) => false,
    };
    if is_right {
        return repeated;
    }
    let answer = answer.unwrap_or_else(|| "a miss".to_owned());
    let Some((prim, t)) = right else {
        return Some(Parting {
            test: None,
            sentence: format!("the result is {answer}; exactly, the ray hits nothing"),
        });
    };
    let exactly = format!(
        "the result is {answer}; exactly, primitive {} is hit at t = {t:?}",
        prim.0
    );
    let (test, what) =
        left_out(tree, record, prim).unwrap_or((None, "every test is right".to_owned()));
    Some(Parting {
        test,
        sentence: format!("{what}: {exactly}"),
    })
}

/// Where the way from the root to a primitive ends: the last test on it, and a sentence; `None` if the
/// primitive was tested.
fn left_out(tree: &Bvh, record: &RayRecord, prim: PrimId) -> Option<(Option<usize>, String)> {
    let test_of = |test: &dyn Fn(&Test) -> bool| record.tests.iter().position(test);
    let is_prim = |test: &Test| matches!(test, Test::Primitive { prim: p, .. } if *p == prim);
    if test_of(&is_prim).is_some() {
        return None;
    }
    let mut last = None;
    for node in way_to(tree, prim) {
        let is_node = |test: &Test| matches!(test, Test::Box { node: Some(n), .. } if *n == node);
        let Some(at) = test_of(&is_node) else {
            return Some((last, format!("the box of node {node} is never tested")));
        };
        last = Some(at);
        if let Test::Box {
            visit: Visit::Pruned { .. } | Visit::Behind { .. },
            ..
        } = record.tests[at]
        {
            return Some((last, format!("what is in node {node} is never tested")));
        }
    }
    Some((last, format!("primitive {} is never tested", prim.0)))
}

/// The nodes from the root to the leaf that holds a primitive.
fn way_to(tree: &Bvh, prim: PrimId) -> Vec<u32> {
    let mut parent_of = vec![None; tree.nodes.len()];
    let mut at = None;
    for (i, node) in (0..).zip(&tree.nodes) {
        match node.kind {
            NodeKind::Interior { left, right } => {
                for child in [left, right] {
                    parent_of[child as usize] = Some(i);
                }
            }
            NodeKind::Leaf { first, count } => {
                if tree.leaf(first, count).contains(&prim) {
                    at = Some(i);
                }
            }
        }
    }
    let mut way: Vec<u32> = std::iter::successors(at, |&node| parent_of[node as usize]).collect();
    way.reverse();
    way
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::Hit;
    use wire::Work;

    fn script() -> ScriptedWorld {
        let mut specs = judge::cases::of("part2.task3", 0).into_iter();
        match specs
            .find(|spec| spec.name == "both_children")
            .map(|spec| spec.work)
        {
            Some(Work::Traverse(world)) => world,
            other => panic!("a traversal: {other:?}"),
        }
    }

    /// A traversal as the reference's would be, changed by `change`.
    fn changed(change: impl Fn(&mut RayRecord)) -> Option<Parting> {
        let world = script();
        let (tree, ray) = (kit_tree(&world.tree), convert::ray(&world.rays[0].ray));
        let node_of = nodes_by_box(&tree);
        let hit = right_hit(&world.rays[0], &ray);
        let script = TraverseScript::new(&world.rays[0], &node_of, &tree);
        let tests = way_to(&tree, hit?.0).into_iter().map(|node| Test::Box {
            node: Some(node),
            bounds: tree.nodes[node as usize].bounds,
            max_t: ray.max_t,
            visit: match script.interval(&tree.nodes[node as usize].bounds, &ray) {
                Some(inside) => Visit::Entered {
                    entry: inside.min,
                    exit: inside.max,
                },
                None => Visit::Missed,
            },
        });
        let (prim, t) = hit?;
        let tested = Test::Primitive {
            prim,
            max_t: ray.max_t,
            answer: pathtracer::replay::PrimAnswer::Hit(t),
        };
        let mut record = RayRecord {
            role: pathtracer::RayRole::Camera,
            depth: 0,
            parent: None,
            ray,
            skip: None,
            outcome: Outcome::Hit(Hit {
                t,
                p: ray.at(t),
                n: -ray.d,
                ng: -ray.d,
                uv: kit::Vec2::ZERO,
                prim,
            }),
            tests: tests.chain([tested]).collect(),
        };
        change(&mut record);
        parting(&tree, &record, hit)
    }

    #[test]
    fn a_right_traversal_parts_nowhere() {
        assert_eq!(changed(|_| ()), None);
    }

    #[test]
    fn the_first_box_that_is_left_out_is_named() {
        let parting = changed(|record| {
            record.tests.truncate(1);
            record.outcome = Outcome::Miss;
        });
        let parting = parting.expect("it misses");
        assert_eq!(parting.test, Some(0));
        assert!(
            parting.sentence.contains("never tested"),
            "{}",
            parting.sentence
        );
    }

    #[test]
    fn a_repeated_test_and_a_wrong_result_are_named() {
        let parting = changed(|record| record.tests.extend(record.tests.last().cloned()));
        assert!(parting.expect("twice").sentence.contains("second time"));
        let parting = changed(|record| record.outcome = Outcome::Miss).expect("it misses");
        assert!(
            parting.sentence.starts_with("every test is right"),
            "{}",
            parting.sentence
        );
    }
}
