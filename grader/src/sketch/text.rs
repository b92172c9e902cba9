//! A drawing in characters.

use super::model::{Ink, Layout, Sketch, Stroke, TAxis};
use super::plot::{BOTH, Plot, Side, both};
use super::words::Anchor;
use crate::report::wrap::{columns, wrap};

/// Columns and lines of the shapes.
pub(super) const COLUMNS: usize = 56;
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
        let Drawn {
            shapes: mut lines,
            axis,
            signs,
        } = self.drawn();
        let meanings: Vec<String> = signs.iter().map(|(_, meaning)| meaning.clone()).collect();
        let meanings = match signs.is_empty() {
            true => self.caption.clone(),
            false => format!("{}; {}", self.caption, meanings.join(", ")),
        };
        // Beside the shapes if there is room, so that the drawing stays low.
        let widest = lines.iter().map(|line| columns(line)).max().unwrap_or(0);
        let beside = widest + GAP + columns(&meanings) <= width;
        match lines.last_mut().filter(|_| beside) {
            Some(last) => {
                last.push_str(&" ".repeat(widest + GAP - columns(last)));
                last.push_str(&meanings);
                lines.extend(axis);
            }
            None => {
                lines.extend(axis);
                lines.extend(wrap(&format!("    {meanings}"), 4, width));
            }
        }
        lines
    }

    /// What is false of the drawing: [`false_signs`].
    pub(crate) fn false_signs(&self) -> Vec<String> {
        let words = self.strokes.iter().filter_map(|stroke| match stroke {
            Stroke::Word(_, _, word) => Some(word.trim()).filter(|word| !word.is_empty()),
            _ => None,
        });
        let of = |ink: Ink| self.shows(ink);
        let is_twice = of(Ink::Expected) && of(Ink::Yours);
        false_signs(&words.collect::<Vec<_>>(), &self.drawn(), is_twice)
    }

    fn drawn(&self) -> Drawn {
        let plot = self.plot();
        let (axis, on_axis) = match &self.axis {
            Some(axis) => axis.lines(),
            None => (Vec::new(), Vec::new()),
        };
        Drawn {
            shapes: plot.lines(),
            axis,
            signs: self.signs_of_text(&plot, |sign| plot.has(sign) || on_axis.contains(&sign)),
        }
    }

    /// The shapes, without the axis.
    fn plot(&self) -> Plot {
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
                let is_before = |stroke: &Stroke| matches!(stroke, Stroke::Word(Anchor::End, ..));
                let before = match self.strokes.iter().any(is_before) {
                    true => WORDS,
                    false => 0,
                };
                // And above and below for words that have no room there; empty lines are left out.
                let size = [before + columns + WORDS, lines.max(2) + 2];
                let min = [min[0] - before as f64 * unit / ASPECT, min[1] - unit];
                let max = [
                    min[0] + (size[0] - 1) as f64 * unit / ASPECT,
                    min[1] + (size[1] - 1) as f64 * unit,
                ];
                Plot::sized(min, max, size)
            }
        };
        // A cell has one sign: answers first, then other marks, then the ray, then shapes.
        let is_answer = |ink: &Ink| matches!(ink, Ink::Expected | Ink::Yours);
        for of_answers in [false, true] {
            for stroke in &self.strokes {
                let Stroke::Mark(ink, at) = stroke else {
                    continue;
                };
                match (is_answer(ink), self.layout) {
                    (is, _) if is != of_answers => {}
                    (true, _) => plot.mark_answer(*at, mark(*ink)),
                    (false, Layout::Shape) => plot.set(*at, mark(*ink)),
                    (false, Layout::Rows) => plot.set(*at, '|'),
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
            if let Stroke::Word(anchor, at, word) = stroke
                && !word.trim().is_empty()
            {
                match (anchor, self.layout) {
                    (Anchor::End, _) => plot.word(*at, word, Side::Before),
                    (Anchor::Start, _) => plot.word(*at, word, Side::Behind),
                    (Anchor::Middle, Layout::Rows) => plot.word(*at, word.trim(), Side::Within),
                    (Anchor::Middle, Layout::Shape) => plot.word(*at, word, Side::Around),
                };
            }
        }
        plot
    }

    /// The signs that are drawn, with their meanings.
    fn signs_of_text(&self, plot: &Plot, is_drawn: impl Fn(char) -> bool) -> Vec<(char, String)> {
        let is_shape = self.layout == Layout::Shape;
        let meanings = [
            ('o', self.shows(Ink::Expected), "o expected"),
            ('x', self.shows(Ink::Yours), "x yours"),
            (BOTH, true, self.both(plot)),
            ('@', is_shape && self.shows(Ink::Ray), "@ origin"),
            (
                '+',
                is_shape && self.has(Ink::Shape, true),
                "+ the ray passes",
            ),
            ('L', true, "L light"),
            (
                ':',
                self.shows(Ink::Outside),
                ": out of range or not traced",
            ),
        ];
        let there = meanings
            .into_iter()
            .filter(|(sign, has, _)| *has && is_drawn(*sign));
        there
            .map(|(sign, _, meaning)| (sign, meaning.to_owned()))
            .collect()
    }

    /// The meaning of the sign of both answers: they may be apart by less than a character. Answers
    /// in other places do not count.
    fn both(&self, plot: &Plot) -> &'static str {
        let of = |ink: Ink| {
            self.strokes.iter().filter_map(move |stroke| match stroke {
                Stroke::Mark(of, at) if *of == ink => Some(*at),
                _ => None,
            })
        };
        let is_same = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs()).max(1.0);
        let marks = of(Ink::Yours).all(|at| {
            let mut there = of(Ink::Expected).filter(|other| plot.cell(*other) == plot.cell(at));
            let is_right = there.clone().next().is_none()
                || there.any(|other| (0..2).all(|i| is_same(at[i], other[i])));
            is_right || plot.cell(at).is_none()
        });
        let on_axis = self.axis.iter().all(|axis| {
            axis.yours.iter().all(|t| {
                let expected = axis.expected.iter();
                let mut there = expected.filter(|other| axis.column(**other) == axis.column(*t));
                there.clone().next().is_none() || there.any(|other| is_same(*t, *other))
            })
        });
        // Seen along the ray, hits at different `t` are in one place.
        let is_behind = self.axis.iter().any(
            |axis| matches!((&axis.expected[..], &axis.yours[..]), ([a], [b]) if !is_same(*a, *b)),
        );
        match marks && on_axis {
            true if is_behind => "* expected and yours, one behind the other",
            true => "* expected and yours",
            false => "* expected and yours, too near to be drawn apart",
        }
    }
}

