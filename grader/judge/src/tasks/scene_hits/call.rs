//! One call in words and shown.

use crate::tools::call_text::ray_and;
use crate::tools::plural;
use crate::tools::snapshot::Fields;
use crate::tools::truth::{records, scene};
use wire::work::SceneWork;

pub(super) fn input(work: &SceneWork, call: usize) -> Option<String> {
    let nodes = plural(work.tree.nodes.len(), "node", "nodes");
    Some(ray_and(work.rays.get(call)?, &format!("a tree of {nodes}")))
}

/// The right closest hits of some calls, as fields; `None` for any hits.
pub(super) fn exact(work: &SceneWork, enclosed: bool, calls: &[u32]) -> Option<Vec<Fields>> {
    let scene = (!work.any_hit).then(|| scene::load(&work.scene))?;
    Some(records::of_scene(&scene, enclosed, &work.rays, calls))
}
