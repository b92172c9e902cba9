//! Rust tests of traversals of small trees.

use crate::tools::repro::numbers::{float, ray, unchanged, vec3};
use std::fmt::Write;
use wire::work::{NodeKind, ScriptedRay, ScriptedWorld, Tree};

/// The largest number of nodes in a readable test.
const NODES: usize = 40;

/// A world with given test results, the same as the grader's.
const WORLD: &str = "\
/// For each node the interval in which the line of the ray is inside its box; for each primitive
/// the t of its hit.
struct ScriptedWorldTest {
    boxes: Vec<Aabb>,
    spans: Vec<Option<[f64; 2]>>,
    prims: Vec<Option<f64>>,
}

impl World for ScriptedWorldTest {
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        let node = self.boxes.iter().rposition(|bounds| bounds == b).expect(\"the bounds of a node\");
        let [min, max] = self.spans[node]?;
        let (min, max) = (min.max(ray.min_t), max.min(ray.max_t));
        (min <= max).then_some(Interval { min, max })
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        let t = self.prims[id.0 as usize].filter(|&t| ray.in_range(t))?;
        ray.max_t = t;
        Some(Hit { t, p: ray.at(t), n: -ray.d, ng: -ray.d, uv: Vec2::ZERO, prim: id })
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        self.prims[id.0 as usize].is_some_and(|t| ray.in_range(t))
    }
}
";

/// A test of the closest hit or of any hit of one ray. The number of tests is not checked.
pub(crate) fn traversal(world: &ScriptedWorld, call: usize) -> Option<String> {
    let scripted = world.rays.get(call)?;
    if world.tree.nodes.len() > NODES {
        return None;
    }
    let nodes = match world.tree.nodes.is_empty() {
        true => "",
        false => "BvhNode, NodeKind, ",
    };
    let mut text = format!(
        "use kit::{{Aabb, Bvh, Hit, Interval, {nodes}PrimId, Ray, Vec2, Vec3, World}};\n\n"
    );
    text.push_str(WORLD);
    text.push('\n');
    tree(&mut text, &world.tree);
    let _ = writeln!(
        text,
        "let mut world = ScriptedWorldTest {{\n    boxes: tree.nodes.iter().map(|node| node.bounds).collect(),\n    \
         spans: {},\n    prims: {},\n}};",
        list(&scripted.spans, |[min, max]| format!(
            "[{}, {}]",
            float(*min),
            float(*max)
        )),
        list(&scripted.prims, |t| float(*t)),
    );
    ray(&mut text, &scripted.ray);
    let met = closest(scripted);
    if world.any_hit {
        let _ = writeln!(
            text,
            "assert_eq!(bvh::occludes_bvh(&tree, &ray, &mut world), {});",
            !met.is_empty()
        );
        return Some(text);
    }
    text.push_str("let mut shortened = ray;\nlet hit = bvh::intersect_bvh(&tree, &mut shortened, &mut world);\n");
    let Some((_, t)) = met.first() else {
        text.push_str("assert_eq!(hit, None);\n");
        text.push_str(&unchanged("shortened", &scripted.ray));
        return Some(text);
    };
    let ids: Vec<String> = met.iter().map(|(id, _)| id.to_string()).collect();
    let _ = write!(
        text,
        "let hit = hit.expect(\"it hits\");
assert_eq!(hit.t, {t});
assert!([{}].contains(&hit.prim.0), \"{{:?}}\", hit.prim);
assert_eq!(shortened, Ray {{ max_t: {t}, ..ray }});
",
        ids.join(", "),
        t = float(*t),
    );
    Some(text)
}

/// The primitives that are hit first in the ray's range, all at the same `t`.
fn closest(scripted: &ScriptedRay) -> Vec<(usize, f64)> {
    let range = scripted.ray.min_t..=scripted.ray.max_t;
    let met: Vec<(usize, f64)> = scripted
        .prims
        .iter()
        .enumerate()
        .filter_map(|(id, t)| Some((id, (*t)?)))
        .filter(|(_, t)| range.contains(t))
        .collect();
    let first = met.iter().map(|(_, t)| *t).fold(f64::INFINITY, f64::min);
    met.into_iter().filter(|(_, t)| *t == first).collect()
}

/// Adds the lines that define `tree`.
fn tree(text: &mut String, tree: &Tree) {
    if tree.nodes.is_empty() {
        text.push_str("let tree = Bvh::default();\n");
        return;
    }
    text.push_str("let node = |min, max, kind| BvhNode { bounds: Aabb { min, max }, kind };\n");
    text.push_str("let tree = Bvh {\n    nodes: vec![\n");
    for node in &tree.nodes {
        let [min, max] = node.bounds.map(vec3);
        let kind = match node.kind {
            NodeKind::Interior { left, right } => {
                format!("NodeKind::Interior {{ left: {left}, right: {right} }}")
            }
            NodeKind::Leaf { first, count } => {
                format!("NodeKind::Leaf {{ first: {first}, count: {count} }}")
            }
        };
        let _ = writeln!(text, "        node({min}, {max}, {kind}),");
    }
    let order: Vec<String> = tree.order.iter().map(ToString::to_string).collect();
    let _ = writeln!(
        text,
        "    ],\n    order: [{}].map(PrimId).to_vec(),\n}};",
        order.join(", ")
    );
}

/// A vector of options.
fn list<T>(entries: &[Option<T>], show: impl Fn(&T) -> String) -> String {
    let entries = entries.iter().map(|entry| match entry {
        Some(entry) => format!("Some({})", show(entry)),
        None => "None".into(),
    });
    let entries: Vec<String> = entries.collect();
    format!("vec![{}]", entries.join(", "))
}
