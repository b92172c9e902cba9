//! A heat map of accuracy: one column per family of rays, one row per kernel.

use super::canvas::{DrawResult, Label, svg};
use super::formatting::{list, name, percent};
use super::style::{GREEN, PURPLE, SKY, VERMILION, YELLOW, text_color_on};
use crate::report::{Accuracy, KernelFamily, KernelRow};
use grader::error::GraderError;
use plotters::style::{RGBColor, WHITE};

/// Sizes of the kernel names, the family names and the cells, in points.
const NAMES: f64 = 172.0;
const HEAD: f64 = 34.0;
const WIDTH: f64 = 860.0;
const ROW: f64 = 18.0;
const KEY: f64 = 26.0;

/// Largest median error of `t`, in units in the last place, of [`CellClass::Correct`].
const LAST_PLACE: f64 = 1.0;

/// The class of a kernel on one family of rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CellClass {
    /// No wrong decision, `t` correct to the last place.
    Correct,
    /// No wrong decision, `t` within the forward error bound.
    Within,
    /// No wrong decision, `t` beyond the bound for some rays.
    Beyond,
    /// Wrong decisions.
    Wrong,
    /// Rays leave a closed mesh.
    Leak,
}

impl CellClass {
    const ALL: [CellClass; 5] = [
        CellClass::Correct,
        CellClass::Within,
        CellClass::Beyond,
        CellClass::Wrong,
        CellClass::Leak,
    ];

    fn of(accuracy: &Accuracy) -> CellClass {
        if accuracy.wrong_per_million() > 0.0 {
            CellClass::Wrong
        } else if accuracy.beyond_bound_per_million > 0.0 {
            CellClass::Beyond
        } else if accuracy.t.is_some_and(|t| t.ulp.p50 > LAST_PLACE) {
            CellClass::Within
        } else {
            CellClass::Correct
        }
    }

    fn color(self) -> RGBColor {
        match self {
            CellClass::Correct => GREEN,
            CellClass::Within => SKY,
            CellClass::Beyond => YELLOW,
            CellClass::Wrong => VERMILION,
            CellClass::Leak => PURPLE,
        }
    }

    /// A sign that can be read without colour.
    fn sign(self) -> &'static str {
        match self {
            CellClass::Correct => "=",
            CellClass::Within => "≈",
            CellClass::Beyond => ">",
            CellClass::Wrong => "✗",
            CellClass::Leak => "○",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            CellClass::Correct => "correct to the last place",
            CellClass::Within => "within the bound (bits)",
            CellClass::Beyond => "t beyond the bound",
            CellClass::Wrong => "wrong decisions",
            CellClass::Leak => "leaks",
        }
    }
}

/// Draws the heat map; returns the SVG and its caption.
pub(crate) fn figure(family: &KernelFamily) -> Result<(String, String), GraderError> {
    let has_leaks = family
        .rows
        .iter()
        .any(|row| row.leaks_per_million.is_some());
    let columns = family.columns.len() + usize::from(has_leaks);
    let cell = (WIDTH - NAMES) / columns.max(1) as f64;
    let height = HEAD + ROW * family.rows.len() as f64 + KEY;
    let label = format!("Accuracy by family of rays: {}", family.shape.name());
    let figure_html = svg(WIDTH, height, &label, |canvas| -> DrawResult {
        let center = |column: usize, y: f64| (NAMES + cell * (column as f64 + 0.5), y);
        let mut headings: Vec<&str> = family.columns.iter().map(|c| c.family.name()).collect();
        if has_leaks {
            headings.push("closed mesh");
        }
        for (column, head) in headings.iter().enumerate() {
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
            for (column, (class, text)) in cells(row).into_iter().enumerate() {
                let left = NAMES + cell * column as f64;
                let color = class.map_or(WHITE, CellClass::color);
                let corners = [
                    (left + 0.6, top + 0.6),
                    (left + cell - 0.6, top + ROW - 0.6),
                ];
                canvas.rectangle(corners[0], corners[1], color)?;
                let label = Label::centered(9.0).in_color(text_color_on(color));
                canvas.text(&text, center(column, top + 0.5 * ROW), label)?;
            }
        }
        let y = height - 0.4 * KEY;
        let mut x = 12.0;
        for class in CellClass::ALL {
            if class == CellClass::Leak && !has_leaks {
                continue;
            }
            canvas.rectangle((x, y - 7.0), (x + 16.0, y + 7.0), class.color())?;
            let label = Label::centered(9.0).in_color(text_color_on(class.color()));
            canvas.text(class.sign(), (x + 8.0, y), label)?;
            let label = Label::left(9.5);
            canvas.text(class.meaning(), (x + 21.0, y), label)?;
            x += 36.0 + label.width(class.meaning());
        }
        Ok(())
    })?;
    Ok((figure_html, caption(family)))
}

/// Returns the cells of a kernel: the bits of t that are correct for half of the rays, or the
/// fraction of wrong rays.
fn cells(row: &KernelRow) -> Vec<(Option<CellClass>, String)> {
    let mut cells: Vec<(Option<CellClass>, String)> = row
        .by_ray_family
        .iter()
        .map(|accuracy| {
            let class = CellClass::of(accuracy);
            let number = match class {
                CellClass::Wrong => share(accuracy.wrong_per_million()),
                CellClass::Beyond => share(accuracy.beyond_bound_per_million),
                _ => accuracy
                    .t
                    .map_or(String::new(), |t| format!("{:.0}", t.correct_bits())),
            };
            (Some(class), format!("{} {number}", class.sign()))
        })
        .collect();
    if let Some(leaks) = row.leaks_per_million {
        cells.push(if leaks > 0.0 {
            let sign = CellClass::Leak.sign();
            (Some(CellClass::Leak), format!("{sign} {}", share(leaks)))
        } else {
            (Some(CellClass::Correct), "= closed".into())
        });
    }
    cells
}

/// Formats a count per million in percent.
fn share(per_million: f64) -> String {
    percent(per_million / 1e6)
}

/// Returns the caption, computed from the numbers.
fn caption(family: &KernelFamily) -> String {
    let known = || family.rows.iter().filter(|row| !row.student);
    let right: Vec<String> = known().filter(|row| is_right(row)).map(name).collect();
    let mut text = format!(
        "Of {} kernels, these have no wrong decision in any family of rays{}: {}. ",
        known().count(),
        if known().any(|row| row.leaks_per_million.is_some()) {
            " and no leaks"
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
        text += &format!(
            "The family with wrong decisions for most kernels is “{}” ({} of {} kernels): {}. ",
            family.columns[k].family.name(),
            wrong(k),
            known().count(),
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
        text += &if wrong.is_empty() {
            "Your code has no wrong decision.".to_string()
        } else {
            format!("Your code has wrong decisions for: {}.", list(&wrong))
        };
    }
    text
}

fn is_right(row: &KernelRow) -> bool {
    row.leaks_per_million.unwrap_or(0.0) == 0.0
        && row
            .by_ray_family
            .iter()
            .all(|a| a.wrong_per_million() == 0.0)
}
