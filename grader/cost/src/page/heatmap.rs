//! A heat map of accuracy: one column per family of rays, one row per kernel.

use super::heatmap_cell::{CellClass, CellLook, cells};
use super::kernel_name::name;
use crate::report::{Accuracy, KernelFamily, KernelRow};
use plots::canvas::{Canvas, Label, Position, for_both_widths};
use plots::columns::Columns;
use plots::figure::Figure;
use plots::numbers::list;
use plots::style::{self, text_color_on};

/// Sizes in points of the kernel names, the family names and the rows.
const NAMES: f64 = 172.0;
const HEAD: f64 = 34.0;
const WIDTH: f64 = 860.0;
const ROW: f64 = 18.0;
const KEY: f64 = 26.0;

/// The same on a telephone, where the kernel's name is above its cells and the names of families
/// are upright.
const NARROW_WIDTH: f64 = 300.0;
const NARROW_HEAD: f64 = 88.0;
const NAME_LINE: f64 = 14.0;

/// Font size of names.
const NAME: f64 = 9.5;

/// Draws the heat map.
pub(crate) fn figure(family: &KernelFamily) -> Figure {
    let mut headings: Vec<&str> = family.columns.iter().map(|c| c.family.name()).collect();
    if has_leaks(family) {
        headings.push("closed mesh");
    }
    let rows = family.rows.len() as f64;
    let broad = [WIDTH, HEAD + ROW * rows + KEY];
    let narrow_key = KEY_LINE * (classes(family).count() as f64 + 1.0);
    let narrow = [
        NARROW_WIDTH,
        NARROW_HEAD + (NAME_LINE + ROW) * rows + narrow_key,
    ];
    let label = format!("Accuracy by family of rays: {}", family.shape.name());
    let drawing = for_both_widths(broad, narrow, &label, |canvas, size, is_narrow| {
        let layout = match is_narrow {
            false => Layout {
                is_narrow,
                left: NAMES,
                head: HEAD,
                row: ROW,
                cell: (WIDTH - NAMES) / headings.len().max(1) as f64,
            },
            true => Layout {
                is_narrow,
                left: 0.0,
                head: NARROW_HEAD,
                row: NAME_LINE + ROW,
                cell: NARROW_WIDTH / headings.len().max(1) as f64,
            },
        };
        draw_headings(canvas, &layout, &headings);
        for (i, row) in family.rows.iter().enumerate() {
            let top = layout.head + layout.row * i as f64;
            draw_row(canvas, &layout, top, row, &headings);
        }
        let corner = match is_narrow {
            false => (12.0, size[1] - 0.4 * KEY),
            true => (2.0, size[1] - narrow_key + 1.2 * KEY_LINE),
        };
        draw_key(canvas, corner, family, is_narrow)
    });
    let numbered = headings.iter().enumerate();
    let columns = numbered.fold(Columns::new("test", name), |columns, (i, head)| {
        columns.and_some(head, move |row| Some(cells(row).into_iter().nth(i)?.text))
    });
    let figure = Figure {
        finding: finding(family),
        drawing,
        caption: "Each cell is a test on a family of rays, with its correct bits of t, or with the share of rays that are wrong, shaded by degree."
            .into(),
        notes: caption(family),
        ..Figure::default()
    };
    columns.table(&family.rows, figure)
}

/// Where names and cells are.
struct Layout {
    /// Whether the drawing is for a telephone.
    is_narrow: bool,
    /// Left end of the first cell.
    left: f64,
    /// Top of the first row.
    head: f64,
    /// Distance of two rows.
    row: f64,
    /// Width of a cell.
    cell: f64,
}

impl Layout {
    fn middle(&self, column: usize) -> f64 {
        self.left + self.cell * (column as f64 + 0.5)
    }
}

/// Writes the names of the families above their columns.
fn draw_headings(canvas: &Canvas, layout: &Layout, headings: &[&str]) {
    for (column, head) in headings.iter().enumerate() {
        let x = layout.middle(column);
        if layout.is_narrow {
            let upright = Label {
                upright: true,
                ..Label::left(NAME)
            };
            canvas.text(head, (x, layout.head - 4.0), upright);
            continue;
        }
        let words: Vec<&str> = head.split(' ').collect();
        let (first, last) = words.split_at(words.len() - 1);
        let (first, last) = (first.join(" "), last.join(" "));
        canvas.text(&first, (x, layout.head - 21.0), Label::centered(NAME));
        canvas.text(&last, (x, layout.head - 9.0), Label::centered(NAME));
    }
}

