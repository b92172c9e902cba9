//! A drawing as SVG.

use super::model::{Ink, Layout, Sketch, Stroke, TAxis};
use super::words::{Anchor, Words, above_row, around, short};
use pictures::palette::OF_PAGES;
use serde::Serialize;
use std::fmt::Write;

/// The size of the shapes, without room for words.
const SIZE: [f64; 2] = [360.0, 170.0];

/// The height of a row of intervals.
const ROW: f64 = 30.0;

/// Room around the shapes.
const MARGIN: f64 = 34.0;

/// The height of the axis of `t`.
const AXIS: f64 = 54.0;

/// The style of a drawing that is a file of its own.
const STYLE: &str = include_str!("drawing.css");

/// A drawing as a file.
#[derive(Clone, Debug, Serialize)]
pub struct Drawing {
    /// An SVG file.
    pub svg: String,
    /// What is seen, and what the signs mean.
    pub caption: String,
}

impl Sketch {
    /// The drawing as an SVG element. The classes of its parts are `edge`, `inside`, `outside`,
    /// `lamp`, `expected`, `yours`, `origin`, `passing`.
    pub fn svg(&self) -> String {
        let [min, max] = self.bounds();
        let size = [0, 1].map(|i| max[i] - min[i]);
        let fit = |i: usize| match size[i] > 0.0 {
            true => SIZE[i] / size[i],
            false => f64::INFINITY,
        };
        let scale = match self.layout {
            Layout::Shape => [fit(0).min(fit(1)); 2],
            Layout::Rows => [fit(0), ROW],
        };
        let scale = scale.map(|scale| if scale.is_finite() { scale } else { 1.0 });
        let drawn = [0, 1].map(|i| scale[i] * size[i]);
        let width = SIZE[0] + 2.0 * MARGIN;
        let left = 0.5 * (width - drawn[0]);
        let place = |p: [f64; 2]| {
            [
                left + scale[0] * (p[0] - min[0]),
                MARGIN + scale[1] * (max[1] - p[1]),
            ]
        };
        let shapes = drawn[1] + 2.0 * MARGIN;
        let height = shapes + self.axis.as_ref().map_or(0.0, |_| AXIS);
        let mut svg = format!(
            "<svg class=\"ray sketch\" viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" aria-label=\"{}\">",
            self.caption
        );
        let mut words = Words::new([2.0, 2.0, width - 2.0, shapes - 4.0]);
        for stroke in &self.strokes {
            match stroke {
                Stroke::Line(ink, ends) => line(&mut svg, class(*ink), ends.map(place)),
                Stroke::Arrow(ink, ends) => arrow(&mut svg, class(*ink), ends.map(place)),
                Stroke::Mark(ink, at) => {
                    mark(&mut svg, *ink, place(*at), self.layout);
                    words.avoid(place(*at), 7.0);
                }
                Stroke::Word(..) => {}
            }
        }
        for stroke in &self.strokes {
            let Stroke::Word(anchor, at, word) = stroke else {
                continue;
            };
            let places = match self.layout {
                Layout::Shape => around(place(*at), *anchor),
                Layout::Rows => above_row(place(*at)),
            };
            if let Some((at, anchor)) = words.place(word.trim(), &places) {
                text(&mut svg, at, anchor, word.trim());
            }
        }
        if let Some(axis) = &self.axis {
            axis.draw(&mut svg, [MARGIN, width - MARGIN], shapes + 6.0);
        }
        svg + "</svg>"
    }

    /// What the signs of the drawing mean, as HTML with the classes `good` and `bad`.
    pub fn key(&self) -> String {
        let signs = self.signs().map(|(class, meaning)| match class {
            "" => meaning.to_owned(),
            class => format!("<span class=\"{class}\">{meaning}</span>"),
        });
        signs.collect::<Vec<_>>().join(" · ")
    }

    /// The meaning of each sign that is there, and its class.
    fn signs(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let meanings = [
            (Ink::Expected, "good", "○ expected"),
            (Ink::Yours, "bad", "× yours"),
            (Ink::Ray, "", "● the ray's origin"),
            (
                Ink::Outside,
                "",
                "dashed: out of the ray's range, or not traced",
            ),
        ];
        let there = meanings.into_iter().filter(|(ink, ..)| self.shows(*ink));
        there.map(|(_, class, meaning)| (class, meaning))
    }

