//! Shapes and rays at them: ordinary ones, and every kind of hard one. By seed, the same everywhere.

mod bbox;
mod sphere;
mod triangle;

use super::report::{RayFamily, Shape};
use judge::cases::probes::{Dice, through};
use kernels::{Bundle, Precision};
use kit::{Ray, Vec3};

/// A shape that rays can be aimed at in hard ways.
pub(crate) trait Target: kernels::shapes::Shape {
    /// Which shape it is.
    const SHAPE: Shape;

    /// How many of them one ray is tested against in a row when times are taken: a leaf's worth.
    const PER_RAY: usize;

    /// What each family of rays is for this shape; families that say nothing about it are left out.
    const COLUMNS: &'static [(RayFamily, &'static str)];

    /// An ordinary one around the origin, and a point to aim at, on it or near it.
    fn aim(dice: &mut Dice) -> (Self, Vec3);

    /// One of a family that is particular to this shape.
    fn hard(family: RayFamily, dice: &mut Dice) -> Option<(Self, Ray)>;

    /// `scale` times as large about the origin, then moved.
    fn placed(&self, scale: f64, by: Vec3) -> Self;

    /// Each number rounded to what a kernel can store.
    fn stored(&self, precision: Precision) -> Self;

    /// Whether a kernel that leaves out what is seen from behind should hit where any kernel does.
    fn faces(&self, ray: &Ray) -> bool;
}

/// `count` shapes of a family, each with a ray at it.
pub(crate) fn pairs<S: Target>(family: RayFamily, seed: u64, count: usize) -> Vec<(S, Ray)> {
    let name = format!("cost {} {}", S::SHAPE.name(), family.name());
    let mut dice = Dice::new(&name, seed);
    (0..count)
        .map(|_| S::hard(family, &mut dice).unwrap_or_else(|| common(family, &mut dice)))
        .collect()
}

/// One of a family that is alike for all shapes.
fn common<S: Target>(family: RayFamily, dice: &mut Dice) -> (S, Ray) {
    let (shape, target) = S::aim(dice);
    let o = target + dice.range(2.0, 6.0) * dice.direction();
    let (scale, by) = match family {
        RayFamily::FarOffset => (1.0, decades(dice, 1.0, 6.0) * dice.direction()),
        RayFamily::TinyScale => (decades(dice, -30.0, -10.0), Vec3::ZERO),
        RayFamily::HugeScale => (decades(dice, 10.0, 30.0), Vec3::ZERO),
        _ => (1.0, Vec3::ZERO),
    };
    let place = |p: Vec3| scale * p + by;
    (shape.placed(scale, by), through(place(o), place(target)))
}

/// Uniform in orders of magnitude, from `10^low` to `10^high`.
fn decades(dice: &mut Dice, low: f64, high: f64) -> f64 {
    kit::math::pow(10.0, dice.range(low, high))
}

/// Ordinary rays, each with the shapes that it is tested against when times are taken.
pub(crate) fn bundles<S: Target>(seed: u64, tests: usize) -> Vec<Bundle<S>> {
    let mut dice = Dice::new(&format!("cost {} times", S::SHAPE.name()), seed);
    (0..tests / S::PER_RAY)
        .map(|_| {
            let ray = through(3.0 * dice.direction(), dice.in_cube());
            let shapes = (0..S::PER_RAY).map(|_| {
                let (shape, target) = S::aim(&mut dice);
                shape.placed(1.0, ray.at(dice.range(1.0, 5.0)) - target)
            });
            Bundle {
                shapes: shapes.collect(),
                ray,
            }
        })
        .collect()
}

/// The ray as a kernel can store it.
pub(crate) fn stored_ray(ray: &Ray, precision: Precision) -> Ray {
    Ray {
        o: stored_vec(ray.o, precision),
        d: stored_vec(ray.d, precision),
        min_t: precision.stored(ray.min_t),
        max_t: precision.stored(ray.max_t),
    }
}

/// The vector as a kernel can store it.
fn stored_vec(v: Vec3, precision: Precision) -> Vec3 {
    Vec3::from_array(v.to_array().map(|x| precision.stored(x)))
}
