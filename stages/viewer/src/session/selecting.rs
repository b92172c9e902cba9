//! Selecting parts of the scene, with the mouse and with the keyboard.

use super::Session;
use crate::element_walk::{ElementKind, next};
use crate::topology::{Element, ElementInfo};

impl Session {
    /// What is under the pointer.
    pub fn hovered(&self) -> Option<Element> {
        let (scene, topology) = (self.scene.as_ref()?, self.topology()?);
        let hit = self.view.picture(scene)?.hit_at(self.pointer_in_view?)?;
        let triangles = scene.scene().triangles.len() as u32;
        if hit.prim >= triangles {
            return Some(Element::Sphere(hit.prim - triangles));
        }
        let [b1, b2] = hit.uv.map(f64::from);
        Some(topology.element_at(hit.prim, [1.0 - b1 - b2, b1, b2]))
    }

    /// Facts about the selected element.
    pub fn selection_info(&self) -> Option<ElementInfo> {
        let (scene, topology) = (self.scene.as_ref()?, self.topology()?);
        Some(topology.info(scene.scene(), self.selection?))
    }

    pub(super) fn select(&mut self) {
        self.selection = self.hovered();
        match self.selection_info() {
            Some(info) => self.say(format!("Selected {}", info.kind)),
            None => self.say("Nothing is selected"),
        }
    }

    pub(super) fn select_next(&mut self, kind: ElementKind, forward: bool) {
        let (Some(scene), Some(topology)) = (self.scene.as_ref(), self.topology()) else {
            return self.say("Vertices and edges are not found yet");
        };
        let spheres = scene.scene().spheres.len() as u32;
        let selected = next(topology, spheres, kind, self.selection, forward);
        if selected.is_none() {
            return self.say("The scene has none of these");
        }
        self.selection = selected;
        if let Some(info) = self.selection_info() {
            self.say(format!("Selected {}", info.kind));
        }
    }
}
