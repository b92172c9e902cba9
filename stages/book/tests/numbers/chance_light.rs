//! The numbers of the chapters about chance and light, by integration and not by the formulas of
//! the text.

use super::claims::Claim;
use super::{Numbers, check};
use kit::Vec3;
use std::f64::consts::PI;

/// The integral of `f` from 0 to 1, by Simpson's rule.
fn integral(f: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 2000;
    let h = 1.0 / f64::from(STEPS);
    let weight = |i: u32| match i {
        0 | STEPS => 1.0,
        i if i % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let sum: f64 = (0..=STEPS).map(|i| weight(i) * f(h * f64::from(i))).sum();
    sum * h / 3.0
}

/// Mean and variance of `value` of a number with the density `density`.
fn moments(value: impl Fn(f64) -> f64, density: impl Fn(f64) -> f64) -> (f64, f64) {
    let mean = integral(|x| value(x) * density(x));
    let square = integral(|x| value(x) * value(x) * density(x));
    (mean, square - mean * mean)
}

#[test]
fn chance() {
    let mut text = Numbers::default();
    let half = text.n(0.5);
    text.n(half);
    text.n(half * integral(|x| 2.0 * half * x));
    let (mean, variance) = moments(|r| r, |r| 2.0 * r);
    text.n(mean);
    text.n(integral(|r| r * r * 2.0 * r));
    text.n(0.5);
    text.n(mean);
    text.n(variance);
    let sigma = text.n(variance.sqrt());
    let n = text.n(100.0);
    text.n(sigma / n.sqrt());
    text.n(0.0);
    text.n(1.0);
    let (mean, plain) = moments(|x| x * x, |_| 1.0);
    text.n(mean);
    text.n(plain);
    text.n(2.0);
    text.n(2.0);
    let (mean, better) = moments(|x| 0.5 * x, |x| 2.0 * x);
    assert!((mean - 1.0 / 3.0).abs() < 1e-12, "unbiased");
    text.n(better);
    text.n(plain / better);
    text.n(plain / better);
    check("chance.md", text);
}

/// The solid angle and the irradiance of a square with edges of 1 and the radiance 1, at the height
/// `h` above the point: integrals over the square.
fn square_above(h: f64) -> [f64; 2] {
    let of = |power: i32| {
        let inner = |x: f64| {
            integral(|y| {
                let r2 = (x - 0.5).powi(2) + (y - 0.5).powi(2) + h * h;
                (h / r2.sqrt()).powi(power) / r2
            })
        };
        // The outer integral with fewer steps, by the midpoint rule.
        (0..200)
            .map(|i| inner((f64::from(i) + 0.5) / 200.0))
            .sum::<f64>()
            / 200.0
    };
    [of(1), of(2)]
}

#[test]
fn light() {
    let mut text = Numbers::default();
    let area = text.n(1.0);
    let radiance = text.n(10.0);
    let h = text.n(2.0);
    let [omega, irradiance] = square_above(h);
    text.n(area);
    text.n(h);
    let rough = text.n(area / (h * h));
    text.n(omega);
    let twice = text.n(2.0 * h);
    text.n(area);
    text.n(twice);
    text.n(area / (twice * twice));
    text.n(square_above(twice)[0]);
    text.n(radiance);
    text.n(rough);
    text.n(radiance * rough);
    let exact = text.n(radiance * irradiance);
    let rho = text.n(0.8);
    text.n(exact);
    text.n(rho);
    text.n(exact * rho / PI);
    check("light.md", text);
}

pub(super) fn claims() -> Vec<Claim> {
    let die = (1..=6).map(f64::from);
    let mean = die.clone().sum::<f64>() / 6.0;
    let variance = die.map(|x| x * x).sum::<f64>() / 6.0 - mean * mean;
    let q: f64 = 0.01;
    let spread = ((1.0 - q) / q).sqrt();
    // By the change of variables of the chapter: with the density 2r of r = sqrt(u).
    let root = integral(|r| (1.0 / r.max(1e-9)) * (2.0 * r.max(1e-9)));
    assert!((root - 2.0).abs() < 1e-9, "the mean of 1/sqrt(u) is {root}");
    vec![
        (
            "chance.md",
            format!("For a die it is {mean}, which no throw ever shows"),
        ),
        (
            "chance.md",
            format!("so the variance is 35/12, about {variance:.2}"),
        ),
        (
            "chance.md",
            format!(
                "about {spread:.2}. Its square divided by 0.01 is {:.0} samples: about 10,000",
                (spread / 0.1).powi(2)
            ),
        ),
    ]
}

/// The numbers of the answers to exercises.
pub(super) fn answers() -> Vec<Claim> {
    let fraction = |cos: f64, eta: f64| {
        let sine2 = eta * eta * (1.0 - cos * cos);
        if sine2 >= 1.0 {
            return 1.0;
        }
        let other = (1.0 - sine2).sqrt();
        let parallel = (cos - eta * other) / (cos + eta * other);
        let across = (eta * cos - other) / (eta * cos + other);
        0.5 * (parallel * parallel + across * across)
    };
    let schlick = |cos: f64| 0.04 + 0.96 * (1.0 - cos).powi(5);
    let outside = (0..900).map(|tenth| {
        let degrees = 0.1 * f64::from(tenth);
        let cos = degrees.to_radians().cos();
        let right = fraction(cos, 1.0 / 1.5);
        (schlick(cos) - right, degrees, right)
    });
    let worst = outside.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    let (error, degrees, right) = worst.expect("angles");
    let sign = if error > 0.0 { "much" } else { "little" };
    let error = error.abs();
    let critical = (1.0_f64 - (1.0 / 1.5_f64).powi(2)).sqrt();
    let inside = 1.0 - schlick(critical);
    let [_, below] = square_above(2.0);
    let first = (1..).find(|n| 0.99_f64.powi(*n) < 0.01).expect("a number");
    // The other end of the chord through (1, 2, 0), from behind the triangle.
    let (o, d) = (Vec3::new(-1.0, 1.0, -4.0), Vec3::new(1.0, 0.5, 2.0));
    assert_eq!(o + 2.0 * d, Vec3::new(1.0, 2.0, 0.0));
    assert_eq!(-d.dot((4.0 * Vec3::X).cross(4.0 * Vec3::Y)), -32.0);
    // Squares of twice the cosine, over uniform directions: the cosine is uniform.
    let square = integral(|z| 4.0 * z * z);
    assert!((square - 4.0 / 3.0).abs() < 1e-9);
    vec![
        (
            "part1/task3.md",
            "start at (-1, 1, -4) with the direction (1, 0.5, 2)".into(),
        ),
        (
            "part3/task1.md",
            "over the hemisphere is 4/3, so the relative variance is 1/3".into(),
        ),
        (
            "part3/task2.md",
            format!(
                "For the worked example that is {:.2}, and 0.8 / π of it is {:.3}",
                10.0 * below,
                8.0 * below / PI
            ),
        ),
        (
            "part4/task1.md",
            format!("that is {:.1} degrees", 1.5_f64.atan().to_degrees()),
        ),
        (
            "part4/task1.md",
            format!(
                "From outside the largest error is {error:.3}, too {sign}, at {degrees:.0} degrees, where the true fraction is {right:.3}. From inside the error grows up to {inside:.2} at the critical angle"
            ),
        ),
        (
            "part4/task3.md",
            format!(
                "for a reflectance above {:.2} the variance is infinite",
                0.5_f64.sqrt()
            ),
        ),
        (
            "part5/task2.md",
            format!("0.99 to the power of {first} is just below 0.01. So {first} samples"),
        ),
    ]
}
