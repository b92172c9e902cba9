//! Computes the results that score for triangles and spheres, with the exact oracle.
//!
//! The tier decides how large rounding errors may be: as large as those of textbook code in `f64`
//! for core points; as large as those of numerically stable code for robust points, where the hit
//! point must also lie on the surface.

pub mod expected;
pub(crate) mod records;
pub mod scene;
pub(crate) mod tree_tests;

use crate::tools::Tier;
use crate::tools::truth::expected::{Expected, ExpectedHit, TrueSurface};
use kit::{PrimId, Ray, Sphere, Triangle, Vec3, scene::Primitive};
use oracle::surface::{
    geometric_normal, sphere_normal, sphere_point, triangle_normal, triangle_point,
};
use oracle::{
    self, Answers, Candidate, KernelClass, Miss, Shapes, SphereClass, SphereVerdict, TriangleClass,
    TriangleVerdict, closest,
};

/// The largest distance of a hit point from the surface, in roundings of its largest coordinate:
/// the weighted sum of three vertices makes about ten roundings, projecting a point to a sphere
/// fewer.
const SURFACE_ROUNDINGS: f64 = 16.0;

/// The results that score for `ray` and the triangle with index `prim`.
pub fn triangle(tier: Tier, prim: u32, triangle: &Triangle, ray: &Ray) -> Expected {
    let verdict = oracle::triangle(triangle, ray);
    let answers = verdict.answers.get(kernel(tier));
    let hits = candidates(answers)
        .filter_map(|candidate| triangle_hit(tier, prim, triangle, &verdict, &candidate))
        .collect();
    Expected {
        hits,
        miss: answers.miss,
        why_miss: match verdict.class {
            TriangleClass::Miss(why) => why_miss(why),
            _ => "",
        },
    }
}

/// The results that score for `ray` and the sphere with index `prim`.
pub fn sphere(tier: Tier, prim: u32, sphere: &Sphere, ray: &Ray) -> Expected {
    let verdict = oracle::sphere(sphere, ray);
    let answers = verdict.answers.get(kernel(tier));
    let hits = candidates(answers)
        .filter_map(|candidate| sphere_hit(tier, prim, sphere, ray, &verdict, &candidate))
        .collect();
    Expected {
        hits,
        miss: answers.miss,
        why_miss: match verdict.class {
            SphereClass::Miss(why) => why_miss(why),
            _ => "",
        },
    }
}

/// The results that score for the closest hit of `ray` among `shapes`, numbered from 0. If
/// `enclosed`, the shapes enclose the ray's origin: a miss is wrong even where rounding decides
/// which of two adjacent shapes is hit.
pub fn first_of(tier: Tier, shapes: &Shapes<'_>, ray: &Ray, enclosed: bool) -> Expected {
    let near = shapes.near(ray, kernel(tier));
    let closest = closest(near.iter().map(|(_, shape)| *shape), ray);
    let answers = closest.answers.get(kernel(tier));
    let hit = |(PrimId(index), candidate): &(PrimId, Candidate)| {
        let (prim, shape) = near[*index as usize];
        match shape {
            Primitive::Triangle(t) => {
                triangle_hit(tier, prim, t, &oracle::triangle(t, ray), candidate)
            }
            Primitive::Sphere(s) => {
                sphere_hit(tier, prim, s, ray, &oracle::sphere(s, ray), candidate)
            }
        }
    };
    let mut hits: Vec<ExpectedHit> = answers.hits.iter().filter_map(hit).collect();
    hits.sort_by(|a, b| a.t.total_cmp(&b.t));
    Expected {
        hits,
        miss: answers.miss && !enclosed,
        why_miss: match closest.nearest {
            Some(_) => "",
            None => "no shape is in its way",
        },
    }
}

fn kernel(tier: Tier) -> KernelClass {
    match tier {
        Tier::Core => KernelClass::Textbook,
        Tier::Robust => KernelClass::Robust,
    }
}

