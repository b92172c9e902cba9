//! The worked examples of Part 2.

use super::{Numbers, check};
use kit::{Aabb, Bvh, BvhNode, NodeKind, Vec3};

fn cube(x: f64) -> Aabb {
    Aabb {
        min: Vec3::new(x - 0.5, 0.0, 0.0),
        max: Vec3::new(x + 0.5, 1.0, 1.0),
    }
}

fn area(centroids: &[f64]) -> f64 {
    let boxes = centroids.iter().map(|x| cube(*x));
    boxes.fold(Aabb::EMPTY, Aabb::union).surface_area()
}

/// The levels of interior nodes from `node` down.
pub(super) fn height(tree: &Bvh, node: u32) -> f64 {
    match tree.nodes[node as usize].kind {
        NodeKind::Leaf { .. } => 0.0,
        NodeKind::Interior { left, right } => 1.0 + height(tree, left).max(height(tree, right)),
    }
}

#[test]
fn task1() {
    let mut text = Numbers::default();
    let all = [0.0, 1.0, 2.0, 3.0, 8.0, 20.0];
    for x in all {
        text.n(x);
    }
    text.n(2.0);
    let middle = |part: &[f64]| 0.5 * (part[0] + part[part.len() - 1]);
    let below = |part: &[f64]| part.iter().filter(|x| **x < middle(part)).count();
    text.n(all[0]);
    text.n(all[5]);
    text.n(middle(&all));
    assert_eq!(below(&all), 5);
    text.n(all[0]);
    text.n(all[4]);
    text.n(2.0);
    text.n(middle(&all[..5]));
    assert_eq!(below(&all[..5]), 4);
    text.n(middle(&all[..4]));
    assert_eq!(below(&all[..4]), 2);
    let tree = bvh::construct_bvh(&all.map(cube), 2);
    let interior = |node: &&BvhNode| matches!(node.kind, NodeKind::Interior { .. });
    assert_eq!(tree.nodes.iter().filter(interior).count(), 3);
    assert_eq!(tree.nodes.len(), 4 + 3, "leaves and interior nodes");
    text.n(height(&tree, 0));
    let sides = |text: &mut Numbers, part: &[f64]| {
        let length = part[part.len() - 1] - part[0] + 1.0;
        text.n(2.0);
        text.n(length);
        text.n(1.0);
        text.n(length);
        text.n(area(part));
    };
    text.n(21.0);
    text.n(1.0);
    text.n(1.0);
    sides(&mut text, &all);
    sides(&mut text, &all[..5]);
    text.n(area(&all[5..]));
    let ways = [
        vec![&all[..5], &all[5..]],
        vec![&all[..2], &all[2..4], &all[4..5], &all[5..]],
    ];
    for (i, leaves) in ways.iter().enumerate() {
        if i == 1 {
            for leaf in leaves {
                text.n(area(leaf));
            }
        }
        let mut sum = 0.0;
        for leaf in leaves {
            sum += text.n(area(leaf)) * text.n(leaf.len() as f64);
        }
        text.n(area(&all));
        text.n(sum / area(&all));
        if i == 0 {
            text.n(6.0);
        }
    }
    check("part2/task1.md", text);
}

