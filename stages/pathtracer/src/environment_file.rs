//! Reading environment maps.

use image::ImageError;
use kit::environment::EnvironmentError;
use kit::{Environment, Spectrum};
use std::fmt;
use std::path::{Path, PathBuf};

/// Why a file cannot light a scene.
#[derive(Debug)]
pub enum EnvironmentFileError {
    /// The file name ends in none of the known ways.
    UnknownFormat(PathBuf),
    /// The file cannot be read, or is not what its name says.
    Unreadable(PathBuf, ImageError),
    /// What is in it is no light.
    NoLight(PathBuf, EnvironmentError),
}

impl fmt::Display for EnvironmentFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EnvironmentFileError::UnknownFormat(path) => write!(
                f,
                "{}: the name of an environment map ends in .exr or .hdr: other pictures do not say how bright they are",
                path.display()
            ),
            EnvironmentFileError::Unreadable(path, why) => write!(
                f,
                "cannot read the environment map {}: {why}",
                path.display()
            ),
            EnvironmentFileError::NoLight(path, why) => write!(f, "{}: {why}", path.display()),
        }
    }
}

impl std::error::Error for EnvironmentFileError {}

/// Reads an environment map: an `.exr` or `.hdr` picture by longitude and latitude, its middle along -z.
pub fn load_environment(path: &Path) -> Result<Environment, EnvironmentFileError> {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    if !["exr", "hdr"].contains(&ending.to_ascii_lowercase().as_str()) {
        return Err(EnvironmentFileError::UnknownFormat(path.to_owned()));
    }
    let picture = image::open(path)
        .map_err(|why| EnvironmentFileError::Unreadable(path.to_owned(), why))?
        .into_rgb32f();
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let texels = picture
        .pixels()
        .map(|p| Spectrum::from(p.0.map(f64::from)))
        .collect();
    Environment::new(width, height, texels)
        .map_err(|why| EnvironmentFileError::NoLight(path.to_owned(), why))
}
