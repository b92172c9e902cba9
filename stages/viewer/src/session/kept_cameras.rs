//! Cameras that are kept to return to them, and those of files.

use super::{Mode, Session};
use crate::remembered::{KeptCamera, Remembered};
use scenes::CameraFile;
use std::path::Path;

impl Session {
    /// The kept cameras of the open scene, in order, with their places among all.
    pub fn kept_cameras(&self) -> impl Iterator<Item = (usize, &KeptCamera)> {
        let path = self.scene.as_ref().map(|scene| &scene.source.path);
        let all = self.kept_cameras.iter().enumerate();
        all.filter(move |(_, kept)| Some(&kept.scene) == path)
    }

    /// Keeps the render camera.
    pub(super) fn keep_camera(&mut self) {
        let (Some(orbit), Some(settings), Some(scene)) = (self.orbit, self.settings, &self.scene)
        else {
            return self.say("There is no camera: open a scene first");
        };
        self.kept_cameras.push(KeptCamera {
            scene: scene.source.path.clone(),
            file: CameraFile::new(orbit.view(), settings.film),
        });
        let number = self.kept_cameras().count();
        self.say(format!(
            "Kept as camera {number}: Shift 4 goes through them"
        ));
    }

    /// Goes to the kept camera after the one that is set.
    pub(super) fn next_kept_camera(&mut self) {
        let places: Vec<usize> = self.kept_cameras().map(|(place, _)| place).collect();
        let view = self.orbit.map(|orbit| orbit.view());
        let is_set = |place: &usize| Some(self.kept_cameras[*place].file.view) == view;
        let next = match places.iter().position(is_set) {
            Some(at) => places.get((at + 1) % places.len()),
            None => places.first(),
        };
        match next {
            Some(place) => self.go_to_kept_camera(*place),
            None => self.say("No camera is kept: 4 keeps this one"),
        }
    }

    /// Goes to the kept camera at this place among all.
    pub(super) fn go_to_kept_camera(&mut self, place: usize) {
        if let Some(kept) = self.kept_cameras.get(place) {
            let file = kept.file;
            self.set_camera(file);
            let number = self.kept_cameras().position(|(at, _)| at == place);
            self.say(format!("Camera {}", number.map_or(0, |number| number + 1)));
        }
    }

    /// Forgets the kept camera at this place among all.
    pub(super) fn forget_camera(&mut self, place: usize) {
        if place < self.kept_cameras.len() {
            self.kept_cameras.remove(place);
        }
    }

    /// Reads a camera file, as `-c` does.
    pub(super) fn load_camera(&mut self, path: &Path) {
        match CameraFile::load(path) {
            Ok(_) if self.orbit.is_none() => self.say("Open a scene before its camera"),
            Ok(file) => {
                self.set_camera(file);
                self.say(format!("The camera of {}", path.display()));
            }
            Err(why) => self.say(why.to_string()),
        }
    }

    /// Sets the render camera and the size of the picture. In render mode the render starts again.
    fn set_camera(&mut self, file: CameraFile) {
        if let Some(orbit) = &mut self.orbit {
            orbit.go_to(file.view);
        }
        if let Some(settings) = &mut self.settings
            && settings.film != file.film
        {
            settings.film = file.film;
            settings.cell = None;
        }
        if self.mode == Mode::Render {
            self.restart_render();
        }
    }

    /// What to write for the next start.
    pub fn remembered(&self) -> Remembered {
        let cameras = self.kept_cameras.iter();
        Remembered {
            recent: self.recent.clone(),
            cameras: cameras
                .map(|kept| (kept.scene.clone(), kept.file.to_string()))
                .collect(),
            light: !self.dark,
            hides_edges: !self.edges,
            hides_text: !self.overlay,
        }
    }

    /// Takes what was written at the last end of the window.
    pub fn restore(&mut self, remembered: Remembered) {
        self.kept_cameras = remembered.kept_cameras();
        self.recent = remembered.recent;
        self.dark = !remembered.light;
        self.edges = !remembered.hides_edges;
        self.overlay = !remembered.hides_text;
    }
}
