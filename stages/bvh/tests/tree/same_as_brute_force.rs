//! The tree gives the same hits as brute force.
// BEGIN SOLUTION(part2.task1)

use crate::rectangles::{Rectangles, check_tree, square};
use bvh::{construct_bvh, intersect_bvh, occludes_bvh};
use kit::{Aabb, Bvh, PrimId, Ray, Vec3, World};
use proptest::prelude::*;

/// Asserts that the tree's closest hit and any hit are those of brute force, which tests every
/// primitive, bit for bit.
fn assert_same(tree: &Bvh, rects: &[Aabb], ray: &Ray) {
    let mut world = Rectangles::new(rects.to_vec());
    let (mut tree_ray, mut brute_force_ray) = (*ray, *ray);
    let hit = intersect_bvh(tree, &mut tree_ray, &mut world);
    let expected = world.brute_force(&mut brute_force_ray);
    assert_eq!(hit, expected);
    assert_eq!(
        tree_ray, brute_force_ray,
        "a hit must shorten the ray, a miss must not change it"
    );
    assert_eq!(occludes_bvh(tree, ray, &mut world), expected.is_some());
}

/// Coordinates on a coarse grid, so that boxes touch, overlap, coincide and share planes.
fn on_grid() -> impl Strategy<Value = f64> {
    (-4..=4).prop_map(f64::from)
}

fn rectangle() -> impl Strategy<Value = Aabb> {
    let corner = || [on_grid(), on_grid(), on_grid()].prop_map(Vec3::from);
    (corner(), corner(), 0..3_usize).prop_map(|(a, mut b, axis)| {
        b[axis] = a[axis];
        Aabb::of([a, b])
    })
}