    /// The drawing as a file, for who has no style sheet of ours, with its caption.
    pub fn drawing(&self) -> Drawing {
        let svg = self.svg();
        let (start, rest) = svg.split_once('>').unwrap_or_default();
        let start = start.replacen("<svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"", 1);
        let signs = self
            .signs()
            .map(|(_, meaning)| meaning)
            .collect::<Vec<_>>()
            .join(" · ");
        Drawing {
            svg: format!("{start}><style>{OF_PAGES}{STYLE}</style>{rest}"),
            caption: match signs.is_empty() {
                true => self.caption.clone(),
                false => format!("{}. {signs}", self.caption),
            },
        }
    }

    /// What is seen, as a sentence without its full stop.
    pub fn caption(&self) -> &str {
        &self.caption
    }
}

fn class(ink: Ink) -> &'static str {
    match ink {
        Ink::Shape => "edge",
        Ink::Ray => "inside",
        Ink::Outside => "outside",
        Ink::Light => "lamp",
        Ink::Expected => "expected",
        Ink::Yours => "yours",
    }
}

fn line(svg: &mut String, class: &str, [[x1, y1], [x2, y2]]: [[f64; 2]; 2]) {
    let _ = write!(
        svg,
        "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
    );
}

fn arrow(svg: &mut String, class: &str, [from, to]: [[f64; 2]; 2]) {
    line(svg, class, [from, to]);
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let length = dx.hypot(dy).max(1e-9);
    let [dx, dy] = [9.0 * dx / length, 9.0 * dy / length];
    for side in [-0.45, 0.45] {
        let barb = [to[0] - dx - side * dy, to[1] - dy + side * dx];
        line(svg, class, [barb, to]);
    }
}

fn mark(svg: &mut String, ink: Ink, at: [f64; 2], layout: Layout) {
    let [x, y] = at;
    let mut circle = |class: &str, r: f64| {
        let _ = write!(
            svg,
            "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\"/>"
        );
    };
    match ink {
        Ink::Expected => circle("expected", 7.0),
        Ink::Ray => circle("origin", 4.0),
        Ink::Light => circle("lamp", 6.0),
        Ink::Yours => {
            for side in [-5.0, 5.0] {
                line(svg, "yours", [[x - 5.0, y - side], [x + 5.0, y + side]]);
            }
        }
        // An end of an interval, or a point that the ray passes.
        Ink::Shape | Ink::Outside => match layout {
            Layout::Rows => line(svg, "edge", [[x, y - 4.0], [x, y + 4.0]]),
            Layout::Shape => circle("passing", 4.0),
        },
    }
}

fn text(svg: &mut String, [x, y]: [f64; 2], anchor: Anchor, word: &str) {
    let anchor = match anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let _ = write!(
        svg,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{word}</text>"
    );
}

impl TAxis {
    fn draw(&self, svg: &mut String, [left, right]: [f64; 2], y: f64) {
        let [low, high] = self.extent();
        let place = |t: f64| left + (t.clamp(low, high) - low) / (high - low) * (right - left);
        text(svg, [left - 12.0, y + 4.0], Anchor::End, "t");
        arrow(svg, "outside", [[left, y], [right, y]]);
        let range = self.range.map(place);
        line(svg, "inside", [[range[0], y], [range[1], y]]);
        for end in self.range.into_iter().filter(|end| end.is_finite()) {
            let x = place(end);
            line(svg, "inside", [[x, y - 6.0], [x, y + 6.0]]);
        }
        for (ink, whose, hits) in [
            (Ink::Expected, "expected", &self.expected),
            (Ink::Yours, "yours", &self.yours),
        ] {
            for t in hits {
                let _ = write!(svg, "<g><title>{whose}: t = {t}</title>");
                mark(svg, ink, [place(*t), y], Layout::Shape);
                svg.push_str("</g>");
            }
        }
        // Hits first, so that a value without room is an end of the range or the origin.
        let mut words = Words::new([2.0, y + 8.0, right + left - 2.0, y + AXIS - 6.0]);
        let mut written = Vec::new();
        for value in self.marked() {
            let number = short(value);
            let rows = [22.0, 39.0].map(|below| ([place(value), y + below], Anchor::Middle));
            if !written.contains(&number)
                && let Some((at, anchor)) = words.place(&number, &rows)
            {
                text(svg, at, anchor, &number);
                written.push(number);
            }
        }
    }
}
