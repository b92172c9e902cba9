//! Where each kernel is right and where it is not: families of rays across, kernels down.

use super::canvas::{Drawn, Label, svg};
use super::look::{GREEN, PURPLE, SKY, VERMILION, YELLOW, ink_on};
use super::words::{list, name, percent};
use crate::report::{Accuracy, Family, Row};
use grader::error::GraderError;
use plotters::style::{RGBColor, WHITE};

/// Names of kernels, names of families and cells, in points.
const NAMES: f64 = 172.0;
const HEAD: f64 = 34.0;
const WIDTH: f64 = 860.0;
const ROW: f64 = 18.0;
const KEY: f64 = 26.0;

/// `t` is called right to the last place if it is at most so many units in the last place off on half of the rays.
const LAST_PLACE: f64 = 1.0;

/// What is said of a kernel on a family of rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    /// Decided right, `t` to the last place.
    Correct,
    /// Decided right, `t` within the forward error bound.
    Within,
    /// Decided right, `t` beyond the bound.
    Beyond,
    /// Decided wrong.
    Wrong,
    /// A closed mesh is not closed.
    Leak,
}

impl Verdict {
    const ALL: [Verdict; 5] = [
        Verdict::Correct,
        Verdict::Within,
        Verdict::Beyond,
        Verdict::Wrong,
        Verdict::Leak,
    ];

    fn of(accuracy: &Accuracy) -> Verdict {
        if accuracy.wrong_per_million() > 0.0 {
            Verdict::Wrong
        } else if accuracy.beyond_bound_per_million > 0.0 {
            Verdict::Beyond
        } else if accuracy.t.is_some_and(|t| t.ulp.p50 > LAST_PLACE) {
            Verdict::Within
        } else {
            Verdict::Correct
        }
    }

    fn color(self) -> RGBColor {
        match self {
            Verdict::Correct => GREEN,
            Verdict::Within => SKY,
            Verdict::Beyond => YELLOW,
            Verdict::Wrong => VERMILION,
            Verdict::Leak => PURPLE,
        }
    }

    /// A sign for who sees no colours.
    fn sign(self) -> &'static str {
        match self {
            Verdict::Correct => "=",
            Verdict::Within => "≈",
            Verdict::Beyond => ">",
            Verdict::Wrong => "✗",
            Verdict::Leak => "○",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Verdict::Correct => "correct to the last place",
            Verdict::Within => "within the bound (bits)",
            Verdict::Beyond => "t beyond the bound",
            Verdict::Wrong => "wrong decisions",
            Verdict::Leak => "leaks",
        }
    }
}

/// The map of a family of kernels, and what it shows.
pub(crate) fn figure(family: &Family) -> Result<(String, String), GraderError> {
    let has_leaks = family
        .rows
        .iter()
        .any(|row| row.leaks_per_million.is_some());
    let columns = family.columns.len() + usize::from(has_leaks);
    let cell = (WIDTH - NAMES) / columns.max(1) as f64;
    let height = HEAD + ROW * family.rows.len() as f64 + KEY;
    let says = format!("Where kernels are right: {}", family.shape.name());
    let drawn = svg(WIDTH, height, &says, |canvas| -> Drawn {
        let center = |column: usize, y: f64| (NAMES + cell * (column as f64 + 0.5), y);
        let mut heads: Vec<&str> = family.columns.iter().map(|c| c.family.name()).collect();
        if has_leaks {
            heads.push("closed mesh");
        }
        for (column, head) in heads.iter().enumerate() {
            let words: Vec<&str> = head.split(' ').collect();
            let (first, last) = words.split_at(words.len() - 1);
            let (first, last) = (first.join(" "), last.join(" "));
            canvas.text(&first, center(column, HEAD - 21.0), Label::centered(9.5))?;
            canvas.text(&last, center(column, HEAD - 9.0), Label::centered(9.5))?;
        }
        for (i, row) in family.rows.iter().enumerate() {
            let top = HEAD + ROW * i as f64;
            let label = Label::right(9.5);
            let label = if row.student { label.bold() } else { label };
            canvas.text(&name(row), (NAMES - 6.0, top + 0.5 * ROW), label)?;
            for (column, (verdict, text)) in cells(row).into_iter().enumerate() {
                let left = NAMES + cell * column as f64;
                let color = verdict.map_or(WHITE, Verdict::color);
                let corners = [
                    (left + 0.6, top + 0.6),
                    (left + cell - 0.6, top + ROW - 0.6),
                ];
                canvas.rectangle(corners[0], corners[1], color)?;
                let label = Label::centered(9.0).in_color(ink_on(color));
                canvas.text(&text, center(column, top + 0.5 * ROW), label)?;
            }
        }
        let y = height - 0.4 * KEY;
        let mut x = 12.0;
        for verdict in Verdict::ALL {
            if verdict == Verdict::Leak && !has_leaks {
                continue;
            }
            canvas.rectangle((x, y - 7.0), (x + 16.0, y + 7.0), verdict.color())?;
            let label = Label::centered(9.0).in_color(ink_on(verdict.color()));
            canvas.text(verdict.sign(), (x + 8.0, y), label)?;
            let label = Label::left(9.5);
            canvas.text(verdict.meaning(), (x + 21.0, y), label)?;
            x += 36.0 + label.width(verdict.meaning());
        }
        Ok(())
    })?;
    Ok((drawn, words(family)))
}

