//! The worked examples of the chapters of Part 2, tasks 1 and 3: the first tests to make green.

use bvh::{construct_bvh, intersect_bvh};
use kit::{Aabb, Bvh, BvhNode, Hit, Interval, NodeKind, PrimId, Ray, Vec2, Vec3, World};

#[test]
fn part2_task1_six_cubes_on_a_line() {
    let centroids = [0.0, 1.0, 2.0, 3.0, 8.0, 20.0];
    let cubes = centroids.map(|x| Aabb {
        min: Vec3::new(x - 0.5, 0.0, 0.0),
        max: Vec3::new(x + 0.5, 1.0, 1.0),
    });
    let tree = construct_bvh(&cubes, 2);
    let root = tree.nodes.first().expect("the tree has a root").bounds;
    assert_eq!(root.surface_area(), 86.0);
    let mut found = Vec::new();
    let mut tests = 0.0;
    for node in &tree.nodes {
        if let NodeKind::Leaf { first, count } = node.kind {
            assert!(
                count <= 2,
                "a leaf holds at most 2 cubes, and one has {count}"
            );
            found.extend(tree.leaf(first, count).iter().map(|id| id.0));
            tests += node.bounds.surface_area() * f64::from(count) / root.surface_area();
        }
    }
    found.sort_unstable();
    assert_eq!(found, [0, 1, 2, 3, 4, 5], "every cube is in one leaf");
    // 0.60 with splits at the middle; any tree that splits saves most of the 6 tests.
    assert!(
        tests < 2.28,
        "a ray that hits the root tests {tests} cubes on average"
    );
}

/// Where the boxes of the nodes A to G are entered, and the hits in the leaves D to G.
const ENTRIES: [f64; 7] = [0.0, 1.0, 3.0, 1.0, 4.0, 3.0, 7.0];
const HITS: [f64; 4] = [6.0, 5.0, 4.5, 7.5];

/// A world in which the box of node number `n` is the one from (n, 0, 0) on.
struct Scripted {
    tested: Vec<u32>,
}

impl World for Scripted {
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        let min = ENTRIES[b.min.x as usize];
        let max = ray.max_t;
        (min <= max).then_some(Interval { min, max })
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        self.tested.push(id.0);
        let t = HITS[id.0 as usize];
        (t <= ray.max_t).then(|| {
            ray.max_t = t;
            Hit {
                t,
                p: ray.at(t),
                n: Vec3::Z,
                ng: Vec3::Z,
                uv: Vec2::ZERO,
                prim: id,
            }
        })
    }

    fn blocked(&mut self, _: PrimId, _: &Ray) -> bool {
        false
    }
}

#[test]
fn part2_task3_the_leaf_that_is_visited_last_has_the_nearest_hit() {
    let interior = |left, right| NodeKind::Interior { left, right };
    let leaf = |first| NodeKind::Leaf { first, count: 1 };
    let kinds = [
        interior(1, 2),
        interior(3, 4),
        interior(5, 6),
        leaf(0),
        leaf(1),
        leaf(2),
        leaf(3),
    ];
    let nodes = kinds.into_iter().enumerate().map(|(number, kind)| {
        let min = Vec3::new(number as f64, 0.0, 0.0);
        let max = min + Vec3::ONE;
        BvhNode {
            bounds: Aabb { min, max },
            kind,
        }
    });
    let tree = Bvh {
        nodes: nodes.collect(),
        order: (0..4).map(PrimId).collect(),
    };
    let mut world = Scripted { tested: Vec::new() };
    let mut ray = Ray::new(Vec3::ZERO, Vec3::Z);
    let hit = intersect_bvh(&tree, &mut ray, &mut world).expect("the ray hits");
    assert_eq!((hit.t, hit.prim, ray.max_t), (4.5, PrimId(2), 4.5));
    // Near children first: D, E, F, and not G, whose box is entered behind the nearest hit.
    assert_eq!(world.tested, [0, 1, 2]);
}
