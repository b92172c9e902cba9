//! The camera and the size of the picture.

use super::Args;
use kit::{FilmSize, Scene};
use scenes::placement::{self, View};
use scenes::{CameraFile, SceneError};
use std::fmt;

/// Why there is no camera or no film.
#[derive(Debug)]
pub enum ViewError {
    /// A flag is invalid.
    Flag(String),
    /// The camera file cannot be read.
    File(SceneError),
}

impl fmt::Display for ViewError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ViewError::Flag(why) => f.write_str(why),
            ViewError::File(why) => why.fmt(f),
        }
    }
}

impl std::error::Error for ViewError {}

impl Args {
    /// The view and the size of the picture: those of the camera file `-c` with its angles
    /// unchanged, else those of the scene.
    pub fn view(&self, scene: &Scene) -> Result<(View, FilmSize), ViewError> {
        let Some(path) = &self.camera else {
            let film = self.film(None).map_err(ViewError::Flag)?;
            return Ok((placement::place(scene, film), film));
        };
        let file = CameraFile::load(path).map_err(ViewError::File)?;
        let film = self.film(Some(file.film)).map_err(ViewError::Flag)?;
        Ok((file.view, film))
    }
}
