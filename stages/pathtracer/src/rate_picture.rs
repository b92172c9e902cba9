//! The picture of the sampling rate (`-a`): how many samples each pixel took.

use adaptive::rate_colour;
use kit::Film;
use kit::film::Cell;

/// The colours of a sampling rate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RateScale {
    /// Viridis (Smith, van der Walt, 2015), from dark blue over green to yellow: its brightness
    /// rises evenly, so that it reads the same without colour vision and in grey. With a legend.
    #[default]
    Viridis,
    /// The assignment's: blue, green, red, without a legend.
    Assignment,
}

/// A picture as bytes, row by row from the top left, three bytes for each pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bytes {
    /// Pixels from left to right.
    pub w: u32,
    /// Pixels from top to bottom.
    pub h: u32,
    /// Red, green and blue of each pixel.
    pub rgb: Vec<u8>,
}

/// Shows the number of samples of each pixel of `cell`, of at most `ns_aa`, as a colour of `scale`.
///
/// With a legend the picture is higher by [`LEGEND_HEIGHT`], and at least [`LEGEND_WIDTH`] wide.
pub fn rate_picture(film: &Film, cell: Cell, ns_aa: u32, scale: RateScale) -> Bytes {
    let (w, h) = (cell.x1 - cell.x0, cell.y1 - cell.y0);
    let mut picture = match scale {
        RateScale::Assignment => Bytes::filled(w, h, [0; 3]),
        RateScale::Viridis => Bytes::filled(w.max(LEGEND_WIDTH), h + LEGEND_HEIGHT, PAPER),
    };
    for (x, y) in cell.pixels() {
        let samples = film.get(x, y).samples;
        let color = match scale {
            RateScale::Assignment => rate_colour(samples, ns_aa).to_array().map(to_byte),
            RateScale::Viridis => viridis(f64::from(samples) / f64::from(ns_aa.max(1))),
        };
        picture.set(x - cell.x0, cell.y1 - 1 - y, color);
    }
    if scale == RateScale::Viridis {
        draw_legend(&mut picture, h, ns_aa);
    }
    picture
}

impl Bytes {
    fn filled(w: u32, h: u32, color: [u8; 3]) -> Bytes {
        Bytes {
            w,
            h,
            rgb: color.repeat(w as usize * h as usize),
        }
    }

    fn set(&mut self, x: u32, y: u32, color: [u8; 3]) {
        let i = 3 * (y as usize * self.w as usize + x as usize);
        self.rgb[i..i + 3].copy_from_slice(&color);
    }
}

fn to_byte(c: f64) -> u8 {
    (255.0 * c).round() as u8
}

/// The colours of viridis at equal steps, as bytes.
const VIRIDIS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 45, 123],
    [59, 82, 139],
    [44, 114, 142],
    [33, 145, 140],
    [40, 174, 128],
    [94, 201, 98],
    [173, 220, 48],
    [253, 231, 37],
];

/// The colour of a share of the samples, in [0, 1]: interpolated linearly between nine steps.
pub fn viridis(share: f64) -> [u8; 3] {
    let steps = VIRIDIS.len() - 1;
    let place = share.clamp(0.0, 1.0) * steps as f64;
    let i = (place as usize).min(steps - 1);
    let t = place - i as f64;
    std::array::from_fn(|c| {
        let (a, b) = (f64::from(VIRIDIS[i][c]), f64::from(VIRIDIS[i + 1][c]));
        (a + t * (b - a)).round() as u8
    })
}

/// The height of the legend in pixels.
pub const LEGEND_HEIGHT: u32 = 36;
/// The width of the narrowest legend in pixels: room for three numbers of seven digits.
pub const LEGEND_WIDTH: u32 = 280;

const PAPER: [u8; 3] = [255; 3];
const INK: [u8; 3] = [40; 3];
/// The distance of the legend from the edges.
const MARGIN: u32 = 8;
/// The height of the bar of colours.
const BAR: u32 = 8;
/// The edge of a dot of a digit in pixels.
const DOT: u32 = 2;
/// The distance from a digit to the next one: three dots and a gap.
const ADVANCE: u32 = 4 * DOT;

/// Below row `top`: a bar of all colours, and under it the numbers of samples of its ends and its
/// middle.
fn draw_legend(picture: &mut Bytes, top: u32, ns_aa: u32) {
    let (left, right) = (MARGIN, picture.w - MARGIN);
    for x in left..right {
        let share = f64::from(x - left) / f64::from(right - 1 - left);
        for y in 0..BAR {
            picture.set(x, top + MARGIN + y, viridis(share));
        }
    }
    let y = top + MARGIN + BAR + 4;
    let width = |text: &str| text.len() as u32 * ADVANCE - DOT;
    let most = ns_aa.to_string();
    draw_number(picture, (left, y), "0");
    draw_number(picture, (right - width(&most), y), &most);
    if ns_aa.is_multiple_of(2) {
        let half = (ns_aa / 2).to_string();
        draw_number(picture, (picture.w / 2 - width(&half) / 2, y), &half);
    }
}

