//! Writes numbers, vectors and rays as Rust literals.

use std::fmt::Write;
use wire::work::{Ray, Xyz};

/// Adds the line that defines `ray`.
pub(crate) fn ray(text: &mut String, ray: &Ray) {
    let _ = writeln!(
        text,
        "let ray = Ray {{\n    o: {},\n    d: {},",
        vec3(ray.o),
        vec3(ray.d)
    );
    let _ = writeln!(
        text,
        "    min_t: {},\n    max_t: {},\n}};",
        float(ray.min_t),
        float(ray.max_t)
    );
}

/// The line that asserts that the variable `after` equals `ray`, which has this value.
pub(crate) fn unchanged(after: &str, ray: &Ray) -> String {
    let mut fields = ray.o.into_iter().chain(ray.d).chain([ray.min_t, ray.max_t]);
    match fields.any(f64::is_nan) {
        // A NaN is not equal to itself.
        true => format!("assert_eq!(format!(\"{{{after}:?}}\"), format!(\"{{ray:?}}\"));\n"),
        false => format!("assert_eq!({after}, ray);\n"),
    }
}

/// A vector, bit for bit.
pub(crate) fn vec3([x, y, z]: Xyz) -> String {
    format!("Vec3::new({}, {}, {})", float(x), float(y), float(z))
}

/// A colour, bit for bit.
pub(crate) fn spectrum([r, g, b]: Xyz) -> String {
    format!("Spectrum::new({}, {}, {})", float(r), float(g), float(b))
}

/// A float, bit for bit.
pub(crate) fn float(number: f64) -> String {
    if number.is_nan() {
        "f64::NAN".into()
    } else if number.is_infinite() {
        if number > 0.0 {
            "f64::INFINITY".into()
        } else {
            "f64::NEG_INFINITY".into()
        }
    } else {
        format!("{number:?}")
    }
}

/// The lines that assert that each channel of `what` is within `bound` of the right one, relative
/// to the largest right channel.
pub(crate) fn same_colour(what: &str, right: Xyz, bound: f64) -> String {
    let scale = right
        .iter()
        .fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let [r, g, b] = right.map(float);
    format!(
        "let off = [{what}.r - {r}, {what}.g - {g}, {what}.b - {b}];
assert!(off.iter().all(|off| off.abs() <= {}), \"{{{what}:?}}\");",
        float(bound * scale)
    )
}
