//! Test pairs of a shape and a ray, ordinary and hard ones. They depend only on the seed, on every
//! platform.

mod bbox;
mod sphere;
mod triangle;

use super::report::{RayFamily, Shape};
use judge::cases::probes::{ProbeRng, through};
use kernels::{Precision, RayAndShapes};
use kit::{Ray, Vec3};

/// A shape that test rays are generated for.
pub(crate) trait Target: kernels::shapes::Shape {
    /// The kind of shape.
    const SHAPE: Shape;

    /// Number of shapes that one ray is tested against in the timed loop: about as many as in a
    /// leaf.
    const SHAPES_PER_RAY: usize;

    /// The description of each family of rays for this shape; families without meaning for it are
    /// left out.
    const RAY_FAMILIES: &'static [(RayFamily, &'static str)];

    /// Returns an ordinary shape around the origin, and a target point on it or near it.
    fn shape_and_target(dice: &mut ProbeRng) -> (Self, Vec3);

    /// Returns a pair of a family that is specific to this shape.
    fn hard_pair(family: RayFamily, dice: &mut ProbeRng) -> Option<(Self, Ray)>;

    /// Returns the shape scaled by `scale` about the origin, then translated by `by`.
    fn transformed(&self, scale: f64, by: Vec3) -> Self;

    /// Returns the shape with each number rounded to what a kernel can store.
    fn stored(&self, precision: Precision) -> Self;

    /// Whether the ray certainly hits the front face if it hits, so that a culling kernel must hit,
    /// too.
    fn is_front_facing(&self, _ray: &Ray) -> bool {
        true
    }
}

/// Returns `count` pairs of a family.
pub(crate) fn pairs<S: Target>(family: RayFamily, seed: u64, count: usize) -> Vec<(S, Ray)> {
    let name = format!("cost {} {}", S::SHAPE.name(), family.name());
    let mut dice = ProbeRng::new(&name, seed);
    (0..count)
        .map(|_| S::hard_pair(family, &mut dice).unwrap_or_else(|| common_pair(family, &mut dice)))
        .collect()
}

/// Returns a pair of a family that is the same for all shapes.
fn common_pair<S: Target>(family: RayFamily, dice: &mut ProbeRng) -> (S, Ray) {
    let (shape, target) = S::shape_and_target(dice);
    let o = target + dice.range(2.0, 6.0) * dice.direction();
    let (scale, by) = match family {
        RayFamily::FarOffset => (1.0, log_uniform(dice, 1.0, 6.0) * dice.direction()),
        RayFamily::TinyScale => (log_uniform(dice, -30.0, -10.0), Vec3::ZERO),
        RayFamily::HugeScale => (log_uniform(dice, 10.0, 30.0), Vec3::ZERO),
        _ => (1.0, Vec3::ZERO),
    };
    let transform = |p: Vec3| scale * p + by;
    (
        shape.transformed(scale, by),
        through(transform(o), transform(target)),
    )
}

/// Returns a log-uniform number from `10^low` to `10^high`.
fn log_uniform(dice: &mut ProbeRng, low: f64, high: f64) -> f64 {
    kit::math::pow(10.0, dice.range(low, high))
}

/// Returns ordinary rays, each with the shapes that it is tested against in the timed loop.
pub(crate) fn timed_batches<S: Target>(seed: u64, tests: usize) -> Vec<RayAndShapes<S>> {
    let mut dice = ProbeRng::new(&format!("cost {} times", S::SHAPE.name()), seed);
    (0..tests / S::SHAPES_PER_RAY)
        .map(|_| {
            let ray = through(3.0 * dice.direction(), dice.in_cube());
            let shapes = (0..S::SHAPES_PER_RAY).map(|_| {
                let (shape, target) = S::shape_and_target(&mut dice);
                shape.transformed(1.0, ray.at(dice.range(1.0, 5.0)) - target)
            });
            RayAndShapes {
                shapes: shapes.collect(),
                ray,
            }
        })
        .collect()
}

/// Returns `passes` random orders of `rays` rays.
pub(crate) fn orders(seed: u64, rays: usize, passes: usize) -> Vec<Vec<u32>> {
    let mut dice = ProbeRng::new("cost orders", seed);
    let mut order: Vec<u32> = (0..rays as u32).collect();
    let shuffled = (0..passes).map(|_| {
        for i in (1..rays).rev() {
            order.swap(i, dice.below(i + 1));
        }
        order.clone()
    });
    shuffled.collect()
}

/// Returns the ray rounded to what a kernel can store.
pub(crate) fn stored_ray(ray: &Ray, precision: Precision) -> Ray {
    Ray {
        o: stored_vec(ray.o, precision),
        d: stored_vec(ray.d, precision),
        min_t: precision.stored(ray.min_t),
        max_t: precision.stored(ray.max_t),
    }
}

/// Returns the vector rounded to what a kernel can store.
fn stored_vec(v: Vec3, precision: Precision) -> Vec3 {
    Vec3::from_array(v.to_array().map(|x| precision.stored(x)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_pass_tests_all_rays_in_another_order() {
        let mut orders = orders(0, 100, 3);
        assert!(orders[0] != orders[1] && orders[1] != orders[2]);
        for order in &mut orders {
            order.sort_unstable();
            assert!(order.iter().copied().eq(0..100));
        }
    }
}