#[test]
fn task2() {
    let mut text = Numbers::default();
    let low = text.v(-Vec3::ONE);
    let high = text.v(Vec3::ONE);
    let o = text.v(Vec3::new(-3.0, 0.5, 0.0));
    let d = text.v(Vec3::new(2.0, -0.5, 0.25));
    let min_t = text.n(0.0);
    // x: low plane first.
    text.n(low.x);
    text.n(-o.x);
    text.n(d.x);
    let ex = text.n((low.x - o.x) / d.x);
    text.n(high.x);
    text.n(-o.x);
    text.n(d.x);
    let fx = text.n((high.x - o.x) / d.x);
    // y: high plane first.
    text.n(high.y);
    text.n(o.y);
    text.n(d.y);
    let ey = text.n((high.y - o.y) / d.y);
    text.n(low.y);
    text.n(o.y);
    text.n(d.y);
    let fy = text.n((low.y - o.y) / d.y);
    let ez = text.n((low.z - o.z) / d.z);
    let fz = text.n((high.z - o.z) / d.z);
    for t in [ex, ey, ez, min_t] {
        text.n(t);
    }
    let entry = text.n(ex.max(ey).max(ez).max(min_t));
    for t in [fx, fy, fz] {
        text.n(t);
    }
    let exit = text.n(fx.min(fy).min(fz));
    let p = o + entry * d;
    text.n(p.x);
    text.n(o.y);
    text.n(-entry * d.y);
    assert_eq!(p.y, 0.0);
    text.n(p.z);
    text.n(0.5);
    text.n(exit.min(0.5));
    text.n(entry);
    let late = text.n(1.5);
    text.n(entry.max(late));
    text.n(exit);
    check("part2/task2.md", text);
}

/// The tree of the example: node, entry, hit; children of B and C.
const ENTRIES: [(char, f64, Option<f64>); 6] = [
    ('B', 1.0, None),
    ('C', 3.0, None),
    ('D', 1.0, Some(6.0)),
    ('E', 4.0, Some(5.0)),
    ('F', 3.0, Some(4.5)),
    ('G', 7.0, Some(7.5)),
];

fn entry(node: char) -> f64 {
    ENTRIES
        .iter()
        .find(|(name, ..)| *name == node)
        .expect("a node")
        .1
}

/// Box tests, visited leaves, and the hits in the order in which they are found.
fn walk(nearer_first: bool) -> (u32, String, Vec<f64>) {
    let children = |node| match node {
        'A' => Some(['B', 'C']),
        'B' => Some(['D', 'E']),
        'C' => Some(['F', 'G']),
        _ => None,
    };
    let (mut boxes, mut leaves, mut hits) = (1, String::new(), Vec::new());
    let mut end = f64::INFINITY;
    let mut later = vec!['A'];
    while let Some(node) = later.pop() {
        if node != 'A' && entry(node) > end {
            continue;
        }
        if let Some(pair) = children(node) {
            boxes += 2;
            let mut hit: Vec<char> = pair.into_iter().filter(|n| entry(*n) <= end).collect();
            hit.sort_by(|a, b| entry(*a).total_cmp(&entry(*b)));
            if nearer_first {
                hit.reverse();
            }
            later.extend(hit);
        } else {
            leaves.push(node);
            let t = ENTRIES
                .iter()
                .find(|(name, ..)| *name == node)
                .and_then(|n| n.2);
            if let Some(t) = t.filter(|t| *t <= end) {
                end = t;
                hits.push(t);
            }
        }
    }
    (boxes, leaves, hits)
}

#[test]
fn task3() {
    let mut text = Numbers::default();
    for (_, entry, hit) in ENTRIES {
        text.n(entry);
        if let Some(hit) = hit {
            text.n(hit);
        }
    }
    let (boxes, leaves, hits) = walk(true);
    assert_eq!(leaves, "DEF");
    text.n(entry('C'));
    text.n(entry('E'));
    text.n(hits[0]);
    text.n(hits[0]);
    text.n(entry('E'));
    text.n(hits[0]);
    text.n(hits[1]);
    text.n(hits[1]);
    text.n(entry('C'));
    text.n(hits[1]);
    text.n(entry('G'));
    text.n(hits[1]);
    text.n(hits[2]);
    text.n(hits[2]);
    text.n(f64::from(boxes));
    text.n(leaves.len() as f64);
    let (_, leaves, hits) = walk(false);
    assert_eq!(leaves, "GFED");
    text.n(hits[0]);
    text.n(hits[1]);
    text.n(entry('E'));
    text.n(entry('D'));
    text.n(leaves.len() as f64);
    assert_eq!(hits.len(), 2);
    check("part2/task3.md", text);
}
