//! The picture of Part 2, task 3.

use super::{Eye, Panel, heat, two_panels};
use crate::bvh::kit_tree;
use crate::meshes::{SceneWorld, load};
use crate::stages::OfScenes;
use wire::picture::View;
use wire::work::{SceneSource, Tree};

/// The normals of the closest hits, then the tests of boxes and primitives per ray.
pub(super) fn closest(
    stages: OfScenes<'_>,
    size: [u32; 2],
    scene: &SceneSource,
    tree: &Tree,
    view: &View,
    hottest: u32,
) -> Result<Vec<Panel>, String> {
    let scene = load(scene)?;
    let tree = kit_tree(tree);
    let eye = Eye::new(view);
    Ok(two_panels(size, |x, y| {
        let mut world = SceneWorld::new(stages, &scene);
        let hit = (stages.bvh.intersect_bvh)(&tree, &mut eye.through(x, y), &mut world);
        let tests = world.tests() as f64 / f64::from(hottest);
        let normal = hit.map_or([0.0; 3], |hit| (0.5 * hit.n + 0.5).to_array());
        [normal, heat(tests)]
    }))
}
