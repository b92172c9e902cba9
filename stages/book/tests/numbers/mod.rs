//! The numbers of the text are computed here, from the given values and by formulas of our own.
//!
//! In the section "A worked example" of a chapter every number of every formula is compared, in the
//! order in which they stand there. Numbers in other places are those of `claims`.

mod chance_light;
mod claims;
mod furnace;
mod measured;
mod part1;
mod part2;
mod part3;
mod part4;
mod part5;
mod part6;
mod sphere_error;
mod stopping;

use book::chapter::Chapter;
use kit::{Vec2, Vec3};
use std::path::Path;

/// The numbers of a worked example, in the order of the text.
#[derive(Default)]
struct Numbers(Vec<f64>);

impl Numbers {
    /// Adds a number and returns it.
    fn n(&mut self, x: f64) -> f64 {
        self.0.push(x);
        x
    }

    /// Adds the coordinates of a vector and returns it.
    fn v(&mut self, v: Vec3) -> Vec3 {
        self.0.extend(v.to_array());
        v
    }

    /// Adds the coordinates of a pair and returns it.
    fn p(&mut self, p: Vec2) -> Vec2 {
        self.0.extend(p.to_array());
        p
    }
}

/// A number of a formula as it is written.
#[derive(Debug, PartialEq)]
struct Literal {
    value: f64,
    decimals: i32,
}

/// The numbers of a formula that are no index and no exponent.
fn literals(latex: &str) -> Vec<Literal> {
    let chars: Vec<char> = latex.chars().collect();
    let mut found = Vec::new();
    let mut i = 0;
    while i < chars.len() {
        match chars[i] {
            '_' | '^' => {
                i += 1;
                if chars.get(i) == Some(&'{') {
                    while i < chars.len() && chars[i] != '}' {
                        i += 1;
                    }
                }
                i += 1;
            }
            c if c.is_ascii_digit() => {
                let start = i;
                while i < chars.len() && (chars[i].is_ascii_digit() || is_point(&chars, i)) {
                    i += 1;
                }
                let digits: String = chars[start..i].iter().collect();
                let before: String = chars[..start].iter().collect();
                let value: f64 = digits.parse().expect("digits with at most one point");
                let decimals = digits.split_once('.').map_or(0, |(_, after)| after.len());
                found.push(Literal {
                    value: if is_negated(&before) { -value } else { value },
                    decimals: decimals as i32,
                });
            }
            _ => i += 1,
        }
    }
    found
}

/// Whether the point at `i` is part of a number: a digit follows.
fn is_point(chars: &[char], i: usize) -> bool {
    chars[i] == '.' && chars.get(i + 1).is_some_and(char::is_ascii_digit)
}

/// Whether the text before a number ends with a sign, and not with a subtraction.
fn is_negated(before: &str) -> bool {
    let Some(rest) = before.trim_end().strip_suffix('-') else {
        return false;
    };
    let rest = rest.trim_end();
    let last_word = rest
        .rsplit(|c: char| !c.is_ascii_alphabetic())
        .next()
        .unwrap_or_default();
    let after_command =
        !last_word.is_empty() && rest[..rest.len() - last_word.len()].ends_with('\\');
    rest.is_empty()
        || after_command
        || rest.ends_with(['(', ',', '=', '&', '{', '<', '>', '|', '/', '[', ';'])
}

#[test]
fn numbers_are_found_in_formulas() {
    let numbers = |latex| {
        literals(latex)
            .into_iter()
            .map(|l| l.value)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        numbers(r"b_1 = (-1, 2 - 3) \cdot 4^2 / 0.5"),
        [-1.0, 2.0, 3.0, 4.0, 0.5]
    );
    assert_eq!(numbers(r"x \approx -2.5, t_{12}"), [-2.5]);
    assert_eq!(literals("0.50")[0].decimals, 2);
}

/// Compares the worked example of the chapter at `path` with `numbers`.
fn check(path: &str, numbers: Numbers) {
    let chapter = Chapter::read(Path::new(path)).expect("the chapter");
    let section = chapter
        .section("A worked example")
        .expect("a worked example");
    let mut expected = numbers.0.into_iter();
    for formula in section.formulas() {
        for literal in literals(&formula.latex) {
            let value = expected.next().unwrap_or(f64::NAN);
            let rounding = 0.5 * 10_f64.powi(-literal.decimals) * (1.0 + 1e-9);
            let is_exact = literal.decimals == 0;
            let allowed = if is_exact { 1e-9 } else { rounding };
            assert!(
                (literal.value - value).abs() <= allowed,
                "{path}: the text has {}, computed is {value}, in ${}$",
                literal.value,
                formula.latex
            );
        }
    }
    let rest: Vec<f64> = expected.collect();
    assert!(rest.is_empty(), "{path}: the text ends before {rest:?}");
}

/// Outside of formulas no number with a decimal point is compared, so there is none.
#[test]
fn worked_examples_have_their_numbers_in_formulas() {
    for chapter in book::chapter::all().expect("all chapters") {
        let Some(section) = chapter.section("A worked example") else {
            continue;
        };
        let mut text = section.text.clone();
        for formula in section.formulas().iter().rev() {
            text.replace_range(formula.range.clone(), "");
        }
        let prose: String = text.split('`').step_by(2).collect();
        let words = prose.split_whitespace();
        let decimal = words.filter(|word| {
            let (before, after) = word.split_once('.').unwrap_or_default();
            before.ends_with(|c: char| c.is_ascii_digit())
                && after.starts_with(|c: char| c.is_ascii_digit())
        });
        let found: Vec<&str> = decimal.collect();
        assert!(found.is_empty(), "{}: {found:?}", chapter.path.display());
    }
}
