//! The film: an array of pixels with the origin at the bottom left, divided into tiles.

use crate::Spectrum;

/// Width and height of a film in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FilmSize {
    /// Pixels from left to right.
    pub w: u32,
    /// Pixels from bottom to top.
    pub h: u32,
}

/// The result of sampling one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelEstimate {
    /// Mean radiance over the pixel.
    pub radiance: Spectrum,
    /// Number of camera samples.
    pub samples: u32,
}

/// A rectangle of pixels, `x0 <= x < x1` and `y0 <= y < y1`.
///
/// ```
/// use kit::FilmSize;
/// let film = FilmSize { w: 3, h: 2 }.whole();
/// assert_eq!(film.area(), 6);
/// assert_eq!(film.pixels().last(), Some((2, 1)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// First column.
    pub x0: u32,
    /// First row, counted from the bottom.
    pub y0: u32,
    /// One past the last column.
    pub x1: u32,
    /// One past the last row.
    pub y1: u32,
}

/// A rendered image: one estimate for each pixel, row by row from the bottom left.
///
/// ```
/// use kit::{Film, FilmSize, PixelEstimate, Spectrum};
/// let mut film = Film::new(FilmSize { w: 40, h: 20 });
/// let grey = PixelEstimate {
///     radiance: Spectrum::grey(0.5),
///     samples: 4,
/// };
/// film.set(39, 0, grey); // bottom right
/// assert_eq!(film.get(39, 0), grey);
/// assert_eq!(film.size().whole().tiles().len(), 3 * 2);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    size: FilmSize,
    pixels: Vec<PixelEstimate>,
}

/// Edge of a tile in pixels. Small enough to keep all threads busy until the end.
const TILE: u32 = 16;

impl Film {
    /// A black film.
    pub fn new(size: FilmSize) -> Film {
        Film {
            size,
            pixels: vec![PixelEstimate::default(); size.w as usize * size.h as usize],
        }
    }

    /// Width and height.
    pub fn size(&self) -> FilmSize {
        self.size
    }

    /// The pixel in column `x` and row `y`, counted from the bottom left. Panics outside the film.
    pub fn get(&self, x: u32, y: u32) -> PixelEstimate {
        self.pixels[self.index(x, y)]
    }

    /// Sets the pixel in column `x` and row `y`, counted from the bottom left. Panics outside the
    /// film.
    pub fn set(&mut self, x: u32, y: u32, pixel: PixelEstimate) {
        let i = self.index(x, y);
        self.pixels[i] = pixel;
    }

    /// All pixels, row by row from the bottom left.
    pub fn pixels(&self) -> &[PixelEstimate] {
        &self.pixels
    }

    fn index(&self, x: u32, y: u32) -> usize {
        assert!(
            x < self.size.w && y < self.size.h,
            "pixel ({x}, {y}) is outside of the film, which has {:?}",
            self.size
        );
        y as usize * self.size.w as usize + x as usize
    }
}

impl FilmSize {
    /// The whole film as one cell.
    pub fn whole(self) -> Cell {
        Cell {
            x0: 0,
            y0: 0,
            x1: self.w,
            y1: self.h,
        }
    }
}

impl Cell {
    /// The tiles that cover the cell. They lie at multiples of 16 pixels on the film, whatever the
    /// cell.
    pub fn tiles(self) -> Vec<Cell> {
        let starts = |a: u32, b: u32| (a / TILE * TILE..b).step_by(TILE as usize);
        starts(self.y0, self.y1)
            .flat_map(|y0| starts(self.x0, self.x1).map(move |x0| (x0, y0)))
            .map(|(x0, y0)| Cell {
                x0: x0.max(self.x0),
                y0: y0.max(self.y0),
                x1: self.x1.min(x0.saturating_add(TILE)),
                y1: self.y1.min(y0.saturating_add(TILE)),
            })
            .collect()
    }

    /// The pixels, row by row from the bottom left.
    pub fn pixels(self) -> impl Iterator<Item = (u32, u32)> {
        (self.y0..self.y1).flat_map(move |y| (self.x0..self.x1).map(move |x| (x, y)))
    }

    /// Number of pixels.
    pub fn area(self) -> u64 {
        u64::from(self.x1 - self.x0) * u64::from(self.y1 - self.y0)
    }
}
