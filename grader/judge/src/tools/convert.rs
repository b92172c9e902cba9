//! Converts the plain numbers of `wire` to the types of `kit`.

use kit::{Ray, Scene, Sphere, Triangle, Vec3};
use wire::work::{self, Xyz};

/// A ray.
pub fn ray(r: &work::Ray) -> Ray {
    Ray {
        o: r.o.into(),
        d: r.d.into(),
        min_t: r.min_t,
        max_t: r.max_t,
    }
}

/// A triangle from its vertices and their normals.
pub fn triangle(vectors: &[Xyz; 6]) -> Triangle {
    let [p0, p1, p2, n0, n1, n2] = vectors.map(Vec3::from);
    Triangle::smooth([p0, p1, p2], [n0, n1, n2])
}

/// A sphere from its centre and radius.
pub fn sphere(&(center, radius): &(Xyz, f64)) -> Sphere {
    Sphere {
        center: center.into(),
        radius,
    }
}

/// A list of triangles and, numbered after them, spheres.
pub fn scene(triangles: &[[Xyz; 6]], spheres: &[(Xyz, f64)]) -> Scene {
    Scene {
        triangles: triangles.iter().map(triangle).collect(),
        spheres: spheres.iter().map(sphere).collect(),
        ..Scene::default()
    }
}
