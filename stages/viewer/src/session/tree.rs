//! The walk through the tree, and the statistics of its nodes.

use super::Session;
use crate::scene_data::SceneData;
use crate::tree_walk::{NodeStatistics, TreeWalk};
use kit::Aabb;
use std::sync::Arc;

impl Session {
    /// Walks through the visible tree: that of the scene, or of a case.
    pub(super) fn with_tree(&mut self, change: impl FnOnce(&mut TreeWalk, &kit::Bvh)) {
        if let Some(opened) = self.walked_case() {
            opened.with_tree(change);
        } else if let Some(tree) = self.scene.as_ref().and_then(|scene| scene.bvh()) {
            change(&mut self.walk, tree);
        }
    }

    /// Whether BVH mode shows the boxes of the wide tree instead of those of the binary one.
    pub fn shows_wide_tree(&self) -> bool {
        self.shows_wide && !self.wide_boxes().is_empty()
    }

    /// Shows the boxes of the wide tree, or those of the binary one.
    pub(super) fn toggle_wide_tree(&mut self) {
        self.shows_wide = !self.shows_wide;
        if self.shows_wide && self.wide_boxes().is_empty() {
            self.say("Pictures of this scene use no wide tree, or one without nodes");
        }
    }

    /// The boxes of the wide tree and their depths; none if pictures do not use it.
    pub fn wide_boxes(&self) -> &[(Aabb, usize)] {
        self.scene.as_ref().map_or(&[], |scene| &scene.wide_boxes)
    }

    /// The statistics of the selected node. They are computed once for each node.
    pub fn node_statistics(&mut self) -> Option<NodeStatistics> {
        self.statistics_of(self.walk.node())
    }

    /// The statistics of the whole tree.
    pub fn root_statistics(&mut self) -> Option<NodeStatistics> {
        self.statistics_of(0)
    }

    fn statistics_of(&mut self, node: u32) -> Option<NodeStatistics> {
        let scene = self.scene.as_ref()?;
        let is_known = |(of, known): &&(Arc<SceneData>, NodeStatistics)| {
            Arc::ptr_eq(of, scene) && known.node == node
        };
        if let Some((_, known)) = self.statistics.iter().find(is_known) {
            return Some(known.clone());
        }
        let statistics = NodeStatistics::of(scene.bvh()?, node)?;
        // Those of the root and of the selected node.
        self.statistics
            .retain(|(of, known)| Arc::ptr_eq(of, scene) && known.node == 0);
        self.statistics
            .push((Arc::clone(scene), statistics.clone()));
        Some(statistics)
    }
}