/// Answers that differ by less are drawn as one.
const SAME: f64 = 1e-9;

/// A drawing before its meanings are put beside or below it.
struct Drawn {
    shapes: Vec<String>,
    axis: Vec<String>,
    /// The signs that are explained, with their meanings.
    signs: Vec<(char, String)>,
}

/// What is false of a drawing with these words: a word that another one or a mark covers, a meaning
/// without its sign, the sign of both answers where not both are drawn.
fn false_signs(words: &[&str], drawn: &Drawn, is_twice: bool) -> Vec<String> {
    let mut shapes = drawn.shapes.join("\n");
    let mut found = Vec::new();
    let mut longest_first = words.to_vec();
    longest_first.sort_by_key(|word| std::cmp::Reverse(word.len()));
    for word in longest_first {
        match shapes.contains(word) {
            true => shapes = shapes.replacen(word, &" ".repeat(word.len()), 1),
            false => found.push(format!("the word \"{word}\" is covered")),
        }
    }
    let axis = drawn.axis.first().map_or("", String::as_str);
    let is_drawn = |sign: char| shapes.contains(sign) || axis.contains(sign);
    let without = drawn.signs.iter().filter(|(sign, _)| !is_drawn(*sign));
    found.extend(without.map(|(_, meaning)| format!("\"{meaning}\" is not drawn")));
    if is_drawn(BOTH) && !is_twice {
        found.push("both are said to be where one is".into());
    }
    found
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
        // The sum of 0 removes the sign of a zero.
        all.filter(|t| t.is_finite()).map(|t| t + 0.0)
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

    /// The column of the axis in which a value is.
    fn column(&self, t: f64) -> usize {
        let [low, high] = self.extent();
        let share = ((t - low) / (high - low)).clamp(0.0, 1.0);
        (share * (AXIS - 1) as f64).round() as usize
    }

    /// The axis with its marks and the values below, and the signs on it.
    fn lines(&self) -> (Vec<String>, Vec<char>) {
        let column = |t: f64| self.column(t);
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
        for (ts, mark) in [(&self.expected, 'o'), (&self.yours, 'x')] {
            for t in ts {
                let cell = &mut line[column(*t)];
                *cell = both(*cell, mark);
            }
        }
        let range_signs: String = ['[', '=', ']']
            .into_iter()
            .filter(|c| line.contains(c))
            .collect();
        let range = match range_signs.as_str() {
            "" => String::new(),
            range => format!("  {range} range"),
        };
        let mut below = String::new();
        for value in self.values() {
            let text = crate::report::wrap::shorten_numbers(&format!("{value}"), 4);
            let start = column(value).saturating_sub(text.len() / 2);
            if below.is_empty() || start > below.len() {
                below.push_str(&" ".repeat(start - below.len()));
                below.push_str(&text);
            }
        }
        let axis = format!("  t {}{range}", line.iter().collect::<String>());
        (vec![axis, format!("    {below}")], line)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is found in a drawing of one line with a meaning each for `signs`.
    fn found(line: &str, words: &[&str], signs: &str, is_twice: bool) -> Vec<String> {
        let drawn = Drawn {
            shapes: vec![line.into()],
            axis: Vec::new(),
            signs: signs.chars().map(|sign| (sign, sign.into())).collect(),
        };
        false_signs(words, &drawn, is_twice)
    }

    #[test]
    fn false_signs_are_found() {
        let normals = ["your normal", "expected normal"];
        let both = "o your normal x expected normal";
        assert_eq!(found(both, &normals, "ox", true), [""; 0]);
        let covered = found("o yoxr normalormal", &normals, "o", true);
        assert_eq!(covered.len(), 2, "{covered:?}");
        // Letters of words are no marks.
        assert_eq!(found(both, &normals, "@", true), ["\"@\" is not drawn"]);
        assert_eq!(
            found("o normal", &["normal"], "x", true),
            ["\"x\" is not drawn"]
        );
        let one = ["both are said to be where one is"];
        assert_eq!(found("*", &[], "*", false), one);
        assert_eq!(found("*", &[], "*", true), [""; 0]);
    }
}
