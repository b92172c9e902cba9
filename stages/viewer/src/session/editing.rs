//! Moving parts of the scene.

use super::Session;
use super::progress::LoadProgress;
use crate::project::Projection;
use crate::scene_data::SceneData;
use crate::task::{Task, guarded};
use crate::topology::{Element, Topology, move_vertex};
use kit::{Scene, Vec2, Vec3};
use std::sync::Arc;
use std::time::Duration;

/// The vertex that is being moved, and the moves so far.
#[derive(Default)]
pub(super) struct Edit {
    /// The vertex and its newest position, which the scene does not show yet.
    wanted: Option<(u32, Vec3)>,
    rebuilding: Option<Task<SceneData>>,
    /// Whether the mouse is moving the vertex.
    is_moving: bool,
    /// Each vertex that was moved, and where it was before.
    undo: Vec<(u32, Vec3)>,
    /// Each vertex that was moved back, and where it was before that.
    redo: Vec<(u32, Vec3)>,
}

/// The topology of a scene, or the search for it.
pub(super) struct FoundTopology {
    of: Arc<SceneData>,
    topology: Option<Topology>,
    task: Option<Task<Topology>>,
}

impl Edit {
    /// The mouse has let go of the vertex.
    pub(super) fn end_move(&mut self) {
        self.is_moving = false;
    }

    pub(super) fn is_rebuilding(&self) -> bool {
        self.rebuilding.is_some() || self.wanted.is_some()
    }
}

impl Session {
    /// The vertices and edges of the scene, once they are found.
    pub fn topology(&self) -> Option<&Topology> {
        let found = self.topology.as_ref()?;
        let scene = self.scene.as_ref()?;
        found
            .topology
            .as_ref()
            .filter(|_| Arc::ptr_eq(scene, &found.of))
    }

    /// Where the selected vertex is, or will be as soon as the tree is rebuilt.
    pub fn selected_vertex_position(&self) -> Option<Vec3> {
        let Some(Element::Vertex(v)) = self.selection else {
            return None;
        };
        match self.edit.wanted {
            Some((wanted, position)) if wanted == v => Some(position),
            _ => self.topology().map(|topology| topology.position(v)),
        }
    }

    /// Moves the selected vertex in the plane of the film by fractions of the view.
    pub(super) fn move_vertex(&mut self, by: Vec2) {
        let (Some(position), Some(Element::Vertex(v)), Some(orbit)) =
            (self.selected_vertex_position(), self.selection, self.orbit)
        else {
            return;
        };
        let scene = self.scene.as_ref().expect("a vertex is selected");
        let camera = match self.view.picture(scene) {
            Some(picture) => picture.request.camera,
            None => orbit.camera(),
        };
        let shift = match guarded(|| Projection::new(&camera).shift_at(position, by)) {
            Ok(shift) => shift,
            Err(failure) => return self.say(failure.to_string()),
        };
        if !self.edit.is_moving {
            self.edit.is_moving = true;
            self.edit.undo.push((v, position));
            self.edit.redo.clear();
        }
        self.edit.wanted = Some((v, position + shift));
    }

    pub(super) fn undo_move(&mut self) {
        match self.edit.undo.pop() {
            Some(before) => {
                let now = self.moved_to(before);
                self.edit.redo.extend(now);
            }
            None => self.say("Nothing was moved"),
        }
    }

    pub(super) fn redo_move(&mut self) {
        match self.edit.redo.pop() {
            Some(after) => {
                let before = self.moved_to(after);
                self.edit.undo.extend(before);
            }
            None => self.say("Nothing was moved back"),
        }
    }

    /// Moves a vertex to a position. Returns where it was.
    fn moved_to(&mut self, (v, position): (u32, Vec3)) -> Option<(u32, Vec3)> {
        let before = match self.edit.wanted {
            Some((wanted, position)) if wanted == v => Some(position),
            _ => self.topology().map(|topology| topology.position(v)),
        };
        self.edit.wanted = Some((v, position));
        before.map(|before| (v, before))
    }

    /// Finds the topology, and rebuilds the trees around the moved vertex.
    pub(super) fn update_editing(&mut self, wait: Duration) {
        self.update_topology(wait);
        if self.edit.rebuilding.is_none() {
            self.start_rebuild();
        }
        let Some(rebuilt) = self
            .edit
            .rebuilding
            .as_ref()
            .and_then(|task| task.wait(wait))
        else {
            return;
        };
        self.edit.rebuilding = None;
        match rebuilt {
            Ok(data) => {
                self.scene = Some(Arc::new(data));
                self.render = None;
                self.inspector.close();
                self.update_topology(wait);
            }
            Err(failure) => self.say(format!("The tree was not rebuilt: {failure}")),
        }
    }

    fn start_rebuild(&mut self) {
        let (Some((v, position)), Some(scene), Some(topology)) =
            (self.edit.wanted, &self.scene, self.topology())
        else {
            return;
        };
        // Triangles of area lights are not those of the file: their lights would not follow.
        let of_file = scene.file_scene.triangles.len() as u32;
        if topology.corners_at(v).iter().any(|c| c.triangle >= of_file) {
            self.edit.wanted = None;
            self.say("The corner of an area light cannot be moved");
            return;
        }
        let mut moved = Scene::clone(&scene.file_scene);
        move_vertex(&mut moved, topology, v, position);
        let source = Arc::clone(&scene.source);
        self.edit.wanted = None;
        self.edit.rebuilding = Some(Task::spawn(Arc::clone(&self.wake), move |_| {
            SceneData::build(source, Arc::new(moved), &LoadProgress::default())
        }));
    }

    fn update_topology(&mut self, wait: Duration) {
        let Some(scene) = &self.scene else { return };
        let is_current = |found: &FoundTopology| Arc::ptr_eq(&found.of, scene);
        if !self.topology.as_ref().is_some_and(is_current) {
            let data = Arc::clone(scene);
            let task = Task::spawn(Arc::clone(&self.wake), move |_| Topology::new(data.scene()));
            self.topology = Some(FoundTopology {
                of: Arc::clone(scene),
                topology: None,
                task: Some(task),
            });
        }
        let Some(found) = &mut self.topology else {
            return;
        };
        if let Some(Ok(topology)) = found.task.as_ref().and_then(|task| task.wait(wait)) {
            found.topology = Some(topology);
            found.task = None;
        }
    }
}
