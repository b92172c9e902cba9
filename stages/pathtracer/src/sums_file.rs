//! Parts of a picture as files: the exact sums of the samples of a cell (`-f NAME.sums`).
//!
//! A file is a few lines of text and then the pixels, row by row from the bottom left. Of each sum
//! only the bytes that differ from its sign are stored: about ten for a channel.

use crate::exact_sum::{ExactSum, PixelSum};
use crate::part_file::PartFile;
use crate::{Job, Rendered};
use base::fnv;
use kit::film::Cell;
use kit::{Film, FilmSize, PixelEstimate, Spectrum};
use std::fmt;
use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Read, Write};
use std::path::Path;

/// The first line of a file.
const MAGIC: &str = "first light sums 1";

/// More than the longest head of a file, in bytes.
const MAX_HEAD: u64 = 4096;

/// The largest cell that is read, in pixels: as many as a picture may have.
const MAX_PIXELS: u64 = 100_000_000;

/// The bytes of the shortest pixel: its kind, its samples, three sums of 0.
const MIN_PIXEL: u64 = 1 + 4 + 3 * 2;

/// What a file contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SumsHead {
    /// Identifies everything that the samples depend on: parts of one picture have the same
    /// ([`Fingerprint`]).
    pub picture: u64,
    /// The size of the whole picture.
    pub film: FilmSize,
    /// The pixels.
    pub cell: Cell,
    /// The index of the first sample of each pixel.
    pub first_sample: u32,
    /// The samples of each pixel, or the largest number with adaptive sampling.
    pub samples: u32,
    /// Whether the numbers of samples differ between pixels.
    pub adaptive: bool,
}

/// A part of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct SumsFile {
    /// What it contains.
    pub head: SumsHead,
    /// The pixels of the cell, in the order of [`Cell::pixels`].
    pub pixels: Vec<PixelSum>,
}

impl SumsFile {
    /// The part that `job` describes. `rendered` needs exact sums; `picture` is its fingerprint.
    pub fn of_cell(rendered: &Rendered, job: &Job, adaptive: bool, picture: u64) -> SumsFile {
        let width = job.film.w as usize;
        let sum = |(x, y): (u32, u32)| rendered.sums[y as usize * width + x as usize];
        SumsFile {
            head: SumsHead {
                picture,
                film: job.film,
                cell: job.cell,
                first_sample: job.sampling.first_sample,
                samples: job.samples,
                adaptive,
            },
            pixels: job.cell.pixels().map(sum).collect(),
        }
    }

    /// The means of the pixels in the whole film; black outside of the cell.
    pub fn film(&self) -> Film {
        let mut film = Film::new(self.head.film);
        for ((x, y), sum) in self.head.cell.pixels().zip(&self.pixels) {
            film.set(x, y, sum.mean());
        }
        film
    }

    /// Writes the file. The head has to fit the pixels.
    pub fn write(&self, part: &PartFile) -> io::Result<()> {
        let mut out = Checked::new(BufWriter::new(part.file()));
        out.write_all(self.head.to_string().as_bytes())?;
        for pixel in &self.pixels {
            write_pixel(&mut out, pixel)?;
        }
        let Checked {
            inner: mut out,
            checksum,
        } = out;
        out.write_all(&checksum.0.to_le_bytes())?;
        out.flush()?;
        drop(out);
        part.finish()
    }

    /// Reads a file. The error is a sentence about its content, without its name.
    pub fn read(path: &Path) -> Result<SumsFile, String> {
        let mut input = open(path)?;
        let head = SumsHead::read_from(&mut input)?;
        let damaged = |why: io::Error| format!("is damaged: {why}: render or copy it again");
        let mut pixels = Vec::new();
        for _ in 0..head.cell.area() {
            pixels.push(read_pixel(&mut input).map_err(damaged)?);
        }
        let Checked {
            inner: mut input,
            checksum,
        } = input;
        let mut end = Vec::new();
        input.read_to_end(&mut end).map_err(damaged)?;
        if end != checksum.0.to_le_bytes() {
            return Err("is damaged: its checksum is wrong: render or copy it again".to_owned());
        }
        Ok(SumsFile { head, pixels })
    }
}

