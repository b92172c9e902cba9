//! An SVG canvas with coordinates in points.

use crate::style::{COLOR_RULES, Color};
use pages::html::escape;
use std::cell::RefCell;
use std::fmt::{self, Write};

/// A position on the canvas in points, from its top left corner.
pub type Position = (f64, f64);

/// Coordinates are written as integers. This many units are one point, so that lines are smooth.
const UNITS: f64 = 4.0;

/// Approximate widths of a letter in a font of size 1.
const LETTER: f64 = 0.56;
const BOLD_LETTER: f64 = 0.63;

/// A canvas.
#[derive(Default)]
pub struct Canvas {
    elements: RefCell<String>,
    /// SVG elements that show a text when the pointer is over them.
    tips: RefCell<String>,
}

/// Which point of a text is at its position, at half the height of its letters.
#[derive(Clone, Copy)]
pub enum Anchor {
    /// The left end.
    Start,
    /// The middle.
    Middle,
    /// The right end.
    End,
}

/// Size, colour and anchor of a text.
#[derive(Clone, Copy)]
pub struct Label {
    /// Font size in points.
    pub size: f64,
    /// Whether it is bold.
    pub bold: bool,
    /// Colour of the letters.
    pub color: Color,
    /// The point of the text that is at its position.
    pub anchor: Anchor,
    /// Rotated by 90°, to be read from bottom to top.
    pub upright: bool,
}

impl Label {
    /// Black, anchored at its left end.
    pub fn left(size: f64) -> Label {
        Label {
            size,
            bold: false,
            color: Color(0, 0, 0),
            anchor: Anchor::Start,
            upright: false,
        }
    }

    /// Black, anchored at its middle.
    pub fn centered(size: f64) -> Label {
        Label {
            anchor: Anchor::Middle,
            ..Label::left(size)
        }
    }

    /// Black, anchored at its right end.
    pub fn right(size: f64) -> Label {
        Label {
            anchor: Anchor::End,
            ..Label::left(size)
        }
    }

    /// Returns the label in bold.
    pub fn bold(self) -> Label {
        Label { bold: true, ..self }
    }

