//! Closest and any hit among a few primitives, hit points and normals.

use kit::scene::Primitive;
use kit::{PrimId, Ray, Sphere, Triangle, Vec3};
use oracle::closest::ClosestJudgement;
use oracle::surface::{
    geometric_normal, sphere_normal, sphere_point, triangle_normal, triangle_point,
};
use oracle::{KernelClass, PerKernel, any, closest, sphere, triangle};

use crate::rays::{self, Family, Random};

fn wall(z: f64) -> Triangle {
    Triangle::flat(
        Vec3::new(-4.0, -4.0, z),
        Vec3::new(4.0, -4.0, z),
        Vec3::new(-4.0, 4.0, z),
    )
}

fn forward() -> Ray {
    Ray::new(Vec3::new(-1.0, -1.0, -2.0), Vec3::Z)
}

#[test]
fn the_nearest_primitive_is_closest() {
    let (near, far) = (wall(0.0), wall(1.0));
    let ball = Sphere {
        center: Vec3::new(-1.0, -1.0, 0.5),
        radius: 1.0,
    };
    let all = [
        Primitive::Triangle(&far),
        Primitive::Triangle(&near),
        Primitive::Sphere(&ball),
    ];
    let truth = closest(all, &forward());
    assert_eq!(
        truth.nearest.map(|(id, t)| (id, t.to_f64())),
        Some((PrimId(2), 1.5))
    );
    for kernel in [KernelClass::Textbook, KernelClass::Robust] {
        assert!(truth.judge(kernel, Some((PrimId(2), 1.5))).scores());
        let wrong = truth.judge(kernel, Some((PrimId(1), 2.0)));
        assert_eq!(wrong, ClosestJudgement::WrongPrimitive);
        assert!(!truth.judge(kernel, Some((PrimId(2), 2.5))).scores());
        assert_eq!(truth.judge(kernel, None), ClosestJudgement::FalseMiss);
        assert!(truth.judge_any(kernel, true) && !truth.judge_any(kernel, false));
    }
    assert!(any(all, &forward()));
}

#[test]
fn equal_hits_are_ties_and_any_of_them_scores() {
    let (a, b, c) = (wall(0.0), wall(0.0), wall(1.0));
    let all = [&c, &a, &b].map(Primitive::Triangle);
    let truth = closest(all, &forward());
    assert_eq!(truth.ties, [PrimId(1), PrimId(2)]);
    assert_eq!(truth.nearest.map(|(id, _)| id), Some(PrimId(1)));
    for kernel in [KernelClass::Textbook, KernelClass::Robust] {
        assert!(truth.judge(kernel, Some((PrimId(1), 2.0))).scores());
        assert!(truth.judge(kernel, Some((PrimId(2), 2.0))).scores());
        assert!(!truth.judge(kernel, Some((PrimId(0), 3.0))).scores());
    }
}

#[test]
fn either_of_two_walls_an_ulp_apart_scores() {
    // Away from 0, so that t cannot represent the difference.
    let (a, b) = (wall(1.0), wall(1.0_f64.next_up()));
    let ray = Ray::new(Vec3::new(-1.0, -1.0, -2.0), Vec3::new(0.1, 0.2, 0.7));
    let truth = closest([&b, &a].map(Primitive::Triangle), &ray);
    assert_eq!(truth.ties, [PrimId(1)]);
    let t = truth.nearest.expect("a hit").1.to_f64();
    for kernel in [KernelClass::Textbook, KernelClass::Robust] {
        assert!(truth.judge(kernel, Some((PrimId(0), t))).scores());
    }
}

#[test]
fn a_ray_away_from_the_primitive_misses() {
    let back = Ray::new(Vec3::new(-1.0, -1.0, -2.0), -Vec3::Z);
    let near = wall(0.0);
    let all = [Primitive::Triangle(&near)];
    let truth = closest(all, &back);
    assert_eq!(truth.nearest, None);
    assert_eq!(
        truth.judge(KernelClass::Robust, None),
        ClosestJudgement::Miss
    );
    let false_hit = truth.judge(KernelClass::Robust, Some((PrimId(0), 2.0)));
    assert_eq!(false_hit, ClosestJudgement::FalseHit);
    assert!(!any(all, &back));
    assert!(closest([], &back).answers.textbook.miss);
}

