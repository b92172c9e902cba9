//! A fast filter: selects the shapes that are close enough to a ray to need an exact test.

use super::closest::{Closest, closest_of};
use super::sphere_error::SphereErrorBounds;
use super::triangle_error::{TriangleErrorBounds, TriangleSizes};
use super::verdict::KernelClass;
use kit::scene::Primitive;
use kit::{Aabb, PrimId, Ray, Sphere};

/// Bounding spheres are enlarged by this fraction of their radius and distance, which is much more
/// than the rounding error of the test.
const LOOSE: f64 = 1e-6;

/// Shapes that many rays are tested against, numbered from 0. What the filters need of a shape is
/// computed once, unless it depends on the ray.
pub struct Shapes<'a>(Vec<Shape<'a>>);

struct Shape<'a> {
    primitive: Primitive<'a>,
    ball: Sphere,
    /// Of a triangle.
    sizes: Option<TriangleSizes>,
}

impl<'a> Shapes<'a> {
    /// Prepares the shapes.
    pub fn new(shapes: impl IntoIterator<Item = Primitive<'a>>) -> Shapes<'a> {
        let shapes = shapes.into_iter().map(|primitive| Shape {
            primitive,
            ball: ball_around(&primitive.bounds()),
            sizes: match primitive {
                Primitive::Triangle(tri) => Some(TriangleSizes::of(tri)),
                Primitive::Sphere(_) => None,
            },
        });
        Shapes(shapes.collect())
    }

    /// The shapes that `ray` may hit, with their numbers: see [`may_touch`].
    pub fn near(&self, ray: &Ray, kernel: KernelClass) -> Vec<(u32, Primitive<'a>)> {
        let is_near = |shape: &Shape<'a>| match kernel {
            KernelClass::Textbook => touches(&shape.ball, ray),
            KernelClass::Robust => !surely_misses(ray, shape.primitive, shape.sizes, kernel),
        };
        let near = (0..).zip(&self.0).filter(|(_, shape)| is_near(shape));
        near.map(|(number, s)| (number, s.primitive)).collect()
    }

    /// The closest hit of `ray` among all shapes: what [`closest`](super::closest()) returns.
    pub fn closest(&self, ray: &Ray) -> Closest {
        let kernel = KernelClass::Textbook;
        let numbered = (0..).map(PrimId).zip(&self.0);
        let others = numbered.filter(|(_, s)| !surely_misses(ray, s.primitive, s.sizes, kernel));
        closest_of(others.map(|(id, shape)| (id, shape.primitive)), ray)
    }
}

/// Whether the error bounds of correct code of this class say that `ray` misses the shape. `sizes`
/// are those of a triangle, where they are known.
fn surely_misses(
    ray: &Ray,
    shape: Primitive<'_>,
    sizes: Option<TriangleSizes>,
    kernel: KernelClass,
) -> bool {
    match shape {
        Primitive::Triangle(tri) => {
            let sizes = sizes.unwrap_or_else(|| TriangleSizes::of(tri));
            TriangleErrorBounds::with(sizes, tri, ray).surely_misses(kernel)
        }
        Primitive::Sphere(sphere) => SphereErrorBounds::new(sphere, ray).surely_misses(kernel),
    }
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
    match kernel {
        KernelClass::Textbook => touches(&ball_around(&shape.bounds()), ray),
        KernelClass::Robust => !surely_misses(ray, *shape, None, kernel),
    }
}

/// A sphere around a box, whose faces may be rounded.
fn ball_around(bounds: &Aabb) -> Sphere {
    let center = (bounds.min + bounds.max) / 2.0;
    // From the rounded centre: far from the world's origin it may be as far off as the shape is
    // large. There the box of a sphere may be a point.
    let radius = (bounds.max - center).max(center - bounds.min).length();
    let rounding = f64::EPSILON * bounds.min.abs().max(bounds.max.abs()).element_sum();
    Sphere {
        center,
        radius: radius + rounding,
    }
}

