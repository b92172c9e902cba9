//! A large mesh, and the boxes of the tree over it.

use crate::collada::{Document, Mesh, Paint};
use crate::shapes::{block, square};
use kit::{Aabb, Bvh, NodeKind, Triangle, Vec3};
use meshes::{MeshKind, generate};

/// The number of triangles of the mesh.
pub const TRIANGLES: usize = 200_000;

/// The height of the mountains, as a share of those of the mesh.
const RELIEF: f64 = 0.5;

/// The height of the water.
const LAKE: f64 = 0.012;

/// Primitives of a leaf.
const MAX_LEAF_SIZE: usize = 4;

/// A level of the tree that is shown: its depth below the root, the range of z of its boxes, their
/// colour and the thickness of their edges.
struct Level {
    depth: u32,
    z: [f64; 2],
    color: [f64; 3],
    thickness: f64,
}

/// The levels that are shown, from the coarse one on the right to the fine one on the left.
const LEVELS: [Level; 3] = [
    Level {
        depth: 6,
        z: [-0.34, 0.02],
        color: [0.95, 0.62, 0.05],
        thickness: 0.0035,
    },
    Level {
        depth: 9,
        z: [0.02, 0.36],
        color: [0.05, 0.70, 0.72],
        thickness: 0.002,
    },
    Level {
        depth: 12,
        z: [0.36, 1.0],
        color: [0.90, 0.20, 0.45],
        thickness: 0.001,
    },
];

/// The scene of a landscape of `triangles` triangles. Its right third is bare; further left are the
/// boxes of its tree, the further left, the deeper the level.
pub fn document(triangles: usize) -> Document {
    let mesh: Vec<Triangle> = generate(MeshKind::Terrain, triangles)
        .iter()
        .map(flattened)
        .collect();
    let bounds: Vec<Aabb> = mesh.iter().map(Triangle::bounds).collect();
    let tree = bvh::construct_bvh(&bounds, MAX_LEAF_SIZE);
    let mut meshes = vec![
        Mesh {
            name: "mesh".to_owned(),
            paint: Paint::Matte([0.66, 0.58, 0.50]),
            triangles: mesh,
        },
        Mesh {
            name: "lake".to_owned(),
            paint: Paint::Mirror([0.55, 0.60, 0.68]),
            triangles: square(400.0, LAKE),
        },
    ];
    for Level {
        depth,
        z: [from, to],
        color,
        thickness,
    } in LEVELS
    {
        let boxes = boxes_at_depth(&tree, depth).into_iter().filter(|b| {
            let center = 0.5 * (b.min.z + b.max.z);
            (from..to).contains(&center)
        });
        meshes.push(Mesh {
            name: format!("level-{depth}"),
            paint: Paint::Matte(color),
            triangles: boxes.flat_map(|b| edges(&b, thickness)).collect(),
        });
    }
    Document {
        yfov: 22.0,
        aspect: 2.0,
        camera: [Vec3::new(2.3, 0.80, 0.0), Vec3::new(0.0, 0.05, 0.0)],
        ambient: None,
        sun: None,
        lights: Vec::new(),
        meshes,
    }
}

/// A triangle of the landscape with lower mountains.
fn flattened(t: &Triangle) -> Triangle {
    let lower = |p: Vec3| Vec3::new(p.x, RELIEF * p.y, p.z);
    // Normals are transformed by the inverse.
    let normal = |n: Vec3| Vec3::new(n.x, n.y / RELIEF, n.z).normalize_or(Vec3::Y);
    Triangle {
        n0: normal(t.n0),
        n1: normal(t.n1),
        n2: normal(t.n2),
        ..Triangle::flat(lower(t.p0), lower(t.p1), lower(t.p2))
    }
}

/// The boxes of all nodes `depth` levels below the root, and of leaves above that level.
fn boxes_at_depth(tree: &Bvh, depth: u32) -> Vec<Aabb> {
    let mut boxes = Vec::new();
    let mut open = vec![(0, 0)];
    while let Some((node, level)) = open.pop() {
        let Some(node) = tree.nodes.get(node as usize) else {
            continue;
        };
        match node.kind {
            NodeKind::Interior { left, right } if level < depth => {
                open.extend([(left, level + 1), (right, level + 1)]);
            }
            _ => boxes.push(node.bounds),
        }
    }
    boxes
}

/// The twelve edges of a box, as bars.
fn edges(b: &Aabb, thickness: f64) -> Vec<Triangle> {
    let half = 0.5 * thickness;
    let mut bars = Vec::new();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for corner in 0..4 {
            let mut min = b.min;
            min[u] = if corner & 1 == 0 { b.min[u] } else { b.max[u] };
            min[v] = if corner & 2 == 0 { b.min[v] } else { b.max[v] };
            let mut max = min;
            max[axis] = b.max[axis];
            let margin = Vec3::splat(half);
            bars.extend(block(min - margin, max + margin));
        }
    }
    bars
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collada::read_again;

    /// The file that is written is read without a warning, with every triangle of every mesh.
    #[test]
    fn the_scene_can_be_read_again() {
        let document = document(2000);
        let loaded = read_again(|file| document.write(file));
        let count: usize = document.meshes.iter().map(|m| m.triangles.len()).sum();
        assert_eq!(loaded.scene.triangles.len(), count);
        assert_eq!(loaded.scene.lights.len(), 0);
        let boxes = &document.meshes[2..];
        assert!(boxes.iter().all(|level| !level.triangles.is_empty()));
    }

    /// At every depth the boxes together contain all triangles.
    #[test]
    fn boxes_of_a_level_cover_the_mesh() {
        let mesh = generate(MeshKind::Knot, 1000);
        let bounds: Vec<Aabb> = mesh.iter().map(Triangle::bounds).collect();
        let tree = bvh::construct_bvh(&bounds, MAX_LEAF_SIZE);
        for depth in [0, 3, 6] {
            let boxes = boxes_at_depth(&tree, depth);
            assert!(boxes.len() <= 1 << depth);
            for t in &bounds {
                let is_inside = |b: &Aabb| b.min.cmple(t.min).all() && b.max.cmpge(t.max).all();
                assert!(boxes.iter().any(is_inside));
            }
        }
    }
}
