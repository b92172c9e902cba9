//! A fast filter: selects the shapes that are close enough to a ray to need an exact test.

use kit::Ray;
use kit::scene::Primitive;

/// Bounding spheres are enlarged by this fraction of their radius and distance, which is much more
/// than the rounding error of the test.
const LOOSE: f64 = 1e-6;

/// Returns the shapes that `ray` may hit, with their indices in `shapes`. It misses all others by
/// more than every error bound.
pub fn near<'a>(shapes: &[Primitive<'a>], ray: &Ray) -> Vec<(u32, Primitive<'a>)> {
    (0..)
        .zip(shapes.iter().copied())
        .filter(|(_, shape)| may_touch(shape, ray))
        .collect()
}

/// Whether the line of `ray` intersects the enlarged bounding sphere of the shape.
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
    // If the sum overflows, the oracle decides.
    off.is_nan() || off <= radius + slack
}
