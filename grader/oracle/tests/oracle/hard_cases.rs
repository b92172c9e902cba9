//! The hard cases that have one correct answer.

use kit::{Aabb, Interval, Ray, Sphere, Triangle, Vec3};
use oracle::verdict::Miss;
use oracle::{KernelClass, SphereClass, TriangleClass, bbox, sphere, triangle};

const BOTH: [KernelClass; 2] = [KernelClass::Textbook, KernelClass::Robust];

fn v(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3::new(x, y, z)
}

/// A right triangle with legs of 4 on the x and y axes; twice its area is a power of two.
fn right_angled() -> Triangle {
    Triangle::flat(Vec3::ZERO, v(4.0, 0.0, 0.0), v(0.0, 4.0, 0.0))
}

fn ray(o: Vec3, d: Vec3) -> Ray {
    Ray::new(o, d)
}

/// Asserts the exact class, and that only one answer scores for either kernel.
fn decides(tri: &Triangle, ray: &Ray, class: TriangleClass) {
    let verdict = triangle(tri, ray);
    assert_eq!(verdict.class, class, "{ray:?}");
    for kernel in BOTH {
        assert!(!verdict.undecidable(kernel), "{kernel:?}: {verdict:?}");
        let miss_is_right = verdict.judge(kernel, None).scores();
        assert_eq!(miss_is_right, !verdict.hits(), "{kernel:?}: {verdict:?}");
    }
}

#[test]
fn edges_and_vertices_count() {
    let down = v(0.0, 0.0, -1.0);
    let at = |x, y| ray(v(x, y, 2.0), down);
    let tri = right_angled();
    decides(&tri, &at(1.0, 1.0), TriangleClass::Inside);
    decides(&tri, &at(2.0, 2.0), TriangleClass::Edge(0));
    decides(&tri, &at(0.0, 1.0), TriangleClass::Edge(1));
    decides(&tri, &at(2.0, 0.0), TriangleClass::Edge(2));
    decides(&tri, &at(0.0, 0.0), TriangleClass::Vertex(0));
    decides(&tri, &at(4.0, 0.0), TriangleClass::Vertex(1));
    decides(&tri, &at(0.0, 4.0), TriangleClass::Vertex(2));
    decides(
        &tri,
        &at(-0.125, 1.0),
        TriangleClass::Miss(Miss::LineMisses),
    );
    let verdict = triangle(&tri, &at(2.0, 0.0));
    assert_eq!(verdict.crossing.map(|at| at.t.to_f64()), Some(2.0));
}

#[test]
fn back_faces_are_hit() {
    let up = ray(v(1.0, 1.0, -2.0), Vec3::Z);
    decides(&right_angled(), &up, TriangleClass::Inside);
}

#[test]
fn parallel_and_coplanar_rays_miss() {
    let above = ray(v(-1.0, 1.0, 1.0), Vec3::X);
    let within = ray(v(-1.0, 1.0, 0.0), Vec3::X);
    let miss = TriangleClass::Miss;
    decides(&right_angled(), &above, miss(Miss::LineMisses));
    decides(&right_angled(), &within, miss(Miss::Coplanar));
}

#[test]
fn triangles_without_area_miss() {
    let down = ray(v(1.0, 0.0, 1.0), -Vec3::Z);
    let [a, b, c] = [0.0, 1.0, 3.0].map(|x| v(x, 0.0, 0.0));
    for (p0, p1, p2) in [(a, b, c), (b, b, b), (a, a, c), (c, a, c)] {
        let tri = Triangle::flat(p0, p1, p2);
        decides(&tri, &down, TriangleClass::Miss(Miss::Degenerate));
    }
}

#[test]
fn the_class_does_not_depend_on_scale() {
    let down = ray(v(1.0, 1.0, 2.0), v(0.0, 0.0, -1.0));
    for scale in [1e-15, 1e-6, 1e6, 1e15] {
        let big = |p: Vec3| scale * p;
        let t = right_angled();
        let tri = Triangle::flat(big(t.p0), big(t.p1), big(t.p2));
        decides(&tri, &ray(big(down.o), down.d), TriangleClass::Inside);
    }
}

