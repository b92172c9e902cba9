//! Colours and shapes that are told apart by the colour-blind and on paper without colour.

use super::canvas::{Canvas, Drawn, Place};
use plotters::style::{RGBColor, WHITE};
use std::f64::consts::{FRAC_PI_2, PI};

/// The palette of Okabe and Ito, "Color universal design" (2008), darkest contrasts first; its yellow is too faint for lines
/// on white.
const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(0, 0, 0),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];

/// Bluish green: as it should be.
pub(crate) const GREEN: RGBColor = PALETTE[2];
/// Sky blue: near enough.
pub(crate) const SKY: RGBColor = PALETTE[6];
/// Yellow: not as it should be.
pub(crate) const YELLOW: RGBColor = RGBColor(240, 228, 66);
/// Vermilion: wrong.
pub(crate) const VERMILION: RGBColor = PALETTE[1];
/// Reddish purple: leaks.
pub(crate) const PURPLE: RGBColor = PALETTE[4];
/// Lines to read values by.
pub(crate) const GRID: RGBColor = RGBColor(222, 222, 222);
/// What errors are held against.
pub(crate) const BOUND: RGBColor = RGBColor(170, 170, 170);
/// Axes and what explains.
pub(crate) const INK: RGBColor = RGBColor(60, 60, 60);

/// Dashes and gaps in points; a line without is whole.
const DASHES: [Option<[f64; 2]>; 4] = [None, Some([7.0, 3.0]), Some([2.0, 2.5]), Some([11.0, 2.5])];

/// The shape of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Marker {
    Disc,
    Square,
    Triangle,
    Diamond,
    Down,
    Star,
}

const MARKERS: [Marker; 5] = [
    Marker::Disc,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Down,
];

/// How a series of points looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Look {
    pub(crate) color: RGBColor,
    pub(crate) marker: Marker,
    /// Only the marker's outline is drawn.
    pub(crate) hollow: bool,
    pub(crate) dashes: Option<[f64; 2]>,
}

impl Look {
    /// Of the series number `i`: colour, marker and dashes go round in circles of different lengths, so that no two of the first
    /// dozens are the same.
    pub(crate) fn of(i: usize) -> Look {
        Look {
            color: PALETTE[i % PALETTE.len()],
            marker: MARKERS[i % MARKERS.len()],
            hollow: false,
            dashes: DASHES[i % DASHES.len()],
        }
    }
}

/// Width of the rim around markers, in points.
const RIM: f64 = 0.8;

/// Draws a marker of about `area` square points.
pub(crate) fn marker(canvas: &Canvas, look: Look, center: Place, area: f64) -> Drawn {
    let radius = (area / PI).sqrt();
    if !look.hollow {
        // A white rim keeps markers apart that lie on each other.
        filled(canvas, look.marker, center, radius + RIM, WHITE)?;
        return filled(canvas, look.marker, center, radius, look.color);
    }
    if look.marker == Marker::Disc {
        return canvas.disc(center, radius, look.color, Some(1.5));
    }
    let mut closed = outline(look.marker, center, radius);
    closed.extend_from_within(..1);
    canvas.line(&closed, look.color, 1.5)
}

fn filled(canvas: &Canvas, marker: Marker, center: Place, radius: f64, color: RGBColor) -> Drawn {
    if marker == Marker::Disc {
        canvas.disc(center, radius, color, None)
    } else {
        canvas.polygon(&outline(marker, center, radius), color)
    }
}

/// The corners of a marker whose area is that of a disc of `radius`.
fn outline(marker: Marker, (x, y): Place, radius: f64) -> Vec<Place> {
    // Corners, their distance from the middle, and where the first one is.
    let (corners, out, first) = match marker {
        Marker::Disc => (24, 1.0, 0.0),
        Marker::Square => (4, 1.25, FRAC_PI_2 / 2.0),
        Marker::Diamond => (4, 1.25, 0.0),
        Marker::Triangle => (3, 1.55, -FRAC_PI_2),
        Marker::Down => (3, 1.55, FRAC_PI_2),
        Marker::Star => (10, 1.9, -FRAC_PI_2),
    };
    (0..corners)
        .map(|i| {
            let inner = marker == Marker::Star && i % 2 == 1;
            let out = if inner { 0.45 * out } else { out };
            let angle = first + 2.0 * PI * f64::from(i) / f64::from(corners);
            (
                x + out * radius * angle.cos(),
                y + out * radius * angle.sin(),
            )
        })
        .collect()
}

/// Draws a line as `look` has it.
pub(crate) fn line(canvas: &Canvas, look: Look, places: &[Place], width: f64) -> Drawn {
    match look.dashes {
        None => canvas.line(places, look.color, width),
        Some(dashes) => canvas.dashes(places, look.color, width, dashes),
    }
}

/// White or black, whichever is easier to read on `color` (relative luminance of WCAG 2, linearised by a power).
pub(crate) fn ink_on(color: RGBColor) -> RGBColor {
    let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
    let luminance = 0.2126 * linear(color.0) + 0.7152 * linear(color.1) + 0.0722 * linear(color.2);
    if luminance > 0.18 {
        RGBColor(0, 0, 0)
    } else {
        RGBColor(255, 255, 255)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_are_told_apart() {
        for i in 0..24 {
            for j in 0..i {
                assert_ne!(Look::of(i), Look::of(j), "{i} and {j}");
            }
        }
    }

    #[test]
    fn markers_have_one_size() {
        let area = |marker| {
            let corners = outline(marker, (0.0, 0.0), 1.0);
            let next = corners.iter().cycle().skip(1);
            let twice: f64 = corners
                .iter()
                .zip(next)
                .map(|(a, b)| a.0 * b.1 - a.1 * b.0)
                .sum();
            twice.abs() / 2.0
        };
        for marker in MARKERS {
            assert!(
                (area(marker) / PI - 1.0).abs() < 0.06,
                "{marker:?} {}",
                area(marker)
            );
        }
    }

    #[test]
    fn ink_is_read_on_every_colour() {
        assert_eq!(ink_on(RGBColor(0, 114, 178)), RGBColor(255, 255, 255));
        assert_eq!(ink_on(YELLOW), RGBColor(0, 0, 0));
    }
}
