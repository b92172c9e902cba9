//! Cases that break simple implementations. "Naive:" in a test's comment describes what a simple
//! implementation does, and how it fails.
// BEGIN SOLUTION(part2.task1)

use crate::rectangles::{Rectangles, check_tree, square};
use bvh::{construct_bvh, intersect_bvh, occludes_bvh};
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId, Ray, Vec3};

/// The largest depth that a tree may have: 64 midpoint splits and 32 median splits.
const DEPTH_BOUND: usize = 96;

fn ray_along_z(x: f64, y: f64) -> Ray {
    Ray::new(Vec3::new(x, y, -1.0), Vec3::Z)
}

fn closest(rects: &[Aabb], max_leaf_size: usize, mut ray: Ray) -> Option<(u32, f64)> {
    let tree = construct_bvh(rects, max_leaf_size);
    let mut world = Rectangles::new(rects.to_vec());
    let hit = intersect_bvh(&tree, &mut ray, &mut world);
    hit.map(|hit| (hit.prim.0, hit.t))
}

/// Hard case 62. Naive: no split separates the primitives, so the recursion never ends.
#[test]
fn equal_centroids_terminate() {
    let rects: Vec<Aabb> = (0..100)
        .map(|i| {
            let half = Vec3::new(1.0 + f64::from(i), 1.0, 0.0);
            Aabb {
                min: -half,
                max: half,
            }
        })
        .collect();
    let depth = check_tree(&construct_bvh(&rects, 1), &rects, 1);
    assert_eq!(depth, 7, "halving 100 primitives takes 7 levels");
}

/// Hard case 63. Naive: splits at the midpoint of the boxes. All centroids are on one side of it,
/// so the other child is empty.
#[test]
fn empty_side_falls_back_to_the_median() {
    let mut rects = vec![square(0.0, 0.0, 0.0); 2];
    rects.push(Aabb {
        min: Vec3::new(-1.0, -1.0, 0.0),
        max: Vec3::new(1000.0, 1.0, 0.0),
    });
    check_tree(&construct_bvh(&rects, 1), &rects, 1);
    // Two adjacent floats: their midpoint rounds to one of them.
    let point = |x: f64| Aabb {
        min: Vec3::new(x, 0.0, 0.0),
        max: Vec3::new(x, 0.0, 0.0),
    };
    let rects = [point(1.0), point(1.0_f64.next_up()), point(1.0)];
    check_tree(&construct_bvh(&rects, 1), &rects, 1);
}

/// Hard case 64. Naive: reads the root of a tree without nodes.
#[test]
fn empty_tree_has_no_hits() {
    let tree = construct_bvh(&[], 4);
    check_tree(&tree, &[], 4);
    let mut world = Rectangles::default();
    let mut ray = ray_along_z(0.0, 0.0);
    assert_eq!(intersect_bvh(&tree, &mut ray, &mut world), None);
    assert_eq!(ray, ray_along_z(0.0, 0.0));
    assert!(!occludes_bvh(&tree, &ray, &mut world));
}

/// Hard case 64.
#[test]
fn one_and_two_primitives() {
    let rects = [square(0.0, 0.0, 0.0), square(2.0, 0.0, 1.0)];
    for n in 1..=2 {
        for leaf in 0..3 {
            check_tree(&construct_bvh(&rects[..n], leaf), &rects[..n], leaf);
        }
    }
    assert_eq!(
        closest(&rects[..1], 1, ray_along_z(0.1, 0.1)),
        Some((0, 1.0))
    );
    assert_eq!(closest(&rects, 1, ray_along_z(2.1, 0.1)), Some((1, 2.0)));
    assert_eq!(closest(&rects, 1, ray_along_z(1.0, 0.1)), None);
}

/// Naive: no node ever has at most 0 primitives, so the recursion never ends.
#[test]
fn leaf_size_0_counts_as_1() {
    let rects: Vec<Aabb> = (0..10).map(|i| square(f64::from(i), 0.0, 0.0)).collect();
    assert_eq!(construct_bvh(&rects, 0), construct_bvh(&rects, 1));
}

/// Hard case 65. Naive: a division by the small extent gives an index out of range.
#[test]
fn very_thin_object() {
    let rects: Vec<Aabb> = (0..1000)
        .map(|i| square(f64::from(i) * 1e-300, 0.0, f64::from(i) * 1e-310))
        .collect();
    check_tree(&construct_bvh(&rects, 1), &rects, 1);
}

/// Hard case 66. Naive: each split separates a single primitive, so the tree has more than a
/// thousand levels.
#[test]
fn depth_is_bounded_for_halving_distances() {
    let rects: Vec<Aabb> = (0..2000)
        .map(|k| {
            let x = 2.0_f64.powi(1000 - k);
            Aabb::of([Vec3::new(x, 0.0, 0.0), Vec3::new(x, 1.0, 1.0)])
        })
        .collect();
    let depth = check_tree(&construct_bvh(&rects, 1), &rects, 1);
    assert!(depth <= DEPTH_BOUND, "{depth} levels");
}

/// Hard case 67. Naive: returns the last of the primitives with an equal `t`.
#[test]
fn lowest_id_of_duplicates_is_hit() {
    let rects = vec![square(0.0, 0.0, 0.0); 50];
    for leaf in [1, 4, 50] {
        assert_eq!(closest(&rects, leaf, ray_along_z(0.1, 0.1)), Some((0, 1.0)));
    }
}