/// Whether the line of `ray` intersects the sphere, enlarged.
fn touches(&Sphere { center, radius }: &Sphere, ray: &Ray) -> bool {
    let to_center = center - ray.o;
    // The sum of the coordinates is at least the distance.
    let reach = radius + LOOSE * (radius + to_center.abs().element_sum());
    let (d2, reach2) = (ray.d.length_squared(), reach * reach);
    let off2 = (to_center - to_center.dot(ray.d) / d2 * ray.d).length_squared();
    // If a square overflows or underflows, the oracle decides.
    let is_sure = [d2, reach2, off2].iter().all(|square| square.is_normal());
    !is_sure || off2 <= reach2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Answers, closest, sphere, triangle};
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
                let may_textbook = may_touch(&shape, &ray, KernelClass::Textbook);
                assert!(may_textbook || !hits, "{shape:?} {ray:?}");
                touching += usize::from(touches);
                dropped += usize::from(!may);
            }
        }
        assert!(dropped > 2000 && touching > 2000, "{dropped} {touching}");
    }

    /// For rays past all of them, past some, and through thin triangles.
    #[test]
    fn prepared_shapes_give_the_same_answers() {
        let random = &mut PixelSampler::new(4, 5, 6);
        let pairs: Vec<_> = (0..60).map(|_| random_pair(random)).collect();
        let primitives: Vec<Primitive<'_>> = pairs
            .iter()
            .flat_map(|(tri, ball, _)| [Primitive::Triangle(tri), Primitive::Sphere(ball)])
            .collect();
        let shapes = Shapes::new(primitives.iter().copied());
        let mut hits = 0;
        for (.., ray) in &pairs {
            let truth = closest(primitives.iter().copied(), ray);
            hits += usize::from(truth.nearest.is_some());
            assert_eq!(shapes.closest(ray), truth, "{ray:?}");
            for kernel in [KernelClass::Textbook, KernelClass::Robust] {
                let numbered = (0..).zip(primitives.iter().copied());
                let near = numbered.filter(|(_, shape)| may_touch(shape, ray, kernel));
                assert_eq!(shapes.near(ray, kernel), near.collect::<Vec<_>>());
            }
        }
        assert!((10..60).contains(&hits), "{hits}");
    }

    /// Triangles of 0.1 side by side: a ray from 1e8 away has at most those around its target.
    #[test]
    fn few_shapes_remain_far_away() {
        let corner = |i: u32, j: u32| 0.1 * Vec3::new(f64::from(i), f64::from(j), 0.0);
        let squares = (0..40).flat_map(|i| (0..40).map(move |j| (i, j)));
        let triangles: Vec<Triangle> = squares
            .map(|(i, j)| Triangle::flat(corner(i, j), corner(i + 1, j), corner(i, j + 1)))
            .collect();
        let shapes = Shapes::new(triangles.iter().map(Primitive::Triangle));
        let target = Vec3::new(1.03, 2.04, 0.0);
        for distance in [1.0, 1e4, 1e8, 1e12] {
            let o = target + distance * Vec3::new(0.1, 0.2, 1.0);
            let found = shapes.near(&Ray::new(o, target - o), KernelClass::Robust);
            assert!(
                (1..=6).contains(&found.len()),
                "{distance}: {}",
                found.len()
            );
        }
    }

    /// Squares of the direction that overflow or underflow, and a sphere whose box has no size.
    #[test]
    fn hits_whose_squares_or_boxes_are_out_of_range_are_kept() {
        let ball = |center, radius| Sphere { center, radius };
        let tri = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
        let (target, o) = (Vec3::new(0.25, 0.25, 0.0), Vec3::new(5.25, 5.25, 5.0));
        let mut cases = Vec::new();
        for length in [2e154, 1e154, 1.0, 1e-154, 1e-163] {
            let ray = Ray::new(o, (target - o) * length);
            assert!(triangle(&tri, &ray).hits(), "{length}");
            assert!(
                may_touch(&Primitive::Triangle(&tri), &ray, KernelClass::Textbook),
                "{length}"
            );
            cases.push((ball(target, 1.0), ray));
        }
        let far = Vec3::splat(3e10);
        let o = Vec3::new(30_000_000_000.000_004, 3e10, 3e10);
        cases.push((ball(far, 1.9e-6), Ray::new(o, Vec3::new(-1.0, 0.3, 0.0))));
        for radius in [0.9, 1.0] {
            let center = Vec3::splat(1e16);
            let ray = Ray::new(center + 2.0 * Vec3::X, Vec3::new(-1.0, 0.3, 0.0));
            cases.push((ball(center, radius), ray));
        }
        for (ball, ray) in &cases {
            assert!(sphere(ball, ray).hits(), "{ball:?} {ray:?}");
            let shapes = Shapes::new([Primitive::Sphere(ball)]);
            for kernel in [KernelClass::Textbook, KernelClass::Robust] {
                assert_eq!(
                    shapes.near(ray, kernel).len(),
                    1,
                    "{kernel:?} {ball:?} {ray:?}"
                );
            }
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
