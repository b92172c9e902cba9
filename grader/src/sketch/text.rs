//! A drawing in characters.

use super::model::{Ink, Layout, Sketch, Stroke, TAxis};
use super::plot::{Plot, Side};
use crate::report::wrap::{columns, wrap};

/// Columns and lines of the shapes.
const COLUMNS: usize = 56;
const LINES: usize = 6;

/// Columns between the shapes and the words beside them.
const GAP: usize = 3;

/// A character is about twice as high as it is wide.
const ASPECT: f64 = 2.0;

/// Columns of the axis of `t`.
const AXIS: usize = 48;

impl Sketch {
    /// The drawing in lines of at most `width` columns, with the meanings of its signs below.
    pub fn text(&self, width: usize) -> Vec<String> {
        let mut lines = self.shapes();
        let axis = self.axis.as_ref().map(TAxis::lines);
        let signs = lines.iter().chain(axis.iter().flatten());
        let both = signs.into_iter().any(|line| line.contains('*'));
        let signs = self.meanings(both);
        let meanings = match signs.is_empty() {
            true => self.caption.clone(),
            false => format!("{}; {signs}", self.caption),
        };
        // Beside the shapes if there is room, so that the drawing stays low.
        let widest = lines.iter().map(|line| columns(line)).max().unwrap_or(0);
        let beside = widest + GAP + columns(&meanings) <= width;
        match lines.last_mut().filter(|_| beside) {
            Some(last) => {
                last.push_str(&" ".repeat(widest + GAP - columns(last)));
                last.push_str(&meanings);
                lines.extend(axis.into_iter().flatten());
            }
            None => {
                lines.extend(axis.into_iter().flatten());
                lines.extend(wrap(&format!("    {meanings}"), 4, width));
            }
        }
        lines
    }

    fn shapes(&self) -> Vec<String> {
        let [min, max] = self.bounds();
        let size = [max[0] - min[0], max[1] - min[1]];
        let mut plot = match self.layout {
            Layout::Rows => {
                let lines = size[1].round() as usize + 1;
                Plot::sized(
                    min,
                    [max[0].max(min[0] + 1e-9), max[1].max(min[1] + 1e-9)],
                    [COLUMNS, lines],
                )
            }
            Layout::Shape => {
                // Units of length per line.
                let unit =
                    (size[1] / (LINES - 1) as f64).max(ASPECT * size[0] / (COLUMNS - 1) as f64);
                let columns = (ASPECT * size[0] / unit).round() as usize + 1;
                let lines = (size[1] / unit).round() as usize + 1;
                // Room for words beside the first and the last point.
                let is_before = |stroke: &Stroke| matches!(stroke, Stroke::WordBefore(..));
                let before = match self.strokes.iter().any(is_before) {
                    true => WORDS,
                    false => 0,
                };
                let size = [before + columns + WORDS, lines.max(2)];
                let min = [min[0] - before as f64 * unit / ASPECT, min[1]];
                let max = [
                    min[0] + (size[0] - 1) as f64 * unit / ASPECT,
                    min[1] + (size[1] - 1) as f64 * unit,
                ];
                Plot::sized(min, max, size)
            }
        };
        // A cell has one sign: marks first, then the ray, then shapes.
        for stroke in &self.strokes {
            if let Stroke::Mark(ink, at) = stroke {
                let is_answer = matches!(ink, Ink::Expected | Ink::Yours);
                match is_answer || self.layout == Layout::Shape {
                    true => {
                        plot.mark(*at, mark(*ink));
                    }
                    false => plot.set(*at, '|'),
                }
            }
        }
        for stroke in &self.strokes {
            if let Stroke::Arrow(_, [from, to]) = stroke {
                plot.set_if_free(*to, head(*from, *to));
            }
        }
        let is_shape = |ink: &Ink| matches!(ink, Ink::Shape | Ink::Light);
        for of_shapes in [false, true] {
            for stroke in &self.strokes {
                if let Stroke::Line(ink, ends) | Stroke::Arrow(ink, ends) = stroke
                    && is_shape(ink) == of_shapes
                {
                    let sign = match self.layout {
                        Layout::Rows => '-',
                        Layout::Shape => sign(*ink, *ends),
                    };
                    plot.stroke(ends[0], ends[1], sign);
                }
            }
        }
        for stroke in &self.strokes {
            match stroke {
                Stroke::WordBefore(at, word) => plot.word(*at, word, Side::Before),
                Stroke::Word(at, word) => plot.word(*at, word, Side::Behind),
                Stroke::Name(at, word) if !word.trim().is_empty() => {
                    plot.word(*at, word, Side::Around)
                }
                _ => {}
            }
        }
        plot.lines()
    }