/// Hard case 68. Naive: skips a box that the ray enters at the `t` of the closest hit, or returns
/// the last of the primitives with an equal `t`.
#[test]
fn lowest_id_is_hit_among_equal_t_in_several_leaves() {
    // Overlapping squares in one plane. The ray hits all of them at t = 1, in several leaves.
    for reversed in [false, true] {
        let mut rects: Vec<Aabb> = (0..8)
            .map(|i| square(0.1 * f64::from(i), 0.0, 0.0))
            .collect();
        if reversed {
            rects.reverse();
        }
        assert_eq!(closest(&rects, 1, ray_along_z(0.35, 0.0)), Some((0, 1.0)));
    }
}

/// Hard case 69. Naive: stops after a hit in the near child, although the box of the far child
/// overlaps and contains a nearer hit.
#[test]
fn overlapping_children_are_both_visited() {
    let floor = Aabb {
        min: Vec3::new(-9.0, -9.0, 5.0),
        max: Vec3::new(9.0, 9.0, 5.0),
    };
    let tall = Aabb {
        min: Vec3::new(-9.0, 1.0, -0.5),
        max: Vec3::new(9.0, 1.0, 9.0),
    };
    let rects = [tall, floor, square(0.0, 0.0, 3.0)];
    let mut ray = ray_along_z(0.2, 0.2);
    let tree = construct_bvh(&rects, 1);
    let hit = intersect_bvh(&tree, &mut ray, &mut Rectangles::new(rects.to_vec()));
    assert_eq!(hit.map(|h| (h.prim, h.t)), Some((PrimId(2), 4.0)));
    assert_eq!(ray.max_t, 4.0);
}

/// Hard case 72. Naive: 1e308 + 1e308 is infinite, and infinite centroids cannot be separated.
#[test]
fn centroids_near_the_largest_float() {
    let rects: Vec<Aabb> = (0..64)
        .map(|i| {
            let x = 1e308 + f64::from(i) * 1e306;
            Aabb::of([Vec3::new(x, -f64::MAX, 0.0), Vec3::new(x, f64::MAX, 0.0)])
        })
        .collect();
    let depth = check_tree(&construct_bvh(&rects, 1), &rects, 1);
    assert!(depth <= 7, "{depth} levels for 64 evenly spaced primitives");
}

/// Naive: one NaN propagates to the boxes of all ancestors, and every ray misses the tree.
#[test]
fn other_boxes_are_hit_next_to_empty_nan_and_infinite_ones() {
    let nan = Aabb {
        min: Vec3::NAN,
        max: Vec3::NAN,
    };
    let half_nan = Aabb {
        min: Vec3::new(f64::NAN, 0.0, 0.0),
        max: Vec3::ONE,
    };
    let unbounded = Aabb {
        min: Vec3::NEG_INFINITY,
        max: Vec3::INFINITY,
    };
    let half_space = Aabb {
        min: Vec3::NEG_INFINITY,
        max: Vec3::new(f64::INFINITY, f64::INFINITY, -5.0),
    };
    let odd = [nan, Aabb::EMPTY, half_nan, unbounded, half_space];
    for leaf in [1, 2, 8] {
        for repeats in [1, 20] {
            let mut rects = odd.repeat(repeats);
            let first_square = rects.len() as u32;
            rects.extend((0..100).map(|i| square(f64::from(i), 0.0, 0.0)));
            let tree = construct_bvh(&rects, leaf);
            assert!(check_tree(&tree, &rects, leaf) <= DEPTH_BOUND);
            let mut world = Rectangles::new(rects);
            let hit = intersect_bvh(&tree, &mut ray_along_z(7.1, 0.1), &mut world);
            assert_eq!(hit.map(|h| h.prim.0), Some(first_square + 7));
        }
    }
}

#[test]
fn tree_of_empty_boxes_has_no_hits() {
    let rects = vec![Aabb::EMPTY; 9];
    check_tree(&construct_bvh(&rects, 1), &rects, 1);
    assert_eq!(closest(&rects, 1, ray_along_z(0.0, 0.0)), None);
}

/// Naive: a stack of fixed size overflows, or a recursive traversal overflows the call stack.
#[test]
fn very_deep_tree_is_traversed() {
    // Built by hand: the children of each interior node are one leaf and the rest of the tree. The
    // ray enters all boxes at the same t.
    const N: u32 = 100_000;
    let all = Aabb {
        min: Vec3::new(-0.5, -0.5, 0.0),
        max: Vec3::new(0.5, 0.5, f64::from(N)),
    };
    let rects: Vec<Aabb> = (0..N).map(|i| square(0.0, 0.0, f64::from(N - i))).collect();
    let leaf = |first| NodeKind::Leaf { first, count: 1 };
    let mut nodes = Vec::new();
    for i in 0..N - 1 {
        let (left, right) = (2 * i + 2, 2 * i + 1);
        nodes.push(BvhNode {
            bounds: all,
            kind: NodeKind::Interior { left, right },
        });
        nodes.push(BvhNode {
            bounds: all,
            kind: leaf(i),
        });
    }
    nodes.push(BvhNode {
        bounds: all,
        kind: leaf(N - 1),
    });
    let order = (0..N).map(PrimId).collect();
    let tree = Bvh { nodes, order };
    let mut world = Rectangles::new(rects);
    let hit = intersect_bvh(&tree, &mut ray_along_z(0.0, 0.0), &mut world);
    assert_eq!(hit.map(|h| h.prim.0), Some(N - 1));
}
// END SOLUTION(part2.task1)
