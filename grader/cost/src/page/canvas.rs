//! Drawing into an SVG, in points.

use grader::error::GraderError;
use pages::html::escape;
use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Where to draw.
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A place on the canvas in points, from its top left corner.
pub(crate) type Place = (f64, f64);

/// The library rounds to whole units: so many of them make a point, for lines without steps.
const UNITS: f64 = 4.0;

/// What the library calls a font of size 1 it writes as 1/1.24.
const FONT_SIZE: f64 = 1.24;

/// A font of size 1 takes about so much room a letter.
const LETTER: f64 = 0.56;

/// A canvas.
pub(crate) struct Canvas<'a> {
    area: Area<'a>,
}

/// Why something was not drawn.
pub(crate) type Drawn = Result<(), GraderError>;

/// Text and where its place is in it.
#[derive(Clone, Copy)]
pub(crate) struct Label {
    /// In points.
    pub(crate) size: f64,
    pub(crate) bold: bool,
    pub(crate) color: RGBColor,
    pub(crate) anchor: Pos,
    /// Read from below to above.
    pub(crate) upright: bool,
}

impl Label {
    /// Black, its place at the middle of its left end.
    pub(crate) fn left(size: f64) -> Label {
        Label {
            size,
            bold: false,
            color: BLACK,
            anchor: Pos::new(HPos::Left, VPos::Center),
            upright: false,
        }
    }

    /// Black, its place in its middle.
    pub(crate) fn centered(size: f64) -> Label {
        Label {
            anchor: Pos::new(HPos::Center, VPos::Center),
            ..Label::left(size)
        }
    }

    /// Black, its place at the middle of its right end.
    pub(crate) fn right(size: f64) -> Label {
        Label {
            anchor: Pos::new(HPos::Right, VPos::Center),
            ..Label::left(size)
        }
    }

    /// The same in bold.
    pub(crate) fn bold(self) -> Label {
        Label { bold: true, ..self }
    }

    /// The same in another colour.
    pub(crate) fn in_color(self, color: RGBColor) -> Label {
        Label { color, ..self }
    }

    /// About how wide `text` is, in points.
    pub(crate) fn width(&self, text: &str) -> f64 {
        text.chars().count() as f64 * self.size * LETTER
    }
}

/// An SVG element `w` by `h` points large that `draw` draws; `says` is read out to who cannot see it.
pub(crate) fn svg(
    w: f64,
    h: f64,
    says: &str,
    draw: impl FnOnce(&Canvas) -> Drawn,
) -> Result<String, GraderError> {
    let [units_w, units_h] = [w, h].map(|edge| (edge * UNITS).round() as u32);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (units_w, units_h)).into_drawing_area();
        let canvas = Canvas { area };
        draw(&canvas)?;
        canvas.area.present().map_err(failed)?;
    }
    // As wide as its place on the page, and no wider than it was made for.
    let size = format!("width=\"{units_w}\" height=\"{units_h}\"");
    let fluid = format!(
        "role=\"img\" aria-label=\"{}\" style=\"width:100%;max-width:{w}pt;height:auto;background:#fff\"",
        escape(says)
    );
    Ok(text.replacen(&size, &fluid, 1))
}

fn failed(why: impl std::fmt::Display) -> GraderError {
    GraderError::new(format!("cannot draw a plot: {why}"))
}

fn units((x, y): Place) -> (i32, i32) {
    ((x * UNITS).round() as i32, (y * UNITS).round() as i32)
}

fn stroke(color: RGBColor, width: f64) -> ShapeStyle {
    color.stroke_width((width * UNITS).round().max(1.0) as u32)
}

impl Canvas<'_> {
    /// A line through `places`.
    pub(crate) fn line(&self, places: &[Place], color: RGBColor, width: f64) -> Drawn {
        let places: Vec<(i32, i32)> = places.iter().copied().map(units).collect();
        self.area
            .draw(&PathElement::new(places, stroke(color, width)))
            .map_err(failed)
    }

    /// A line of dashes and gaps.
    pub(crate) fn dashes(
        &self,
        places: &[Place],
        color: RGBColor,
        width: f64,
        [dash, gap]: [f64; 2],
    ) -> Drawn {
        let [dash, gap] = [dash, gap].map(|length| (length * UNITS).round() as i32);
        let places: Vec<(i32, i32)> = places.iter().copied().map(units).collect();
        let line = DashedPathElement::new(places, dash, gap, stroke(color, width));
        self.area.draw(&line).map_err(failed)
    }

    /// A filled shape.
    pub(crate) fn polygon(&self, places: &[Place], color: RGBColor) -> Drawn {
        let places: Vec<(i32, i32)> = places.iter().copied().map(units).collect();
        self.area
            .draw(&Polygon::new(places, color.filled()))
            .map_err(failed)
    }

    /// A disc, or with a width of its rim only that.
    pub(crate) fn disc(
        &self,
        center: Place,
        radius: f64,
        color: RGBColor,
        rim: Option<f64>,
    ) -> Drawn {
        let style = rim.map_or(color.filled(), |width| stroke(color, width));
        let radius = (radius * UNITS).round() as i32;
        self.area
            .draw(&Circle::new(units(center), radius, style))
            .map_err(failed)
    }

    /// A filled rectangle between two corners.
    pub(crate) fn rectangle(&self, from: Place, to: Place, color: RGBColor) -> Drawn {
        self.area
            .draw(&Rectangle::new([units(from), units(to)], color.filled()))
            .map_err(failed)
    }

    /// Text.
    pub(crate) fn text(&self, text: &str, place: Place, label: Label) -> Drawn {
        let size = label.size * UNITS * FONT_SIZE;
        let weight = if label.bold {
            FontStyle::Bold
        } else {
            FontStyle::Normal
        };
        let turn = if label.upright {
            FontTransform::Rotate270
        } else {
            FontTransform::None
        };
        let font = FontDesc::new(FontFamily::SansSerif, size, weight).transform(turn);
        let style = TextStyle::from(font).color(&label.color).pos(label.anchor);
        self.area
            .draw(&Text::new(text.to_string(), units(place), style))
            .map_err(failed)
    }
}
