//! A loaded scene with everything that the window needs of it.

use crate::features::Feature;
use crate::session::progress::{LoadProgress, LoadStep};
use crate::task::{StageFailure, guarded};
use kit::{Aabb, Bvh, Environment, FilmSize, Scene};
use pathtracer::args::{Args, NormalsName, Shade};
use pathtracer::{
    Accel, AccelKind, Guide, Job, LightSettings, Picture, PreparedScene, ProgressiveRender,
    Textures, load_environment,
};
use scenes::placement::{View, place};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::SystemTime;

/// The parts of a scene that stay when a vertex moves.
#[derive(Clone, Debug)]
pub struct Source {
    /// The scene file.
    pub path: PathBuf,
    /// What its pictures show.
    pub shade: Shade,
    /// How hits are found.
    pub accel: AccelKind,
    /// The environment map of the flag `-e`.
    pub environment: Option<Environment>,
    /// The textures.
    pub textures: Textures,
    /// Repaired or ignored parts of the file, and missing textures.
    pub warnings: Vec<String>,
    /// When the file was last changed.
    pub modified: Option<SystemTime>,
}

/// A scene that is ready to be shown, and its trees.
#[derive(Clone, Debug)]
pub struct SceneData {
    /// The parts that stay when a vertex moves.
    pub source: Arc<Source>,
    /// The scene of the file, without triangles for its area lights.
    pub file_scene: Arc<Scene>,
    /// What is rendered.
    pub prepared: PreparedScene,
    /// The binary tree over the scene: for the visualiser and for replays.
    pub tree: Accel,
    /// The first boxes of the wide tree and their depths, breadth first; none if it is not used.
    pub wide_boxes: Vec<(Aabb, usize)>,
    /// Whether the wide tree is not used because the stages of Parts 1 to 5 render another picture:
    /// then their picture is the one to see.
    pub stages_differ: bool,
    /// Why the wide tree is not used, if it should be.
    pub missing_accel: Option<StageFailure>,
    /// The bounding box.
    pub bounds: Aabb,
}

/// A scene as it is opened: with its view.
#[derive(Clone, Debug)]
pub struct Opened {
    /// The scene.
    pub data: SceneData,
    /// The view of `-c`, else that of the scene.
    pub view: View,
    /// The size of the picture.
    pub film: FilmSize,
}

impl Opened {
    /// Reads the scene `path`, with the flags of `args`. The error is a sentence.
    /// Its steps are written to `progress`.
    pub fn load(path: &Path, args: &Args, progress: &LoadProgress) -> Result<Opened, String> {
        let bytes = std::fs::metadata(path).map_or(0, |file| file.len());
        progress.start(LoadStep::Reading { bytes });
        let modified = modified(path);
        let mut loaded = scenes::load(path).map_err(|why| why.to_string())?;
        if args.normals == NormalsName::Flat {
            loaded.scene.flatten_normals();
        }
        if loaded.added_light && args.environment.is_some() {
            loaded.scene.lights.clear();
        }
        let (view, film) = args.view(&loaded.scene).map_err(|why| why.to_string())?;
        let environment = match &args.environment {
            Some(map) => Some(load_environment(map).map_err(|why| why.to_string())?.0),
            None => None,
        };
        let folder = path.parent().unwrap_or(Path::new(""));
        let (textures, texture_warnings) = Textures::load(&loaded.scene, folder);
        // Until there is light, the window shows what there is.
        let no_light = match args.shade {
            Shade::Auto => Feature::Light.missing(),
            Shade::Normals | Shade::Lit => None,
        };
        let shade = if no_light.is_some() {
            Shade::Normals
        } else {
            args.shade
        };
        let no_light = no_light.map(|why| format!("{why}: pictures show normals instead of light"));
        let warnings = loaded.warnings.iter().map(ToString::to_string);
        let source = Source {
            path: path.to_owned(),
            shade,
            accel: args.accel.into(),
            environment,
            textures,
            warnings: warnings
                .chain(texture_warnings.iter().map(ToString::to_string))
                .chain(no_light)
                .collect(),
            modified,
        };
        Ok(Opened {
            data: SceneData::build(Arc::new(source), Arc::new(loaded.scene), progress),
            view,
            film,
        })
    }
}

/// The size of the picture that the stages and Part 6 both render before Part 6 is used.
const TRIAL: FilmSize = FilmSize { w: 32, h: 24 };

/// Whether a small picture with the scene's accelerator differs from one with `plain`. Part 6 was
/// tested to render what the stages do, bit for bit: where it does not, a stage was changed.
fn differs_with(prepared: &mut PreparedScene, plain: &Accel) -> bool {
    let first = trial(prepared);
    let wide = std::mem::replace(&mut prepared.accel, plain.clone());
    let second = trial(prepared);
    prepared.accel = wide;
    first != second
}

