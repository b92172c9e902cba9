//! One call in words and shown.

use crate::tools::call_text::{holding, range_circumstances, ray_and};
use crate::tools::plural;
use wire::work::ScriptedWorld;

pub(super) fn input(world: &ScriptedWorld, call: usize) -> Option<String> {
    let nodes = plural(world.tree.nodes.len(), "node", "nodes");
    Some(ray_and(
        &world.rays.get(call)?.ray,
        &format!("a tree of {nodes}"),
    ))
}

pub(super) fn circumstances(world: &ScriptedWorld, call: usize) -> Vec<&'static str> {
    let Some(scripted) = world.rays.get(call) else {
        return Vec::new();
    };
    let function = [
        (world.any_hit, "any hit is looked for"),
        (!world.any_hit, "the closest hit is looked for"),
    ];
    [holding(&function), range_circumstances(&scripted.ray)].concat()
}
