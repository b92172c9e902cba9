//! Builds of other kinds than those of the corpus: correct ones whose time or use of memory differs
//! most from the reference's, and quadratic ones.

use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId};

/// A function as students write it.
pub(super) type Build = fn(&[Aabb], usize) -> Bvh;

/// Correct builds.
pub(super) const CORRECT: [(&str, Build); 6] = [
    ("sort at each level", sort_at_each_level),
    ("two lists at each level", two_lists_at_each_level),
    ("sweep of three axes", sweep),
    ("Morton", morton),
    ("PLOC", ploc),
    ("insertion", insertion),
];

/// Builds in O(n²).
pub(super) const QUADRATIC: [(&str, Build); 4] = [
    ("contains", |bounds, size| {
        top_down(bounds, size, &mut halves_by_contains)
    }),
    ("remove(0)", |bounds, size| {
        top_down(bounds, size, &mut halves_by_remove)
    }),
    ("insert(0, ...)", |bounds, size| {
        top_down(bounds, size, &mut halves_by_insert)
    }),
    ("all primitives in each node", all_in_each_node),
];

fn placeholder(bounds: Aabb) -> BvhNode {
    BvhNode {
        bounds,
        kind: NodeKind::Leaf { first: 0, count: 0 },
    }
}

fn union(bounds: &[Aabb], ids: &[u32]) -> Aabb {
    ids.iter()
        .fold(Aabb::EMPTY, |all, &id| all.union(bounds[id as usize]))
}

fn all_ids(bounds: &[Aabb]) -> Vec<u32> {
    (0..bounds.len() as u32).collect()
}

fn sort_by_axis(bounds: &[Aabb], ids: &mut [u32], axis: usize) {
    let at = |id: u32| bounds[id as usize].centroid()[axis];
    ids.sort_by(|&a, &b| at(a).total_cmp(&at(b)));
}

/// Divides a list into two, given their box.
type Divide<'a> = &'a mut dyn FnMut(&[Aabb], Vec<u32>, &Aabb) -> [Vec<u32>; 2];

/// A top-down build whose nodes are divided by `divide`.
fn top_down(bounds: &[Aabb], max_leaf_size: usize, divide: Divide) -> Bvh {
    let mut bvh = Bvh::default();
    if !bounds.is_empty() {
        node(
            &mut bvh,
            bounds,
            all_ids(bounds),
            max_leaf_size.max(1),
            divide,
        );
    }
    bvh
}

fn node(bvh: &mut Bvh, bounds: &[Aabb], ids: Vec<u32>, size: usize, divide: Divide) -> u32 {
    let around = union(bounds, &ids);
    let me = bvh.nodes.len();
    bvh.nodes.push(placeholder(around));
    if ids.len() <= size {
        let first = bvh.order.len() as u32;
        bvh.order.extend(ids.iter().map(|&id| PrimId(id)));
        bvh.nodes[me].kind = NodeKind::Leaf {
            first,
            count: ids.len() as u32,
        };
        return me as u32;
    }
    let [low, high] = divide(bounds, ids, &around);
    let left = node(bvh, bounds, low, size, divide);
    let right = node(bvh, bounds, high, size, divide);
    bvh.nodes[me].kind = NodeKind::Interior { left, right };
    me as u32
}

fn sort_at_each_level(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    top_down(bounds, max_leaf_size, &mut |bounds, mut ids, around| {
        sort_by_axis(bounds, &mut ids, around.extent().max_position());
        let high = ids.split_off(ids.len() / 2);
        [ids, high]
    })
}

fn two_lists_at_each_level(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    top_down(bounds, max_leaf_size, &mut |bounds, ids, around| {
        let axis = around.extent().max_position();
        let middle = around.centroid()[axis];
        let is_low = |id: &&u32| bounds[**id as usize].centroid()[axis] < middle;
        let low: Vec<u32> = ids.iter().filter(is_low).copied().collect();
        let high: Vec<u32> = ids.iter().filter(|id| !is_low(id)).copied().collect();
        match low.is_empty() || high.is_empty() {
            true => [ids[..ids.len() / 2].to_vec(), ids[ids.len() / 2..].to_vec()],
            false => [low, high],
        }
    })
}

