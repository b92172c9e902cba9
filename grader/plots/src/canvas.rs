//! An SVG canvas with coordinates in points.

use crate::style::COLOR_RULES;
use base::GraderError;
use pages::html::escape;
use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::cell::RefCell;
use std::fmt::Write;

/// The drawing area of plotters.
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A position on the canvas in points, from its top left corner.
pub type Position = (f64, f64);

/// Plotters rounds coordinates to integers. This many units are one point, so that lines are
/// smooth.
const UNITS: f64 = 4.0;

/// Plotters writes a font of size 1 as 1/1.24.
const FONT_SIZE: f64 = 1.24;

/// Approximate widths of a letter in a font of size 1.
const LETTER: f64 = 0.56;
const BOLD_LETTER: f64 = 0.63;

/// A canvas.
pub struct Canvas<'a> {
    area: Area<'a>,
    /// SVG elements that show a text when the pointer is over them.
    tips: RefCell<String>,
}

/// The result of a drawing operation.
pub type DrawResult = Result<(), GraderError>;

/// Size, colour and anchor of a text.
#[derive(Clone, Copy)]
pub struct Label {
    /// Font size in points.
    pub size: f64,
    /// Whether it is bold.
    pub bold: bool,
    /// Colour of the letters.
    pub color: RGBColor,
    /// The point of the text that is at its position.
    pub anchor: Pos,
    /// Rotated by 90°, to be read from bottom to top.
    pub upright: bool,
}

impl Label {
    /// Black, anchored at the middle of its left end.
    pub fn left(size: f64) -> Label {
        Label {
            size,
            bold: false,
            color: BLACK,
            anchor: Pos::new(HPos::Left, VPos::Center),
            upright: false,
        }
    }

    /// Black, anchored at its centre.
    pub fn centered(size: f64) -> Label {
        Label {
            anchor: Pos::new(HPos::Center, VPos::Center),
            ..Label::left(size)
        }
    }

    /// Black, anchored at the middle of its right end.
    pub fn right(size: f64) -> Label {
        Label {
            anchor: Pos::new(HPos::Right, VPos::Center),
            ..Label::left(size)
        }
    }

    /// Returns the label in bold.
    pub fn bold(self) -> Label {
        Label { bold: true, ..self }
    }

    /// Returns the label in another colour.
    pub fn in_color(self, color: RGBColor) -> Label {
        Label { color, ..self }
    }

    /// Returns the approximate width of `text` in points.
    pub fn width(&self, text: &str) -> f64 {
        let letter = if self.bold { BOLD_LETTER } else { LETTER };
        text.chars().count() as f64 * self.size * letter
    }
}

/// Returns an SVG element of `w` by `h` points with the content that `draw` draws. `label` is its
/// text for screen readers.
pub fn svg(
    w: f64,
    h: f64,
    label: &str,
    draw: impl FnOnce(&Canvas) -> DrawResult,
) -> Result<String, GraderError> {
    let [units_w, units_h] = [w, h].map(|edge| (edge * UNITS).round() as u32);
    let mut text = String::new();
    let tips;
    {
        let area = SVGBackend::with_string(&mut text, (units_w, units_h)).into_drawing_area();
        let canvas = Canvas {
            area,
            tips: RefCell::new(String::new()),
        };
        draw(&canvas)?;
        canvas.area.present().map_err(failed)?;
        tips = canvas.tips.take();
    }
    // Above everything else, so that the pointer reaches them.
    text = text.replacen("</svg>", &format!("{tips}</svg>"), 1);
    // As wide as the column, but at most `w`.
    let size = format!("width=\"{units_w}\" height=\"{units_h}\"");
    let fluid = format!(
        "class=\"plot\" role=\"img\" aria-label=\"{}\" style=\"width:100%;max-width:{w}pt;height:auto\"",
        escape(label)
    );
    Ok(text.replacen(&size, &fluid, 1))
}

/// Returns HTML with the plot drawn twice: `broad` in points for screens and print, and `narrow`
/// for telephones. `draw` gets the size, and whether it is the narrow one.
pub fn for_both_widths(
    broad: [f64; 2],
    narrow: [f64; 2],
    label: &str,
    draw: impl Fn(&Canvas, [f64; 2], bool) -> DrawResult,
) -> Result<String, GraderError> {
    let drawing = |size: [f64; 2], is_narrow| {
        svg(size[0], size[1], label, |canvas| {
            draw(canvas, size, is_narrow)
        })
    };
    Ok(format!(
        "<div class=\"broad\">{}</div><div class=\"narrow\">{}</div>",
        drawing(broad, false)?,
        drawing(narrow, true)?
    ))
}