/// Draws the name of a kernel and its cells.
fn draw_row(canvas: &Canvas, layout: &Layout, top: f64, row: &KernelRow, headings: &[&str]) {
    let bottom = top + layout.row;
    let (position, label) = match layout.is_narrow {
        false => ((layout.left - 6.0, bottom - 0.5 * ROW), Label::right(NAME)),
        true => ((2.0, bottom - ROW - 0.4 * NAME_LINE), Label::left(NAME)),
    };
    let label = if row.student { label.bold() } else { label };
    canvas.text(&name(row), position, label);
    for (column, cell) in cells(row).into_iter().enumerate() {
        let left = layout.left + layout.cell * column as f64;
        let corners = [
            (left + 0.6, bottom - ROW + 0.6),
            (left + layout.cell - 0.6, bottom - 0.6),
        ];
        canvas.rectangle(corners[0], corners[1], cell.color);
        let label = Label::centered(9.0).in_color(text_color_on(cell.color));
        let text = match layout.is_narrow {
            false => &cell.text,
            true => &cell.short,
        };
        canvas.text(text, (layout.middle(column), bottom - 0.5 * ROW), label);
        let tip = format!("{}, {}: {}", name(row), headings[column], cell.tip);
        canvas.tip_over(corners[0], corners[1], &tip);
    }
}

/// Distance in points of the lines of the key, where it has several.
const KEY_LINE: f64 = 16.0;

/// Draws what the shades of cells mean, in one line or, on a telephone, in one for each class.
fn draw_key(canvas: &Canvas, (start, mut y): Position, family: &KernelFamily, is_narrow: bool) {
    let mut x = start;
    for class in classes(family) {
        let CellLook {
            color,
            sign,
            meaning,
            unit,
        } = class.look();
        // Those that are shaded by degree have a key of three shades.
        let shades: &[f64] = match class {
            CellClass::Correct => &[1.0],
            _ => &[0.0, 0.5, 1.0],
        };
        for (i, strength) in shades.iter().enumerate() {
            let left = x + 8.0 * i as f64;
            let shade = style::tint(color, *strength);
            canvas.rectangle((left, y - 7.0), (left + 8.0, y + 7.0), shade);
        }
        let shown = if is_narrow { 3 } else { shades.len() };
        x += 8.0 * shown as f64 + 5.0;
        let label = Label::left(NAME);
        let text = match is_narrow {
            false => format!("{sign} {meaning}"),
            true => format!("{sign} {meaning}, {unit}"),
        };
        canvas.text(&text, (x, y), label);
        if is_narrow {
            (x, y) = (start, y + KEY_LINE);
        } else {
            x += 14.0 + label.width(&text);
        }
    }
}

fn has_leaks(family: &KernelFamily) -> bool {
    let mut rows = family.rows.iter();
    rows.any(|row| row.leaks_per_million.is_some())
}

/// The classes that cells of the map can have.
fn classes(family: &KernelFamily) -> impl Iterator<Item = CellClass> {
    let has_leaks = has_leaks(family);
    let all = CellClass::ALL.into_iter();
    all.filter(move |class| *class != CellClass::Leak || has_leaks)
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
    let mut text = String::new();
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
        let families = yours.by_ray_family.iter();
        let is_wrong = |a: &&Accuracy| a.wrong_per_million() > 0.0;
        let wrong: Vec<&str> = families.filter(is_wrong).map(|a| a.family.name()).collect();
        text += &if wrong.is_empty() {
            "Your code has no wrong decision.".to_string()
        } else {
            format!("Your code has wrong decisions for: {}.", list(&wrong))
        };
    }
    text
}

fn is_right(row: &KernelRow) -> bool {
    let mut families = row.by_ray_family.iter();
    row.leaks_per_million.unwrap_or(0.0) == 0.0 && families.all(|a| a.wrong_per_million() == 0.0)
}
