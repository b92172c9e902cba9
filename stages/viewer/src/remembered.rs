//! What the window remembers from one start to the next, besides its size.
//!
//! The settings of renders are not among it: with the same flags the window renders the picture of
//! the program.

use scenes::CameraFile;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A camera that was kept.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptCamera {
    /// The scene that it belongs to.
    pub scene: PathBuf,
    /// The camera, its target, and the size of the picture.
    pub file: CameraFile,
}

/// What is written when the window closes. What a newer version does not know is left out, and
/// what an older one did not write has its default.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Remembered {
    /// The scenes that were open, the newest first.
    pub recent: Vec<PathBuf>,
    /// The kept cameras: a scene, and the text of a camera file, which has all digits.
    pub cameras: Vec<(PathBuf, String)>,
    /// Whether the window is light.
    pub light: bool,
    /// Whether edges are hidden.
    pub hides_edges: bool,
    /// Whether the text in the view is hidden.
    pub hides_text: bool,
}

impl Remembered {
    /// The kept cameras. One whose text is damaged is left out.
    pub(crate) fn kept_cameras(&self) -> Vec<KeptCamera> {
        let read = |(scene, text): &(PathBuf, String)| {
            let file = CameraFile::parse("a kept camera", text).ok()?;
            Some(KeptCamera {
                scene: scene.clone(),
                file,
            })
        };
        self.cameras.iter().filter_map(read).collect()
    }
}
