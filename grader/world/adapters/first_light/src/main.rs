//! This project's trees: the wide one, by the ray and by the tile, and the plain one in both
//! precisions and with tests of textbooks.

#[allow(dead_code, reason = "the other adapters use all of it")]
#[path = "../../rust/src/lib.rs"]
mod world_adapters;

use bvh::construct_bvh;
use kit::{Bvh, PrimId, Triangle, TriangleHit, Vec3};
use simd_bvh::{RayTile, Subset, TestCounts, TileEnds, TileMemory, WideBvh};
use std::cell::RefCell;
use world_adapters::{About, Mesh, Ray, run};

const MISS: [f64; 3] = [f64::INFINITY, -1.0, f64::NAN];

fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let corner = |vertex: u32| Vec3::from_array(mesh.vertices[vertex as usize]);
    mesh.faces.iter().map(|face| face.map(corner)).map(|[a, b, c]| Triangle::flat(a, b, c)).collect()
}

fn ray([x, y, z, dx, dy, dz, min_t, max_t]: &Ray) -> kit::Ray {
    let (o, d) = (Vec3::new(*x, *y, *z), Vec3::new(*dx, *dy, *dz));
    kit::Ray { o, d, min_t: *min_t, max_t: *max_t }
}

fn found(hit: Option<(f64, PrimId)>) -> [f64; 3] {
    hit.map_or(MISS, |(t, id)| [t, f64::from(id.0), f64::NAN])
}

fn exact(triangles: &[Triangle]) -> impl FnMut(PrimId, &kit::Ray) -> Option<TriangleHit> + '_ {
    |id, ray| intersect::test_triangle(&triangles[id.0 as usize], ray)
}

/// The hit of `ray` as the first of a tile of 64, whose other directions are close to its own.
fn in_a_tile((tree, triangles): &(WideBvh, Vec<Triangle>), ray: &kit::Ray) -> Option<(PrimId, TriangleHit)> {
    let Vec3 { x, y, z } = ray.d;
    let beside = |i: usize| match [i % 8, i / 8].map(|i| i as f64 / 1024.0) {
        [0.0, 0.0] => ray.d,
        [u, v] => ray.d + u * Vec3::new(y, z, x) - v * Vec3::new(z, x, y),
    };
    let directions = [0, 1, 2].map(|axis| (0..64).map(|i| beside(i)[axis]).collect::<Vec<f64>>());
    let tile = RayTile {
        o: ray.o,
        d: [0, 1, 2].map(|axis| &directions[axis][..]),
        min_t: ray.min_t,
        max_t: TileEnds::All(ray.max_t),
        skips: &[],
    };
    let (memory, counts, mut hits) = (&mut TileMemory::default(), &mut TestCounts::default(), Vec::new());
    tree.closest_of_tile(Subset::default(), &tile, &mut exact(triangles), memory, counts, &mut hits);
    hits.swap_remove(0)
}

fn main() {
    let about = |interface, precision| About("First Light", "0.1.0", interface, precision);
    let wide = |mesh: &Mesh| {
        let triangles = triangles(mesh);
        (WideBvh::build(&triangles, &[]), triangles)
    };
    run("first_light", about("WideBvh::closest", "f64"), &[], wide, |(tree, triangles), numbers| {
        let counts = &mut TestCounts::default();
        found(tree.closest(&ray(numbers), None, &mut exact(triangles), counts).map(|(id, hit)| (hit.t, id)))
    });
    // Of 64 answers 63 are not asked for: no speed.
    let tile = about("WideBvh::closest_of_tile, 64 rays of one origin", "f64");
    run("first_light_tile", tile, &["speed"], wide, |scene, numbers| {
        found(in_a_tile(scene, &ray(numbers)).map(|(id, hit)| (hit.t, id)))
    });
    // The plain tree: with exact tests, and with those of textbooks.
    let ours = |precision| About("First Light", "0.1.0", "construct_bvh; Woop's test, Ize's slabs", precision);
    let textbook = |precision| About("textbook code", "0.1.0", "construct_bvh; Moller-Trumbore, Williams's slabs", precision);
    let rows = [
        ("first_light_plain", 0, ours("f64")),
        ("first_light_plain_f32", 3, ours("f32")),
        ("textbook_f64", 2, textbook("f64")),
        ("textbook_f32", 6, textbook("f32")),
    ];
    for (row, number, about) in rows {
        let build = |mesh: &Mesh| {
            let triangles = triangles(mesh);
            let bounds: Vec<_> = triangles.iter().map(Triangle::bounds).collect();
            // The tree lives as long as the program.
            let tree: &'static Bvh = Box::leak(Box::new(construct_bvh(&bounds, 4)));
            RefCell::new(kernels::rounded_trees(tree, &triangles).swap_remove(number))
        };
        run(row, about, &[], build, |tree, numbers| found((tree.borrow_mut().closest)(&ray(numbers))));
    }
}
