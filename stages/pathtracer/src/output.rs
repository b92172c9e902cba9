//! Picture files: tone-mapped PNG, EXR and HDR with linear radiance.

use crate::part_file::PartFile;
use crate::rate_picture::{Bytes, RateScale, rate_picture};
use crate::tone::Tone;
use kit::Film;
use kit::film::Cell;
use picture_files::{Channel, ImageError, Values, write_exr, write_hdr, write_png};
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// The formats of picture files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
    Hdr,
}

/// A picture file, which appears under its name when it is complete.
#[derive(Debug)]
pub struct Output {
    format: Format,
    part: PartFile,
    tone: Tone,
}

/// Why a picture cannot be written.
#[derive(Debug)]
pub enum OutputError {
    /// The file extension is unknown.
    UnknownFormat(PathBuf),
    /// The path is a folder.
    IsFolder(PathBuf),
    /// The file cannot be created.
    NotWritable(PathBuf, io::Error),
    /// Writing the file failed.
    Failed(PathBuf, ImageError),
}

impl fmt::Display for OutputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OutputError::UnknownFormat(path) => write!(
                f,
                "{}: unknown picture format: use a name that ends in .png, .exr or .hdr, or in .sums for a part",
                path.display()
            ),
            OutputError::IsFolder(path) => write!(
                f,
                "{} is a folder: add a file name, as in {}",
                path.display(),
                path.join("picture.png").display()
            ),
            OutputError::NotWritable(path, why) => write!(
                f,
                "cannot write {}: {why}: choose an existing folder with write permission",
                path.display()
            ),
            OutputError::Failed(path, why) => {
                write!(f, "writing {} failed: {why}", path.display())
            }
        }
    }
}

impl std::error::Error for OutputError {}

impl Output {
    /// Creates the file, before any rendering. The extension selects the format: `.png`, `.exr` or
    /// `.hdr`.
    pub fn create(path: &Path) -> Result<Output, OutputError> {
        if path.is_dir() {
            return Err(OutputError::IsFolder(path.to_owned()));
        }
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
        let format = match extension.to_ascii_lowercase().as_str() {
            "png" => Format::Png,
            "exr" => Format::Exr,
            "hdr" => Format::Hdr,
            _ => return Err(OutputError::UnknownFormat(path.to_owned())),
        };
        let part =
            PartFile::create(path).map_err(|why| OutputError::NotWritable(path.to_owned(), why))?;
        Ok(Output {
            format,
            part,
            tone: Tone::default(),
        })
    }

    /// The same file, with another tone curve for `.png`. The other formats store radiance.
    pub fn with_tone(self, tone: Tone) -> Output {
        Output { tone, ..self }
    }

    /// Writes the pixels of `cell`. On success the file is complete and has its name.
    pub fn write(self, film: &Film, cell: Cell) -> Result<(), OutputError> {
        self.encode(film, cell)
            .and_then(|()| Ok(self.part.finish()?))
            .map_err(|why| OutputError::Failed(self.part.path().to_owned(), why))
    }

    /// Writes the channels of a picture of `w` x `h` pixels as one `.exr`.
    pub fn write_channels(self, channels: Vec<Channel>, w: u32, h: u32) -> Result<(), OutputError> {
        write_exr(self.part.file(), channels, [w, h])
            .and_then(|()| self.part.finish())
            .map_err(|why| OutputError::NotWritable(self.part.path().to_owned(), why))
    }

    /// Writes the number of samples of each pixel of `cell`, of at most `ns_aa`, as a colour: blue
    /// for few, green for half, red for all.
    pub fn write_rate(self, film: &Film, cell: Cell, ns_aa: u32) -> Result<(), OutputError> {
        self.write_bytes(&rate_picture(film, cell, ns_aa, RateScale::Assignment))
    }

    /// Writes a picture of bytes as `.png`, whatever the name ends in.
    pub fn write_bytes(self, picture: &Bytes) -> Result<(), OutputError> {
        let Bytes { w, h, rgb } = picture;
        write_png(self.part.file(), rgb, [*w, *h])
            .and_then(|()| Ok(self.part.finish()?))
            .map_err(|why| OutputError::Failed(self.part.path().to_owned(), why))
    }

    fn encode(&self, film: &Film, cell: Cell) -> Result<(), ImageError> {
        let (w, h) = (cell.x1 - cell.x0, cell.y1 - cell.y0);
        // Rows of a file start at the top, rows of a film at the bottom.
        let radiance = (cell.y0..cell.y1)
            .rev()
            .flat_map(|y| (cell.x0..cell.x1).map(move |x| film.get(x, y).radiance));
        let (file, size) = (self.part.file(), [w, h]);
        match self.format {
            Format::Png => {
                let bytes: Vec<u8> = radiance.flat_map(|c| self.tone.to_bytes(c)).collect();
                write_png(file, &bytes, size)
            }
            Format::Hdr => {
                let pixels: Vec<[f32; 3]> =
                    radiance.map(|c| c.to_array().map(|c| c as f32)).collect();
                write_hdr(file, &pixels, size)
            }
            Format::Exr => {
                let channel = |(i, &name): (usize, &&'static str)| {
                    let color = radiance.clone().map(|c| c.to_array()[i] as f32);
                    let values = Values::Float(color.collect());
                    Channel { name, values }
                };
                let channels = ["R", "G", "B"].iter().enumerate().map(channel);
                Ok(write_exr(file, channels.collect(), size)?)
            }
        }
    }
}
