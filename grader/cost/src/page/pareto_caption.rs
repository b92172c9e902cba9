//! The heading and the notes of the plot of accuracy against time.

use super::front::{beats, bits, front};
use super::kernel_name::name;
use super::pareto::failure_rate;
use crate::report::{KernelFamily, KernelRow, Shape};
use crate::table::plus_minus;
use crate::timing::Timing;
use plots::numbers::{figures, list, percent};

/// Returns the caption, computed from the numbers.
pub(super) fn caption(family: &KernelFamily) -> String {
    let mut text = format!(
        "Bits: correct bits of t for half of the rays, averaged over the {} families of rays. The Pareto front (no other kernel is as \
         accurate and faster, or more accurate and as fast within the error bars), from the fastest on: {}. ",
        family.columns.len(),
        list(&front_steps(family)),
    );
    text += &fastest_without_failures(family);
    text += &with_and_without_fma(family);
    if let Some(yours) = family.rows.iter().find(|row| row.student) {
        let better: Vec<String> = family
            .rows
            .iter()
            .filter(|row| beats(row, yours))
            .map(name)
            .collect();
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

/// Returns each step of the front: its kernels, their times, bits and failures.
fn front_steps(family: &KernelFamily) -> Vec<String> {
    let kernel = |row: &&KernelRow| {
        let failures = match failure_rate(row) {
            0.0 => String::new(),
            rate => format!(", {} {}", failure_name(family.shape), percent(rate)),
        };
        format!(
            "{} ({}, {} bits{failures})",
            name(row),
            times_as_long(row.ranked_time()),
            bits(row)
        )
    };
    let steps = front(&family.rows).into_iter();
    steps
        .map(|step| {
            let kernels: Vec<String> = step.iter().map(kernel).collect();
            match kernels.as_slice() {
                [_, _, ..] => format!("the tie of {}", list(&kernels)),
                _ => list(&kernels),
            }
        })
        .collect()
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

/// Returns the sentence about the fastest kernels without failures.
fn fastest_without_failures(family: &KernelFamily) -> String {
    let without = match family.shape {
        Shape::Triangle => "without leaks",
        Shape::Sphere | Shape::Box => "without wrong decisions",
    };
    let rows = family.rows.iter();
    let mut safe: Vec<&KernelRow> = rows
        .filter(|row| !row.student && failure_rate(row) == 0.0)
        .collect();
    let time = |row: &KernelRow| row.ranked_time().ratio.median;
    safe.sort_by(|a, b| time(a).total_cmp(&time(b)));
    let Some((fastest, others)) = safe.split_first() else {
        return format!("There is no known kernel {without}. ");
    };
    let ties = others
        .iter()
        .filter(|row| row.ranked_time().ties_with(fastest.ranked_time()));
    let ties: Vec<String> = ties.map(|row| name(row)).collect();
    let takes = times_as_long(fastest.ranked_time());
    if ties.is_empty() {
        format!(
            "The fastest known kernel {without} is {}: it takes {takes}. ",
            name(fastest)
        )
    } else {
        format!(
            "The fastest known kernels {without} are {}, which takes {takes}, and within the error bars {}. ",
            name(fastest),
            list(&ties)
        )
    }
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

fn failure_name(shape: Shape) -> &'static str {
    match shape {
        Shape::Triangle => "leaks",
        Shape::Sphere | Shape::Box => "wrong decisions in the worst family:",
    }
}
