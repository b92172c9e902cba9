//! How tables are laid out, and how their numbers are written.

use crate::quartiles::Quartiles;
use crate::timing::Timing;
use comfy_table::{Cell, CellAlignment, Table, presets};
use plots::columns::{Columns, Kind};

/// Lays out rows in a frame: words on the left of their columns, numbers on the right.
pub(crate) fn framed<'r, T: 'r>(
    columns: &Columns<'_, T>,
    rows: impl IntoIterator<Item = &'r T>,
) -> Table {
    let (heads, rows) = columns.cells(rows);
    let mut table = Table::new();
    table
        .load_style(presets::UTF8_BORDERS_ONLY)
        .set_header(heads.iter().map(|(_, head)| head));
    for row in rows {
        table.add_row(heads.iter().zip(row).map(|((kind, _), cell)| match kind {
            Kind::Words => Cell::new(cell),
            _ => Cell::new(cell).set_alignment(CellAlignment::Right),
        }));
    }
    table
}

/// The same with narrow columns.
pub(crate) fn narrow<'r, T: 'r>(
    columns: &Columns<'_, T>,
    rows: impl IntoIterator<Item = &'r T>,
) -> Table {
    let mut table = framed(columns, rows);
    for column in table.column_iter_mut() {
        column.set_padding((1, 0));
    }
    if let Some(last) = table.column_iter_mut().last() {
        last.set_padding((1, 1));
    }
    table
}

pub(crate) fn nanoseconds(time: &Timing) -> String {
    plus_minus(&time.ns, 1)
}

pub(crate) fn ratio(time: &Timing) -> String {
    let tie = if time.ties_with_base() { "~" } else { "" };
    format!("{tie}{}", plus_minus(&time.ratio, 2))
}

/// Formats a median with the distance to the farther quartile.
pub(crate) fn plus_minus(measured: &Quartiles, decimals: usize) -> String {
    let error = measured.plus_minus();
    format!("{:.decimals$} ±{error:.decimals$}", measured.median)
}

/// Formats a factor of any size with its error.
pub(crate) fn factor(measured: &Quartiles) -> String {
    let decimals = match measured.median {
        ..9.95 => 2,
        ..99.5 => 1,
        _ => 0,
    };
    plus_minus(measured, decimals)
}

/// Formats a count per million.
pub(crate) fn count(per_million: f64) -> String {
    if per_million == 0.0 {
        "0".into()
    } else {
        figures(per_million)
    }
}

/// Formats with at most three significant digits; large numbers as powers of ten.
pub(crate) fn figures(x: f64) -> String {
    if x >= 1e6 {
        format!("{x:.0e}")
    } else if x >= 99.95 {
        format!("{x:.0}")
    } else {
        format!("{x:.1}")
    }
}