#[test]
fn range_ends_count() {
    let tri = right_angled();
    let down = ray(v(1.0, 1.0, 2.0), v(0.0, 0.0, -1.0));
    let within = |min_t, max_t| Ray {
        min_t,
        max_t,
        ..down
    };
    decides(&tri, &within(0.0, 2.0), TriangleClass::Inside);
    decides(&tri, &within(2.0, 9.0), TriangleClass::Inside);
    decides(&tri, &within(2.0, 2.0), TriangleClass::Inside);
    assert!(triangle(&tri, &within(2.0, 2.0)).at_range_end);
    let out = TriangleClass::Miss(Miss::OutOfRange);
    decides(&tri, &within(0.0, 2.0_f64.next_down()), out);
    decides(&tri, &within(2.0_f64.next_up(), 9.0), out);
    decides(&tri, &within(-9.0, -2.0), out);
    let empty = TriangleClass::Miss(Miss::EmptyRange);
    decides(&tri, &within(3.0, 1.0), empty);
}

#[test]
fn an_origin_on_the_plane_is_a_hit_only_if_zero_counts() {
    let tri = right_angled();
    let on = ray(v(1.0, 1.0, 0.0), v(0.0, 0.0, 1.0));
    decides(&tri, &on, TriangleClass::Inside);
    let later = Ray { min_t: 1e-9, ..on };
    decides(&tri, &later, TriangleClass::Miss(Miss::OutOfRange));
    let at_vertex = ray(Vec3::ZERO, v(0.0, 0.0, 1.0));
    decides(&tri, &at_vertex, TriangleClass::Vertex(0));
}

#[test]
fn t_is_in_lengths_of_the_direction() {
    let fast = ray(v(1.0, 1.0, 2.0), v(0.0, 0.0, -4.0));
    let at = triangle(&right_angled(), &fast).crossing.expect("a hit");
    assert_eq!(at.t.to_f64(), 0.5);
}

#[test]
fn nan_and_zero_directions_miss() {
    let tri = right_angled();
    let down = ray(v(1.0, 1.0, 2.0), v(0.0, 0.0, -1.0));
    let nan = TriangleClass::Miss(Miss::NotANumber);
    let bad = Triangle::flat(v(f64::NAN, 0.0, 0.0), tri.p1, tri.p2);
    decides(&bad, &down, nan);
    decides(&tri, &ray(v(1.0, f64::NAN, 2.0), down.d), nan);
    decides(
        &tri,
        &Ray {
            max_t: f64::NAN,
            ..down
        },
        nan,
    );
    let still = ray(down.o, Vec3::ZERO);
    decides(&tri, &still, TriangleClass::Miss(Miss::ZeroDirection));
}

/// By convention; textbook code does not see it.
#[test]
fn an_infinite_vertex_is_a_miss_for_a_robust_kernel() {
    let tri = Triangle::flat(Vec3::ZERO, v(f64::INFINITY, 0.0, 0.0), v(0.0, 4.0, 0.0));
    let verdict = triangle(&tri, &ray(v(1.0, 1.0, 2.0), -Vec3::Z));
    for kernel in BOTH {
        let hit_scores = verdict.judge(kernel, Some(2.0)).scores();
        assert_eq!(hit_scores, kernel == KernelClass::Textbook);
        assert!(verdict.judge(kernel, None).scores());
    }
}

/// With Möller-Trumbore ten of a hundred such rays pass between the faces; in exact arithmetic none
/// does.
#[test]
fn a_closed_mesh_does_not_leak() {
    let mut r = crate::rays::Random::new(30);
    for _ in 0..5_000 {
        // A needle-shaped tetrahedron around the origin, and a ray from near the origin at one of
        // its edges.
        let stretch = v(1.0, 1e-3, 1e-6);
        let corners = [
            v(1.0, 1.0, 1.0),
            v(1.0, -1.0, -1.0),
            v(-1.0, 1.0, -1.0),
            v(-1.0, -1.0, 1.0),
        ]
        .map(|c| (c + 0.2 * r.place()) * stretch);
        let (a, b) = (corners[r.below(4) as usize], corners[r.below(4) as usize]);
        let out = ray(1e-3 * r.place() * stretch, a + r.unit() * (b - a));
        let faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
        let verdicts = faces
            .map(|[i, j, k]| triangle(&Triangle::flat(corners[i], corners[j], corners[k]), &out));
        assert!(verdicts.iter().any(|verdict| verdict.hits()), "{out:?}");
    }
}

fn ball(radius: f64) -> Sphere {
    let center = Vec3::ZERO;
    Sphere { center, radius }
}

fn decides_sphere(s: &Sphere, ray: &Ray, class: SphereClass, t: Option<f64>) {
    let verdict = sphere(s, ray);
    assert_eq!(verdict.class, class, "{ray:?}");
    assert_eq!(verdict.t.map(|t| t.to_f64()), t, "{ray:?}");
    for kernel in BOTH {
        assert!(!verdict.undecidable(kernel), "{kernel:?}: {verdict:?}");
        assert!(verdict.judge(kernel, t).scores(), "{kernel:?}: {verdict:?}");
    }
}

