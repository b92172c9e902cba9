//! The picture of Part 2, task 1.

use super::{Panel, heat};
use crate::stages;
use kit::{Aabb, Bvh, NodeKind, Vec3};
use wire::work::Xyz;

/// A mesh in the colours of its leaves, then of their depths. Triangles in no leaf are left out.
pub(super) fn leaves(
    stage: &stages::Bvh,
    size: [u32; 2],
    triangles: &[[Xyz; 3]],
    max_leaf_size: u32,
) -> Vec<Panel> {
    let triangles: Vec<[Vec3; 3]> = triangles.iter().map(|t| t.map(Vec3::from)).collect();
    let bounds_of = |corners: &[Vec3; 3]| Aabb {
        min: corners[0].min(corners[1]).min(corners[2]),
        max: corners[0].max(corners[1]).max(corners[2]),
    };
    let bounds: Vec<Aabb> = triangles.iter().map(bounds_of).collect();
    let tree = (stage.construct_bvh)(&bounds, max_leaf_size as usize);
    let all = bounds.iter().fold(Aabb::EMPTY, |all, b| all.union(*b));
    let places = places(&tree, triangles.len());
    // The depth of a tree whose leaves are all full, twice.
    let full = (triangles.len() as f64 / f64::from(max_leaf_size.max(1))).max(2.0);
    let hottest = 2.0 * full.log2();

    let mut screen = Screen::new(size, &all);
    for (corners, place) in triangles.iter().zip(&places.of_primitive) {
        let Some(place) = place else { continue };
        let share = (place.bounds.centroid() - all.min) / all.extent();
        let leaf = (0.15 + 0.55 * share) * brightness(share);
        let depth = heat(f64::from(place.depth) / hottest);
        screen.fill(corners, [leaf.to_array(), depth]);
    }
    for (bounds, depth) in places.interior {
        if depth <= OUTLINED {
            screen.outline(&bounds, 0.7 / f64::from(depth + 1));
        }
    }
    screen.panels
}

/// Boxes of nodes at most this deep are drawn.
const OUTLINED: u32 = 4;

/// The leaf of a primitive.
#[derive(Clone, Copy)]
struct Place {
    bounds: Aabb,
    depth: u32,
}

/// What a picture shows of a tree.
struct Places {
    of_primitive: Vec<Option<Place>>,
    /// The boxes of all nodes, with their depths.
    interior: Vec<(Aabb, u32)>,
}

/// Visits each node at most once, so that a malformed tree ends, too.
fn places(tree: &Bvh, primitives: usize) -> Places {
    let mut places = Places {
        of_primitive: vec![None; primitives],
        interior: Vec::new(),
    };
    let mut is_new = vec![true; tree.nodes.len()];
    let mut open = vec![(0_u32, 0_u32)];
    while let Some((index, depth)) = open.pop() {
        let Some(node) = tree.nodes.get(index as usize) else {
            continue;
        };
        if !std::mem::replace(&mut is_new[index as usize], false) {
            continue;
        }
        places.interior.push((node.bounds, depth));
        match node.kind {
            NodeKind::Interior { left, right } => {
                open.extend([(right, depth + 1), (left, depth + 1)]);
            }
            NodeKind::Leaf { first, count } => {
                let (first, count) = (first as usize, count as usize);
                for id in tree.order.iter().skip(first).take(count) {
                    if let Some(place) = places.of_primitive.get_mut(id.0 as usize) {
                        let bounds = node.bounds;
                        *place = Some(Place { bounds, depth });
                    }
                }
            }
        }
    }
    places
}

/// A brightness from 0.5 to 1 that differs between neighbours: a hash of the place in 64 steps.
fn brightness(share: Vec3) -> f64 {
    let cell = (share * 64.0).to_array().map(|s| s as u32);
    let mixed = cell.iter().fold(0x9E37_79B9_u32, |hash, &c| {
        (hash ^ c).wrapping_mul(0x85EB_CA6B).rotate_left(13)
    });
    0.5 + 0.5 * f64::from(mixed >> 16) / 65536.0
}

/// Two panels that show the same points, and the depth of the nearest.
struct Screen {
    size: [u32; 2],
    panels: Vec<Panel>,
    nearest: Vec<f64>,
    centre: Vec3,
    /// Pixels per unit of length.
    scale: f64,
}

impl Screen {
    /// A screen that shows the box `all` along -z, with a margin.
    fn new(size: [u32; 2], all: &Aabb) -> Screen {
        let pixels = size[0] as usize * size[1] as usize;
        let extent = all.extent();
        let [w, h] = size.map(|side| 0.94 * f64::from(side));
        Screen {
            size,
            panels: vec![vec![[0.0; 3]; pixels]; 2],
            nearest: vec![f64::NEG_INFINITY; pixels],
            centre: all.centroid(),
            scale: (w / extent.x).min(h / extent.y),
        }
    }

    fn pixel(&self, p: Vec3) -> Option<usize> {
        let [x, y] = self.on_screen(p);
        let [w, h] = self.size.map(f64::from);
        let is_inside = (0.0..w).contains(&x) && (0.0..h).contains(&y);
        is_inside.then(|| y as usize * self.size[0] as usize + x as usize)
    }

    fn on_screen(&self, p: Vec3) -> [f64; 2] {
        let offset = (p - self.centre) * self.scale;
        let [w, h] = self.size.map(f64::from);
        [0.5 * w + offset.x, 0.5 * h + offset.y]
    }

    /// Draws a triangle as a cloud of points, half a pixel apart.
    fn fill(&mut self, [a, b, c]: &[Vec3; 3], colours: [[f64; 3]; 2]) {
        let (u, v) = (*b - *a, *c - *a);
        let steps = (2.0 * self.scale * u.length().max(v.length()))
            .ceil()
            .max(1.0);
        for i in 0..=steps as u32 {
            for j in 0..=steps as u32 - i {
                let p = *a + (f64::from(i) * u + f64::from(j) * v) / steps;
                let Some(pixel) = self.pixel(p) else { continue };
                if p.z > self.nearest[pixel] {
                    self.nearest[pixel] = p.z;
                    for (panel, colour) in self.panels.iter_mut().zip(colours) {
                        panel[pixel] = colour.map(|channel| channel as f32);
                    }
                }
            }
        }
    }

    /// Draws the edges of a box in grey on the second panel.
    fn outline(&mut self, bounds: &Aabb, grey: f64) {
        let [[x0, y0], [x1, y1]] = [bounds.min, bounds.max].map(|p| self.on_screen(p));
        let [w, h] = self.size;
        let rounded = |x: f64, end: u32| x.clamp(0.0, f64::from(end - 1)) as u32;
        let (x0, x1) = (rounded(x0, w), rounded(x1, w));
        let (y0, y1) = (rounded(y0, h), rounded(y1, h));
        let across = (x0..=x1).flat_map(|x| [(x, y0), (x, y1)]);
        let along = (y0..=y1).flat_map(|y| [(x0, y), (x1, y)]);
        for (x, y) in across.chain(along) {
            self.panels[1][(y * w + x) as usize] = [grey as f32; 3];
        }
    }
}
