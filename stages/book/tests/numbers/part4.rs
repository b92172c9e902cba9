//! The worked examples of Part 4.

use super::{Numbers, check};
use kit::Vec3;

#[test]
fn task1() {
    let mut text = Numbers::default();
    let ior = text.n(1.5);
    let wo = text.v(Vec3::new(0.6, 0.0, 0.8));
    text.v(Vec3::new(-wo.x, -wo.y, wo.z));
    text.n(1.0);
    text.n(ior);
    let eta = text.n(1.0 / ior);
    text.n(eta);
    text.n(wo.x);
    let sin = text.n(eta * wo.x);
    text.n(1.0 - sin * sin);
    let cos = text.n((1.0 - sin * sin).sqrt());
    text.v(Vec3::new(-sin, 0.0, -cos));
    // Fresnel by the sine and tangent laws, which are another form of the amplitudes.
    let (a, b) = (wo.x.asin(), sin.asin());
    for x in [wo.z, eta, cos, wo.z, eta, cos] {
        text.n(x);
    }
    let p = text.n((a - b).tan() / (a + b).tan());
    for x in [eta, wo.z, cos, eta, wo.z, cos] {
        text.n(x);
    }
    let s = text.n(-(a - b).sin() / (a + b).sin());
    text.n(p * p);
    text.n(s * s);
    text.n(2.0);
    let fraction = text.n(0.5 * (p * p + s * s));
    text.n(1.0);
    text.n(1.0 - fraction);
    text.n(eta * eta);
    let below = text.v(Vec3::new(0.8, 0.0, -0.6));
    text.n(ior);
    let sine = text.n(ior * below.x);
    assert!(sine >= 1.0);
    text.n(1.0);
    text.v(Vec3::new(-below.x, 0.0, below.z));
    check("part4/task1.md", text);
}

#[test]
fn task2() {
    let mut text = Numbers::default();
    let rho = text.v(Vec3::new(0.8, 0.2, 0.2));
    let first = text.v(Vec3::new(0.4, 0.1, 0.1));
    let beta2 = text.v(rho);
    let floor = text.n(0.5);
    let second = text.v(Vec3::splat(0.3));
    let added = text.v(beta2 * second);
    let beta3 = text.v(floor * beta2);
    assert!((beta3 - Vec3::new(0.4, 0.1, 0.1)).length() < 1e-15);
    let lamp = text.n(10.0);
    text.v(first);
    text.v(added);
    text.v(first + added);
    text.n(0.0);
    let beta3 = text.v(beta2);
    text.v(first + beta3 * lamp);
    let rho = text.n(0.5);
    let limit = text.n(3.0) as i32;
    let terms: Vec<f64> = (0..=limit).map(|k| text.n(f64::powi(rho, k))).collect();
    let sum = super::furnace::radiance(rho, limit as u32);
    assert_eq!(sum, terms.iter().sum::<f64>());
    text.n(sum);
    text.n(1.0 / (1.0 - rho));
    check("part4/task2.md", text);
}

#[test]
fn task3() {
    let mut text = Numbers::default();
    let beta = text.v(Vec3::new(0.25, 0.125, 0.0));
    let q = text.n(beta.max_element());
    let won = text.n(0.1);
    assert!(won < q);
    let survivor = text.v(beta / q);
    assert_eq!(text.n(0.25), q);
    text.n(q);
    text.v(survivor);
    text.n(1.0 - q);
    text.n(0.0);
    text.v(q * survivor);
    let rho = text.n(0.5);
    text.n(rho);
    text.n(2.0);
    text.n(1.0 / f64::powi(rho, 3));
    text.n(1.0);
    text.n(f64::powi(rho, 3));
    check("part4/task3.md", text);
}
