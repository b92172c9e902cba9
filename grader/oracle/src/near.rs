//! A fast filter: selects the shapes that are close enough to a ray to need an exact test.

use super::sphere_error::SphereErrorBounds;
use super::triangle_error::TriangleErrorBounds;
use super::verdict::KernelClass;
use kit::scene::Primitive;
use kit::{Aabb, Ray};

/// Bounding spheres are enlarged by this fraction of their radius and distance, which is much more
/// than the rounding error of the test.
const LOOSE: f64 = 1e-6;

/// Returns the shapes that `ray` may hit, with their indices in `shapes`: see [`may_touch`].
pub fn near<'a>(
    shapes: &[Primitive<'a>],
    ray: &Ray,
    kernel: KernelClass,
) -> Vec<(u32, Primitive<'a>)> {
    (0..)
        .zip(shapes.iter().copied())
        .filter(|(_, shape)| may_touch(shape, ray, kernel))
        .collect()
}

/// Whether `ray` may hit the shape, exactly or with the roundings of a kernel of this class.
///
/// For a robust kernel its own error bounds decide: few shapes remain even 1e12 away. Textbook code
/// may hit what the line of the ray misses by much more, so there an enlarged bounding sphere
/// decides.
///
/// ```
/// use kit::{Primitive, Ray, Triangle, Vec3};
/// use oracle::{KernelClass, may_touch};
/// let tri = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
/// let ray = |x| Ray::new(Vec3::new(x, 0.25, 1e8), Vec3::NEG_Z);
/// let touches = |x| may_touch(&Primitive::Triangle(&tri), &ray(x), KernelClass::Robust);
/// assert_eq!([0.25, 0.75, 0.76].map(touches), [true, true, false]);
/// ```
pub fn may_touch(shape: &Primitive<'_>, ray: &Ray, kernel: KernelClass) -> bool {
    match (kernel, shape) {
        (KernelClass::Textbook, Primitive::Triangle(t)) => touches_bounds(&t.bounds(), ray),
        (KernelClass::Textbook, Primitive::Sphere(s)) => touches_bounds(&s.bounds(), ray),
        (KernelClass::Robust, Primitive::Triangle(t)) => {
            !TriangleErrorBounds::new(t, ray).surely_misses(kernel)
        }
        (KernelClass::Robust, Primitive::Sphere(s)) => {
            !SphereErrorBounds::new(s, ray).surely_misses(kernel)
        }
    }
}

/// Whether the line of `ray` intersects an enlarged sphere around the box.
fn touches_bounds(bounds: &Aabb, ray: &Ray) -> bool {
    let center = (bounds.min + bounds.max) / 2.0;
    // From the rounded centre: far from the world's origin it may be as far off as the shape is
    // large.
    let radius = (bounds.max - center).max(center - bounds.min).length();
    let to_center = center - ray.o;
    // The sum of the coordinates is at least the distance.
    let reach = radius + LOOSE * (radius + to_center.abs().element_sum());
    let nearest = to_center.dot(ray.d) / ray.d.length_squared();
    let off2 = (to_center - nearest * ray.d).length_squared();
    // If a product overflows, the oracle decides.
    off2.is_nan() || off2 <= reach * reach
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Answers, sphere, triangle};
    use kit::{PixelSampler, Sphere, Triangle, Vec3};

    /// A shape of random size at a random distance, far from the world's origin or not, and a ray
    /// that is aimed within some roundings of its border.
    fn random_pair(random: &mut PixelSampler) -> (Triangle, Sphere, Ray) {
        let mut power = |low: f64, high: f64| {
            let exponent = low + (high - low) * random.next_1d();
            kit::math::pow(10.0, exponent)
        };
        let (size, distance) = (power(-8.0, 4.0), power(0.0, 13.0));
        let (off, thin) = (power(-1.0, 12.0), power(-9.0, 0.0));
        let past = power(-18.0, -1.0);
        let mut signed = || 2.0 * random.next_1d() - 1.0;
        let mut vector = || Vec3::new(signed(), signed(), signed());
        let center = if vector().x > 0.0 {
            off * vector()
        } else {
            Vec3::ZERO
        };
        let [p0, p1] = [0; 2].map(|_| center + size * vector());
        let p2 = p1 + size * thin * vector();
        let along = 0.5 + 0.5 * vector().x;
        let away = vector().normalize();
        let target = p0 + along * (p1 - p0) + past * distance * vector();
        let o = target + distance * away;
        let tri = Triangle::flat(p0, p1, p2);
        let rim = size * away.any_orthonormal_vector();
        let ball = Sphere {
            center: target + rim,
            radius: size,
        };
        (tri, ball, Ray::new(o, target - o))
    }

    /// Exact arithmetic judges what the filter drops.
    #[test]
    fn nothing_that_touches_is_dropped() {
        let random = &mut PixelSampler::new(1, 2, 3);
        let (mut dropped, mut touching) = (0, 0);
        for _ in 0..20_000 {
            let (tri, ball, ray) = random_pair(random);
            let (of_tri, of_ball) = (triangle(&tri, &ray), sphere(&ball, &ray));
            let shapes = [
                (Primitive::Triangle(&tri), of_tri.hits(), of_tri.answers),
                (Primitive::Sphere(&ball), of_ball.hits(), of_ball.answers),
            ];
            for (shape, hits, answers) in shapes {
                let touches = hits || answers.robust != Answers::MISS;
                let may = may_touch(&shape, &ray, KernelClass::Robust);
                assert!(may || !touches, "{shape:?} {ray:?}");
                touching += usize::from(touches);
                dropped += usize::from(!may);
            }
        }
        assert!(dropped > 2000 && touching > 2000, "{dropped} {touching}");
    }

    /// Triangles of 0.1 side by side: a ray from 1e8 away has at most those around its target.
    #[test]
    fn few_shapes_remain_far_away() {
        let corner = |i: u32, j: u32| 0.1 * Vec3::new(f64::from(i), f64::from(j), 0.0);
        let squares = (0..40).flat_map(|i| (0..40).map(move |j| (i, j)));
        let triangles: Vec<Triangle> = squares
            .map(|(i, j)| Triangle::flat(corner(i, j), corner(i + 1, j), corner(i, j + 1)))
            .collect();
        let shapes: Vec<Primitive<'_>> = triangles.iter().map(Primitive::Triangle).collect();
        let target = Vec3::new(1.03, 2.04, 0.0);
        for distance in [1.0, 1e4, 1e8, 1e12] {
            let o = target + distance * Vec3::new(0.1, 0.2, 1.0);
            let found = near(&shapes, &Ray::new(o, target - o), KernelClass::Robust);
            assert!(
                (1..=6).contains(&found.len()),
                "{distance}: {}",
                found.len()
            );
        }
    }

    /// A triangle as small as two roundings of its own position: its rounded centre is a corner.
    #[test]
    fn the_centre_may_be_rounded_to_a_corner() {
        let at = |x: f64, y: f64| 1e8 * Vec3::ONE + 1.5e-8 * Vec3::new(x, y, 0.0);
        let tri = Triangle::flat(at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0));
        for p in [tri.p0, tri.p1, tri.p2] {
            let ray = Ray::new(p + 1.5e-8 * Vec3::Z, Vec3::NEG_Z);
            assert!(triangle(&tri, &ray).hits());
            for kernel in [KernelClass::Textbook, KernelClass::Robust] {
                assert!(may_touch(&Primitive::Triangle(&tri), &ray, kernel));
            }
        }
    }
}
