//! parry3d in both precisions.

use world_adapters::{About, Mesh, NO_START, Ray, only_t, run};

macro_rules! row {
    ($parry:ident, $real:ty, $row:literal, $precision:literal) => {
        run(
            $row,
            About(stringify!($parry), "0.31.1", "TriMesh::cast_local_ray", $precision),
            NO_START,
            |mesh: &Mesh| {
                let point = |[x, y, z]: &[f64; 3]| $parry::math::Vector::new(*x as $real, *y as $real, *z as $real);
                let vertices = mesh.vertices.iter().map(point).collect();
                $parry::shape::TriMesh::new(vertices, mesh.faces.clone()).expect("it has triangles")
            },
            |mesh, ray: &Ray| {
                use $parry::query::RayCast;
                let [x, y, z, dx, dy, dz, _, end] = ray.map(|x| x as $real);
                let vector = $parry::math::Vector::new;
                let ray = $parry::query::Ray::new(vector(x, y, z), vector(dx, dy, dz));
                only_t(mesh.cast_local_ray(&ray, end.min(1e30), false).map(|t| t as f64))
            },
        )
    };
}

fn main() {
    row!(parry3d, f32, "parry3d", "f32");
    row!(parry3d_f64, f64, "parry3d_f64", "f64");
}