fn candidates(answers: &Answers) -> impl Iterator<Item = Candidate> {
    answers.hits.into_iter().flatten()
}

fn triangle_hit(
    tier: Tier,
    prim: u32,
    triangle: &Triangle,
    verdict: &TriangleVerdict,
    candidate: &Candidate,
) -> Option<ExpectedHit> {
    let kernel = kernel(tier);
    let at = verdict.crossing?;
    let p = triangle_point(triangle, &at);
    let n = triangle_normal(triangle, &at);
    let ng = geometric_normal(triangle);
    let direction = (*ng.n.get(kernel))?;
    Some(ExpectedHit {
        prim,
        t: candidate.t.to_f64(),
        exact_t: candidate.t,
        t_bound: t_bound(candidate),
        p: p.p,
        p_bound: *p.tolerance.get(kernel),
        surface: surface(tier, TrueSurface::Plane(triangle.p0, direction), p.p),
        uv: Some((
            kit::Vec2::new(at.b1.to_f64(), at.b2.to_f64()),
            *at.b_tolerance.get(kernel),
        )),
        n: *n.n.get(kernel),
        n_bound: *n.tolerance.get(kernel),
        ng: Some(direction),
        ng_bound: *ng.tolerance.get(kernel),
    })
}

fn sphere_hit(
    tier: Tier,
    prim: u32,
    sphere: &Sphere,
    ray: &Ray,
    verdict: &SphereVerdict,
    candidate: &Candidate,
) -> Option<ExpectedHit> {
    let kernel = kernel(tier);
    // Near the silhouette textbook code may report a false hit, for which there is no root.
    let root = usize::from(verdict.roots.is_some_and(|[near, _]| near != candidate.t));
    let (p, p_bound) = match sphere_point(verdict, ray, root) {
        Some(point) => (point.p, *point.tolerance.get(kernel)),
        None => (ray.at(candidate.t.to_f64()), f64::INFINITY),
    };
    let normal = sphere_normal(verdict, sphere, ray, root);
    let outward = normal.and_then(|normal| *normal.n.get(kernel));
    let n_bound = normal.map_or(f64::INFINITY, |normal| *normal.tolerance.get(kernel));
    Some(ExpectedHit {
        prim,
        t: candidate.t.to_f64(),
        exact_t: candidate.t,
        t_bound: t_bound(candidate),
        p,
        p_bound,
        surface: surface(tier, TrueSurface::Sphere(sphere.center, sphere.radius), p),
        uv: None,
        n: outward,
        n_bound,
        ng: outward,
        ng_bound: n_bound,
    })
}

/// The oracle's bound, but at least one unit in the last place.
fn t_bound(candidate: &Candidate) -> f64 {
    candidate.tolerance.max(candidate.t.ulp())
}

/// The surface on which the hit point must lie, for robust points; textbook code cannot guarantee
/// it.
fn surface(tier: Tier, surface: TrueSurface, p: Vec3) -> Option<(TrueSurface, f64)> {
    let world = match surface {
        TrueSurface::Plane(q, _) => p.abs().max(q.abs()),
        TrueSurface::Sphere(center, radius) => p.abs().max(center.abs() + radius),
    };
    let bound = SURFACE_ROUNDINGS * f64::EPSILON * world.max_element();
    (tier == Tier::Robust).then_some((surface, bound))
}

