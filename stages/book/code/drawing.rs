//! Figures as SVG.
//!
//! A figure carries its own colours for light and dark pages and for print, so that it can be read
//! wherever an `img` shows it. Coordinates are those of the figure's maths: x to the right, y up.

use crate::page::escaped;
use kit::{Camera, Vec2, Vec3};
use std::fmt::{Display, Write};

/// Rules that do not depend on a colour, and that every figure has.
const STYLE: &str = "\
.paper{fill:#fff}.line,.dots{fill:none;stroke:currentColor;stroke-width:2;stroke-linejoin:round;stroke-linecap:round}\
[class*=f-],text{fill:currentColor}text{font-family:sans-serif}";

/// Rules of a figure whose elements contain the text before them.
const STYLE_OF: [(&str, &str); 5] = [
    (" dash\"", ".dash{stroke-dasharray:6 5}"),
    ("\"dots ", ".dots{stroke-width:8}"),
    ("\"area ", ".area{fill-opacity:.16}"),
    (
        "\"m ",
        ".m{font-family:serif;font-style:italic;font-size:19px}",
    ),
    ("\"s ", ".s{font-size:13px}"),
];

/// A colour of lines (`blue`), areas (`f-blue`) and text: its class, then lines and text on a light
/// page, then on a dark one. Text needs more contrast.
type Colour = (&'static str, [&'static str; 2], [&'static str; 2]);

/// Lines have the colours of Okabe and Ito, which colour-blind readers can distinguish.
const COLOURS: [Colour; 5] = [
    ("ink", ["#222"; 2], ["#e6e6e6"; 2]),
    ("blue", ["#0072b2"; 2], ["#56b4e9"; 2]),
    ("red", ["#d55e00", "#b34700"], ["#ff8c42"; 2]),
    ("green", ["#00795a"; 2], ["#2fc89b"; 2]),
    ("soft", ["#999", "#666"], ["#8a8a8a", "#a8a8a8"]),
];

/// The rules for the colours that `body` uses: for light pages, dark ones and print.
fn style(body: &str) -> String {
    let (mut light, mut dark) = (STYLE.to_string(), ".paper{fill:#16181d}".to_string());
    let needed = STYLE_OF.iter().filter(|(part, _)| body.contains(part));
    light.extend(needed.map(|(_, rule)| *rule));
    for (class, on_light, on_dark) in COLOURS {
        let uses = [" {}\"", " {} ", "f-{}\""].map(|of| of.replace("{}", class));
        if !uses.iter().any(|of| body.contains(of)) {
            continue;
        }
        for (rules, [line, text]) in [(&mut light, on_light), (&mut dark, on_dark)] {
            *rules += &format!(".{class},.f-{class}{{color:{line}}}");
            if line != text {
                *rules += &format!("text.{class}{{color:{text}}}");
            }
        }
        if class == "soft" {
            light += ".soft{stroke-width:1.2}";
        }
    }
    format!(
        "{light}@media (prefers-color-scheme:dark){{{dark}}}\
         @media print{{.paper{{fill:#fff}}.ink,text{{color:#000}}}}"
    )
}

/// Where a label is, relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// To the left.
    Left,
    /// To the right.
    Right,
    /// Above.
    Above,
    /// Below.
    Below,
    /// On the point.
    Centre,
}

/// A figure that is being drawn.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// Width and height in pixels.
    size: Vec2,
    origin: Vec2,
    scale: Vec2,
    description: String,
    body: String,
}

impl Drawing {
    /// An empty figure of `size` pixels, width and height, that shows the rectangle between two
    /// corners, the lower left one first, with a margin. Both axes have the same scale.
    /// `description` says in words what is shown.
    pub fn new(size: [f64; 2], corners: [Vec2; 2], description: &str) -> Drawing {
        let mut drawing = Drawing::graph(size, corners, description);
        drawing.set_scale(corners, Vec2::splat(drawing.scale.min_element()));
        drawing
    }

    /// Like [`Drawing::new`], but each axis has its own scale: for the graph of a function.
    pub fn graph(size: [f64; 2], corners: [Vec2; 2], description: &str) -> Drawing {
        let size = Vec2::from_array(size);
        let [min, max] = corners;
        let mut drawing = Drawing {
            size,
            origin: Vec2::ZERO,
            scale: Vec2::ONE,
            description: description.to_string(),
            body: String::new(),
        };
        drawing.set_scale(corners, (size - 2.0 * MARGIN) / (max - min));
        drawing
    }

    fn set_scale(&mut self, [min, max]: [Vec2; 2], scale: Vec2) {
        self.scale = scale;
        self.origin = 0.5 * self.size - scale * (0.5 * (min + max));
    }

