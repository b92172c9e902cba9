//! Lists that are sorted and cut, one object a node, results compared by hand: the style of a
//! Java programmer.

pub use base::*;
use kit::{Aabb, Bvh, BvhNode, Hit, NodeKind, PrimId, Ray, World};

pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let mut bvh = Bvh { nodes: vec![], order: vec![] };
    if bounds.len() == 0 {
        return bvh;
    }
    let mut list: Vec<usize> = vec![];
    for i in 0..bounds.len() {
        list.push(i);
    }
    make_node(&mut bvh, bounds, list, max_leaf_size);
    return bvh;
}

fn middle(b: &Aabb, axis: usize) -> f64 {
    return b.min[axis] * 0.5 + b.max[axis] * 0.5;
}

fn make_node(bvh: &mut Bvh, bounds: &[Aabb], mut list: Vec<usize>, max_leaf_size: usize) -> usize {
    let mut around = Aabb::EMPTY;
    for &i in &list {
        if !bounds[i].is_empty() {
            around = around.union(bounds[i]);
        }
    }
    let my_index = bvh.nodes.len();
    let start = bvh.order.len();
    bvh.nodes.push(BvhNode { bounds: around, kind: NodeKind::Leaf { first: start as u32, count: list.len() as u32 } });
    if list.len() <= max_leaf_size || list.len() == 1 {
        for &i in &list {
            bvh.order.push(PrimId(i as u32));
        }
        return my_index;
    }
    let mut lowest = [f64::INFINITY; 3];
    let mut highest = [f64::NEG_INFINITY; 3];
    for &i in &list {
        for axis in 0..3 {
            lowest[axis] = lowest[axis].min(middle(&bounds[i], axis));
            highest[axis] = highest[axis].max(middle(&bounds[i], axis));
        }
    }
    let mut best_axis = 0;
    for axis in 1..3 {
        if highest[axis] - lowest[axis] > highest[best_axis] - lowest[best_axis] {
            best_axis = axis;
        }
    }
    list.sort_by(|&a, &b| middle(&bounds[a], best_axis).total_cmp(&middle(&bounds[b], best_axis)));
    let half = list.len() / 2;
    let first_half = list[..half].to_vec();
    let second_half = list[half..].to_vec();
    let left = make_node(bvh, bounds, first_half, max_leaf_size);
    let right = make_node(bvh, bounds, second_half, max_leaf_size);
    bvh.nodes[my_index].kind = NodeKind::Interior { left: left as u32, right: right as u32 };
    return my_index;
}

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let mut best: Option<Hit> = None;
    if bvh.nodes.len() > 0 {
        search(bvh, 0, ray, world, &mut best);
    }
    return best;
}

fn search<W: World>(bvh: &Bvh, index: usize, ray: &mut Ray, world: &mut W, best: &mut Option<Hit>) {
    let node = &bvh.nodes[index];
    if world.hit_box(&node.bounds, ray).is_none() {
        return;
    }
    match node.kind {
        NodeKind::Leaf { first, count } => {
            for i in first..first + count {
                let hit = world.hit_prim(bvh.order[i as usize], ray);
                if let Some(h) = hit {
                    if best.is_none() || h.t <= best.unwrap().t {
                        *best = Some(h);
                    }
                }
            }
        }
        NodeKind::Interior { left, right } => {
            let a = world.hit_box(&bvh.nodes[left as usize].bounds, ray);
            let b = world.hit_box(&bvh.nodes[right as usize].bounds, ray);
            let mut order = vec![];
            if a.is_some() && b.is_some() {
                if a.unwrap().min < b.unwrap().min {
                    order.push(left);
                    order.push(right);
                } else {
                    order.push(right);
                    order.push(left);
                }
            } else if a.is_some() {
                order.push(left);
            } else if b.is_some() {
                order.push(right);
            }
            for child in order {
                search(bvh, child as usize, ray, world, best);
            }
        }
    }
}

pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    let mut todo = vec![];
    if bvh.nodes.len() != 0 {
        todo.push(0);
    }
    while let Some(index) = todo.pop() {
        let node = &bvh.nodes[index as usize];
        if world.hit_box(&node.bounds, ray).is_some() {
            match node.kind {
                NodeKind::Leaf { first, count } => {
                    for i in 0..count {
                        if world.blocked(bvh.order[(first + i) as usize], ray) {
                            return true;
                        }
                    }
                }
                NodeKind::Interior { left, right } => {
                    todo.push(right);
                    todo.push(left);
                }
            }
        }
    }
    return false;
}