/// A small picture of a scene: its pixels' bits.
fn trial(prepared: &PreparedScene) -> Vec<[u64; 3]> {
    let job = Job {
        camera: place(prepared.scene(), TRIAL).camera,
        film: TRIAL,
        cell: TRIAL.whole(),
        samples: 1,
        sampling: 0.into(),
    };
    let settings = LightSettings {
        max_depth: 3,
        ..LightSettings::default()
    };
    let mut render = ProgressiveRender::new(prepared, job, settings);
    render.run(prepared, usize::MAX, &AtomicBool::new(false));
    let film = &render.rendered().film;
    let pixels = (0..TRIAL.h).flat_map(|y| (0..TRIAL.w).map(move |x| (x, y)));
    let radiance = pixels.map(|(x, y)| film.get(x, y).radiance.to_array());
    radiance
        .map(|radiance| radiance.map(f64::to_bits))
        .collect()
}

/// The number of boxes of the wide tree that can be drawn: those of the first levels.
const MAX_WIDE_BOXES: usize = 600;

impl SceneData {
    /// Builds the trees. If a stage fails, the next simpler way to find hits is used: in the end
    /// brute force, which needs no tree. The steps are written to `progress`.
    pub fn build(
        source: Arc<Source>,
        file_scene: Arc<Scene>,
        progress: &LoadProgress,
    ) -> SceneData {
        let environment = source.environment.clone();
        let picture = Picture::new(source.shade, Scene::clone(&file_scene), environment);
        let scene = picture.scene();
        let of = if source.accel == AccelKind::Bvh { 1 } else { 2 };
        let build = |kind| {
            progress.start(LoadStep::Tree {
                number: if kind == AccelKind::Bvh { 1 } else { of },
                of,
                primitives: scene.len(),
            });
            guarded(|| Accel::build(kind, scene))
        };
        let tree = build(AccelKind::Bvh);
        let mut missing_accel = tree.as_ref().err().cloned();
        let tree = tree.unwrap_or(Accel::Brute);
        let accel = match source.accel {
            AccelKind::Bvh => tree.clone(),
            kind => build(kind).unwrap_or_else(|failure| {
                missing_accel = Some(failure);
                tree.clone()
            }),
        };
        let mut prepared = PreparedScene {
            textures: source.textures.clone(),
            picture,
            accel,
            guide: Guide::default(),
        };
        let stages_differ = matches!(prepared.accel, Accel::Simd(_))
            && guarded(|| differs_with(&mut prepared, &tree)).unwrap_or(false);
        if stages_differ {
            prepared.accel = tree.clone();
        }
        let wide_boxes = match &prepared.accel {
            Accel::Simd(wide) => guarded(|| wide.boxes(MAX_WIDE_BOXES)).unwrap_or_default(),
            _ => Vec::new(),
        };
        SceneData {
            wide_boxes,
            bounds: prepared.scene().bounds(),
            prepared,
            stages_differ,
            source,
            file_scene,
            tree,
            missing_accel,
        }
    }

    /// Which code traces the pictures.
    pub fn traced_by(&self) -> &'static str {
        match (&self.prepared.accel, self.stages_differ) {
            (Accel::Simd(_), _) => "Part 6; the stages render the same trial picture",
            (_, true) => "the stages: Part 6 renders another trial picture",
            (Accel::Bvh(_), false) => "the stages of Parts 1 to 5",
            (Accel::Brute, false) => "the stages, without a tree",
        }
    }

    /// Whether pictures show normals although the flags ask for light, since there is none.
    pub fn has_no_light(&self) -> bool {
        self.source.shade == Shade::Auto && matches!(self.prepared.picture, Picture::Normals(_))
    }

    /// The scene that is rendered.
    pub fn scene(&self) -> &Scene {
        self.prepared.scene()
    }

    /// The binary tree; `None` if it could not be built.
    pub fn bvh(&self) -> Option<&Bvh> {
        match &self.tree {
            Accel::Bvh(tree) => Some(tree),
            _ => None,
        }
    }

    /// The name of the file without its folder.
    pub fn name(&self) -> String {
        let name = self.source.path.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }
}

/// When a file was last changed; `None` if there is no such file.
pub fn modified(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path)
        .and_then(|file| file.modified())
        .ok()
}

// BEGIN SOLUTION(part4.task3)
#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    /// A stage that finds other hits than Part 6 is seen in the trial picture; equal ones are not.
    #[test]
    fn a_tree_that_loses_hits_is_noticed() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../scenes/dae/cornell_spheres.dae"
        );
        let args = Args::parse_from(["viewer", path]);
        let opened = Opened::load(Path::new(path), &args, &LoadProgress::default());
        let mut data = opened.expect("a scene").data;
        let Accel::Bvh(tree) = &data.tree else {
            panic!("a tree")
        };
        // The same picture, without its last leaf.
        let mut losing = tree.clone();
        let leaf = |node: &&mut kit::BvhNode| matches!(node.kind, kit::NodeKind::Leaf { .. });
        let last = losing.nodes.iter_mut().rfind(leaf).expect("a leaf");
        last.kind = kit::NodeKind::Leaf { first: 0, count: 0 };
        let right = data.tree.clone();
        assert!(!differs_with(&mut data.prepared, &right));
        assert!(differs_with(&mut data.prepared, &Accel::Bvh(losing)));
    }
}
// END SOLUTION(part4.task3)