/// Returns the first plot of a drawing as an SVG file, black on white or, for readers who prefer
/// that, light on dark.
pub fn file(drawing: &str) -> String {
    let end = drawing.find("</svg>").map_or(drawing.len(), |i| i + 6);
    let start = drawing.find("<svg").unwrap_or(0);
    let element = &drawing[start..end];
    let head = element.find('>').map_or(0, |i| i + 1);
    format!(
        "{}\n<style>svg{{background:#fff}}svg text{{font-family:system-ui,'Liberation Sans',Arial,sans-serif}}\n\
         polyline{{fill:none}}polyline:not([stroke-width]){{stroke-width:4}}.tip{{fill:transparent}}\n\
         @media screen and (prefers-color-scheme:dark){{svg{{background:#16171b}}}}\n{COLOR_RULES}</style>{}\n",
        &element[..head],
        without_defaults(&element[head..])
    )
}

/// The elements without the attributes and blanks that say what is so without them, or what the
/// style says.
fn without_defaults(elements: &str) -> String {
    let shorter = [
        ("<polyline fill=\"none\"", "<polyline"),
        (" stroke-width=\"4\" points=", " points="),
        (" opacity=\"1\"", ""),
        (" font-family=\"sans-serif\"", ""),
        (" fill=\"transparent\"", ""),
        (" \"/>", "\"/>"),
        ("\">\n", "\">"),
        ("\n</text>", "</text>"),
    ];
    shorter
        .iter()
        .fold(elements.to_owned(), |text, (long, short)| {
            text.replace(long, short)
        })
}

fn failed(why: impl std::fmt::Display) -> GraderError {
    GraderError::new(format!("cannot draw a plot: {why}"))
}

fn units((x, y): Position) -> (i32, i32) {
    ((x * UNITS).round() as i32, (y * UNITS).round() as i32)
}

fn stroke(color: RGBColor, width: f64) -> ShapeStyle {
    color.stroke_width((width * UNITS).round().max(1.0) as u32)
}

impl Canvas<'_> {
    /// Shows `text` when the pointer is within `radius` of `center`.
    pub fn tip(&self, center: Position, radius: f64, text: &str) {
        let (x, y) = units(center);
        let _ = writeln!(
            self.tips.borrow_mut(),
            "<circle class=\"tip\" cx=\"{x}\" cy=\"{y}\" r=\"{}\" fill=\"transparent\"><title>{}</title></circle>",
            (radius * UNITS).round(),
            escape(text)
        );
    }

    /// Shows `text` when the pointer is over the rectangle between two corners.
    pub fn tip_over(&self, from: Position, to: Position, text: &str) {
        let ((x, y), (right, bottom)) = (units(from), units(to));
        let _ = writeln!(
            self.tips.borrow_mut(),
            "<rect class=\"tip\" x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{}\" fill=\"transparent\"><title>{}</title></rect>",
            right - x,
            bottom - y,
            escape(text)
        );
    }

    /// Draws a line through `positions`.
    pub fn line(&self, positions: &[Position], color: RGBColor, width: f64) -> DrawResult {
        let positions: Vec<(i32, i32)> = positions.iter().copied().map(units).collect();
        self.area
            .draw(&PathElement::new(positions, stroke(color, width)))
            .map_err(failed)
    }

    /// Draws a dashed line.
    pub fn dashes(
        &self,
        positions: &[Position],
        color: RGBColor,
        width: f64,
        [dash, gap]: [f64; 2],
    ) -> DrawResult {
        let [dash, gap] = [dash, gap].map(|length| (length * UNITS).round() as i32);
        let positions: Vec<(i32, i32)> = positions.iter().copied().map(units).collect();
        let line = DashedPathElement::new(positions, dash, gap, stroke(color, width));
        self.area.draw(&line).map_err(failed)
    }

    /// Draws a filled polygon.
    pub fn polygon(&self, positions: &[Position], color: RGBColor) -> DrawResult {
        let positions: Vec<(i32, i32)> = positions.iter().copied().map(units).collect();
        self.area
            .draw(&Polygon::new(positions, color.filled()))
            .map_err(failed)
    }

    /// Draws a disc, or only its outline if `rim` is the width of the outline.
    pub fn disc(
        &self,
        center: Position,
        radius: f64,
        color: RGBColor,
        rim: Option<f64>,
    ) -> DrawResult {
        let style = rim.map_or(color.filled(), |width| stroke(color, width));
        let radius = (radius * UNITS).round() as i32;
        self.area
            .draw(&Circle::new(units(center), radius, style))
            .map_err(failed)
    }

    /// Draws a filled rectangle between two corners.
    pub fn rectangle(&self, from: Position, to: Position, color: RGBColor) -> DrawResult {
        self.area
            .draw(&Rectangle::new([units(from), units(to)], color.filled()))
            .map_err(failed)
    }

    /// Draws text.
    pub fn text(&self, text: &str, position: Position, label: Label) -> DrawResult {
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
            .draw(&Text::new(text.to_string(), units(position), style))
            .map_err(failed)
    }
}
