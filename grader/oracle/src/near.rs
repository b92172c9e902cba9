//! A fast filter: which shapes are near enough to a ray to be worth an exact test.

use kit::Ray;
use kit::scene::Primitive;

/// Bounding spheres are enlarged by this part of their radius and distance, which is far more than rounding moves
/// them.
const LOOSE: f64 = 1e-6;

/// The shapes that `ray` may hit, with their indices in `shapes`. All others are missed by more than every error bound.
pub fn near<'a>(shapes: &[Primitive<'a>], ray: &Ray) -> Vec<(u32, Primitive<'a>)> {
    (0..)
        .zip(shapes.iter().copied())
        .filter(|(_, shape)| may_touch(shape, ray))
        .collect()
}

/// Whether the line of `ray` meets an enlarged bounding sphere of the shape.
pub fn may_touch(shape: &Primitive<'_>, ray: &Ray) -> bool {
    let bounds = match shape {
        Primitive::Triangle(t) => t.bounds(),
        Primitive::Sphere(s) => s.bounds(),
    };
    let center = (bounds.min + bounds.max) / 2.0;
    let radius = (bounds.max - bounds.min).length() / 2.0;
    let to_center = center - ray.o;
    let slack = LOOSE * (radius + to_center.length());
    let nearest = to_center.dot(ray.d) / ray.d.length_squared();
    let off = (to_center - nearest * ray.d).length();
    // Where the sum overflows, the oracle decides.
    off.is_nan() || off <= radius + slack
}