    /// The position of `p` in pixels from the top left.
    fn place(&self, p: Vec2) -> Vec2 {
        let q = self.origin + self.scale * p;
        Vec2::new(q.x, self.size.y - q.y)
    }

    /// A line from `a` to `b`. `class` is a colour, with `dash` for a dashed line.
    pub fn line(&mut self, a: Vec2, b: Vec2, class: &str) {
        self.path(&[a, b], class);
    }

    /// A line through `points`. Lines of one class that follow each other are one element.
    pub fn path(&mut self, points: &[Vec2], class: &str) {
        let list = self.points(points);
        let start = format!("<path class=\"line {class}\" d=\"");
        let last = self.body.trim_end().rfind('\n').map_or(0, |end| end + 1);
        if self.body[last..].starts_with(&start) {
            self.body.truncate(self.body.len() - "\"/>\n".len());
        } else {
            self.body.push_str(&start);
        }
        let _ = writeln!(self.body, "M{list}\"/>");
    }

    /// A filled area with the corners `points`, without an outline.
    pub fn area(&mut self, points: &[Vec2], colour: &str) {
        let list = self.points(points);
        let _ = writeln!(
            self.body,
            "<polygon class=\"area f-{colour}\" points=\"{list}\"/>"
        );
    }

    /// A line through points that are marked.
    pub fn marked_path(&mut self, points: &[Vec2], colour: &str) {
        self.path(points, colour);
        for p in points {
            self.dot(*p, colour);
        }
    }

    /// A soft line across a graph at each height, from one `x` to another, with words on its left.
    pub fn levels<W: Display>(
        &mut self,
        [from, to]: [f64; 2],
        levels: impl IntoIterator<Item = (f64, W)>,
    ) {
        for (y, words) in levels {
            self.line(Vec2::new(from, y), Vec2::new(to, y), "soft");
            self.note(Vec2::new(from, y), Side::Left, words, "ink");
        }
    }

    /// A filled area with an outline.
    pub fn polygon(&mut self, points: &[Vec2], colour: &str) {
        self.area(points, colour);
        let mut closed = points.to_vec();
        closed.push(points[0]);
        self.path(&closed, colour);
    }

    /// An arrow from `a` to `b`.
    pub fn arrow(&mut self, a: Vec2, b: Vec2, class: &str) {
        self.line(a, b, class);
        let (from, to) = (self.place(a), self.place(b));
        let along = (to - from).normalize_or_zero();
        let across = along.perp();
        let colour = class.split(' ').next().unwrap_or("ink");
        let head = [
            to + along,
            to - 11.0 * along + 4.5 * across,
            to - 11.0 * along - 4.5 * across,
        ];
        let list = head.map(pixel).join(" ");
        let _ = writeln!(
            self.body,
            "<polygon class=\"f-{colour}\" points=\"{list}\"/>"
        );
    }

    /// A dot.
    pub fn dot(&mut self, p: Vec2, colour: &str) {
        let q = self.place(p);
        let _ = writeln!(
            self.body,
            "<circle class=\"f-{colour}\" cx=\"{}\" cy=\"{}\" r=\"4\"/>",
            number(q.x),
            number(q.y)
        );
    }

    /// Many dots of one colour, as a single element.
    pub fn dots(&mut self, points: &[Vec2], colour: &str) {
        let each = points
            .iter()
            .map(|p| format!("M{}h0", pixel(self.place(*p))));
        let list: String = each.collect();
        let _ = writeln!(self.body, "<path class=\"dots {colour}\" d=\"{list}\"/>");
    }

    /// A circle around `centre`; an ellipse on the page if the axes have different scales.
    pub fn circle(&mut self, centre: Vec2, radius: f64, class: &str) {
        let points: Vec<Vec2> = (0..=72).map(|k| centre + radius * turn(k, 72)).collect();
        self.path(&points, class);
    }

    /// An arc around `centre` from the direction `from` to the direction `to`, the short way.
    pub fn arc(&mut self, centre: Vec2, radius: f64, from: Vec2, to: Vec2, class: &str) {
        let start = kit::math::atan2(from.y, from.x);
        let mut sweep = kit::math::atan2(to.y, to.x) - start;
        if sweep > std::f64::consts::PI {
            sweep -= std::f64::consts::TAU;
        }
        if sweep < -std::f64::consts::PI {
            sweep += std::f64::consts::TAU;
        }
        let at = |k: u32| {
            let (sin, cos) = kit::math::sin_cos(start + sweep * f64::from(k) / 24.0);
            centre + radius * Vec2::new(cos, sin)
        };
        let points: Vec<Vec2> = (0..=24).map(at).collect();
        self.path(&points, class);
    }