    /// Returns the label in another colour.
    pub fn in_color(self, color: Color) -> Label {
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
pub fn svg(w: f64, h: f64, label: &str, draw: impl FnOnce(&Canvas)) -> String {
    let canvas = Canvas::default();
    draw(&canvas);
    let (units_w, units_h) = units((w, h));
    // As wide as the column, but at most `w`. Tips are above everything else, so that the pointer
    // reaches them.
    format!(
        "<svg class=\"plot\" role=\"img\" aria-label=\"{}\" style=\"width:100%;max-width:{w}pt;height:auto\" \
         viewBox=\"0 0 {units_w} {units_h}\" xmlns=\"http://www.w3.org/2000/svg\" font-family=\"sans-serif\">\n{}{}</svg>\n",
        escape(label),
        canvas.elements.take(),
        canvas.tips.take()
    )
}

/// Returns HTML with the plot drawn twice: `broad` in points for screens and print, and `narrow`
/// for telephones. `draw` gets the size, and whether it is the narrow one.
pub fn for_both_widths(
    broad: [f64; 2],
    narrow: [f64; 2],
    label: &str,
    draw: impl Fn(&Canvas, [f64; 2], bool),
) -> String {
    let drawing = |size: [f64; 2], is_narrow| {
        svg(size[0], size[1], label, |canvas| {
            draw(canvas, size, is_narrow)
        })
    };
    format!(
        "<div class=\"broad\">{}</div><div class=\"narrow\">{}</div>",
        drawing(broad, false),
        drawing(narrow, true)
    )
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
         @media screen and (prefers-color-scheme:dark){{svg{{background:#16171b}}}}\n{COLOR_RULES}</style>{}\n",
        &element[..head],
        &element[head..]
    )
}

fn units((x, y): Position) -> (i32, i32) {
    ((x * UNITS).round() as i32, (y * UNITS).round() as i32)
}

/// A width in units, at least 1.
fn width(points: f64) -> f64 {
    (points * UNITS).round().max(1.0)
}

/// The points of a line or polygon.
fn points(positions: &[Position]) -> String {
    let points = positions.iter().map(|&position| {
        let (x, y) = units(position);
        format!("{x},{y}")
    });
    points.collect::<Vec<_>>().join(" ")
}

impl Canvas {
    /// Adds an element.
    fn add(&self, element: fmt::Arguments<'_>) {
        let _ = self
            .elements
            .borrow_mut()
            .write_fmt(format_args!("{element}\n"));
    }

    /// Shows `text` when the pointer is within `radius` of `center`.
    pub fn tip(&self, center: Position, radius: f64, text: &str) {
        let (x, y) = units(center);
        let _ = writeln!(
            self.tips.borrow_mut(),
            "<circle class=\"tip\" cx=\"{x}\" cy=\"{y}\" r=\"{}\"><title>{}</title></circle>",
            (radius * UNITS).round(),
            escape(text)
        );
    }

    /// Shows `text` when the pointer is over the rectangle between two corners.
    pub fn tip_over(&self, from: Position, to: Position, text: &str) {
        let ((x, y), (right, bottom)) = (units(from), units(to));
        let _ = writeln!(
            self.tips.borrow_mut(),
            "<rect class=\"tip\" x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{}\"><title>{}</title></rect>",
            right - x,
            bottom - y,
            escape(text)
        );
    }

    /// Draws a line through `positions`.
    pub fn line(&self, positions: &[Position], color: Color, thickness: f64) {
        self.add(format_args!(
            "<polyline stroke=\"{color}\" stroke-width=\"{}\" points=\"{}\"/>",
            width(thickness),
            points(positions)
        ));
    }

    /// Draws a dashed line.
    pub fn dashes(
        &self,
        positions: &[Position],
        color: Color,
        thickness: f64,
        [dash, gap]: [f64; 2],
    ) {
        self.add(format_args!(
            "<polyline stroke=\"{color}\" stroke-width=\"{}\" stroke-dasharray=\"{},{}\" points=\"{}\"/>",
            width(thickness),
            width(dash),
            width(gap),
            points(positions)
        ));
    }

    /// Draws a filled polygon.
    pub fn polygon(&self, positions: &[Position], color: Color) {
        let points = points(positions);
        self.add(format_args!(
            "<polygon fill=\"{color}\" points=\"{points}\"/>"
        ));
    }

    /// Draws a disc, or only its outline if `rim` is the width of the outline.
    pub fn disc(&self, center: Position, radius: f64, color: Color, rim: Option<f64>) {
        let paint = match rim {
            None => format!("fill=\"{color}\""),
            Some(rim) => format!(
                "fill=\"none\" stroke=\"{color}\" stroke-width=\"{}\"",
                width(rim)
            ),
        };
        let ((x, y), r) = (units(center), (radius * UNITS).round());
        self.add(format_args!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" {paint}/>"
        ));
    }

    /// Draws a filled rectangle between two corners.
    pub fn rectangle(&self, from: Position, to: Position, color: Color) {
        let ((x, y), (right, bottom)) = (units(from), units(to));
        self.add(format_args!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{}\" fill=\"{color}\"/>",
            right - x,
            bottom - y
        ));
    }

    /// Draws text.
    pub fn text(&self, text: &str, position: Position, label: Label) {
        let (x, y) = units(position);
        let anchor = match label.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let bold = if label.bold {
            " font-weight=\"bold\""
        } else {
            ""
        };
        let turn = match label.upright {
            true => format!(" transform=\"rotate(270,{x},{y})\""),
            false => String::new(),
        };
        self.add(format_args!(
            "<text x=\"{x}\" y=\"{y}\" dy=\"0.5ex\" text-anchor=\"{anchor}\" font-size=\"{}\" fill=\"{}\"{bold}{turn}>{}</text>",
            label.size * UNITS,
            label.color,
            escape(text)
        ));
    }
}
