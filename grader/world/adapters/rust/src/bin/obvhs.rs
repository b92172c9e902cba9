//! obvhs: its tree of two children and its compressed wide tree.

use glam::vec3a;
use obvhs::BvhBuildParams;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;
use world_adapters::{About, Mesh, only_t, run};

fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let point = |vertex: u32| {
        let [x, y, z] = mesh.vertices[vertex as usize].map(|x| x as f32);
        vec3a(x, y, z)
    };
    let triangle = |[v0, v1, v2]: [glam::Vec3A; 3]| Triangle { v0, v1, v2 };
    mesh.faces.iter().map(|face| triangle(face.map(point))).collect()
}

fn ray(ray: &world_adapters::Ray) -> Ray {
    let [x, y, z, dx, dy, dz, start, end] = ray.map(|x| x as f32);
    Ray::new(vec3a(x, y, z), vec3a(dx, dy, dz), start, end)
}

fn found(hit: &RayHit) -> [f64; 3] {
    only_t((hit.t < 1e30).then_some(f64::from(hit.t)))
}

fn main() {
    let about = |interface| About("obvhs", "0.4.0", interface, "f32");
    let build = |mesh: &Mesh| {
        let triangles = triangles(mesh);
        let tree = obvhs::bvh2::builder::build_bvh2_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Default::default());
        (tree, triangles)
    };
    run("obvhs_bvh2", about("Bvh2::ray_traverse, Triangle::intersect"), &[], build, |(tree, triangles), numbers| {
        let mut hit = RayHit::none();
        tree.ray_traverse(ray(numbers), &mut hit, |ray, id| triangles[tree.primitive_indices[id] as usize].intersect(ray));
        found(&hit)
    });
    let build = |mesh: &Mesh| {
        let triangles = triangles(mesh);
        let tree = obvhs::cwbvh::builder::build_cwbvh_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Default::default());
        (tree, triangles)
    };
    run("obvhs_cwbvh", about("CwBvh::ray_traverse, Triangle::intersect"), &[], build, |(tree, triangles), numbers| {
        let mut hit = RayHit::none();
        tree.ray_traverse(ray(numbers), &mut hit, |ray, id| triangles[tree.primitive_indices[id] as usize].intersect(ray));
        found(&hit)
    });
}