fn open(path: &Path) -> Result<Checked<BufReader<File>>, String> {
    let file = File::open(path).map_err(|why| format!("cannot be read: {why}"))?;
    match file.metadata() {
        Ok(found) if !found.is_file() => Err(
            "is a folder, a pipe or a device: expected a file that pathtracer -f NAME.sums wrote"
                .to_owned(),
        ),
        _ => Ok(Checked::new(BufReader::new(file))),
    }
}

impl SumsHead {
    /// Reads the head of a file only.
    pub fn read(path: &Path) -> Result<SumsHead, String> {
        SumsHead::read_from(&mut open(path)?)
    }

    fn read_from(input: &mut Checked<BufReader<File>>) -> Result<SumsHead, String> {
        let none = "is not a file of sums: expected one that pathtracer -f NAME.sums wrote";
        let mut lines = Vec::new();
        while lines.last().is_none_or(|line| line != "pixels") {
            let mut line = String::new();
            let read = input.inner.by_ref().take(MAX_HEAD).read_line(&mut line);
            input.checksum.add(line.as_bytes());
            match line.strip_suffix('\n') {
                Some(text) if read.is_ok() && lines.len() < 8 => lines.push(text.to_owned()),
                _ => return Err(none.to_owned()),
            }
            if lines[0] != MAGIC {
                return Err(none.to_owned());
            }
        }
        let head = SumsHead::parse(&lines[1..]).ok_or_else(|| {
            "has a head that does not fit a picture: render or copy it again".to_owned()
        })?;
        // Memory is asked for by the head's word.
        let length = input
            .inner
            .get_ref()
            .metadata()
            .map_or(0, |file| file.len());
        if length < head.cell.area() * MIN_PIXEL {
            return Err(
                "is damaged: it is too short for its pixels: render or copy it again".into(),
            );
        }
        Ok(head)
    }

    /// From the lines after the first one. `None` unless they describe a cell of a picture.
    fn parse(lines: &[String]) -> Option<SumsHead> {
        let numbers = |name: &str| -> Option<Vec<u32>> {
            let rest = |line: &String| {
                line.strip_prefix(name)?
                    .strip_prefix(' ')
                    .map(str::to_owned)
            };
            let line = lines.iter().find_map(rest)?;
            line.split(' ').map(|number| number.parse().ok()).collect()
        };
        let picture = lines
            .iter()
            .find_map(|line| line.strip_prefix("picture "))?;
        let &[w, h] = numbers("film")?.as_slice() else {
            return None;
        };
        let &[x0, y0, x1, y1] = numbers("cell")?.as_slice() else {
            return None;
        };
        let &[first_sample, samples] = numbers("samples")?.as_slice() else {
            return None;
        };
        let &[adaptive] = numbers("adaptive")?.as_slice() else {
            return None;
        };
        let is_cell = x0 < x1 && x1 <= w && y0 < y1 && y1 <= h;
        let cell = Cell { x0, y0, x1, y1 };
        let is_range = samples > 0 && first_sample.checked_add(samples).is_some();
        let is_valid = is_cell && cell.area() <= MAX_PIXELS && is_range && adaptive <= 1;
        is_valid.then_some(SumsHead {
            picture: u64::from_str_radix(picture, 16).ok()?,
            film: FilmSize { w, h },
            cell,
            first_sample,
            samples,
            adaptive: adaptive == 1,
        })
    }
}

impl fmt::Display for SumsHead {
    /// The text at the start of a file.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let SumsHead {
            picture,
            film: FilmSize { w, h },
            cell: Cell { x0, y0, x1, y1 },
            first_sample,
            samples,
            adaptive,
        } = self;
        writeln!(f, "{MAGIC}\npicture {picture:016x}\nfilm {w} {h}")?;
        writeln!(f, "cell {x0} {y0} {x1} {y1}")?;
        writeln!(f, "samples {first_sample} {samples}")?;
        writeln!(f, "adaptive {}\npixels", u8::from(*adaptive))
    }
}

/// The kinds of pixels in a file.
const EXACT: u8 = 0;
const ROUNDED: u8 = 1;