fn why_miss(why: Miss) -> &'static str {
    match why {
        Miss::NotANumber => "an input is NaN",
        Miss::NotFinite => "an input is infinite",
        Miss::ZeroDirection => "the direction is 0",
        Miss::EmptyRange => "the range is empty, min_t > max_t",
        Miss::Degenerate => "the shape has no area",
        Miss::Coplanar => "the ray lies in the triangle's plane, which is a miss by convention",
        Miss::LineMisses => "the line of the ray does not meet the shape",
        Miss::OutOfRange => "the line of the ray meets the shape at a t outside min_t..=max_t",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tools::truth::expected::HitOrMiss;
    use oracle::may_touch;

    /// The triangles (0, 0), (8, 0), (0, 8) and its mirror image across their shared edge, in the
    /// plane z = 0.
    fn square() -> [Triangle; 2] {
        let corner = |x: f64, y: f64| Vec3::new(x, y, 0.0);
        let (a, b, c, d) = (
            corner(0.0, 0.0),
            corner(8.0, 0.0),
            corner(8.0, 8.0),
            corner(0.0, 8.0),
        );
        [Triangle::flat(a, b, d), Triangle::flat(c, d, b)]
    }

    fn down(x: f64, y: f64) -> Ray {
        Ray::new(Vec3::new(x, y, 4.0), Vec3::NEG_Z)
    }

    #[test]
    fn on_a_shared_edge_either_triangle_scores() {
        let [first, second] = square();
        let shapes = Shapes::new([&first, &second].map(Primitive::Triangle));
        let expected = first_of(Tier::Core, &shapes, &down(3.0, 5.0), false);
        let mut prims: Vec<u32> = expected.hits.iter().map(|hit| hit.prim).collect();
        prims.sort_unstable();
        assert_eq!((prims, expected.decision()), (vec![0, 1], HitOrMiss::Hit));
    }

    #[test]
    fn only_the_closer_of_two_triangles_scores() {
        let [first, _] = square();
        let above = Triangle {
            p0: first.p0 + Vec3::Z,
            p1: first.p1 + Vec3::Z,
            p2: first.p2 + Vec3::Z,
            ..first
        };
        let shapes = Shapes::new([&first, &above].map(Primitive::Triangle));
        let expected = first_of(Tier::Core, &shapes, &down(1.0, 1.0), false);
        assert_eq!(expected.hits.len(), 1);
        assert_eq!((expected.hits[0].prim, expected.hits[0].t), (1, 3.0));
    }

    #[test]
    fn enclosed_rays_never_miss() {
        // Aimed at an edge with coordinates that round: textbook code may hit either triangle, but
        // must not miss both.
        let [first, second] = square();
        let shapes = Shapes::new([&first, &second].map(Primitive::Triangle));
        let target = Vec3::new(0.1 * 3.0, 8.0 - 0.1 * 3.0, 0.0);
        let o = Vec3::new(1.7, 0.3, 2.9);
        let ray = Ray::new(o, (target - o).normalize());
        assert!(first_of(Tier::Core, &shapes, &ray, false).miss);
        assert!(!first_of(Tier::Core, &shapes, &ray, true).miss);
    }

    #[test]
    fn robust_points_have_tighter_bounds() {
        let [triangle, _] = square();
        let far = Ray::new(Vec3::new(1.0, 2.0, 1e6), Vec3::new(1e-6, 1e-6, -1.0));
        let [core, robust] = [Tier::Core, Tier::Robust].map(|tier| {
            let expected = super::triangle(tier, 0, &triangle, &far);
            expected.hits[0]
        });
        assert!(robust.p_bound < core.p_bound);
        assert!(core.surface.is_none() && robust.surface.is_some());
    }

    #[test]
    fn may_touch_accepts_every_shape_that_is_hit() {
        let mut sampler = kit::PixelSampler::new(1, 2, 3);
        let mut vector = || {
            let [x, y, z] = [0; 3].map(|_| 2.0 * sampler.next_1d() - 1.0);
            Vec3::new(x, y, z)
        };
        let mut hits = 0;
        for _ in 0..2000 {
            let triangle = Triangle::flat(vector(), vector(), vector());
            let o = 3.0 * vector();
            let ray = Ray::new(o, vector() - o);
            let shape = Primitive::Triangle(&triangle);
            for tier in [Tier::Core, Tier::Robust] {
                let expected = super::triangle(tier, 0, &triangle, &ray);
                if !expected.hits.is_empty() {
                    hits += 1;
                    assert!(may_touch(&shape, &ray, kernel(tier)));
                }
            }
        }
        assert!(hits > 100);
    }
}
