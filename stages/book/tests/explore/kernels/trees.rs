//! Building and traversing a tree, as the reference does.

use super::{Records, records};
use kit::{Aabb, Bvh, BvhNode, Hit, Interval, NodeKind, PrimId, Ray, Vec2, Vec3, World};

pub(super) fn all() -> Vec<Records> {
    vec![traversal(), build()]
}

/// A world whose boxes and primitives have given distances; NaN is a miss. It counts.
struct Scripted {
    /// For each node, at the x coordinate of its box.
    entries: [f64; 7],
    hits: [f64; 4],
    box_tests: u32,
    /// The leaves, as the digits of a number.
    leaves: u32,
}

impl World for Scripted {
    fn hit_box(&mut self, bounds: &Aabb, ray: &Ray) -> Option<Interval> {
        self.box_tests += 1;
        let min = self.entries[bounds.min.x as usize];
        let max = ray.max_t;
        (min <= max).then_some(Interval { min, max })
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        self.leaves = 10 * self.leaves + id.0 + 1;
        let t = self.hits[id.0 as usize];
        ray.in_range(t).then(|| {
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
        unreachable!("the figure shows the closest hit")
    }
}

/// The tree of the worked example: nodes A to G, and a primitive in each leaf.
fn tree_of_the_example() -> Bvh {
    let node = |i: u32, kind| {
        let corner = Vec3::new(f64::from(i), 0.0, 0.0);
        let bounds = Aabb {
            min: corner,
            max: corner,
        };
        BvhNode { bounds, kind }
    };
    let interior = |i, left| {
        node(
            i,
            NodeKind::Interior {
                left,
                right: left + 1,
            },
        )
    };
    let leaf = |i: u32| {
        node(
            i,
            NodeKind::Leaf {
                first: i - 3,
                count: 1,
            },
        )
    };
    Bvh {
        nodes: vec![
            interior(0, 1),
            interior(1, 3),
            interior(2, 5),
            leaf(3),
            leaf(4),
            leaf(5),
            leaf(6),
        ],
        order: (0..4).map(PrimId).collect(),
    }
}

/// The reference's traversal: t or NaN, the box tests, the leaves in their order.
fn traversal() -> Records {
    let tree = tree_of_the_example();
    records("traversal", 11, move |inputs| {
        // Few values, so that ties are frequent.
        let mut distances = [0.0; 11].map(|_: f64| match inputs.below(6) {
            0 => f64::NAN,
            _ => f64::from(inputs.below(16)) * 0.5,
        });
        distances[0] = if inputs.below(50) == 0 { f64::NAN } else { 0.0 };
        let mut world = Scripted {
            entries: std::array::from_fn(|i| distances[i]),
            hits: std::array::from_fn(|i| distances[7 + i]),
            box_tests: 0,
            leaves: 0,
        };
        let closest = bvh::intersect_bvh(&tree, &mut Ray::new(Vec3::ZERO, Vec3::X), &mut world);
        let t = closest.map_or(f64::NAN, |hit| hit.t);
        [
            &distances[..],
            &[t, world.box_tests.into(), world.leaves.into()],
        ]
        .concat()
    })
}

/// The reference's split of six boxes on the x axis, 1 high and 1 deep: which boxes go to the left,
/// as bits; and the areas and the expected number of tests, with the areas of `kit`. All of it is
/// exact for such boxes, but for one division.
fn build() -> Records {
    records("build", 12, |inputs| {
        let bounds: [Aabb; 6] = std::array::from_fn(|_| {
            let (centre, half) = (
                f64::from(inputs.below(97)) * 0.25 - 2.0,
                f64::from(1 + inputs.below(40)) * 0.5,
            );
            Aabb {
                min: Vec3::new(centre - half, 0.0, 0.0),
                max: Vec3::new(centre + half, 1.0, 1.0),
            }
        });
        let tree = bvh::construct_bvh(&bounds, 5);
        let NodeKind::Interior { left, right } = tree.nodes[0].kind else {
            unreachable!("six boxes are more than a leaf holds");
        };
        let leaf = |node: u32| match tree.nodes[node as usize].kind {
            NodeKind::Leaf { first, count } => tree.leaf(first, count),
            NodeKind::Interior { .. } => unreachable!("a side has at most five boxes"),
        };
        let bits = leaf(left).iter().fold(0, |bits, id| bits | 1 << id.0);
        let [all, low, high] =
            [0, left, right].map(|i| tree.nodes[i as usize].bounds.surface_area());
        let expected = (low * leaf(left).len() as f64 + high * leaf(right).len() as f64) / all;
        let ends = bounds.iter().flat_map(|b| [b.min.x, b.max.x]);
        ends.chain([f64::from(bits), low, high, expected]).collect()
    })
}