#[test]
fn a_tangent_in_integers_is_one_hit() {
    let tangent = ray(v(1.0, -3.0, 0.0), Vec3::Y);
    decides_sphere(&ball(1.0), &tangent, SphereClass::Tangent, Some(3.0));
    let beside = ray(v(1.0 + f64::EPSILON, -3.0, 0.0), Vec3::Y);
    let verdict = sphere(&ball(1.0), &beside);
    assert_eq!(verdict.class, SphereClass::Miss(Miss::LineMisses));
    assert!(
        verdict.undecidable(KernelClass::Robust),
        "an ulp off the rim is undecidable"
    );
}

#[test]
fn far_spheres_are_decided_in_the_middle_and_at_the_rim_by_robust_kernels() {
    let far = ray(v(0.0, 0.0, 1e6), -Vec3::Z);
    decides_sphere(&ball(1.0), &far, SphereClass::Near, Some(1e6 - 1.0));
    // 0.0005 radii inside the rim: a robust kernel must decide it, textbook code need not.
    let rim = ray(v(0.9995, 0.0, 1e6), -Vec3::Z);
    let verdict = sphere(&ball(1.0), &rim);
    assert_eq!(verdict.class, SphereClass::Near);
    assert!(verdict.undecidable(KernelClass::Textbook));
    assert!(!verdict.undecidable(KernelClass::Robust));
}

#[test]
fn inside_a_sphere_the_far_root_counts() {
    let s = ball(2.0);
    decides_sphere(
        &s,
        &ray(v(0.0, 0.0, 1.0), Vec3::Z),
        SphereClass::Far,
        Some(1.0),
    );
    let from_center = ray(Vec3::ZERO, v(0.0, 0.0, 4.0));
    decides_sphere(&s, &from_center, SphereClass::Far, Some(0.5));
    let near_cut = Ray {
        min_t: 1.5,
        ..ray(v(0.0, 0.0, -3.0), Vec3::Z)
    };
    decides_sphere(&s, &near_cut, SphereClass::Far, Some(5.0));
}

#[test]
fn on_the_sphere_the_range_decides() {
    let s = ball(2.0);
    let outward = ray(v(0.0, 0.0, 2.0), Vec3::Z);
    let after = |ray: Ray, min_t| Ray { min_t, ..ray };
    decides_sphere(&s, &outward, SphereClass::Far, Some(0.0));
    let out = SphereClass::Miss(Miss::OutOfRange);
    decides_sphere(&s, &after(outward, 1e-9), out, None);
    let inward = ray(v(0.0, 0.0, 2.0), -Vec3::Z);
    decides_sphere(&s, &inward, SphereClass::Near, Some(0.0));
    decides_sphere(&s, &after(inward, 1e-9), SphereClass::Far, Some(4.0));
    let behind = ray(v(0.0, 0.0, 3.0), Vec3::Z);
    decides_sphere(&s, &behind, out, None);
}

#[test]
fn a_sphere_of_no_radius_is_hit_only_exactly() {
    let through = ray(v(0.0, 0.0, -1.0), Vec3::Z);
    decides_sphere(&ball(0.0), &through, SphereClass::Tangent, Some(1.0));
    let beside = ray(v(0.5, 0.0, -1.0), Vec3::Z);
    let miss = SphereClass::Miss;
    decides_sphere(&ball(0.0), &beside, miss(Miss::LineMisses), None);
    decides_sphere(&ball(-1.0), &through, miss(Miss::Degenerate), None);
}

#[test]
fn t_on_a_huge_sphere_is_accurate() {
    let ground = Sphere {
        center: v(0.0, -1e5, 0.0),
        radius: 1e5,
    };
    let verdict = sphere(&ground, &ray(v(0.3, 1.7, 0.2), v(0.1, -1.0, 0.2)));
    let t = verdict.t.expect("a hit").to_f64();
    assert!(verdict.t_tolerance[0].robust < 1e-9 * t, "{verdict:?}");
}

fn unit_box() -> Aabb {
    Aabb {
        min: Vec3::ZERO,
        max: Vec3::ONE,
    }
}

fn decides_box(b: &Aabb, ray: &Ray, inside: Option<(f64, f64)>) {
    let verdict = bbox(b, ray);
    let exact = verdict
        .inside
        .ok()
        .map(|i| (i.min.to_f64(), i.max.to_f64()));
    assert_eq!(exact, inside, "{b:?} {ray:?}");
    for kernel in BOTH {
        assert!(!verdict.undecidable(kernel), "{kernel:?}: {verdict:?}");
        let answer = inside.map(|(min, max)| Interval { min, max });
        assert!(verdict.judge(kernel, answer).scores(), "{verdict:?}");
        let other = match answer {
            Some(_) => None,
            None => Some(Interval { min: 0.0, max: 1.0 }),
        };
        assert!(!verdict.judge(kernel, other).scores(), "{verdict:?}");
    }
}

