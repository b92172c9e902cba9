//! The crate bvh in both precisions. Its triangle test culls back faces: both windings are tested.

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use nalgebra::{Point3, Vector3};
use world_adapters::{About, Mesh, NO_RANGE, run};

macro_rules! row {
    ($real:ty, $row:literal, $precision:literal) => {{
        struct Triangle([Point3<$real>; 3], usize);
        impl Bounded<$real, 3> for Triangle {
            fn aabb(&self) -> Aabb<$real, 3> {
                self.0.iter().fold(Aabb::empty(), |bounds, p| bounds.grow(p))
            }
        }
        impl BHShape<$real, 3> for Triangle {
            fn set_bh_node_index(&mut self, index: usize) {
                self.1 = index;
            }
            fn bh_node_index(&self) -> usize {
                self.1
            }
        }
        let build = |mesh: &Mesh| {
            let point = |vertex: u32| Point3::from(mesh.vertices[vertex as usize].map(|x| x as $real));
            let triangle = |face: &[u32; 3]| Triangle(face.map(point), 0);
            let mut triangles: Vec<Triangle> = mesh.faces.iter().map(triangle).collect();
            let tree = Bvh::build(&mut triangles);
            (tree, triangles)
        };
        run($row, About("bvh", "0.13.0", "Bvh::traverse, Ray::intersects_triangle", $precision), NO_RANGE, build, |scene, ray| {
            let (tree, triangles) = scene;
            let [x, y, z, dx, dy, dz, ..] = ray.map(|x| x as $real);
            let d = Vector3::new(dx, dy, dz);
            let ray = bvh::ray::Ray::new(Point3::new(x, y, z), d);
            let test = |t: &&Triangle| {
                let [a, b, c] = &t.0;
                let front = ray.intersects_triangle(a, b, c).distance;
                front.min(ray.intersects_triangle(a, c, b).distance)
            };
            let near = tree.traverse(&ray, triangles);
            let hits: Vec<$real> = near.iter().map(test).filter(|t| t.is_finite()).collect();
            let t = hits.iter().copied().fold(<$real>::INFINITY, <$real>::min);
            [(t / d.norm()) as f64, f64::NAN, hits.len() as f64]
        });
    }};
}

fn main() {
    row!(f32, "bvh_f32", "f32");
    row!(f64, "bvh_f64", "f64");
}
