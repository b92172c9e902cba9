//! What the window reads of the session.

use super::{Heat, Loading, Mode, Saved, Session};
use crate::features::MissingFeatures;
use crate::orbit::Orbit;
use crate::render_control::RenderControl;
use crate::scene_data::SceneData;
use crate::settings::RenderSettings;
use crate::topology::Element;
use crate::tree_walk::TreeWalk;
use std::path::PathBuf;
use std::sync::Arc;

impl Session {
    /// The scene.
    pub fn scene(&self) -> Option<&Arc<SceneData>> {
        self.scene.as_ref()
    }

    /// The scene that is being read.
    pub fn loading(&self) -> Option<&Loading> {
        self.loading.as_ref()
    }

    /// The scenes that were open, the newest first.
    pub fn recent(&self) -> &[PathBuf] {
        &self.recent
    }

    /// The mode.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// The render camera.
    pub fn orbit(&self) -> Option<&Orbit> {
        self.orbit.as_ref()
    }

    /// The settings of renders.
    pub fn settings(&self) -> Option<&RenderSettings> {
        self.settings.as_ref()
    }

    /// The selected element.
    pub fn selection(&self) -> Option<Element> {
        self.selection
    }

    /// The selected node of the tree.
    pub fn walk(&self) -> &TreeWalk {
        &self.walk
    }

    /// The render in progress, or the last one.
    pub fn render(&self) -> Option<&RenderControl> {
        self.render.as_ref()
    }

    /// Whether a drag in the picture selects a cell.
    pub fn cell_mode(&self) -> bool {
        self.cell_mode
    }

    /// Whether the picture shows the number of samples of each pixel.
    pub fn shows_rate(&self) -> bool {
        self.show_rate
    }

    /// The heat map.
    pub fn heat(&self) -> &Heat {
        &self.heat
    }

    /// What does not work because a task is not written yet.
    pub fn missing(&self) -> &MissingFeatures {
        &self.missing
    }

    /// What happened last, as a sentence.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Why the last scene was not loaded, in full.
    pub fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    /// The scenes that come with the course.
    pub fn course_scenes(&self) -> &[PathBuf] {
        &self.course_scenes
    }

    /// Offers these scenes in place of those of the course.
    pub fn set_course_scenes(&mut self, scenes: Vec<PathBuf>) {
        self.course_scenes = scenes;
    }

    /// Says what happened.
    pub fn say(&mut self, message: impl Into<String>) {
        self.message = message.into();
    }

    /// Whether the text in the view is visible.
    pub fn overlay(&self) -> bool {
        self.overlay
    }

    /// Whether the list of keys is visible.
    pub fn help(&self) -> bool {
        self.help
    }

    /// Whether the window is dark.
    pub fn dark(&self) -> bool {
        self.dark
    }

    /// Whether the window asks what to do with the render in progress.
    pub fn asks_to_quit(&self) -> bool {
        self.asks_to_quit
    }

    /// Whether the window is to close.
    pub fn quits(&self) -> bool {
        self.quits
    }

    /// Whether the user wants to choose a file; asked once.
    pub fn take_file_question(&mut self) -> bool {
        std::mem::take(&mut self.asks_for_file)
    }

    /// The files that were written or are to be written, in order.
    pub fn take_saved(&mut self) -> Vec<Saved> {
        std::mem::take(&mut self.saved)
    }
}