/// What stands in the cells of a kernel: bits that are right on half of the rays, or the share that is wrong. A cell
/// without a verdict was not measured.
fn cells(row: &Row) -> Vec<(Option<Verdict>, String)> {
    let mut cells: Vec<(Option<Verdict>, String)> = row
        .by_ray_family
        .iter()
        .map(|accuracy| {
            let verdict = Verdict::of(accuracy);
            let number = match verdict {
                Verdict::Wrong => share(accuracy.wrong_per_million()),
                Verdict::Beyond => share(accuracy.beyond_bound_per_million),
                _ => accuracy
                    .t
                    .map_or(String::new(), |t| format!("{:.0}", t.correct_bits())),
            };
            (Some(verdict), format!("{} {number}", verdict.sign()))
        })
        .collect();
    if let Some(leaks) = row.leaks_per_million {
        cells.push(if leaks > 0.0 {
            let sign = Verdict::Leak.sign();
            (Some(Verdict::Leak), format!("{sign} {}", share(leaks)))
        } else {
            (Some(Verdict::Correct), "= closed".into())
        });
    }
    cells
}

/// Of a million.
fn share(per_million: f64) -> String {
    percent(per_million / 1e6)
}

/// What the numbers say.
fn words(family: &Family) -> String {
    let known = || family.rows.iter().filter(|row| !row.student);
    let right: Vec<String> = known().filter(|row| is_right(row)).map(name).collect();
    let mut said = format!(
        "Of {} kernels these decide every family of rays right{}: {}. ",
        known().count(),
        if known().any(|row| row.leaks_per_million.is_some()) {
            " and let nothing out of a closed mesh"
        } else {
            ""
        },
        list(&right)
    );
    let wrong = |k: usize| {
        let wrong = known().map(|row| {
            row.by_ray_family
                .get(k)
                .map_or(0.0, Accuracy::wrong_per_million)
        });
        wrong.filter(|wrong| *wrong > 0.0).count()
    };
    let hardest = (0..family.columns.len()).max_by_key(|k| wrong(*k));
    if let Some(k) = hardest.filter(|k| wrong(*k) > 0) {
        said += &format!(
            "The family that most are wrong on is “{}” ({} of them): {}. ",
            family.columns[k].family.name(),
            wrong(k),
            family.columns[k].about
        );
    }
    if let Some(yours) = family.rows.iter().find(|row| row.student) {
        let wrong: Vec<&str> = yours
            .by_ray_family
            .iter()
            .filter(|a| a.wrong_per_million() > 0.0)
            .map(|a| a.family.name())
            .collect();
        said += &if wrong.is_empty() {
            "Yours decides all of them right.".to_string()
        } else {
            format!("Yours is wrong on: {}.", list(&wrong))
        };
    }
    said
}

fn is_right(row: &Row) -> bool {
    row.leaks_per_million.unwrap_or(0.0) == 0.0
        && row
            .by_ray_family
            .iter()
            .all(|a| a.wrong_per_million() == 0.0)
}
