//! tinybvh's widest layout for processors. Needs AVX2: `RUSTFLAGS="-C target-cpu=native"`.

use tinybvh_rs::{Intersector, Ray, bvh, bvh8_cpu, mbvh};
use world_adapters::{About, Mesh, NO_START, only_t, run};

fn build(mesh: &Mesh) -> bvh8_cpu::BVH {
    let corner = |vertex: &u32| {
        let [x, y, z] = mesh.vertices[*vertex as usize].map(|x| x as f32);
        [x, y, z, 0.0]
    };
    let corners: Vec<[f32; 4]> = mesh.faces.iter().flatten().map(corner).collect();
    let mut two = bvh::BVH::new(corners.as_slice().into()).expect("it has triangles");
    two.split_leaves(4);
    bvh8_cpu::BVH::new(&mbvh::BVH::new(&two)).expect("its leaves are small")
}

fn main() {
    let about = About("tinybvh", "tinybvh-rs 0.1.0-beta.3", "BVH8_CPU::intersect", "f32");
    run("tinybvh", about, NO_START, build, |tree, ray| {
        let [x, y, z, dx, dy, dz, _, end] = ray.map(|x| x as f32);
        // The library normalises the direction.
        let length = (dx * dx + dy * dy + dz * dz).sqrt();
        let mut ray = Ray::new([x, y, z], [dx, dy, dz]);
        ray.hit.t = (end * length).min(1e30);
        let limit = ray.hit.t;
        tree.intersect(&mut ray);
        only_t((ray.hit.t < limit).then(|| f64::from(ray.hit.t) / f64::from(length)))
    });
}