/// Sorts along each axis at each level, and takes the split of the lowest cost.
fn sweep(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    top_down(bounds, max_leaf_size, &mut |bounds, mut ids, _| {
        let n = ids.len();
        let (mut best, mut best_cost) = ((0, n / 2), f64::INFINITY);
        for axis in 0..3 {
            sort_by_axis(bounds, &mut ids, axis);
            let mut above = vec![0.0; n];
            let mut around = Aabb::EMPTY;
            for i in (1..n).rev() {
                around = around.union(bounds[ids[i] as usize]);
                above[i] = around.surface_area() * (n - i) as f64;
            }
            let mut around = Aabb::EMPTY;
            for i in 1..n {
                around = around.union(bounds[ids[i - 1] as usize]);
                let cost = around.surface_area() * i as f64 + above[i];
                if cost < best_cost {
                    (best, best_cost) = ((axis, i), cost);
                }
            }
        }
        let (axis, at) = best;
        sort_by_axis(bounds, &mut ids, axis);
        let high = ids.split_off(at);
        [ids, high]
    })
}

fn morton_code(all: &Aabb, b: &Aabb) -> u64 {
    let cell = ((b.centroid() - all.min) / all.extent() * 1023.0).to_array();
    let mut code = 0;
    for bit in (0..10).rev() {
        for along in cell {
            code = code << 1 | (along as u64 >> bit) & 1;
        }
    }
    code
}

fn morton(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let all = union(bounds, &all_ids(bounds));
    let mut ids = all_ids(bounds);
    ids.sort_by_cached_key(|&id| morton_code(&all, &bounds[id as usize]));
    let mut rest = Some(ids);
    top_down(bounds, max_leaf_size, &mut |_, ids, _| {
        let mut ids = rest.take().unwrap_or(ids);
        let high = ids.split_off(ids.len() / 2);
        [ids, high]
    })
}

/// Parallel locally-ordered clustering (Meister and Bittner 2018): neighbours along a curve that are
/// each other's nearest are joined, in passes.
fn ploc(bounds: &[Aabb], _: usize) -> Bvh {
    const RADIUS: usize = 12;
    let all = union(bounds, &all_ids(bounds));
    let mut ids = all_ids(bounds);
    ids.sort_by_cached_key(|&id| morton_code(&all, &bounds[id as usize]));
    let mut nodes = vec![placeholder(all)];
    let mut clusters: Vec<u32> = Vec::new();
    for (place, &id) in ids.iter().enumerate() {
        clusters.push(nodes.len() as u32);
        nodes.push(BvhNode {
            bounds: bounds[id as usize],
            kind: NodeKind::Leaf {
                first: place as u32,
                count: 1,
            },
        });
    }
    while clusters.len() > 1 {
        let nearest: Vec<usize> = (0..clusters.len())
            .map(|i| {
                let around = i.saturating_sub(RADIUS)..(i + RADIUS + 1).min(clusters.len());
                let area = |j: usize| {
                    let [a, b] = [i, j].map(|k| nodes[clusters[k] as usize].bounds);
                    a.union(b).surface_area()
                };
                let others = around.filter(|&j| j != i);
                others
                    .min_by(|&a, &b| area(a).total_cmp(&area(b)))
                    .unwrap_or(i)
            })
            .collect();
        let mut next = Vec::new();
        for i in 0..clusters.len() {
            let j = nearest[i];
            if nearest[j] != i {
                next.push(clusters[i]);
            } else if i < j {
                let (left, right) = (clusters[i], clusters[j]);
                let bounds = nodes[left as usize]
                    .bounds
                    .union(nodes[right as usize].bounds);
                next.push(nodes.len() as u32);
                nodes.push(BvhNode {
                    bounds,
                    kind: NodeKind::Interior { left, right },
                });
            }
        }
        clusters = next;
    }
    nodes.swap_remove(0);
    let moved = nodes.len() as u32;
    for node in &mut nodes {
        if let NodeKind::Interior { left, right } = &mut node.kind {
            for child in [left, right] {
                *child = if *child == moved { 0 } else { *child };
            }
        }
    }
    Bvh {
        nodes,
        order: ids.into_iter().map(PrimId).collect(),
    }
}

