//! Two pictures side by side: how much they differ.

use crate::picture_layer::Layer;
use kit::{Film, FilmSize};
use pathtracer::{SumsFile, tone};
use picture_files::Pixels;
use pictures::Image;
use std::path::Path;

/// A picture to compare with.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Where it is from.
    pub name: String,
    /// Width and height.
    pub size: FilmSize,
    /// The bytes of its pixels, row by row from the bottom left.
    pub bytes: Vec<[u8; 3]>,
    /// Linear values in the same order, if it has them.
    pub linear: Option<Vec<[f64; 3]>>,
    /// The other layers of its file, if it is an `.exr`.
    pub layers: Vec<Layer>,
}

impl Reference {
    /// The picture that a film shows.
    pub fn of_film(name: &str, film: &Film) -> Reference {
        let pixels = film.pixels().iter().map(|pixel| pixel.radiance);
        Reference {
            name: name.to_owned(),
            size: film.size(),
            bytes: pixels.clone().map(tone::to_bytes).collect(),
            linear: Some(pixels.map(|radiance| radiance.to_array()).collect()),
            layers: Vec::new(),
        }
    }

    /// Reads a picture file: png, jpg, exr or hdr, or a part of a picture, sums. The error is a
    /// sentence.
    pub fn load(path: &Path) -> Result<Reference, String> {
        let name = path.display();
        let ends_in = |end: &str| {
            path.extension()
                .is_some_and(|e| e.eq_ignore_ascii_case(end))
        };
        if ends_in("sums") {
            let sums = SumsFile::read(path).map_err(|why| format!("{name} {why}"))?;
            return Ok(Reference::of_film(&name.to_string(), &sums.film()));
        }
        let bytes = std::fs::read(path).map_err(|why| format!("{name}: {why}"))?;
        let picture =
            picture_files::decode(&bytes, path).map_err(|why| format!("{name}: {why}"))?;
        let [w, h] = picture.size;
        let (linear, bytes) = match picture.pixels {
            Pixels::Linear(pixels) => {
                let pixels = from_bottom(&pixels, w).map(|c| c.map(f64::from));
                let linear: Vec<[f64; 3]> = pixels.collect();
                let bytes = linear.iter().map(|&c| tone::to_bytes(c.into())).collect();
                (Some(linear), bytes)
            }
            Pixels::Srgb(pixels) => (None, from_bottom(&pixels, w).collect()),
        };
        let size = FilmSize { w, h };
        Ok(Reference {
            name: path.display().to_string(),
            size,
            bytes,
            linear,
            layers: match ends_in("exr") {
                true => Layer::load(path, size)?,
                false => Vec::new(),
            },
        })
    }

    /// The picture with its rows from the top.
    pub fn image(&self) -> Image {
        Image::from_fn([self.size.w, self.size.h], |x, y| {
            self.get(x, self.size.h - 1 - y)
        })
    }

    /// The radiance of the pixel in column `x` and row `y`, from the bottom left, if the picture
    /// has it.
    pub fn radiance(&self, x: u32, y: u32) -> Option<[f64; 3]> {
        let linear = self.linear.as_ref()?;
        linear
            .get(y as usize * self.size.w as usize + x as usize)
            .copied()
    }

    /// The bytes of the pixel in column `x` and row `y`, from the bottom left.
    pub fn get(&self, x: u32, y: u32) -> [u8; 3] {
        self.bytes[y as usize * self.size.w as usize + x as usize]
    }
}

/// The pixels of a file, whose rows of `w` start at the top, with the rows from the bottom.
fn from_bottom<P: Copy>(pixels: &[P], w: u32) -> impl Iterator<Item = P> {
    pixels.chunks(w as usize).rev().flatten().copied()
}

/// How much two pictures of one size differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Pixels with another byte.
    pub pixels: usize,
    /// The largest difference of two bytes.
    pub largest: u8,
    /// The root mean square of the differences of bytes.
    pub rmse: f64,
    /// The peak signal-to-noise ratio of the bytes in decibels; infinite for equal pictures.
    pub psnr: f64,
    /// The mean of `(a - b)² / (b² + 0.01)` over linear channels, as in the literature on
    /// denoising (Rousselle et al., "Adaptive sampling and reconstruction using greedy error
    /// minimization", 2011); `None` if one picture has only bytes.
    pub relative_mse: Option<f64>,
}

/// The number that keeps dark pixels from dominating [`Difference::relative_mse`].
const DARK: f64 = 0.01;

impl Difference {
    /// Compares `a` with the reference `b`; `None` if the sizes differ.
    pub fn of(a: &Reference, b: &Reference) -> Option<Difference> {
        if a.size != b.size {
            return None;
        }
        let differences = |(a, b): (&[u8; 3], &[u8; 3])| [0, 1, 2].map(|c| a[c].abs_diff(b[c]));
        let by_pixel = a.bytes.iter().zip(&b.bytes).map(differences);
        let pixels = by_pixel.clone().filter(|d| *d != [0; 3]).count();
        let largest = by_pixel.clone().flatten().max().unwrap_or(0);
        let squares: f64 = by_pixel.flatten().map(|d| f64::from(d).powi(2)).sum();
        let rmse = (squares / (3 * a.bytes.len()).max(1) as f64).sqrt();
        let relative_mse = a.linear.as_ref().zip(b.linear.as_ref()).map(|(a, b)| {
            let pairs = a.iter().flatten().zip(b.iter().flatten());
            let errors = pairs.map(|(a, b)| (a - b).powi(2) / (b.powi(2) + DARK));
            errors.sum::<f64>() / (3 * a.len()).max(1) as f64
        });
        Some(Difference {
            pixels,
            largest,
            rmse,
            psnr: 20.0 * (255.0 / rmse).log10(),
            relative_mse,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{PixelEstimate, Spectrum};

    fn film(values: [f64; 2]) -> Reference {
        let mut film = Film::new(FilmSize { w: 2, h: 1 });
        for (x, value) in (0..).zip(values) {
            let radiance = Spectrum::grey(value);
            film.set(
                x,
                0,
                PixelEstimate {
                    radiance,
                    samples: 1,
                },
            );
        }
        Reference::of_film("film", &film)
    }

    #[test]
    fn equal_pictures_do_not_differ() {
        let difference = Difference::of(&film([0.1, 0.5]), &film([0.1, 0.5])).expect("one size");
        assert_eq!((difference.pixels, difference.largest), (0, 0));
        assert_eq!(
            (difference.psnr, difference.relative_mse),
            (f64::INFINITY, Some(0.0))
        );
    }

    #[test]
    fn errors_are_those_of_the_formulas() {
        // Bytes 0 and 255, against 0 and 0.
        let difference = Difference::of(&film([0.0, 1.0]), &film([0.0, 0.0])).expect("one size");
        assert_eq!((difference.pixels, difference.largest), (1, 255));
        assert!((difference.rmse - 255.0 / 2.0_f64.sqrt()).abs() < 1e-9);
        assert!((difference.psnr - 10.0 * 2.0_f64.log10()).abs() < 1e-9);
        assert!((difference.relative_mse.expect("linear") - 50.0).abs() < 1e-9);
    }

    #[test]
    fn other_sizes_have_no_difference() {
        let one = Reference::of_film("one", &Film::new(FilmSize { w: 1, h: 1 }));
        assert_eq!(Difference::of(&one, &film([0.0, 0.0])), None);
    }
}