/// Hit points and normals of textbook code are accepted, and the usual mistakes are not.
#[test]
fn wrong_hit_points_and_normals_are_rejected() {
    let mut r = Random::new(40);
    let mut hits = 0;
    for _ in 0..20_000 {
        let (mut tri, ray) = rays::triangle(&mut r, Family::Ordinary);
        let bent = |r: &mut Random, n: Vec3| (n + 0.3 * r.place()).normalize();
        (tri.n0, tri.n1, tri.n2) = (
            bent(&mut r, tri.n0),
            bent(&mut r, tri.n1),
            bent(&mut r, tri.n2),
        );
        let verdict = triangle(&tri, &ray);
        let Some(at) = verdict.crossing.filter(|_| verdict.hits()) else {
            continue;
        };
        hits += 1;
        let (t, b1, b2) = (at.t.to_f64(), at.b1.to_f64(), at.b2.to_f64());
        let point = triangle_point(&tri, &at);
        assert!(point.accepts(KernelClass::Textbook, ray.at(t)), "{point:?}");
        let mixed = (1.0 - b1 - b2) * tri.p0 + b1 * tri.p1 + b2 * tri.p2;
        assert!(point.accepts(KernelClass::Robust, mixed), "{point:?}");
        assert!(!point.accepts(KernelClass::Textbook, ray.at(t * (1.0 + 1e-4))));

        let normal = triangle_normal(&tri, &at);
        let n = ((1.0 - b1 - b2) * tri.n0 + b1 * tri.n1 + b2 * tri.n2).normalize();
        assert!(normal.accepts(KernelClass::Robust, n), "{normal:?}");
        for wrong in [
            -n,
            0.9 * n,
            tri.n0,
            (b1 * tri.n0 + b2 * tri.n1 + (1.0 - b1 - b2) * tri.n2).normalize(),
        ] {
            assert!(
                !normal.accepts(KernelClass::Textbook, wrong),
                "{normal:?} {wrong}"
            );
        }
        let ng = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0).normalize();
        assert!(geometric_normal(&tri).accepts(KernelClass::Robust, ng));
        assert!(!geometric_normal(&tri).accepts(KernelClass::Textbook, -ng));
    }
    assert!(hits > 1_000, "{hits}");
}

#[test]
fn wrong_sphere_points_and_normals_are_rejected() {
    let mut r = Random::new(41);
    let mut hits = 0;
    for _ in 0..20_000 {
        let (s, ray) = rays::sphere(&mut r, Family::Ordinary);
        let verdict = sphere(&s, &ray);
        let Some(t) = verdict.t else { continue };
        if verdict.undecidable(KernelClass::Textbook) {
            continue;
        }
        hits += 1;
        let root = usize::from(verdict.roots.map(|roots| roots[1]) == Some(t));
        let p = ray.at(t.to_f64());
        let point = sphere_point(&verdict, &ray, root).expect("a hit");
        assert!(point.accepts(KernelClass::Robust, p));
        let n = (p - s.center).normalize();
        let normal = sphere_normal(&verdict, &s, &ray, root).expect("a hit");
        assert!(normal.accepts(KernelClass::Robust, n));
        assert!(!normal.accepts(KernelClass::Textbook, -n));
        assert!(!normal.accepts(KernelClass::Textbook, (p - s.center) * 0.5));
    }
    assert!(hits > 1_000, "{hits}");
}

#[test]
fn any_unit_vector_scores_if_normals_cancel() {
    let mut tri = wall(0.0);
    (tri.n1, tri.n2) = (-tri.n0, -tri.n0);
    let ray = Ray::new(Vec3::new(-4.0, 0.0, 1.0), -Vec3::Z);
    let at = triangle(&tri, &ray).crossing.expect("a hit");
    let normal = triangle_normal(&tri, &at);
    assert_eq!(normal.n, PerKernel::default());
    assert!(normal.accepts(KernelClass::Robust, Vec3::X));
    assert!(!normal.accepts(KernelClass::Robust, Vec3::NAN));
}

/// Textbook code loses all digits of the weights of a thin triangle far from the world's origin,
/// but robust code does not: each has bounds of its own.
#[test]
fn robust_normals_are_judged_where_textbook_code_loses_them() {
    let far = Vec3::splat(1e6);
    let tri = Triangle {
        p0: far,
        p1: far + Vec3::new(1.0, 0.0, 0.0),
        p2: far + Vec3::new(0.5, 1e-4, 0.0),
        n0: Vec3::X,
        n1: Vec3::Y,
        n2: Vec3::Z,
    };
    let ray = Ray::new(far + Vec3::new(0.5, 4e-5, 1.0), -Vec3::Z);
    let at = triangle(&tri, &ray).crossing.expect("a hit");
    let normal = triangle_normal(&tri, &at);
    assert_eq!(normal.n.textbook, None);
    let right = normal.n.robust.expect("robust code has digits left");
    assert!(normal.accepts(KernelClass::Textbook, -right));
    assert!(normal.accepts(KernelClass::Robust, right));
    assert!(!normal.accepts(KernelClass::Robust, -right));
    assert!(!normal.accepts(KernelClass::Robust, Vec3::X));
}
