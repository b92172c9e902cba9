//! Rust tests of boxes.

use crate::tools::Tier;
use crate::tools::convert;
use crate::tools::repro::numbers::{float, ray, vec3};
use kit::{Aabb, Vec3};
use oracle::{self, KernelClass};
use std::fmt::Write;
use wire::work::{Probe, Xyz};

/// Relative error that a test allows at an end of the interval: far above the grader's bound, far
/// below the effect of a mistake.
const END_ERROR: f64 = 1e-12;

/// A test of hit or miss, and of the start and end of the interval; `None` where either answer
/// scores.
pub(crate) fn interval(tier: Tier, boxes: &[[Xyz; 2]], probe: &Probe) -> Option<String> {
    let [min, max] = *boxes.get(probe.shape as usize)?;
    let b = Aabb {
        min: Vec3::from(min),
        max: Vec3::from(max),
    };
    let kernel = match tier {
        Tier::Core => KernelClass::Textbook,
        Tier::Robust => KernelClass::Robust,
    };
    let verdict = oracle::bbox(&b, &convert::ray(&probe.ray));
    if verdict.undecidable(kernel) {
        return None;
    }
    let mut text = String::from("use kit::{Aabb, Ray, Vec3};\n");
    let _ = writeln!(
        text,
        "let b = Aabb {{ min: {}, max: {} }};",
        vec3(min),
        vec3(max)
    );
    ray(&mut text, &probe.ray);
    let Ok(inside) = verdict.inside else {
        text.push_str("assert_eq!(bbox::intersect_bbox(&b, &ray), None);\n");
        return Some(text);
    };
    let _ = writeln!(
        text,
        "let inside = bbox::intersect_bbox(&b, &ray).expect(\"the ray meets the box\");"
    );
    for (end, right) in [("min", inside.min.to_f64()), ("max", inside.max.to_f64())] {
        let _ = if right.is_finite() {
            writeln!(
                text,
                "assert!((inside.{end} - {}).abs() <= {}, \"{end} = {{}}\", inside.{end});",
                float(right),
                float(END_ERROR * right.abs().max(f64::MIN_POSITIVE))
            )
        } else {
            writeln!(text, "assert_eq!(inside.{end}, {});", float(right))
        };
    }
    Some(text)
}
