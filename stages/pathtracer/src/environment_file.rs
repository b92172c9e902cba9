//! Reads environment maps.

use kit::environment::EnvironmentError;
use kit::{Environment, Spectrum};
use picture_files::{Picture, Pixels};
use std::fmt;
use std::path::{Path, PathBuf};

/// Why an environment map cannot be read.
#[derive(Debug)]
pub enum EnvironmentFileError {
    /// The file extension is unknown.
    UnknownFormat(PathBuf),
    /// The file cannot be read, or its content does not match its extension.
    Unreadable(PathBuf, String),
    /// Its values are no radiances.
    Invalid(PathBuf, EnvironmentError),
}

impl fmt::Display for EnvironmentFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EnvironmentFileError::UnknownFormat(path) => write!(
                f,
                "{}: an environment map needs a name that ends in .exr or .hdr: other formats do not store radiance",
                path.display()
            ),
            EnvironmentFileError::Unreadable(path, why) => write!(
                f,
                "cannot read the environment map {}: {why}",
                path.display()
            ),
            EnvironmentFileError::Invalid(path, why) => write!(f, "{}: {why}", path.display()),
        }
    }
}

impl std::error::Error for EnvironmentFileError {}

/// An environment map, and what is to be said about its file.
pub type LoadedEnvironment = (Environment, Option<String>);

/// Reads an environment map: an `.exr` or `.hdr` picture in longitude-latitude format, with -z in
/// the centre.
pub fn load_environment(path: &Path) -> Result<LoadedEnvironment, EnvironmentFileError> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    if !["exr", "hdr"].contains(&extension.to_ascii_lowercase().as_str()) {
        return Err(EnvironmentFileError::UnknownFormat(path.to_owned()));
    }
    let unreadable = |why| EnvironmentFileError::Unreadable(path.to_owned(), why);
    let bytes = std::fs::read(path).map_err(|why| unreadable(why.to_string()))?;
    let decoded = picture_files::decode(&bytes, path);
    let Picture { size, pixels, note } = decoded.map_err(|why| unreadable(why.to_string()))?;
    let Pixels::Linear(pixels) = pixels else {
        let why = "it has colours of a display, no radiance, whatever its name ends in";
        return Err(unreadable(why.to_owned()));
    };
    let [width, height] = size.map(|length| length as usize);
    let radiance = |texel: &[f32; 3]| Spectrum::from(texel.map(f64::from));
    let texels = pixels.iter().map(radiance).collect();
    let environment = Environment::new(width, height, texels)
        .map_err(|why| EnvironmentFileError::Invalid(path.to_owned(), why))?;
    Ok((
        environment,
        note.map(|note| format!("{}: {note}", path.display())),
    ))
}