/// The digits in rows of three dots, from the top; the highest of the three bits is on the left.
const DIGITS: [[u8; 5]; 10] = [
    [0b111, 0b101, 0b101, 0b101, 0b111],
    [0b010, 0b110, 0b010, 0b010, 0b111],
    [0b111, 0b001, 0b111, 0b100, 0b111],
    [0b111, 0b001, 0b111, 0b001, 0b111],
    [0b101, 0b101, 0b111, 0b001, 0b001],
    [0b111, 0b100, 0b111, 0b001, 0b111],
    [0b111, 0b100, 0b111, 0b101, 0b111],
    [0b111, 0b001, 0b001, 0b010, 0b010],
    [0b111, 0b101, 0b111, 0b101, 0b111],
    [0b111, 0b101, 0b111, 0b001, 0b111],
];

/// Draws a number with its top left corner at `(x, y)`.
fn draw_number(picture: &mut Bytes, (x, y): (u32, u32), number: &str) {
    let digits = number.chars().filter_map(|digit| digit.to_digit(10));
    for (i, digit) in digits.enumerate() {
        let rows = DIGITS[digit as usize].iter().zip(0..);
        for (row, dy) in rows.flat_map(|(row, dy)| (0..DOT).map(move |d| (row, dy * DOT + d))) {
            for dx in (0..3 * DOT).filter(|dx| row >> (2 - dx / DOT) & 1 == 1) {
                picture.set(x + i as u32 * ADVANCE + dx, y + dy, INK);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{FilmSize, PixelEstimate, Spectrum};

    fn film(w: u32, h: u32, samples: impl Fn(u32, u32) -> u32) -> Film {
        let size = FilmSize { w, h };
        let mut film = Film::new(size);
        for (x, y) in size.whole().pixels() {
            let pixel = PixelEstimate {
                radiance: Spectrum::BLACK,
                samples: samples(x, y),
            };
            film.set(x, y, pixel);
        }
        film
    }

    fn at(picture: &Bytes, x: u32, y: u32) -> [u8; 3] {
        let i = 3 * (y * picture.w + x) as usize;
        [picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]]
    }

    #[test]
    fn rows_start_at_the_top() {
        let film = film(300, 4, |x, y| if (x, y) == (1, 3) { 64 } else { 0 });
        let cell = film.size().whole();
        let safe = rate_picture(&film, cell, 64, RateScale::Viridis);
        assert_eq!((safe.w, safe.h), (300, 4 + LEGEND_HEIGHT));
        assert_eq!(at(&safe, 1, 0), [253, 231, 37]);
        assert_eq!(at(&safe, 1, 3), [68, 1, 84]);
        let assignment = rate_picture(&film, cell, 64, RateScale::Assignment);
        assert_eq!((assignment.w, assignment.h), (300, 4));
        assert_eq!(at(&assignment, 1, 0), [255, 0, 0]);
        assert_eq!(at(&assignment, 0, 0), [0, 0, 255]);
    }

    /// The ends of the bar are the colours of no and of all samples, and numbers are below it.
    #[test]
    fn the_legend_shows_the_whole_scale() {
        let film = film(2, 1, |_, _| 1);
        for ns_aa in [1, 7, 64, 1_048_576] {
            let picture = rate_picture(&film, film.size().whole(), ns_aa, RateScale::Viridis);
            assert_eq!(picture.w, LEGEND_WIDTH);
            let bar = 1 + MARGIN;
            assert_eq!(at(&picture, MARGIN, bar), VIRIDIS[0]);
            assert_eq!(at(&picture, LEGEND_WIDTH - MARGIN - 1, bar), VIRIDIS[8]);
            let ink = picture.rgb.chunks(3).filter(|pixel| *pixel == INK);
            assert!(ink.count() > 2 * 7 * (DOT * DOT) as usize, "{ns_aa}");
        }
    }

    /// What makes the scale readable without colour vision.
    #[test]
    fn brightness_rises_with_every_step() {
        let luma = |share: f64| {
            let [r, g, b] = viridis(share).map(|c| (f64::from(c) / 255.0).powf(2.2));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for step in 0..64 {
            let (a, b) = (f64::from(step) / 64.0, f64::from(step + 1) / 64.0);
            assert!(luma(a) < luma(b), "from {a} to {b}");
        }
    }
}
