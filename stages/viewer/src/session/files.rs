//! Files that the window writes: screenshots, cameras, tests.

use super::{Mode, Session};
use crate::ray_test;
use base::utc::Utc;
use kit::film::Cell;
use kit::{Film, Scene};
use pathtracer::{Output, PartFile};
use scenes::{CameraFile, SceneFile};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

/// A file that was written, or that the window has to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Saved {
    /// Written.
    File(PathBuf),
    /// To be written by the window: what it shows.
    Window(PathBuf),
}

impl Session {
    /// Saves the picture in render mode, else the window.
    pub(super) fn screenshot(&mut self) {
        let name = format!(
            "{}_screenshot_{}",
            self.stem(),
            time_stamp(SystemTime::now())
        );
        let path = self.free_path(&name, "png");
        let Some(render) = self.render.as_ref().filter(|_| self.mode == Mode::Render) else {
            self.message = format!("Saving {}", path.display());
            self.saved.push(super::Saved::Window(path));
            return;
        };
        let (film, cell) = (render.shown().film.clone(), render.job().cell);
        let samples = render.job().samples;
        let rate = render.settings().adaptive.is_some();
        let mut written = vec![self.write_picture(&path, &film, cell, None)];
        if rate {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let path = path.with_file_name(format!("{stem}_rate.png"));
            written.push(self.write_picture(&path, &film, cell, Some(samples)));
        }
        self.message = match written.into_iter().collect::<Result<Vec<()>, String>>() {
            Ok(_) => format!("Saved {}", path.display()),
            Err(why) => why,
        };
    }

    /// Writes the pixels of `cell`, or their numbers of samples out of `rate`.
    fn write_picture(
        &mut self,
        path: &Path,
        film: &Film,
        cell: Cell,
        rate: Option<u32>,
    ) -> Result<(), String> {
        let output = Output::create(path)
            .map_err(|why| why.to_string())?
            .with_tone(self.tone);
        let written = match rate {
            Some(samples) => output.write_rate(film, cell, samples),
            None => output.write(film, cell),
        };
        written.map_err(|why| why.to_string())?;
        self.saved.push(Saved::File(path.to_owned()));
        Ok(())
    }

    /// Writes the camera and the film to a file that `-c` reads.
    pub(super) fn dump_camera(&mut self) {
        let (Some(orbit), Some(settings)) = (self.orbit, self.settings) else {
            return self.say("There is no camera: open a scene first");
        };
        let file = CameraFile::new(orbit.view(), settings.film);
        let name = format!("{}_cam_settings.txt", self.stem());
        let path = self.output_folder.join(name);
        self.write_text(&path, &file.to_string());
    }

    /// Writes the scene, as it was edited and with the camera of the window. Returns whether it was
    /// written.
    pub(super) fn save_scene(&mut self, path: &Path) -> bool {
        let is_scene = path
            .extension()
            .is_some_and(|end| end.eq_ignore_ascii_case("dae"));
        let Some(data) = self.scene.clone().filter(|_| is_scene) else {
            self.say(format!("{}: use a name that ends in .dae", path.display()));
            return false;
        };
        if self.edit.is_rebuilding() {
            self.say("The last move is not done yet: save again");
            return false;
        }
        let mut scene = Scene::clone(&data.file_scene);
        scene.camera = self.render_camera().or(scene.camera);
        // Files of textures are relative to the folder of the scene that names them.
        if path.parent() != data.source.path.parent()
            && let Some(folder) = data.source.path.parent()
            && let Ok(folder) = std::path::absolute(folder)
        {
            for file in &mut scene.textures.files {
                *file = folder.join(&*file).display().to_string();
            }
        }
        let before = self.saved.len();
        self.write_text(path, &SceneFile(&scene).to_string());
        self.saved.len() > before
    }

    /// Writes the selected ray of the replay as a Rust test.
    pub(super) fn save_ray_as_test(&mut self) {
        let (Some(inspected), Some(record)) = (self.inspector.inspected(), self.inspector.ray())
        else {
            return self.say("No ray is selected: click a pixel of the picture");
        };
        let scene = inspected.scene.scene();
        // The walked test if there is one, else the whole ray.
        let (_, _, step) = self.inspector.position();
        let text = match step.checked_sub(1).and_then(|step| record.tests.get(step)) {
            Some(test) => ray_test::of_test(scene, record, test),
            None => ray_test::of_ray(scene, record),
        };
        match text {
            Ok(test) => self.save_test(&test),
            Err(why) => self.say(why),
        }
    }

    /// Writes a test into the folder of its stage's tests, with a name that is free.
    pub(crate) fn save_test(&mut self, test: &ray_test::RayTest) {
        let folder = self
            .output_folder
            .join("stages")
            .join(&test.stage)
            .join("tests");
        let path = (0..)
            .map(|i| match i {
                0 => folder.join("ray.rs"),
                i => folder.join(format!("ray_{i}.rs")),
            })
            .find(|path| !path.exists())
            .expect("some name is free");
        if let Err(why) = std::fs::create_dir_all(&folder) {
            return self.say(format!("cannot create {}: {why}", folder.display()));
        }
        self.write_text(&path, &test.text);
        if let Some(Saved::File(_)) = self.saved.last() {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            self.message += &format!(": cargo test -p {} --test {name}", test.stage);
        }
    }

    fn write_text(&mut self, path: &Path, text: &str) {
        let write = || -> io::Result<()> {
            let part = PartFile::create(path)?;
            part.file().write_all(text.as_bytes())?;
            part.finish()
        };
        self.message = match write() {
            Ok(()) => {
                self.saved.push(Saved::File(path.to_owned()));
                format!("Wrote {}", path.display())
            }
            Err(why) => format!("cannot write {}: {why}", path.display()),
        };
    }

    /// The name of the scene file without its extension.
    fn stem(&self) -> String {
        let path = self.scene.as_ref().map(|scene| scene.source.path.clone());
        let stem = path.as_deref().and_then(Path::file_stem);
        stem.map_or_else(
            || "viewer".to_owned(),
            |stem| stem.to_string_lossy().into_owned(),
        )
    }

    /// A path in the output folder that does not exist yet.
    fn free_path(&self, name: &str, extension: &str) -> PathBuf {
        let path = |suffix: &str| {
            self.output_folder
                .join(format!("{name}{suffix}.{extension}"))
        };
        let numbered = (2..).map(|i| path(&format!("_{i}")));
        std::iter::once(path(""))
            .chain(numbered)
            .find(|path| !path.exists())
            .expect("some name is free")
    }
}

/// Month, day, hour, minute and second of a time (UTC), as the assignment's program writes them:
/// `11-5_9-3-27`.
fn time_stamp(time: SystemTime) -> String {
    let seconds = time
        .duration_since(UNIX_EPOCH)
        .map_or(0, |since| since.as_secs());
    let Utc {
        month,
        day,
        hour,
        minute,
        second,
        ..
    } = Utc::at(seconds as i64);
    format!("{month}-{day}_{hour}-{minute}-{second}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn time_stamps_are_dates() {
        let stamp = |seconds| time_stamp(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(stamp(0), "1-1_0-0-0");
        // 2024-02-29 12:34:56 and 2026-11-22 14:22:38.
        assert_eq!(stamp(1_709_210_096), "2-29_12-34-56");
        assert_eq!(stamp(1_795_357_358), "11-22_14-22-38");
    }
}
