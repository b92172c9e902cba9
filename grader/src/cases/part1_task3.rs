//! Triangles.

use super::Spec;
use kit::{Triangle, Vec3};
use wire::Work;
use wire::work::{Probe, Ray, Xyz};

/// The cases of `part1.task3`.
pub(super) fn cases() -> Vec<Spec> {
    vec![
        case(
            "front_face",
            "Rays that meet the side towards which the normal points.",
            from_side(1.0),
        ),
        case(
            "back_face",
            "Rays that meet the other side: walls and open meshes have two.",
            from_side(-1.0),
        ),
    ]
}

fn case(name: &'static str, about: &'static str, work: Work) -> Spec {
    Spec::new("part1.task3", name, about, work)
}

fn from_side(side: f64) -> Work {
    let triangle = Triangle {
        n0: Vec3::new(0.6, 0.0, 0.8),
        n1: Vec3::new(0.0, 0.6, 0.8),
        n2: Vec3::new(-0.6, 0.0, 0.8),
        ..Triangle::flat(
            Vec3::new(-1.0, -1.0, 0.5),
            Vec3::new(2.0, -0.5, 0.0),
            Vec3::new(0.0, 1.5, -0.5),
        )
    };
    let mut probes = Vec::new();
    for i in 0..20 {
        for j in 0..20 {
            let o = Vec3::new(0.31, 0.17, 4.0 * side);
            let target = Vec3::new(f64::from(i) * 0.2 - 1.9, f64::from(j) * 0.2 - 1.9, 0.0);
            probes.push(Probe {
                shape: 0,
                ray: wire_ray(&kit::Ray::new(o, (target - o).normalize())),
            });
        }
    }
    Work::Triangles {
        triangles: vec![wire_triangle(&triangle)],
        probes,
    }
}

fn wire_ray(ray: &kit::Ray) -> Ray {
    Ray {
        o: ray.o.into(),
        d: ray.d.into(),
        min_t: ray.min_t,
        max_t: ray.max_t,
    }
}

fn wire_triangle(t: &Triangle) -> [Xyz; 6] {
    [t.p0, t.p1, t.p2, t.n0, t.n1, t.n2].map(Vec3::into)
}
