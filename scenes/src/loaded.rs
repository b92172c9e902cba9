//! What is read from a scene file.

use crate::diagnostic::Warning;

/// A scene, and what is to be said about its file.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene. Its camera is that of the file, with the frame of the file: see
    /// [`placement`](crate::placement) for the default view.
    pub scene: kit::Scene,
    /// What was repaired or ignored, in the order of the file's scene.
    pub warnings: Vec<Warning>,
    /// The names of meshes without normals that look rounded: the normals of their triangles are
    /// smoothed over edges of the mesh.
    pub smoothed: Vec<String>,
    /// Whether the file has no light, and a sky and a sun were added.
    pub added_light: bool,
}

/// The number of smoothed meshes that a note names.
const MAX_NAMED: usize = 3;

impl Loaded {
    /// That edges look rounded, and of which meshes; `None` of none.
    pub fn smoothed_note(&self) -> Option<String> {
        let named = self.smoothed.get(..MAX_NAMED).unwrap_or(&self.smoothed);
        let others = match self.smoothed.len() - named.len() {
            0 => String::new(),
            count => format!(" and {count} more"),
        };
        let named = (!named.is_empty()).then(|| named.join(", "))?;
        Some(format!(
            "no normals in the file, so edges look rounded: {named}{others}"
        ))
    }
}
