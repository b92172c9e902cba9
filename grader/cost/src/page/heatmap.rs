//! A heat map of accuracy: one column per family of rays, one row per kernel.

use super::heatmap_cell::{Cell, CellClass, cells};
use super::kernel_name::name;
use crate::report::{Accuracy, KernelFamily, KernelRow};
use base::GraderError;
use plots::canvas::{DrawResult, Label, svg};
use plots::figure::Figure;
use plots::numbers::list;
use plots::style::{self, text_color_on};

/// Sizes of the kernel names, the family names and the cells, in points.
const NAMES: f64 = 172.0;
const HEAD: f64 = 34.0;
const WIDTH: f64 = 860.0;
const ROW: f64 = 18.0;
const KEY: f64 = 26.0;

/// Draws the heat map.
pub(crate) fn figure(family: &KernelFamily) -> Result<Figure, GraderError> {
    let has_leaks = family
        .rows
        .iter()
        .any(|row| row.leaks_per_million.is_some());
    let columns = family.columns.len() + usize::from(has_leaks);
    let cell = (WIDTH - NAMES) / columns.max(1) as f64;
    let height = HEAD + ROW * family.rows.len() as f64 + KEY;
    let label = format!("Accuracy by family of rays: {}", family.shape.name());
    let drawing = svg(WIDTH, height, &label, |canvas| -> DrawResult {
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
            for (column, cell_of) in cells(row).into_iter().enumerate() {
                let left = NAMES + cell * column as f64;
                let Cell { color, text, .. } = &cell_of;
                let color = *color;
                let corners = [
                    (left + 0.6, top + 0.6),
                    (left + cell - 0.6, top + ROW - 0.6),
                ];
                canvas.rectangle(corners[0], corners[1], color)?;
                let label = Label::centered(9.0).in_color(text_color_on(color));
                canvas.text(text, center(column, top + 0.5 * ROW), label)?;
                let tip = format!("{}, {}: {}", name(row), headings[column], cell_of.tip);
                canvas.tip_over(corners[0], corners[1], &tip);
            }
        }
        let y = height - 0.4 * KEY;
        let mut x = 12.0;
        for class in CellClass::ALL {
            if class == CellClass::Leak && !has_leaks {
                continue;
            }
            // Those that are shaded by degree have a key of three shades.
            let shades: &[f64] = match class {
                CellClass::Correct => &[1.0],
                _ => &[0.0, 0.5, 1.0],
            };
            for (i, strength) in shades.iter().enumerate() {
                let left = x + 8.0 * i as f64;
                let color = style::tint(class.color(), *strength);
                canvas.rectangle((left, y - 7.0), (left + 8.0, y + 7.0), color)?;
            }
            x += 8.0 * shades.len() as f64 + 5.0;
            let label = Label::left(9.5);
            let text = format!("{} {}", class.sign(), class.meaning());
            canvas.text(&text, (x, y), label)?;
            x += 14.0 + label.width(&text);
        }
        Ok(())
    })?;
    let mut head = vec!["test".to_string()];
    head.extend(family.columns.iter().map(|c| c.family.name().to_string()));
    if has_leaks {
        head.push("closed mesh".into());
    }
    let row_of = |row: &KernelRow| {
        let cells = cells(row).into_iter().map(|cell| cell.text);
        std::iter::once(name(row)).chain(cells).collect()
    };
    Ok(Figure {
        finding: finding(family),
        drawing,
        caption: "Each cell is a test on a family of rays, with its correct bits of t, or with the share of rays that are wrong, shaded by degree."
            .into(),
        notes: caption(family),
        head,
        rows: family.rows.iter().map(row_of).collect(),
    })
}

/// What the map shows: which tests are never wrong.
fn finding(family: &KernelFamily) -> String {
    let known = || family.rows.iter().filter(|row| !row.student);
    let right: Vec<String> = known().filter(|row| is_right(row)).map(name).collect();
    match right.len() {
        0 => format!(
            "None of {} tests is right on all families of rays",
            known().count()
        ),
        1..=3 => format!(
            "Only {} {} never wrong",
            list(&right),
            match right.len() {
                1 => "is",
                _ => "are",
            }
        ),
        n => format!("{n} of {} tests are never wrong", known().count()),
    }
}

/// Returns the notes, computed from the numbers.
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
