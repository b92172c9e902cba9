//! The files that a run writes: each opened before the rendering, no two of them the same.

use crate::args::Args;
use crate::failure::Failure;
use pathtracer::Output;
use std::fs;
use std::path::{Path, PathBuf};

/// A file to be written, and its name as it is told.
pub(crate) struct Named {
    pub(crate) path: PathBuf,
    pub(crate) file: Output,
}

impl Named {
    fn create(path: &Path) -> Result<Named, Failure> {
        Ok(Named {
            path: path.to_owned(),
            file: Output::create(path)?,
        })
    }
}

/// All that `args` ask to be written.
pub(crate) struct Outputs {
    /// The picture of `-f`.
    pub(crate) picture: Named,
    /// How many samples each pixel took, where `-a` decides.
    pub(crate) rate: Option<Named>,
    /// What `--layers` names.
    pub(crate) layers: Option<Named>,
}

impl Outputs {
    /// Makes sure that all files can be written: the `picture`, and what goes with it.
    pub(crate) fn create(args: &Args, picture: &Path) -> Result<Outputs, Failure> {
        let layers = args.layers.as_deref();
        if let Some(path) = layers.filter(|path| path.extension().is_none_or(|e| e != "exr")) {
            return Err(Failure::Input(format!(
                "--layers {}: only an .exr has room for layers: end the name in .exr",
                path.display()
            )));
        }
        let rate = args.adaptive.is_some().then(|| rate_path(picture));
        let mut taken = inputs(args);
        refuse_taken("-f", picture, &taken)?;
        taken.push(("the picture", picture));
        if let Some(rate) = &rate {
            refuse_taken("the sample counts of -a", rate, &taken)?;
            taken.push(("the sample counts of -a", rate));
        }
        if let Some(layers) = layers {
            refuse_taken("--layers", layers, &taken)?;
        }
        Ok(Outputs {
            picture: Named::create(picture)?,
            rate: rate.as_deref().map(Named::create).transpose()?,
            layers: layers.map(Named::create).transpose()?,
        })
    }
}

/// The files that a run reads by name.
pub(crate) fn inputs(args: &Args) -> Vec<(&'static str, &Path)> {
    let mut read = vec![("the scene", args.scene.as_path())];
    read.extend(
        args.camera
            .as_deref()
            .map(|path| ("the camera of -c", path)),
    );
    read.extend(
        args.environment
            .as_deref()
            .map(|path| ("the map of -e", path)),
    );
    read
}

/// Refuses to write `path` for `what` where it is one of the files that are `taken`.
pub(crate) fn refuse_taken(
    what: &str,
    path: &Path,
    taken: &[(&str, &Path)],
) -> Result<(), Failure> {
    match taken.iter().find(|(_, other)| is_same_file(path, other)) {
        Some((owner, _)) => Err(Failure::Input(format!(
            "{what}: {} is {owner} itself: choose another name",
            path.display()
        ))),
        None => Ok(()),
    }
}

/// Do both names lead to one file, be it there already or not?
fn is_same_file(a: &Path, b: &Path) -> bool {
    place(a) == place(b)
}

/// The path with its folder's links followed, and its own if there is a file.
fn place(path: &Path) -> PathBuf {
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    fs::canonicalize(path).unwrap_or_else(|_| {
        let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        folder.join(path.file_name().unwrap_or_default())
    })
}

/// Beside `picture.png`, `picture_rate.png`: how many samples each pixel took.
fn rate_path(picture: &Path) -> PathBuf {
    let stem = picture.file_stem().unwrap_or_default().to_string_lossy();
    picture.with_file_name(format!("{stem}_rate.png"))
}
