//! The files that a run writes. All are created before rendering, and no two are the same.

use crate::failure::Failure;
use pathtracer::args::Args;
use pathtracer::{Output, OutputError, PartFile, Tone};
use std::fs;
use std::path::{Path, PathBuf};

/// A file to write and its path as given.
pub(crate) struct NamedOutput {
    pub(crate) path: PathBuf,
    pub(crate) file: Output,
}

impl NamedOutput {
    fn create(path: &Path) -> Result<NamedOutput, Failure> {
        Ok(NamedOutput {
            path: path.to_owned(),
            file: Output::create(path)?,
        })
    }
}

/// The file of `-f`.
pub(crate) enum PictureFile {
    /// A picture.
    Picture(Output),
    /// The exact sums of a part of a picture.
    Sums(PartFile),
}

impl PictureFile {
    /// Creates the file, before any rendering. Its extension selects the format.
    pub(crate) fn create(path: &Path, tone: Tone) -> Result<PictureFile, Failure> {
        if !is_sums(path) {
            return Ok(PictureFile::Picture(Output::create(path)?.with_tone(tone)));
        }
        PartFile::create(path)
            .map(PictureFile::Sums)
            .map_err(|why| OutputError::NotWritable(path.to_owned(), why).into())
    }
}

/// Whether `path` is a file of sums.
pub(crate) fn is_sums(path: &Path) -> bool {
    path.extension().is_some_and(|end| end == "sums")
}

/// All files that a run writes.
pub(crate) struct Outputs {
    /// The file of `-f`.
    pub(crate) picture: PictureFile,
    /// The sample counts of the pixels, with `-a`.
    pub(crate) rate: Option<NamedOutput>,
    /// The file of `--layers`.
    pub(crate) layers: Option<NamedOutput>,
}

impl Outputs {
    /// Creates the `picture` and the other files of `args`.
    pub(crate) fn create(args: &Args, picture: &Path) -> Result<Outputs, Failure> {
        let layers = args.layers.as_deref();
        if let Some(path) = layers.filter(|path| path.extension().is_none_or(|e| e != "exr")) {
            return Err(Failure::Input(format!(
                "--layers {}: layers need an .exr file: use a name that ends in .exr",
                path.display()
            )));
        }
        let has_rate = args.adaptive.is_some() && !is_sums(picture);
        let rate = has_rate.then(|| rate_path(picture));
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
            picture: PictureFile::create(picture, args.tone())?,
            rate: rate.as_deref().map(NamedOutput::create).transpose()?,
            layers: layers.map(NamedOutput::create).transpose()?,
        })
    }
}

/// The files that a run reads, with their names for messages.
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

/// Returns an error if `path`, to be written for `what`, is one of the files in `taken`.
pub(crate) fn refuse_taken(
    what: &str,
    path: &Path,
    taken: &[(&str, &Path)],
) -> Result<(), Failure> {
    match taken.iter().find(|(_, other)| is_same_file(path, other)) {
        Some((owner, _)) => Err(Failure::Input(format!(
            "{what}: {} is also {owner}: choose another name",
            path.display()
        ))),
        None => Ok(()),
    }
}

/// Whether both paths name the same file, which may not exist yet.
fn is_same_file(a: &Path, b: &Path) -> bool {
    resolved(a) == resolved(b)
}

/// The path with symbolic links resolved: those of the folder, and of the file if it exists.
fn resolved(path: &Path) -> PathBuf {
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    fs::canonicalize(path).unwrap_or_else(|_| {
        let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        folder.join(path.file_name().unwrap_or_default())
    })
}

/// The path of the sample counts: `picture_rate.png` for `picture.png`.
pub(crate) fn rate_path(picture: &Path) -> PathBuf {
    let stem = picture.file_stem().unwrap_or_default().to_string_lossy();
    picture.with_file_name(format!("{stem}_rate.png"))
}
