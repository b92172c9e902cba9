//! Figures as SVG.
//!
//! A figure carries its own colours for light and dark pages and for print, so that it can be read
//! wherever an `img` shows it. Coordinates are those of the figure's maths: x to the right, y up.

use kit::{Camera, Vec2, Vec3};
use std::fmt::Write;

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

/// A colour of lines (`blue`), areas (`f-blue`) and text, on a light and on a dark page. Lines have
/// the colours of Okabe and Ito, which colour-blind readers can distinguish.
struct Colour {
    class: &'static str,
    light: &'static str,
    /// Of text, which needs more contrast.
    light_text: &'static str,
    dark: &'static str,
    dark_text: &'static str,
}

const COLOURS: [Colour; 5] = [
    Colour {
        class: "ink",
        light: "#222",
        light_text: "#222",
        dark: "#e6e6e6",
        dark_text: "#e6e6e6",
    },
    Colour {
        class: "blue",
        light: "#0072b2",
        light_text: "#0072b2",
        dark: "#56b4e9",
        dark_text: "#56b4e9",
    },
    Colour {
        class: "red",
        light: "#d55e00",
        light_text: "#b34700",
        dark: "#ff8c42",
        dark_text: "#ff8c42",
    },
    Colour {
        class: "green",
        light: "#00795a",
        light_text: "#00795a",
        dark: "#2fc89b",
        dark_text: "#2fc89b",
    },
    Colour {
        class: "soft",
        light: "#999",
        light_text: "#666",
        dark: "#8a8a8a",
        dark_text: "#a8a8a8",
    },
];

/// The rules for the colours that `body` uses: for light pages, dark ones and print.
fn style(body: &str) -> String {
    let used = |class: &str| {
        [
            format!(" {class}\""),
            format!(" {class} "),
            format!("f-{class}\""),
        ]
        .iter()
        .any(|use_of| body.contains(use_of.as_str()))
    };
    let (mut light, mut dark) = (STYLE.to_string(), ".paper{fill:#16181d}".to_string());
    let needed = STYLE_OF.iter().filter(|(part, _)| body.contains(part));
    light.extend(needed.map(|(_, rule)| *rule));
    for colour in COLOURS.iter().filter(|colour| used(colour.class)) {
        let class = colour.class;
        let rules = |line: &str, text: &str| {
            let of_text = match line == text {
                true => String::new(),
                false => format!("text.{class}{{color:{text}}}"),
            };
            format!(".{class},.f-{class}{{color:{line}}}{of_text}")
        };
        light += &rules(colour.light, colour.light_text);
        dark += &rules(colour.dark, colour.dark_text);
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
    width: f64,
    height: f64,
    origin: Vec2,
    scale: Vec2,
    description: String,
    body: String,
}

impl Drawing {
    /// An empty figure of `width` by `height` pixels that shows the rectangle from `min` to `max`
    /// with a margin. Both axes have the same scale. `description` says in words what is shown.
    pub fn new(width: f64, height: f64, min: Vec2, max: Vec2, description: &str) -> Drawing {
        let room = Vec2::new(width, height) - 2.0 * MARGIN;
        let scale = (room / (max - min)).min_element();
        Drawing::scaled(width, height, min, max, Vec2::splat(scale), description)
    }

    /// Like [`Drawing::new`], but each axis has its own scale: for the graph of a function.
    pub fn graph(width: f64, height: f64, min: Vec2, max: Vec2, description: &str) -> Drawing {
        let room = Vec2::new(width, height) - 2.0 * MARGIN;
        Drawing::scaled(width, height, min, max, room / (max - min), description)
    }

    fn scaled(
        width: f64,
        height: f64,
        min: Vec2,
        max: Vec2,
        scale: Vec2,
        description: &str,
    ) -> Drawing {
        Drawing {
            width,
            height,
            scale,
            origin: 0.5 * Vec2::new(width, height) - scale * (0.5 * (min + max)),
            description: description.to_string(),
            body: String::new(),
        }
    }

    /// The position of `p` in pixels from the top left.
    fn place(&self, p: Vec2) -> Vec2 {
        let q = self.origin + self.scale * p;
        Vec2::new(q.x, self.height - q.y)
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
    pub fn note(&mut self, p: Vec2, side: Side, words: &str, colour: &str) {
        self.text(p, side, &escape(words), &format!("s {colour}"));
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
        let (w, h) = (number(self.width), number(self.height));
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
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