fn write_pixel(out: &mut impl Write, pixel: &PixelSum) -> io::Result<()> {
    match pixel {
        PixelSum::Exact { sums, samples } => {
            out.write_all(&[EXACT])?;
            out.write_all(&samples.to_le_bytes())?;
            for sum in sums {
                let bytes = sum.to_le_bytes();
                let low = bytes.iter().take_while(|&&byte| byte == 0).count();
                let sign = sign_byte(&bytes);
                let high = bytes.iter().rev().take_while(|&&byte| byte == sign).count();
                // One byte with the sign remains, unless the sum is 0.
                let end = (bytes.len() - high + 1).min(bytes.len());
                let stored = if low == bytes.len() {
                    &[]
                } else {
                    &bytes[low..end]
                };
                out.write_all(&[low as u8, stored.len() as u8])?;
                out.write_all(stored)?;
            }
        }
        PixelSum::Rounded(estimate) => {
            out.write_all(&[ROUNDED])?;
            out.write_all(&estimate.samples.to_le_bytes())?;
            for c in estimate.radiance.to_array() {
                out.write_all(&c.to_le_bytes())?;
            }
        }
    }
    Ok(())
}

/// What the bytes above the highest one of a number in two's complement are.
fn sign_byte(bytes: &[u8]) -> u8 {
    let is_negative = bytes.last().is_some_and(|byte| byte >> 7 == 1);
    if is_negative { 0xff } else { 0 }
}

fn read_pixel(input: &mut impl Read) -> io::Result<PixelSum> {
    let mut kind = [0];
    let mut samples = [0; 4];
    input.read_exact(&mut kind)?;
    input.read_exact(&mut samples)?;
    let samples = u32::from_le_bytes(samples);
    match kind {
        [EXACT] => {
            let mut sums = [ExactSum::default(); 3];
            for sum in &mut sums {
                let mut place = [0; 2];
                input.read_exact(&mut place)?;
                let [low, count] = place.map(usize::from);
                let mut bytes = [0; 24];
                let end = low + count;
                let stored = bytes
                    .get_mut(low..end)
                    .ok_or_else(|| io::Error::other("a sum has more than 24 bytes"))?;
                input.read_exact(stored)?;
                let sign = sign_byte(stored);
                bytes[end..].fill(sign);
                *sum = ExactSum::from_le_bytes(bytes);
            }
            Ok(PixelSum::Exact { sums, samples })
        }
        [ROUNDED] => {
            let mut channels = [0.0; 3];
            for c in &mut channels {
                let mut bytes = [0; 8];
                input.read_exact(&mut bytes)?;
                *c = f64::from_le_bytes(bytes);
            }
            Ok(PixelSum::Rounded(PixelEstimate {
                radiance: Spectrum::from(channels),
                samples,
            }))
        }
        _ => Err(io::Error::other("a pixel of an unknown kind")),
    }
}

/// A hash of what a picture depends on: FNV-1a with 64 bits. It detects mistakes, not malice.
#[derive(Clone, Copy, Debug)]
pub struct Fingerprint(u64);

impl Default for Fingerprint {
    fn default() -> Fingerprint {
        Fingerprint(fnv::START)
    }
}

impl Fingerprint {
    /// Adds bytes. Neighbouring calls are not separated.
    pub fn add(&mut self, bytes: &[u8]) {
        self.0 = bytes.iter().copied().fold(self.0, fnv::add);
    }

    /// The hash of all bytes so far.
    pub fn value(self) -> u64 {
        self.0
    }
}

/// A reader or writer that hashes what passes through it.
struct Checked<T> {
    inner: T,
    checksum: Fingerprint,
}

impl<T> Checked<T> {
    fn new(inner: T) -> Checked<T> {
        Checked {
            inner,
            checksum: Fingerprint::default(),
        }
    }
}