    /// A symbol beside the point `p`, in italics. The letters and digits after `_` are an
    /// index: `p_0`.
    pub fn label(&mut self, p: Vec2, side: Side, symbol: &str, colour: &str) {
        let mut parts = symbol.split('_');
        let mut text = escape(parts.next().unwrap_or_default());
        for part in parts {
            let end = part
                .find(|c: char| !c.is_alphanumeric())
                .unwrap_or(part.len());
            let (index, rest) = part.split_at(end);
            let _ = write!(
                text,
                "<tspan dy=\"5\" font-size=\"13\">{}</tspan>",
                escape(index)
            );
            if !rest.is_empty() {
                let _ = write!(text, "<tspan dy=\"-5\">{}</tspan>", escape(rest));
            }
        }
        self.text(p, side, &text, &format!("m {colour}"));
    }

    /// Words beside the point `p`.
    pub fn note(&mut self, p: Vec2, side: Side, words: impl Display, colour: &str) {
        self.text(p, side, &escape(&words.to_string()), &format!("s {colour}"));
    }

    fn text(&mut self, p: Vec2, side: Side, markup: &str, class: &str) {
        let q = self.place(p);
        let (shift, anchor) = match side {
            Side::Left => (Vec2::new(-9.0, 5.0), "end"),
            Side::Right => (Vec2::new(9.0, 5.0), "start"),
            Side::Above => (Vec2::new(0.0, -10.0), "middle"),
            Side::Below => (Vec2::new(0.0, 21.0), "middle"),
            Side::Centre => (Vec2::new(0.0, 5.0), "middle"),
        };
        let q = q + shift;
        let _ = writeln!(
            self.body,
            "<text class=\"{class}\" x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\">{markup}</text>",
            number(q.x),
            number(q.y)
        );
    }

    fn points(&self, points: &[Vec2]) -> String {
        let places: Vec<Vec2> = points.iter().map(|p| self.place(*p)).collect();
        let kept: Vec<String> = simplified(&places).into_iter().map(pixel).collect();
        kept.join(" ")
    }

    /// The complete SVG file.
    pub fn finish(self) -> String {
        let [w, h] = self.size.to_array().map(number);
        let description = escape(&self.description);
        let style = style(&self.body);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" \
             role=\"img\">\n<title>{description}</title>\n<style>{style}</style>\n\
             <rect class=\"paper\" width=\"{w}\" height=\"{h}\"/>\n{}</svg>\n",
            self.body
        )
    }
}

/// Distance in pixels between the outermost point of a figure and its edge.
const MARGIN: f64 = 34.0;

/// The `k`th of `n` directions around the circle.
pub fn turn(k: u32, n: u32) -> Vec2 {
    let (sin, cos) = kit::math::sin_cos(std::f64::consts::TAU * f64::from(k) / f64::from(n));
    Vec2::new(cos, sin)
}

/// A parallel projection of space onto the page.
#[derive(Clone, Copy, Debug)]
pub struct View {
    right: Vec3,
    up: Vec3,
}

impl View {
    /// The view from the direction of `from`, with the world's `up` upwards.
    pub fn from(from: Vec3, up: Vec3) -> View {
        let c2w = Camera::look_at(from, Vec3::ZERO, up).expect("the view has a direction");
        View {
            right: c2w.x_axis,
            up: c2w.y_axis,
        }
    }

    /// Where the point `p` is on the page.
    pub fn of(self, p: Vec3) -> Vec2 {
        Vec2::new(p.dot(self.right), p.dot(self.up))
    }
}

/// The line through `points` without those that are not needed to stay within [`TOLERANCE`] of it
/// (Douglas and Peucker, 1973).
fn simplified(points: &[Vec2]) -> Vec<Vec2> {
    let [first, .., last] = points else {
        return points.to_vec();
    };
    let along = (*last - *first).normalize_or_zero();
    let off = |p: Vec2| match along == Vec2::ZERO {
        true => (p - *first).length(),
        false => (p - *first).perp_dot(along).abs(),
    };
    let inner = 1..points.len() - 1;
    let farthest = inner.max_by(|a, b| off(points[*a]).total_cmp(&off(points[*b])));
    match farthest {
        Some(at) if off(points[at]) > TOLERANCE => {
            let mut kept = simplified(&points[..=at]);
            kept.pop();
            kept.extend(simplified(&points[at..]));
            kept
        }
        _ => vec![*first, *last],
    }
}

/// In pixels: less than can be seen.
const TOLERANCE: f64 = 0.2;

/// Rounds to a tenth of a pixel: figures are compared as text.
fn number(x: f64) -> String {
    let tenths = (10.0 * x).round() / 10.0;
    // Not "-0".
    format!("{}", tenths + 0.0)
}

fn pixel(p: Vec2) -> String {
    format!("{},{}", number(p.x), number(p.y))
}

fn escape(text: &str) -> String {
    escaped(text).replace('>', "&gt;")
}
