//! The errors that the chapter about spheres shows: measured from kernels and formulas against the
//! exact roots of the oracle.

use super::claims::Claim;
use book::figures::part1_sphere::{EXPONENTS, HAINES, TEXTBOOK};
use kernels::Precision;
use kit::{PixelSampler, Ray, Sphere, Vec3};

/// Rays for each distance.
const RAYS: usize = 200;

/// The medians of the relative errors for one distance.
struct Errors {
    /// Of the squared half chord Δ/a, from b² - ac and from r² - ℓ².
    half_chord: [f64; 2],
    /// Of t: the textbook's formula, and with Haines' discriminant.
    t: [f64; 2],
    /// How many times b² is larger than Δ: no error, but the reason of the first one.
    terms: f64,
}

/// A sphere of radius 1 at the origin, and a ray from `distance` that passes the centre at 0.6. Its
/// direction has small integers as coordinates, so that its square is exact.
fn ray(sampler: &mut PixelSampler, distance: f64) -> Ray {
    loop {
        let (a, b) = (sampler.get_sample(), sampler.get_sample());
        let d = Vec3::new(a.x, a.y, b.x).map(|x| (2000.0 * x).floor() - 1000.0);
        let across = d.cross(Vec3::new(b.y, 0.3, -0.7));
        if d.length() > 100.0 && across.length() > 1.0 {
            let o = 0.6 * across.normalize() - distance * d.normalize();
            return Ray::new(o, d);
        }
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

const SPHERE: Sphere = Sphere {
    center: Vec3::ZERO,
    radius: 1.0,
};

/// The well-known test of this name, in double precision.
fn kernel(name: &str) -> kernels::Kernel<Sphere, kernels::HitF64> {
    let mut all = kernels::spheres().into_iter();
    let is_it = |kernel: &kernels::Kernel<_, _>| {
        kernel.info.name == name && kernel.precision == Precision::F64
    };
    all.find(is_it).expect("the kernel exists")
}

fn relative(value: f64, truth: f64) -> f64 {
    ((value - truth) / truth).abs()
}

fn errors(distance: f64) -> Errors {
    let sphere = SPHERE;
    let kernels = [kernel("quadratic formula"), kernel("Haines's discriminant")];
    let mut sampler = PixelSampler::new(0, 0, 1);
    let (mut half_chord, mut t, mut terms) = ([vec![], vec![]], [vec![], vec![]], vec![]);
    for _ in 0..RAYS {
        let ray = ray(&mut sampler, distance);
        let [near, far] = oracle::sphere(&sphere, &ray).roots.expect("it hits");
        let ((m1, e1), (m2, e2)) = (near.parts(), far.parts());
        // The difference of the roots as an integer times a power of two. The roots have more than
        // 100 bits, of which a few of the last are lost.
        let e = e1.max(e2) + 1;
        let difference = (m2 >> (e - e2)) - (m1 >> (e - e1));
        let half = 0.5 * difference as f64 * 2_f64.powi(e as i32);
        let (a, b) = (ray.d.dot(ray.d), -ray.o.dot(ray.d));
        let truth = a * half * half;
        let c = ray.o.dot(ray.o) - 1.0;
        let nearest = ray.o + (b / a) * ray.d;
        terms.push(b * b / (a * truth));
        half_chord[0].push(relative((b * b - a * c) / a, truth));
        half_chord[1].push(relative(1.0 - nearest.length_squared(), truth));
        for (errors, kernel) in t.iter_mut().zip(&kernels) {
            let hit = kernel.answer(&sphere, &ray);
            errors.push(hit.map_or(1.0, |hit| relative(hit.t, near.to_f64())));
        }
    }
    Errors {
        half_chord: half_chord.map(median),
        t: t.map(median),
        terms: median(terms),
    }
}

/// The median errors of t for rays that start a millionth above the surface: the textbook's
/// formula, the other root from `c / q`, and this root with a `c` that is nearly exact.
fn errors_near_the_surface() -> [f64; 3] {
    let kernels = [kernel("quadratic formula"), kernel("q form")];
    let mut sampler = PixelSampler::new(0, 0, 2);
    let mut found = [vec![], vec![], vec![]];
    while found[0].len() < RAYS {
        let (a, b) = (sampler.get_sample(), sampler.get_sample());
        let up = Vec3::new(a.x - 0.5, a.y - 0.5, b.x - 0.5).normalize();
        let d = Vec3::new(b.y - 0.5, b.x - a.y, a.x - 0.5);
        let ray = Ray::new((1.0 + 1e-6) * up, d);
        // Neither away from the sphere nor nearly along its surface.
        if d.dot(up) > -0.1 * d.length() {
            continue;
        }
        let [near, _] = oracle::sphere(&SPHERE, &ray).roots.expect("it hits");
        let truth = near.to_f64();
        for (errors, kernel) in found.iter_mut().zip(&kernels) {
            let hit = kernel.answer(&SPHERE, &ray).expect("it hits");
            errors.push(relative(hit.t, truth));
        }
        let c = square_less_one(ray.o);
        let (a, b) = (d.dot(d), -ray.o.dot(d));
        let q = b + (b * b - a * c).sqrt();
        found[2].push(relative(c / q, truth));
    }
    found.map(median)
}

/// `v·v - 1`, of which no rounding error is lost before the last addition.
fn square_less_one(v: Vec3) -> f64 {
    let squares = v.to_array().map(|x| (x * x, x.mul_add(x, -x * x)));
    let (mut sum, mut errors) = (-1.0, 0.0);
    for (square, error) in squares {
        let next: f64 = sum + square;
        // What the addition has rounded away (Knuth).
        let back = next - sum;
        errors += (sum - (next - back)) + (square - back) + error;
        sum = next;
    }
    sum + errors
}

/// Rounded to two digits.
fn two_digits(x: f64) -> f64 {
    format!("{x:.1e}").parse().expect("a number")
}

#[test]
fn the_figure_shows_what_is_measured() {
    let found = EXPONENTS.map(|exponent| errors(10_f64.powi(exponent)).half_chord);
    let of = |form: usize| found.map(|errors| two_digits(errors[form]));
    assert_eq!(of(0), TEXTBOOK);
    assert_eq!(of(1), HAINES);
}

pub(super) fn claims() -> Vec<Claim> {
    let (near, far) = (errors(10.0), errors(1e8));
    let digits = |error: f64| (-error.log10()).floor();
    let power = |x: f64| {
        let text = format!("{x:.1e}");
        let (digits, exponent) = text.split_once('e').expect("an exponent");
        format!("${digits} \\cdot 10^{{{exponent}}}$")
    };
    let blind = EXPONENTS
        .into_iter()
        .zip(TEXTBOOK)
        .filter(|(_, error)| *error > 0.1)
        .map(|(exponent, _)| exponent)
        .min();
    let blind = blind.expect("the error grows");
    let thousand = errors(1e3).half_chord[0];
    let lost = 16.0 + thousand.log10();
    assert_eq!(lost.round(), 6.0, "six of sixteen are lost");
    // Digits that are lost with each factor of ten in the distance.
    let slope = |form: usize| {
        let of = |distance: f64| errors(distance).half_chord[form].log10();
        ((of(1e6) - of(1e2)) / 4.0).round()
    };
    assert_eq!([slope(0), slope(1)], [2.0, 1.0], "two digits, and one");
    assert_eq!(blind, 8, "one hundred million");
    let terms = far.terms.log10().round();
    let [textbook, product, exact] = errors_near_the_surface().map(power);
    vec![
        (
            "accuracy.md",
            "the textbook's discriminant loses two digits for each factor of ten in the distance. A sphere 1000 radii away \
             costs six of the sixteen digits of the half chord; one hundred million radii away, all. The form that cancels \
             lengths before it squares them loses one digit for each factor of ten"
                .into(),
        ),
        (
            "part1/task4.md",
            format!(
                "With a distance of $10^8$ radii, the terms are $10^{{{terms}}}$ times larger than their difference"
            ),
        ),
        (
            "part1/task4.md",
            format!(
                "From a height of $10^{{-6}}$ above a sphere of radius 1, the median error of $t$ is {textbook} with the \
                 textbook's formula and {product} with $c / q$."
            ),
        ),
        (
            "part1/task4.md",
            format!("$c / q$ has an error of {exact}."),
        ),
        (
            "part1/task4.md",
            format!("From a distance of about $10^{blind}$ on no digit of it is right"),
        ),
        (
            "part1/task4.md",
            format!(
                "the median error of this form is {} at a distance of 10 and {} at $10^8$",
                power(near.half_chord[1]),
                power(far.half_chord[1])
            ),
        ),
        (
            "part1/task4.md",
            format!(
                "At a distance of $10^8$, {} digits of the textbook's $t$ are still right",
                digits(far.t[0])
            ),
        ),
    ]
}