/// Inserts each primitive where it enlarges the boxes least, found by a search with bounds.
fn insertion(bounds: &[Aabb], _: usize) -> Bvh {
    let mut nodes: Vec<BvhNode> = Vec::new();
    let mut parents: Vec<Option<u32>> = Vec::new();
    for (id, &b) in bounds.iter().enumerate() {
        let leaf = NodeKind::Leaf {
            first: id as u32,
            count: 1,
        };
        if nodes.is_empty() {
            nodes.push(BvhNode {
                bounds: b,
                kind: leaf,
            });
            parents.push(None);
            continue;
        }
        let mut queue = std::collections::BinaryHeap::from([(Cost(0.0), 0u32)]);
        let (mut best, mut best_cost) = (0, f64::INFINITY);
        while let Some((Cost(inherited), at)) = queue.pop() {
            if inherited + b.surface_area() >= best_cost {
                break;
            }
            let node = nodes[at as usize];
            let joined = node.bounds.union(b).surface_area();
            if inherited + joined < best_cost {
                (best, best_cost) = (at, inherited + joined);
            }
            if let NodeKind::Interior { left, right } = node.kind {
                let passed_on = Cost(inherited + joined - node.bounds.surface_area());
                queue.extend([(passed_on, left), (passed_on, right)]);
            }
        }
        // The node that is joined moves, and what was there becomes the parent.
        let old = nodes[best as usize];
        let moved = nodes.len() as u32;
        nodes.extend([
            old,
            BvhNode {
                bounds: b,
                kind: leaf,
            },
        ]);
        parents.extend([Some(best), Some(best)]);
        if let NodeKind::Interior { left, right } = old.kind {
            parents[left as usize] = Some(moved);
            parents[right as usize] = Some(moved);
        }
        nodes[best as usize].kind = NodeKind::Interior {
            left: moved,
            right: moved + 1,
        };
        let mut up = Some(best);
        while let Some(at) = up {
            let node = &mut nodes[at as usize];
            node.bounds = node.bounds.union(b);
            up = parents[at as usize];
        }
    }
    Bvh {
        nodes,
        order: all_ids(bounds).into_iter().map(PrimId).collect(),
    }
}

/// A cost that a queue takes first if it is least.
#[derive(Clone, Copy, PartialEq)]
struct Cost(f64);

impl Eq for Cost {}

impl Ord for Cost {
    fn cmp(&self, other: &Cost) -> std::cmp::Ordering {
        other.0.total_cmp(&self.0)
    }
}

impl PartialOrd for Cost {
    fn partial_cmp(&self, other: &Cost) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

fn halves_by_contains(bounds: &[Aabb], mut ids: Vec<u32>, around: &Aabb) -> [Vec<u32>; 2] {
    sort_by_axis(bounds, &mut ids, around.extent().max_position());
    let low = ids[..ids.len() / 2].to_vec();
    let high = ids.into_iter().filter(|id| !low.contains(id)).collect();
    [low, high]
}

fn halves_by_remove(bounds: &[Aabb], mut ids: Vec<u32>, around: &Aabb) -> [Vec<u32>; 2] {
    sort_by_axis(bounds, &mut ids, around.extent().max_position());
    let half = ids.len() / 2;
    let low = (0..half).map(|_| ids.remove(0)).collect();
    [low, ids]
}

fn halves_by_insert(bounds: &[Aabb], mut ids: Vec<u32>, around: &Aabb) -> [Vec<u32>; 2] {
    sort_by_axis(bounds, &mut ids, around.extent().max_position());
    let (low, high) = ids.split_at(ids.len() / 2);
    [low, high].map(|half| {
        let mut list = Vec::new();
        for &id in half {
            list.insert(0, id);
        }
        list
    })
}

/// Looks for its primitives among all of the scene, in each node.
fn all_in_each_node(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let mut node_of = vec![0u32; bounds.len()];
    let mut next = 0;
    top_down(bounds, max_leaf_size, &mut |bounds, ids, around| {
        next += 1;
        for &id in &ids {
            node_of[id as usize] = next;
        }
        let mut own: Vec<u32> = (0..bounds.len() as u32)
            .filter(|&id| node_of[id as usize] == next)
            .collect();
        sort_by_axis(bounds, &mut own, around.extent().max_position());
        let high = own.split_off(own.len() / 2);
        [own, high]
    })
}
