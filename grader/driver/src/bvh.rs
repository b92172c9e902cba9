//! Runs Part 2, tasks 1 and 3: builds trees, and traverses them in scripted worlds.

use crate::{convert, stages};
use kit::{Aabb, Bvh, BvhNode, Hit, Interval, NodeKind, PrimId, Ray, Vec2, World};
use std::collections::HashMap;
use wire::answer::{BuildAnswer, TraverseAnswer};
use wire::question::Question;
use wire::work::{BuildWork, ScriptedRay, ScriptedWorld, Tree};

pub(crate) fn build(stage: &stages::Bvh, work: &BuildWork) -> BuildAnswer {
    let max_leaf_size = work.max_leaf_size as usize;
    let bounds: Vec<Aabb> = work.bounds.iter().map(convert::aabb).collect();
    let tree = (stage.construct_bvh)(&bounds, max_leaf_size);
    harness::call(1);
    let again = (stage.construct_bvh)(&bounds, max_leaf_size);
    // The debug text of a tree with NaN equals itself, while the tree does not.
    let repeatable = tree == again || format!("{tree:?}") == format!("{again:?}");
    BuildAnswer {
        tree: wire_tree(&tree),
        repeatable,
    }
}

pub(crate) fn traverse(stage: &stages::Bvh, script: &ScriptedWorld) -> Vec<TraverseAnswer> {
    let tree = kit_tree(&script.tree);
    let node_of = nodes_by_box(&tree);
    harness::each_call(&script.rays, |_, scripted| {
        let mut ray = convert::ray(&scripted.ray);
        let mut world = TraverseScript::new(scripted, &node_of, &tree);
        let hit = if script.any_hit {
            (stage.occludes_bvh)(&tree, &ray, &mut world).then_some((0.0, 0))
        } else {
            (stage.intersect_bvh)(&tree, &mut ray, &mut world).map(|hit| (hit.t, hit.prim.0))
        };
        let Counts {
            box_tests,
            prim_tests,
            prim_hits,
            repeated_prims,
            unknown_boxes,
        } = world.counts;
        TraverseAnswer {
            hit,
            ray_after: convert::wire_ray(&ray),
            box_tests,
            prim_tests,
            prim_hits,
            repeated_prims,
            unknown_boxes,
        }
    })
}

/// The corners of a box, bit for bit.
pub type BoxKey = [u64; 6];

/// The node of each box of a tree: of several with one box the last.
pub fn nodes_by_box(tree: &Bvh) -> HashMap<BoxKey, usize> {
    let nodes = tree.nodes.iter().enumerate();
    nodes.map(|(i, node)| (box_key(&node.bounds), i)).collect()
}

pub(crate) fn box_key(b: &Aabb) -> BoxKey {
    let [x0, y0, z0] = b.min.to_array().map(f64::to_bits);
    let [x1, y1, z1] = b.max.to_array().map(f64::to_bits);
    [x0, y0, z0, x1, y1, z1]
}

#[derive(Default)]
struct Counts {
    box_tests: u32,
    prim_tests: u32,
    prim_hits: u32,
    repeated_prims: u32,
    unknown_boxes: u32,
}

/// A world with given test results, which it clips to the ray's range. It counts the tests. It asks
/// the grader for the results that the case does not have.
pub struct TraverseScript<'a> {
    scripted: &'a ScriptedRay,
    node_of: &'a HashMap<BoxKey, usize>,
    tree: &'a Bvh,
    tested: Vec<bool>,
    counts: Counts,
}

impl<'a> TraverseScript<'a> {
    /// The world of `scripted`; `node_of` has the nodes of its `tree` ([`nodes_by_box`]).
    pub fn new(
        scripted: &'a ScriptedRay,
        node_of: &'a HashMap<BoxKey, usize>,
        tree: &'a Bvh,
    ) -> TraverseScript<'a> {
        TraverseScript {
            tree,
            scripted,
            node_of,
            tested: vec![false; tree.order.len()],
            counts: Counts::default(),
        }
    }

    /// The interval of `ray` in the node whose box is `b`; `None` if it misses it, or if there is
    /// no such node. Counts nothing.
    pub fn interval(&self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        let node = *self.node_of.get(&box_key(b))?;
        let span = match self.scripted.is_hidden {
            true => harness::ask(Question::Box(u32::try_from(node).unwrap_or(u32::MAX))),
            false => self.scripted.spans[node],
        };
        let [enters, leaves] = span?;
        let (min, max) = (enters.max(ray.min_t), leaves.min(ray.max_t));
        (min <= max).then_some(Interval { min, max })
    }

    /// What the traversal was asked for.
    fn asked_for(&self) -> String {
        let count = |n: usize, one: &str| match n {
            1 => format!("1 {one}"),
            _ => format!("{n} {one}s"),
        };
        let nodes = count(self.tree.nodes.len(), "node");
        let prims = count(self.tree.order.len(), "primitive");
        format!("one ray through {nodes} and {prims}")
    }

    /// The hit of a primitive by `function`.
    fn prim_t(&mut self, function: &'static str, id: PrimId, ray: &Ray) -> Option<f64> {
        harness::limit_calls(function, self.counts.prim_tests, || self.asked_for());
        let i = id.0 as usize;
        self.counts.prim_tests += 1;
        if std::mem::replace(&mut self.tested[i], true) {
            self.counts.repeated_prims += 1;
        }
        let t = match self.scripted.is_hidden {
            true => harness::ask(Question::Prim(id.0)).map(|[t, _]| t),
            false => self.scripted.prims[i],
        };
        let t = t.filter(|&t| ray.in_range(t));
        self.counts.prim_hits += u32::from(t.is_some());
        t
    }
}

impl World for TraverseScript<'_> {
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        harness::limit_calls("hit_box", self.counts.box_tests, || self.asked_for());
        self.counts.box_tests += 1;
        if !self.node_of.contains_key(&box_key(b)) {
            self.counts.unknown_boxes += 1;
        }
        self.interval(b, ray)
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        let t = self.prim_t("hit_prim", id, ray)?;
        ray.max_t = t;
        Some(Hit {
            t,
            p: ray.at(t),
            n: -ray.d,
            ng: -ray.d,
            uv: Vec2::ZERO,
            prim: id,
        })
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        self.prim_t("blocked", id, ray).is_some()
    }
}

fn wire_tree(tree: &Bvh) -> Tree {
    let node = |node: &BvhNode| wire::work::Node {
        bounds: convert::wire_aabb(&node.bounds),
        kind: match node.kind {
            NodeKind::Interior { left, right } => wire::work::NodeKind::Interior { left, right },
            NodeKind::Leaf { first, count } => wire::work::NodeKind::Leaf { first, count },
        },
    };
    Tree {
        nodes: tree.nodes.iter().map(node).collect(),
        order: tree.order.iter().map(|id| id.0).collect(),
    }
}

/// A tree of a case.
pub fn kit_tree(tree: &Tree) -> Bvh {
    let node = |node: &wire::work::Node| BvhNode {
        bounds: convert::aabb(&node.bounds),
        kind: match node.kind {
            wire::work::NodeKind::Interior { left, right } => NodeKind::Interior { left, right },
            wire::work::NodeKind::Leaf { first, count } => NodeKind::Leaf { first, count },
        },
    };
    Bvh {
        nodes: tree.nodes.iter().map(node).collect(),
        order: tree.order.iter().copied().map(PrimId).collect(),
    }
}
