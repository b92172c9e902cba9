//! Rust tests of diffuse surfaces.

use super::{judge, truth};
use crate::tools::repro::numbers::{float, same_colour, spectrum, vec3};
use std::fmt::Write;
use wire::direct::LambertProbe;

/// A test of value, density and the fields of one sample. The distribution of samples is not
/// tested.
pub(crate) fn matte(probe: &LambertProbe) -> String {
    let (f, pdf) = truth::right(probe);
    let bound = judge::BOUND;
    let mut text = format!(
        "use kit::{{Spectrum, Vec2, Vec3}};
let reflectance = {};
let (wo, wi) = ({}, {});
let f = direct::lambert_f(reflectance, wo, wi);
{}
let pdf = direct::lambert_pdf(wo, wi);
assert!((pdf - {pdf}).abs() <= {}, \"pdf = {{pdf}}\");
let sample = direct::lambert_sample(reflectance, wo, Vec2::new({}, {}));
",
        spectrum(probe.reflectance),
        vec3(probe.wo),
        vec3(probe.wi),
        same_colour("f", f, bound),
        float(bound * pdf),
        float(probe.u[0]),
        float(probe.u[1]),
        pdf = float(pdf),
    );
    if probe.wo[2] == 0.0 {
        text.push_str("assert_eq!(sample, None);\n");
        return text;
    }
    let f = same_colour("f", truth::sampled_f(probe.reflectance), bound);
    let _ = write!(
        text,
        "let sample = sample.expect(\"expected a sample\");
assert!((sample.wi.length() - 1.0).abs() <= {bound:?}, \"{{}} is not unit\", sample.wi);
assert!(sample.wi.z * wo.z > 0.0, \"{{}} is not on the side of wo\", sample.wi);
let f = sample.f;
{f}
let pdf = sample.wi.z.abs() * {along_the_normal};
assert!(sample.pdf > 0.0 && (sample.pdf - pdf).abs() <= {bound:?} * pdf + 1e-15, \"pdf = {{}}\", sample.pdf);
assert!(!sample.delta);
",
        along_the_normal = float(truth::density()(1.0)),
    );
    text
}
