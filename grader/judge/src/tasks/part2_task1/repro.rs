//! Rust tests of trees.

use crate::tools::repro::numbers::vec3;
use std::fmt::Write;
use wire::work::Xyz;

/// The largest number of boxes in a readable test.
const BOXES: usize = 60;

/// A test that the tree over a few boxes has a valid structure, each primitive once, leaves of at
/// most `max_leaf_size` primitives, and boxes that contain the primitives below. The cost is not
/// tested.
pub(crate) fn over(bounds: &[[Xyz; 2]], max_leaf_size: u32) -> Option<String> {
    if bounds.len() > BOXES {
        return None;
    }
    let mut text = String::from("use kit::{Aabb, Bvh, NodeKind};\nuse kit::Vec3;\n");
    text.push_str("let bounds: Vec<Aabb> = vec![\n");
    for &[min, max] in bounds {
        let _ = writeln!(
            text,
            "    Aabb {{ min: {}, max: {} }},",
            vec3(min),
            vec3(max)
        );
    }
    text.push_str("];\n");
    if bounds.is_empty() {
        text =
            String::from("use kit::{Aabb, Bvh, NodeKind};\nlet bounds: Vec<Aabb> = Vec::new();\n");
    }
    let largest = max_leaf_size.max(1);
    let _ = write!(
        text,
        "
/// The primitives below a node; asserts that its box contains them.
fn below(tree: &Bvh, bounds: &[Aabb], node: u32) -> Vec<u32> {{
    let node = &tree.nodes[node as usize];
    let ids: Vec<u32> = match node.kind {{
        NodeKind::Interior {{ left, right }} => [below(tree, bounds, left), below(tree, bounds, right)].concat(),
        NodeKind::Leaf {{ first, count }} => {{
            assert!((1..={largest}).contains(&count), \"a leaf of {{count}}\");
            tree.leaf(first, count).iter().map(|id| id.0).collect()
        }}
    }};
    for &id in &ids {{
        assert!(node.bounds.contains(&bounds[id as usize]), \"{{:?}} does not contain primitive {{id}}\", node.bounds);
    }}
    ids
}}

let tree = bvh::construct_bvh(&bounds, {max_leaf_size});
let mut ids = if tree.nodes.is_empty() {{ Vec::new() }} else {{ below(&tree, &bounds, 0) }};
ids.sort_unstable();
assert_eq!(ids, (0..bounds.len() as u32).collect::<Vec<u32>>());
assert_eq!(tree.order.len(), bounds.len(), \"order must have each primitive once\");
assert_eq!(bvh::construct_bvh(&bounds, {max_leaf_size}), tree, \"two builds over the same boxes differ\");
"
    );
    Some(text)
}