impl<T: Write> Write for Checked<T> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.checksum.add(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

impl<T: Read> Read for Checked<T> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.inner.read(bytes)?;
        self.checksum.add(&bytes[..read]);
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file() -> SumsFile {
        let mut pixels = vec![PixelSum::default(); 6];
        for (i, c) in [1.0, 0.1, -0.1, 1e-40, 3e17].into_iter().enumerate() {
            pixels[i].push(Spectrum::new(c, 0.0, 0.3 * c));
            pixels[i].push(Spectrum::new(1e-9, -c, 2.0));
        }
        pixels[5] = PixelSum::Rounded(PixelEstimate {
            radiance: Spectrum::new(f64::INFINITY, 0.5, -0.0),
            samples: 7,
        });
        SumsFile {
            head: SumsHead {
                picture: 0x12_3456,
                film: FilmSize { w: 10, h: 4 },
                cell: Cell {
                    x0: 1,
                    y0: 2,
                    x1: 4,
                    y1: 4,
                },
                first_sample: 16,
                samples: 2,
                adaptive: false,
            },
            pixels,
        }
    }

    fn written(folder: &Path) -> std::path::PathBuf {
        let path = folder.join("a.sums");
        let part = PartFile::create(&path).expect("a file");
        file().write(&part).expect("it is written");
        path
    }

    #[test]
    fn what_is_written_is_read_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = written(folder.path());
        assert_eq!(SumsFile::read(&path), Ok(file()));
        assert_eq!(SumsHead::read(&path), Ok(file().head));
        let size = std::fs::metadata(&path).expect("it exists").len();
        assert!(size < 500, "{size} bytes");
    }

    /// Bytes at random, with the checksum that fits them: what a mistake of the writer, or somebody,
    /// could have made.
    #[test]
    fn whatever_a_file_contains_it_is_merged_or_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = written(folder.path());
        let whole = std::fs::read(&path).expect("it exists");
        let other = folder.path().join("b.sums");
        let mut next = file();
        (next.head.first_sample, next.head.samples) = (18, 3);
        let part = PartFile::create(&other).expect("a file");
        next.write(&part).expect("it is written");
        let paths = [path.clone(), other];
        let mut merged = 0;
        for seed in 0..2_000 {
            let mut random = kit::PixelSampler::new(0, 0, seed);
            let mut below = |end: usize| (random.next_1d() * end as f64) as usize;
            let mut bytes = whole[..whole.len() - 8].to_vec();
            for _ in 0..1 + below(3) {
                let at = below(bytes.len());
                match below(5) {
                    0 => bytes[at] = below(256) as u8,
                    // The largest number of samples, for example.
                    3 if at + 4 <= bytes.len() => bytes[at..at + 4].fill(0xff),
                    1 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff, b'9'][below(6)],
                    2 => bytes.insert(at, b'9'),
                    _ => drop(bytes.remove(at)),
                }
            }
            let mut checksum = Fingerprint::default();
            checksum.add(&bytes);
            bytes.extend(checksum.value().to_le_bytes());
            std::fs::write(&path, &bytes).expect("it is written");
            if let Ok(file) = crate::merge(&paths) {
                merged += 1;
                for pixel in &file.pixels {
                    let _ = pixel.mean();
                }
            }
        }
        assert!(0 < merged && merged < 2_000, "{merged}");
    }

    #[test]
    fn a_short_file_asks_for_no_memory() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.sums");
        let mut head = file().head;
        head.film = FilmSize {
            w: 10_000,
            h: 10_000,
        };
        head.cell = head.film.whole();
        std::fs::write(&path, head.to_string()).expect("it is written");
        let why = crate::merge(&[path]).expect_err("it is short");
        assert!(why.contains("too short for its pixels"), "{why}");
    }

    /// Every byte matters, and so does every missing one.
    #[test]
    fn a_damaged_file_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = written(folder.path());
        let bytes = std::fs::read(&path).expect("it exists");
        for i in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[i] ^= 0x11;
            std::fs::write(&path, &changed).expect("it is written");
            let read = SumsFile::read(&path).expect_err("it is damaged");
            let expected = ["is damaged", "is not a file of sums", "has a head"];
            assert!(expected.iter().any(|why| read.contains(why)), "{i}: {read}");
            std::fs::write(&path, &bytes[..i]).expect("it is written");
            SumsFile::read(&path).expect_err("it is not whole");
        }
        let mut longer = bytes;
        longer.push(0);
        std::fs::write(&path, longer).expect("it is written");
        SumsFile::read(&path).expect_err("it is too long");
    }
}
