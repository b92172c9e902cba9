//! A [`World`] of simple primitives for tests: axis-aligned rectangles, which take one division per
//! hit.
// BEGIN SOLUTION(part2.task1)

use kit::{Aabb, Bvh, Hit, Interval, NodeKind, PrimId, Ray, Vec2, Vec3, World};

/// Primitive `i` is the flat box `rects[i]`: a rectangle perpendicular to its thinnest axis. Counts
/// the tests.
#[derive(Default)]
pub(crate) struct Rectangles {
    /// The rectangles, which are their own bounding boxes.
    pub(crate) rects: Vec<Aabb>,
    /// Number of box tests.
    pub(crate) box_tests: u32,
    /// Number of primitive tests.
    pub(crate) prim_tests: u32,
}

impl Rectangles {
    pub(crate) fn new(rects: Vec<Aabb>) -> Rectangles {
        Rectangles {
            rects,
            ..Rectangles::default()
        }
    }

    fn t(&self, id: PrimId, ray: &Ray) -> Option<f64> {
        let rect = &self.rects[id.0 as usize];
        let axis = rect.extent().min_position();
        let t = (rect.min[axis] - ray.o[axis]) / ray.d[axis];
        let inside = (0..3).filter(|a| *a != axis).all(|a| {
            let p = ray.o[a] + t * ray.d[a];
            rect.min[a] <= p && p <= rect.max[a]
        });
        (inside && ray.in_range(t)).then_some(t)
    }

    /// The closest hit, by testing every primitive.
    pub(crate) fn brute_force(&mut self, ray: &mut Ray) -> Option<Hit> {
        let ids = 0..self.rects.len() as u32;
        let hits: Vec<Hit> = ids.filter_map(|i| self.hit_prim(PrimId(i), ray)).collect();
        hits.into_iter()
            .reduce(|a, b| if b.t < a.t { b } else { a })
    }
}

impl World for Rectangles {
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        self.box_tests += 1;
        let (mut min, mut max) = (ray.min_t, ray.max_t);
        for axis in 0..3 {
            let (mut near, mut far) = (b.min[axis], b.max[axis]);
            if ray.d[axis].is_sign_negative() {
                (near, far) = (far, near);
            }
            let t_far = (far - ray.o[axis]) / ray.d[axis];
            // `max` and `min` ignore the NaN of 0/0.
            min = min.max((near - ray.o[axis]) / ray.d[axis]);
            max = max.min(t_far.next_up().next_up());
        }
        (!b.is_empty() && min <= max).then_some(Interval { min, max })
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        self.prim_tests += 1;
        let t = self.t(id, ray)?;
        ray.max_t = t;
        Some(Hit {
            t,
            p: ray.at(t),
            n: Vec3::Y,
            ng: Vec3::Y,
            uv: Vec2::ZERO,
            prim: id,
        })
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        self.prim_tests += 1;
        self.t(id, ray).is_some()
    }
}

/// The square with edge length 1 and centre (x, y) at height `z`.
pub(crate) fn square(x: f64, y: f64, z: f64) -> Aabb {
    Aabb {
        min: Vec3::new(x - 0.5, y - 0.5, z),
        max: Vec3::new(x + 0.5, y + 0.5, z),
    }
}

/// Checks the invariants of a tree over `bounds`. Returns the depth of its deepest leaf; the root
/// has depth 0.
pub(crate) fn check_tree(bvh: &Bvh, bounds: &[Aabb], max_leaf_size: usize) -> usize {
    let mut ids: Vec<u32> = bvh.order.iter().map(|id| id.0).collect();
    ids.sort_unstable();
    assert!(
        ids.iter().copied().eq(0..bounds.len() as u32),
        "every primitive is in the order exactly once"
    );
    if bounds.is_empty() {
        assert!(bvh.nodes.is_empty());
        return 0;
    }
    let mut in_leaves = vec![0; bounds.len()];
    let mut visited = 0;
    let mut deepest = 0;
    let mut to_visit = vec![(0, 0)];
    while let Some((i, depth)) = to_visit.pop() {
        visited += 1;
        deepest = depth.max(deepest);
        let node = &bvh.nodes[i as usize];
        match node.kind {
            NodeKind::Interior { left, right } => {
                for child in [left, right] {
                    let child_bounds = &bvh.nodes[child as usize].bounds;
                    assert!(
                        node.bounds.contains(child_bounds),
                        "a node's box must contain the boxes of its children"
                    );
                    to_visit.push((child, depth + 1));
                }
            }
            NodeKind::Leaf { first, count } => {
                assert!(0 < count && count as usize <= max_leaf_size.max(1));
                for k in first..first + count {
                    in_leaves[k as usize] += 1;
                }
                for id in bvh.leaf(first, count) {
                    let prim = &bounds[id.0 as usize];
                    assert!(
                        node.bounds.contains(prim),
                        "a leaf's box must contain the boxes of its primitives"
                    );
                }
            }
        }
    }
    assert_eq!(
        visited,
        bvh.nodes.len(),
        "every node must be reached exactly once"
    );
    assert!(
        in_leaves.iter().all(|n| *n == 1),
        "every primitive must be in exactly one leaf"
    );
    deepest
}
// END SOLUTION(part2.task1)