fn ray() -> impl Strategy<Value = Ray> {
    let arbitrary = || -6.0..6.0;
    let origin = prop_oneof![
        [on_grid(), on_grid(), on_grid()],
        [arbitrary(), arbitrary(), arbitrary()]
    ];
    let direction = prop_oneof![
        [on_grid(), on_grid(), on_grid()],
        [arbitrary(), arbitrary(), arbitrary()]
    ];
    (origin, direction, -2.0..2.0, 0.0..20.0).prop_map(|(o, d, min_t, length)| Ray {
        min_t,
        max_t: min_t + length,
        ..Ray::new(o.into(), d.into())
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn random_rectangles(
        rects in prop::collection::vec(rectangle(), 0..60),
        ray in ray(),
        leaf in 0..9_usize,
    ) {
        let tree = construct_bvh(&rects, leaf);
        let depth = check_tree(&tree, &rects, leaf);
        prop_assert!(depth <= rects.len());
        prop_assert_eq!(&construct_bvh(&rects, leaf), &tree, "the tree must depend only on the boxes");
        assert_same(&tree, &rects, &ray);
    }

    #[test]
    fn boxes_of_arbitrary_floats_give_a_valid_tree(
        corners in prop::collection::vec([any::<f64>(), any::<f64>(), any::<f64>()], 0..80),
        leaf in 0..5_usize,
    ) {
        let rects: Vec<Aabb> = corners
            .chunks_exact(2)
            .map(|c| Aabb { min: c[0].into(), max: c[1].into() })
            .collect();
        check_tree(&construct_bvh(&rects, leaf), &rects, leaf);
    }
}

/// Hard case 70: any hit exists exactly if a closest one does. Axis-aligned and diagonal rays
/// through the corners and edges of a grid of squares.
#[test]
fn rays_on_a_grid() {
    let rects: Vec<Aabb> = (0..400)
        .map(|i| square(f64::from(i % 20), f64::from(i / 20), 0.0))
        .collect();
    let trees = [1, 4].map(|leaf| construct_bvh(&rects, leaf));
    for i in 0..42 {
        for j in 0..42 {
            let o = Vec3::new(0.5 * f64::from(i) - 0.5, 0.5 * f64::from(j) - 0.5, -1.0);
            for tree in &trees {
                assert_same(tree, &rects, &Ray::new(o, Vec3::Z));
                // In the plane of the squares, and along a diagonal.
                assert_same(tree, &rects, &Ray::new(o + Vec3::Z, Vec3::X));
                assert_same(tree, &rects, &Ray::new(o, Vec3::new(1.0, -1.0, 1.0)));
            }
        }
    }
}

/// Hard case 71. The leaf size affects only the speed.
#[test]
fn any_leaf_size() {
    let rects: Vec<Aabb> = (0..200)
        .map(|i| square(f64::from(i % 7), f64::from(i % 11), f64::from(i % 13)))
        .collect();
    for leaf in [1, 2, 3, 7, 50, 199, 200, usize::MAX] {
        let tree = construct_bvh(&rects, leaf);
        check_tree(&tree, &rects, leaf);
        for i in 0..90 {
            let o = Vec3::new(0.1 * f64::from(i), 0.07 * f64::from(i), -1.0);
            assert_same(&tree, &rects, &Ray::new(o, Vec3::new(0.01, 0.02, 1.0)));
        }
    }
}

/// The traversal tests few boxes and primitives. The any-hit traversal stops at the first primitive
/// that the ray hits.
#[test]
fn traversal_needs_few_tests() {
    let rects: Vec<Aabb> = (0..4096)
        .map(|i| square(f64::from(i % 64), f64::from(i / 64), 0.0))
        .collect();
    let tree = construct_bvh(&rects, 4);
    let mut world = Rectangles::new(rects);
    let ray = Ray::new(Vec3::new(30.2, 30.2, -1.0), Vec3::Z);
    assert!(intersect_bvh(&tree, &mut { ray }, &mut world).is_some());
    assert!(
        0 < world.box_tests && world.box_tests < 80,
        "{}",
        world.box_tests
    );
    assert!(world.prim_tests < 20, "{}", world.prim_tests);

    let duplicates = Rectangles::new(vec![square(0.0, 0.0, 0.0); 1000]);
    let tree = construct_bvh(&duplicates.rects, 4);
    let mut world = duplicates;
    assert!(occludes_bvh(
        &tree,
        &Ray::new(-Vec3::Z, Vec3::Z),
        &mut world
    ));
    assert_eq!(world.prim_tests, 1);
}

/// If a ray misses the box of the root, nothing else is tested.
#[test]
fn root_box_is_tested_first() {
    let rects = vec![square(0.0, 0.0, 0.0); 3];
    for leaf in [1, 3] {
        let mut world = Rectangles::new(rects.clone());
        let mut ray = Ray::new(Vec3::new(5.0, 0.0, -1.0), Vec3::Z);
        assert_eq!(
            intersect_bvh(&construct_bvh(&rects, leaf), &mut ray, &mut world),
            None
        );
        assert_eq!((world.box_tests, world.prim_tests), (1, 0));
    }
}

/// Boxes are tested with a slightly larger range, primitives with the ray's own range.
#[test]
fn hit_is_found_if_rounding_moves_it_before_its_box() {
    // The hit of the second primitive is 16 units in the last place before that of the first, but
    // its box is behind that of the first: rounding can cause this.
    struct Rounding;
    impl World for Rounding {
        fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<kit::Interval> {
            let min = b.min.z.max(ray.min_t);
            let max = b.max.z.min(ray.max_t);
            (min <= max).then_some(kit::Interval { min, max })
        }
        fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<kit::Hit> {
            let t = [1.0, 1.0 - 8.0 * f64::EPSILON][id.0 as usize];
            ray.in_range(t).then(|| {
                ray.max_t = t;
                kit::Hit {
                    t,
                    p: ray.at(t),
                    n: Vec3::Z,
                    ng: Vec3::Z,
                    uv: kit::Vec2::ZERO,
                    prim: id,
                }
            })
        }
        fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
            self.hit_prim(id, &mut { *ray }).is_some()
        }
    }
    let rects = [
        square(0.0, 0.0, 1.0),
        square(9.0, 0.0, 1.0 + 8.0 * f64::EPSILON),
    ];
    let tree = construct_bvh(&rects, 1);
    let mut ray = Ray::new(Vec3::ZERO, Vec3::Z);
    let hit = intersect_bvh(&tree, &mut ray, &mut Rounding);
    assert_eq!(hit.map(|h| h.prim), Some(PrimId(1)));
}
// END SOLUTION(part2.task1)
