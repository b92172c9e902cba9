//! Records which boxes a traversal tests, for rays through a whole scene.

use crate::bvh::{BoxKey, box_key, kit_tree};
use crate::convert;
use crate::meshes::{SceneWorld, load};
use crate::stages::OfScenes;
use kit::{Aabb, Hit, Interval, PrimId, Ray, World};
use std::collections::HashMap;
use wire::answer::{Visit, VisitsAnswer};
use wire::work::VisitsWork;

/// Traces the rays through the scene by its tree and records the boxes that each tests.
pub(crate) fn visits(stages: OfScenes<'_>, work: &VisitsWork) -> Result<VisitsAnswer, String> {
    let scene = load(&work.scene)?;
    let tree = kit_tree(&work.tree);
    let mut nodes_of: HashMap<BoxKey, Vec<u32>> = HashMap::new();
    for (node, number) in tree.nodes.iter().zip(0..) {
        let nodes = nodes_of.entry(box_key(&node.bounds)).or_default();
        nodes.push(number);
    }
    let each = work.rays.iter().enumerate();
    let rays = each.map(|(i, ray)| {
        harness::call(i);
        let mut world = RecordingWorld {
            world: SceneWorld::new(stages, &scene),
            nodes_of: &nodes_of,
            visits: Vec::new(),
        };
        (stages.bvh.intersect_bvh)(&tree, &mut convert::ray(ray), &mut world);
        world.visits
    });
    Ok(VisitsAnswer {
        rays: rays.collect(),
    })
}

/// A scene that records the box tests.
struct RecordingWorld<'a> {
    world: SceneWorld<'a>,
    nodes_of: &'a HashMap<BoxKey, Vec<u32>>,
    visits: Vec<Visit>,
}

impl RecordingWorld<'_> {
    /// The node that has this box; of several, the first that was not tested yet.
    fn node(&self, b: &Aabb) -> Option<u32> {
        let nodes = self.nodes_of.get(&box_key(b))?;
        let is_new = |node: &&u32| !self.visits.iter().any(|visit| visit.node == **node);
        nodes.iter().find(is_new).or(nodes.first()).copied()
    }
}

impl World for RecordingWorld<'_> {
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        harness::limit_calls("hit_box", self.visits.len(), || {
            "one ray through the scene".into()
        });
        let interval = self.world.hit_box(b, ray);
        if let Some(node) = self.node(b) {
            let met = interval.is_some();
            self.visits.push(Visit { node, met });
        }
        interval
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        self.world.hit_prim(id, ray)
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        self.world.blocked(id, ray)
    }
}