#[test]
fn an_origin_on_a_slab_plane_counts() {
    for zero in [0.0, -0.0] {
        let along = ray(v(1.0, 0.5, -1.0), v(zero, zero, 1.0));
        decides_box(&unit_box(), &along, Some((1.0, 2.0)));
        let off = ray(v(1.0_f64.next_up(), 0.5, -1.0), v(zero, zero, 1.0));
        decides_box(&unit_box(), &off, None);
    }
}

#[test]
fn flat_boxes_and_points_are_hit() {
    let flat = Aabb {
        min: v(0.0, 0.0, 0.5),
        max: v(1.0, 1.0, 0.5),
    };
    let slanted = ray(v(0.1, 0.2, 3.0), v(0.1, 0.1, -0.7));
    assert!(bbox(&flat, &slanted).touches);
    assert!(!bbox(&flat, &slanted).undecidable(KernelClass::Textbook));
    decides_box(&flat, &ray(v(-1.0, 0.5, 0.5), Vec3::X), Some((1.0, 2.0)));
    let point = Aabb::of([v(0.5, 0.5, 0.5)]);
    decides_box(&point, &ray(v(0.5, 0.5, -1.0), Vec3::Z), Some((1.5, 1.5)));
}

#[test]
fn a_corner_may_be_missed_by_plain_slabs_only() {
    let at_corner = ray(v(-1.0, -1.0, -1.0), v(0.3, 0.3, 0.3) / 3.0);
    let verdict = bbox(&Aabb::of([Vec3::ZERO]), &at_corner);
    assert!(verdict.hits() && verdict.touches);
    assert!(verdict.judge(KernelClass::Textbook, None).scores());
    assert!(!verdict.judge(KernelClass::Robust, None).scores());
}

#[test]
fn a_box_test_may_be_conservative_by_a_few_ulp() {
    let past = ray(v(-1.0, -1.0 - f64::EPSILON, 0.0), v(1.0, 1.0, 0.0));
    let corner = Aabb {
        min: v(-1.0, 0.0, 0.0),
        max: v(0.0, 1.0, 0.0),
    };
    let verdict = bbox(&corner, &past);
    assert!(!verdict.hits() && verdict.gap > 0.0);
    let touched = Some(Interval { min: 1.0, max: 1.0 });
    assert!(verdict.judge(KernelClass::Robust, touched).scores());
    assert!(verdict.judge(KernelClass::Robust, None).scores());
    let clear = ray(v(-1.0, -1.001, 0.0), v(1.0, 1.0, 0.0));
    assert!(
        !bbox(&corner, &clear)
            .judge(KernelClass::Textbook, touched)
            .scores()
    );
}

#[test]
fn odd_boxes_are_decided() {
    let through = ray(v(0.5, 0.5, -1.0), Vec3::Z);
    decides_box(&Aabb::EMPTY, &through, None);
    let all = Aabb {
        min: Vec3::NEG_INFINITY,
        max: Vec3::INFINITY,
    };
    decides_box(&all, &through, Some((0.0, f64::INFINITY)));
    let mut bad = unit_box();
    bad.max.y = f64::NAN;
    decides_box(&bad, &through, None);
}

#[test]
fn only_robust_tests_must_handle_a_denormal_direction() {
    let denormal = ray(v(0.5, 0.5, 0.5), v(f64::from_bits(1), 0.0, 1.0));
    let verdict = bbox(&unit_box(), &denormal);
    assert!(verdict.hits() && verdict.undecidable(KernelClass::Textbook));
    assert!(!verdict.undecidable(KernelClass::Robust));
    assert!(!verdict.judge(KernelClass::Robust, None).scores());
}

#[test]
fn the_interval_is_cut_to_the_range() {
    let inside = Ray {
        max_t: 0.25,
        ..ray(v(0.5, 0.5, 0.5), Vec3::Z)
    };
    decides_box(&unit_box(), &inside, Some((0.0, 0.25)));
    let behind = ray(v(0.5, 0.5, 2.0), Vec3::Z);
    decides_box(&unit_box(), &behind, None);
    let short = Ray {
        max_t: 0.5,
        ..ray(v(0.5, 0.5, -1.0), Vec3::Z)
    };
    decides_box(&unit_box(), &short, None);
}
