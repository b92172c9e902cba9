//! Judges colours, numbers and directions.

use super::hits::{TOO_WIDE, WIDE, show};
use crate::tools::findings::{Aspect, Class, Findings, Message};
use kit::Vec3;
use wire::work::Xyz;

/// Whether every channel is within `bound` of the right one, relative to the largest right channel.
pub(crate) fn same_colour(answered: Xyz, right: Xyz, bound: f64) -> bool {
    let scale = right
        .iter()
        .fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let pairs = answered.iter().zip(right);
    pairs
        .into_iter()
        .all(|(a, b)| (a - b).abs() <= bound * scale)
}

/// The class of a wrong colour.
fn class_of(answered: Xyz, right: Xyz) -> Class {
    let is_finite = answered.iter().all(|channel| channel.is_finite());
    if right == [0.0; 3] && is_finite {
        Class::FalseHit
    } else if answered == [0.0; 3] {
        Class::FalseMiss
    } else {
        Class::of_colour(answered, right)
    }
}

/// Records that an answer is not judged if it may be off by too much.
fn check_width(findings: &mut Findings, aspect: Aspect, call: usize, bound: f64) {
    if bound > WIDE {
        findings.not_judged(aspect, call, TOO_WIDE);
    }
}

/// Judges a colour.
pub(crate) fn colour(
    findings: &mut Findings,
    aspect: Aspect,
    call: usize,
    answered: Xyz,
    right: Xyz,
    bound: f64,
    about: impl FnOnce() -> String,
) {
    let off = (Vec3::from(answered) - Vec3::from(right)).length();
    let class = (!same_colour(answered, right, bound)).then(|| class_of(answered, right));
    check_width(findings, aspect, call, bound);
    findings.judge_class(aspect, call, class, off, || {
        Message::new(format!("your result: {answered:?}; expected: {right:?}"))
            .compares(answered, right)
            .asked(about())
    });
}

/// Judges a number.
pub(crate) fn number(
    findings: &mut Findings,
    aspect: Aspect,
    call: usize,
    answered: f64,
    right: f64,
    bound: f64,
    about: impl FnOnce() -> String,
) {
    let off = (answered - right).abs();
    let is_right = off <= bound * right.abs() || answered == right;
    let class = (!is_right).then(|| Class::of_signed_number(answered, right));
    check_width(findings, aspect, call, bound);
    findings.judge_class(aspect, call, class, off, || {
        Message::new(format!("your result: {answered}; expected: {right}"))
            .compares([answered], [right])
            .asked(about())
    });
}

/// Judges a unit vector.
pub(crate) fn direction(
    findings: &mut Findings,
    aspect: Aspect,
    call: usize,
    answered: Xyz,
    right: Vec3,
    bound: f64,
    about: impl FnOnce() -> String,
) {
    let answered = Vec3::from(answered);
    let off = (answered - right).length();
    let class = (off.is_nan() || off > bound).then(|| Class::of_direction(answered, right));
    check_width(findings, aspect, call, bound);
    findings.judge_class(aspect, call, class, off, || {
        Message::new(format!(
            "your result: {}; expected: {}",
            show(answered),
            show(right)
        ))
        .compares(answered.to_array(), right.to_array())
        .asked(about())
    });
}
