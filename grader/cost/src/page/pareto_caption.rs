//! The heading and the notes of the plot of accuracy against time.

use super::front::{beats, bits};
use super::kernel_name::name;
use super::pareto::failure_rate;
use crate::cells::plus_minus;
use crate::report::{KernelFamily, KernelRow, Shape};
use crate::timing::Timing;
use plots::numbers::{figures, list};

/// Returns the caption, computed from the numbers.
pub(super) fn caption(family: &KernelFamily) -> String {
    let mut text = format!(
        "Bits: correct bits of t for half of the rays, averaged over the {} families of rays. On the Pareto front no other kernel is \
         as accurate and faster, or more accurate and as fast within the error bars. ",
        family.columns.len(),
    );
    text += &with_and_without_fma(family);
    if let Some(yours) = family.rows.iter().find(|row| row.student) {
        let is_better = |row: &&KernelRow| beats(row, yours);
        let better: Vec<String> = family.rows.iter().filter(is_better).map(name).collect();
        text += &format!(
            "Your code (star) takes {} and has {} correct bits; {}.",
            times_as_long(&yours.time),
            bits(yours),
            if better.is_empty() {
                "no other kernel is as accurate and faster, or more accurate and as fast".into()
            } else {
                format!(
                    "these are as accurate and faster, or more accurate and as fast: {}",
                    list(&better)
                )
            }
        );
    }
    text
}

/// What the plot shows: the fastest test in the textbook's precision that never fails, and what it
/// costs.
pub(super) fn finding(family: &KernelFamily) -> String {
    let (never, always) = match family.shape {
        Shape::Triangle => ("never leaks", "Every known test leaks"),
        Shape::Sphere | Shape::Box => ("is never wrong", "Every known test is wrong for some rays"),
    };
    let textbook = family.rows.iter().find(|row| row.textbook);
    let precision = textbook.map(|row| row.precision);
    let time = |row: &KernelRow| row.ranked_time().ratio.median;
    let rows = family.rows.iter();
    let safe = rows
        .filter(|row| !row.student && failure_rate(row) == 0.0 && Some(row.precision) == precision)
        .min_by(|a, b| time(a).total_cmp(&time(b)));
    let Some((safe, textbook)) = safe.zip(textbook) else {
        return always.into();
    };
    let ratio = figures(time(safe));
    if safe.textbook {
        return format!("The textbook's test, {}, {never}", safe.name);
    }
    let (own, base) = (safe.ranked_time(), textbook.ranked_time());
    let cost = if own.ties_with(base) {
        "costs nothing".to_string()
    } else if own.is_faster_than(base) {
        format!("takes only {ratio} times the textbook's time")
    } else {
        format!("takes {ratio} times the textbook's time")
    };
    format!("{} {never} and {cost}", safe.name)
}

/// Returns the sentence about the kernels that use fused multiply-adds: both of their times.
fn with_and_without_fma(family: &KernelFamily) -> String {
    let rows = family.rows.iter().filter(|row| row.uses_fma);
    let both = rows.filter_map(|row| {
        let with_fma = plus_minus(&row.time_with_fma?.ratio, 2);
        let build = plus_minus(&row.time.ratio, 2);
        Some(format!("{} {with_fma} (else {build})", name(row)))
    });
    let both: Vec<String> = both.collect();
    if both.is_empty() {
        return String::new();
    }
    format!(
        "Kernels with fused multiply-adds choose AVX2 and FMA at run time, and are compared with the textbook's kernel with the same \
         instructions: {}. ",
        list(&both)
    )
}

/// Formats a ratio with its error.
fn times_as_long(time: &Timing) -> String {
    format!("{} times the textbook's time", plus_minus(&time.ratio, 2))
}