    /// What the signs of the drawing mean; empty if it has none of these.
    fn meanings(&self, both: bool) -> String {
        let is_shape = self.layout == Layout::Shape;
        let meanings = [
            (self.shows(Ink::Expected), "o expected"),
            (self.shows(Ink::Yours), "x yours"),
            (both, "* both"),
            (is_shape && self.shows(Ink::Ray), "@ origin"),
            (is_shape && self.has(Ink::Shape, true), "+ the ray passes"),
            (self.shows(Ink::Light), "L light"),
            (self.shows(Ink::Outside), ": out of range or not traced"),
        ];
        let all: Vec<&str> = meanings
            .into_iter()
            .filter(|(is_there, _)| *is_there)
            .map(|(_, meaning)| meaning)
            .collect();
        all.join(", ")
    }
}

/// Columns for words beside the first or the last point.
const WORDS: usize = 16;

fn mark(ink: Ink) -> char {
    match ink {
        Ink::Shape | Ink::Outside => '+',
        Ink::Ray => '@',
        Ink::Light => 'L',
        Ink::Expected => 'o',
        Ink::Yours => 'x',
    }
}

/// The sign of a line by its slope.
fn sign(ink: Ink, [from, to]: [[f64; 2]; 2]) -> char {
    match ink {
        Ink::Shape => return '.',
        Ink::Light => return 'L',
        Ink::Outside => return ':',
        Ink::Yours => return 'x',
        Ink::Ray | Ink::Expected => {}
    }
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    if dy.abs() < 0.4 * dx.abs() {
        '-'
    } else if dx.abs() < 0.4 * dy.abs() {
        '|'
    } else if dx * dy > 0.0 {
        '/'
    } else {
        '\\'
    }
}

/// The head of an arrow.
fn head(from: [f64; 2], to: [f64; 2]) -> char {
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    match (dx.abs() >= dy.abs(), dx >= 0.0, dy >= 0.0) {
        (true, true, _) => '>',
        (true, false, _) => '<',
        (false, _, true) => '^',
        (false, _, false) => 'v',
    }
}

impl TAxis {
    /// The finite values of the axis: hits, the ends of the range, the origin.
    pub(super) fn marked(&self) -> impl Iterator<Item = f64> {
        let hits = self.expected.iter().chain(&self.yours).copied();
        let all = hits.chain(self.range).chain([0.0]);
        all.filter(|t| t.is_finite())
    }

    /// The finite values of the axis in increasing order, the origin among them.
    fn values(&self) -> Vec<f64> {
        let mut values: Vec<f64> = self.marked().collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    }

    /// The part of the axis that is drawn: all values, with room at both ends.
    pub(super) fn extent(&self) -> [f64; 2] {
        let values = self.values();
        let [low, high] = [values[0], values[values.len() - 1]];
        let margin = match high > low {
            true => 0.15 * (high - low),
            false => 1.0,
        };
        [low - margin, high + margin]
    }

    /// The axis with its marks, and the values below.
    fn lines(&self) -> [String; 2] {
        let [low, high] = self.extent();
        let column = |t: f64| {
            let share = ((t - low) / (high - low)).clamp(0.0, 1.0);
            (share * (AXIS - 1) as f64).round() as usize
        };
        let [from, to] = self.range;
        let mut line: Vec<char> = (0..AXIS)
            .map(|at| match (column(from)..=column(to)).contains(&at) {
                true => '=',
                false => '-',
            })
            .collect();
        for (end, sign) in [(from, '['), (to, ']')] {
            if end.is_finite() {
                line[column(end)] = sign;
            }
        }
        line[AXIS - 1] = '>';
        for t in &self.expected {
            line[column(*t)] = 'o';
        }
        for t in &self.yours {
            let cell = &mut line[column(*t)];
            *cell = if *cell == 'o' { '*' } else { 'x' };
        }
        let mut below = String::new();
        for value in self.values() {
            let text = crate::report::wrap::shorten_numbers(&format!("{value}"), 4);
            let start = column(value).saturating_sub(text.len() / 2);
            if below.is_empty() || start > below.len() {
                below.push_str(&" ".repeat(start - below.len()));
                below.push_str(&text);
            }
        }
        [
            format!("  t {}  [=] range", line.into_iter().collect::<String>()),
            format!("    {below}"),
        ]
    }
}
