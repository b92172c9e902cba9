//! Reads environment maps.

use crate::radiance_file;
use image::ImageError;
use kit::environment::EnvironmentError;
use kit::{Environment, Spectrum};
use std::fmt;
use std::path::{Path, PathBuf};

/// Why an environment map cannot be read.
#[derive(Debug)]
pub enum EnvironmentFileError {
    /// The file extension is unknown.
    UnknownFormat(PathBuf),
    /// The file cannot be read, or its content does not match its extension.
    Unreadable(PathBuf, ImageError),
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
    let decoded = std::fs::read(path)
        .map_err(ImageError::IoError)
        .and_then(|bytes| radiance_file::decode(&bytes, path));
    let (picture, note) =
        decoded.map_err(|why| EnvironmentFileError::Unreadable(path.to_owned(), why))?;
    let picture = picture.into_rgb32f();
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let texels = picture
        .pixels()
        .map(|p| Spectrum::from(p.0.map(f64::from)))
        .collect();
    let environment = Environment::new(width, height, texels)
        .map_err(|why| EnvironmentFileError::Invalid(path.to_owned(), why))?;
    Ok((
        environment,
        note.map(|note| format!("{}: {note}", path.display())),
    ))
}
