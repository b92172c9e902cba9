//! Opening scenes: in the background, with the last scene shown until the new one is there.

use super::Session;
use super::progress::LoadProgress;
use crate::orbit::Orbit;
use crate::scene_data::{Opened, modified};
use crate::settings::RenderSettings;
use crate::task::Task;
use crate::tree_walk::TreeWalk;
use pathtracer::args::AccelName;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The number of recent scenes that are listed.
const MAX_RECENT: usize = 8;
/// The time between two looks at whether the scene file has changed.
const LOOK_EVERY: Duration = Duration::from_secs(1);

/// A scene that is being read.
pub struct Loading {
    /// The file.
    pub path: PathBuf,
    /// When it started.
    pub since: Instant,
    /// How far it is.
    pub progress: Arc<LoadProgress>,
    task: Task<Result<Opened, String>>,
}

/// The scenes of the course's folder `scenes/dae` above the current folder or the program.
pub(super) fn course_scenes() -> Vec<PathBuf> {
    let starts = [env::current_dir().ok(), env::current_exe().ok()];
    let mut folders = starts.iter().flatten().flat_map(|start| start.ancestors());
    let folder = folders.find_map(|folder| fs::read_dir(folder.join("scenes/dae")).ok());
    let files = folder
        .into_iter()
        .flatten()
        .flatten()
        .map(|file| file.path());
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|end| end == "dae");
    let mut scenes: Vec<PathBuf> = files.filter(is_scene).collect();
    scenes.sort();
    scenes
}

impl Session {
    /// Starts to read a scene.
    pub(super) fn open(&mut self, path: PathBuf) {
        self.message = format!("Loading {}", path.display());
        self.problem = None;
        let mut args = self.args.clone();
        // The camera of `-c` belongs to the scene of the command line.
        if path != self.args.scene {
            args.camera = None;
        }
        let file = path.clone();
        let progress = Arc::new(LoadProgress::default());
        let written = Arc::clone(&progress);
        let task = Task::spawn(Arc::clone(&self.wake), move |_| {
            Opened::load(&file, &args, &written)
        });
        self.loading = Some(Loading {
            path,
            since: Instant::now(),
            progress,
            task,
        });
    }

    /// How hits are found.
    pub fn accel(&self) -> AccelName {
        self.args.accel
    }

    /// Finds hits in another way. The scene is read again.
    pub fn set_accel(&mut self, accel: AccelName) {
        if self.args.accel != accel {
            self.args.accel = accel;
            self.reload();
        }
    }

    /// Reads the scene file again. The camera stays.
    pub(super) fn reload(&mut self) {
        if let Some(scene) = &self.scene {
            self.open(scene.source.path.clone());
        }
    }

    pub(super) fn update_loading(&mut self, now: Instant, wait: Duration) {
        self.reload_if_changed(now);
        let Some(loading) = &self.loading else { return };
        let Some(loaded) = loading.task.wait(wait) else {
            return;
        };
        let (path, time) = (loading.path.clone(), loading.since.elapsed());
        self.loading = None;
        match loaded {
            Ok(Ok(opened)) => self.show(opened, time),
            // The last scene stays.
            Ok(Err(why)) => self.tell_problem(&path, why),
            Err(failure) => self.tell_problem(&path, failure.to_string()),
        }
    }

    fn show(&mut self, opened: Opened, time: Duration) {
        let settings = match (RenderSettings::new(&self.args, opened.film), self.settings) {
            (_, Some(settings)) => settings,
            (Ok(settings), None) => settings,
            (Err(why), None) => {
                return self.tell_problem(&opened.data.source.path, why);
            }
        };
        let path = opened.data.source.path.clone();
        let is_same_file = self
            .scene
            .as_ref()
            .is_some_and(|old| old.source.path == path);
        if !is_same_file {
            self.orbit = Some(Orbit::new(opened.view));
            self.walk = TreeWalk::default();
            self.cut = None;
        }
        self.settings = Some(settings);
        self.spy = None;
        self.selection = None;
        self.render = None;
        self.inspector.close();
        self.heat = Default::default();
        self.edit = Default::default();
        let scene = opened.data.scene();
        let mut message = format!(
            "{}: {} triangles, {} spheres, loaded in {:.2} s",
            path.display(),
            scene.triangles.len(),
            scene.spheres.len(),
            time.as_secs_f64()
        );
        if let Some(failure) = &opened.data.missing_accel {
            message += &format!("; a simpler tree is used: {failure}");
        }
        match opened.data.source.warnings.as_slice() {
            [] => {}
            [warning] => message += &format!("; {warning}"),
            [first, rest @ ..] => message += &format!("; {first}; {} more warnings", rest.len()),
        }
        self.message = message;
        self.scene = Some(Arc::new(opened.data));
        self.recent.retain(|recent| *recent != path);
        self.recent.insert(0, path);
        self.recent.truncate(MAX_RECENT);
    }

    /// Says why a scene is not loaded: in a line, and in full.
    fn tell_problem(&mut self, path: &Path, why: String) {
        let name = path.file_name().unwrap_or(path.as_os_str());
        self.message = format!("{} is not loaded: see above", name.to_string_lossy());
        let file = path.display().to_string();
        // A sentence about the content names no file.
        let is_named = why.contains(&file);
        self.problem = Some(if is_named {
            why
        } else {
            format!("{file}: {why}")
        });
    }

    /// Reads the scene file again if it was changed on the disk.
    fn reload_if_changed(&mut self, now: Instant) {
        let is_due = self
            .last_look_at_file
            .is_none_or(|last| now.duration_since(last) >= LOOK_EVERY);
        let Some(scene) = self
            .scene
            .as_ref()
            .filter(|_| is_due && self.loading.is_none())
        else {
            return;
        };
        self.last_look_at_file = Some(now);
        let path: &Path = &scene.source.path;
        let newest = modified(path);
        // A file that is being replaced may be missing for a moment.
        if newest.is_some() && newest != scene.source.modified {
            self.reload();
        }
    }
}
