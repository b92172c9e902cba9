//! Colours, markers and dashes that can be distinguished by colour-blind readers and in print
//! without colour.

use crate::canvas::{Canvas, Position};
use pictures::image::Rgb;
use pictures::palette;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

/// Red, green and blue of an sRGB colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub u8, pub u8, pub u8);

impl fmt::Display for Color {
    /// As in CSS: "#0072B2".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Color(r, g, b) = self;
        write!(f, "#{r:02X}{g:02X}{b:02X}")
    }
}

/// CSS rules that replace the colours of text, and those of plots on a dark page.
pub const COLOR_RULES: &str = include_str!("colors.css");

const fn of([r, g, b]: Rgb) -> Color {
    Color(r, g, b)
}

/// The colours of lines, strongest contrasts first. Yellow has too little contrast on white.
const PALETTE: [Color; 7] = [
    of(palette::BLUE),
    VERMILION,
    GREEN,
    Color(0, 0, 0),
    PURPLE,
    of(palette::ORANGE),
    SKY,
];

/// Bluish green: correct.
pub const GREEN: Color = of(palette::GREEN);
/// Sky blue: within the bound.
pub const SKY: Color = of(palette::SKY_BLUE);
/// Yellow: beyond the bound.
pub const YELLOW: Color = of(palette::YELLOW);
/// Vermilion: wrong.
pub const VERMILION: Color = of(palette::VERMILION);
/// Reddish purple: leaks.
pub const PURPLE: Color = of(palette::PURPLE);
/// Grid lines.
pub const GRID: Color = Color(222, 222, 222);
/// Error bounds.
pub const BOUND: Color = Color(170, 170, 170);
/// Axes and annotations.
pub const INK: Color = Color(60, 60, 60);

/// Lengths of dashes and gaps in points; `None` is a solid line.
const DASHES: [Option<[f64; 2]>; 4] = [None, Some([7.0, 3.0]), Some([2.0, 2.5]), Some([11.0, 2.5])];

/// The shape of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Disc,
    /// A square.
    Square,
    /// A triangle on its base.
    Triangle,
    /// A square on its corner.
    Diamond,
    /// A triangle on its corner.
    Down,
    /// A star of five points.
    Star,
}

const MARKERS: [Marker; 5] = [
    Marker::Disc,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Down,
];

/// Colour, marker and dashes of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeriesStyle {
    /// Colour of line and markers.
    pub color: Color,
    /// Shape of the markers.
    pub marker: Marker,
    /// Whether only the marker's outline is drawn.
    pub hollow: bool,
    /// Lengths of a dash and a gap in points; `None` is a solid line.
    pub dashes: Option<[f64; 2]>,
}

impl SeriesStyle {
    /// Returns the style of series `i`. Colours, markers and dashes repeat with different periods,
    /// so that the first dozens of styles are all different.
    pub fn of(i: usize) -> SeriesStyle {
        SeriesStyle {
            color: PALETTE[i % PALETTE.len()],
            marker: MARKERS[i % MARKERS.len()],
            hollow: false,
            dashes: DASHES[i % DASHES.len()],
        }
    }

    /// Returns the style with this marker, filled or not, and with solid lines.
    pub fn marked(self, marker: Marker, hollow: bool) -> SeriesStyle {
        SeriesStyle {
            marker,
            hollow,
            dashes: None,
            ..self
        }
    }
}

/// Width of the rim around markers, in points.
const RIM: f64 = 0.8;

/// Draws a marker with an area of about `area` square points.
pub fn marker(canvas: &Canvas, style: SeriesStyle, center: Position, area: f64) {
    let radius = (area / PI).sqrt();
    if !style.hollow {
        // A white outline separates overlapping markers.
        filled(
            canvas,
            style.marker,
            center,
            radius + RIM,
            Color(255, 255, 255),
        );
        return filled(canvas, style.marker, center, radius, style.color);
    }
    if style.marker == Marker::Disc {
        return canvas.disc(center, radius, style.color, Some(1.5));
    }
    let mut closed = outline(style.marker, center, radius);
    closed.extend_from_within(..1);
    canvas.line(&closed, style.color, 1.5)
}

fn filled(canvas: &Canvas, marker: Marker, center: Position, radius: f64, color: Color) {
    if marker == Marker::Disc {
        canvas.disc(center, radius, color, None)
    } else {
        canvas.polygon(&outline(marker, center, radius), color)
    }
}

/// Returns the corners of a marker with the area of a disc of `radius`.
fn outline(marker: Marker, (x, y): Position, radius: f64) -> Vec<Position> {
    // Number of corners, their distance from the centre, and the angle of the first one.
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

/// Draws a line in this style.
pub fn line(canvas: &Canvas, style: SeriesStyle, positions: &[Position], width: f64) {
    match style.dashes {
        None => canvas.line(positions, style.color, width),
        Some(dashes) => canvas.dashes(positions, style.color, width, dashes),
    }
}

/// Black on a coloured background: a dark page, which replaces black, leaves this black alone.
const BLACK_ON_COLOR: Color = Color(1, 1, 1);
/// White on a coloured background.
const WHITE_ON_COLOR: Color = Color(254, 254, 254);

/// Returns white or black, whichever has more contrast on `color` (relative luminance of WCAG 2,
/// linearised by a power).
pub fn text_color_on(color: Color) -> Color {
    let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
    let luminance = 0.2126 * linear(color.0) + 0.7152 * linear(color.1) + 0.0722 * linear(color.2);
    if luminance > 0.18 {
        BLACK_ON_COLOR
    } else {
        WHITE_ON_COLOR
    }
}

/// Returns `color` on white, from a faint tint for 0 to the full colour for 1.
pub fn tint(color: Color, strength: f64) -> Color {
    let strength = FAINTEST + (1.0 - FAINTEST) * strength.clamp(0.0, 1.0);
    let mix = |c: u8| (255.0 + (f64::from(c) - 255.0) * strength).round() as u8;
    Color(mix(color.0), mix(color.1), mix(color.2))
}

/// The strength of the faintest tint that can be told from white.
const FAINTEST: f64 = 0.18;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_of_series_differ() {
        for i in 0..24 {
            for j in 0..i {
                assert_ne!(SeriesStyle::of(i), SeriesStyle::of(j), "{i} and {j}");
            }
        }
    }

    #[test]
    fn markers_have_equal_areas() {
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
    fn text_contrasts_with_its_background() {
        assert_eq!(text_color_on(Color(0, 114, 178)), WHITE_ON_COLOR);
        assert_eq!(text_color_on(YELLOW), BLACK_ON_COLOR);
    }
}
