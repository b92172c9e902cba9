//! A large mesh, and the boxes of the tree over it.

use crate::collada::{AreaLight, Document, Mesh};
use kit::{Aabb, Bvh, NodeKind, Triangle, Vec3};
use meshes::{MeshKind, generate};

/// The number of triangles of the mesh.
pub const TRIANGLES: usize = 200_000;

/// Primitives of a leaf.
const MAX_LEAF_SIZE: usize = 4;

/// A level of the tree that is shown: its depth below the root, the colour of its boxes and the
/// thickness of their edges.
const LEVELS: [(u32, [f64; 3], f64); 3] = [
    (3, [0.95, 0.62, 0.08], 0.012),
    (6, [0.05, 0.55, 0.50], 0.006),
    (9, [0.80, 0.16, 0.42], 0.003),
];

/// The scene of a mesh with `triangles` triangles on a floor. On its left half are the boxes of
/// three levels of its tree; the further left, the deeper the level.
pub fn document(triangles: usize) -> Document {
    let mesh = generate(MeshKind::Knot, triangles);
    let bounds: Vec<Aabb> = mesh.iter().map(Triangle::bounds).collect();
    let tree = bvh::construct_bvh(&bounds, MAX_LEAF_SIZE);
    let floor = tree.nodes.first().map_or(0.0, |root| root.bounds.min.y) - 0.01;
    let mut meshes = vec![
        Mesh {
            name: "mesh".to_owned(),
            color: [0.80, 0.56, 0.40],
            triangles: mesh,
        },
        Mesh {
            name: "floor".to_owned(),
            color: [0.50, 0.51, 0.54],
            triangles: square(60.0, floor),
        },
    ];
    for (i, (depth, color, thickness)) in LEVELS.into_iter().enumerate() {
        let [from, to] = zone(i);
        let boxes = boxes_at_depth(&tree, depth).into_iter().filter(|b| {
            let center = 0.5 * (b.min.x + b.max.x);
            (from..to).contains(&center)
        });
        meshes.push(Mesh {
            name: format!("level-{depth}"),
            color,
            triangles: boxes.flat_map(|b| edges(&b, thickness)).collect(),
        });
    }
    let light = |name: &str, radiance, placement: &str| AreaLight {
        name: name.to_owned(),
        radiance,
        placement: placement.to_owned(),
    };
    Document {
        yfov: 22.5,
        aspect: 2.0,
        camera: [Vec3::new(0.35, 1.75, 4.9), Vec3::new(0.0, -0.04, 0.0)],
        ambient: [0.32, 0.36, 0.42],
        lights: vec![light(
            "key",
            [14.0, 12.6, 11.0],
            "<translate>3 4.5 3</translate><rotate>0 1 0 45</rotate><rotate>1 0 0 -46</rotate>\
             <scale>2.5 2.5 1</scale>",
        )],
        meshes,
    }
}

/// The range of x in which level `i` of [`LEVELS`] is shown, of a mesh in [-1, 1]³.
fn zone(i: usize) -> [f64; 2] {
    [[-0.15, 2.0], [-0.62, -0.15], [-2.0, -0.62]][i].map(|x: f64| x.min(0.42))
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

/// The surface of a box, with normals outwards.
fn block(min: Vec3, max: Vec3) -> Vec<Triangle> {
    let corner = |i: usize| {
        let pick = |bit: usize, lo: f64, hi: f64| if i >> bit & 1 == 0 { lo } else { hi };
        Vec3::new(
            pick(0, min.x, max.x),
            pick(1, min.y, max.y),
            pick(2, min.z, max.z),
        )
    };
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = faces.into_iter().flat_map(|face| {
        let [a, b, c, d] = face.map(corner);
        [Triangle::flat(a, b, c), Triangle::flat(a, c, d)]
    });
    triangles.collect()
}

/// A horizontal square at height `y`, facing up.
fn square(half: f64, y: f64) -> Vec<Triangle> {
    let corner = |x: f64, z: f64| Vec3::new(x * half, y, z * half);
    let (a, b) = (corner(-1.0, 1.0), corner(1.0, 1.0));
    let (c, d) = (corner(1.0, -1.0), corner(-1.0, -1.0));
    vec![Triangle::flat(a, b, c), Triangle::flat(a, c, d)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The file that is written is read without a warning, with every triangle of every mesh.
    #[test]
    fn the_scene_can_be_read_again() {
        let document = document(2000);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("tree.dae");
        let mut file = std::fs::File::create(&path).expect("a file");
        document.write(&mut file).expect("it is written");
        let loaded = scenes::load(&path).expect("a scene");
        assert_eq!(loaded.warnings.len(), 0);
        let count: usize = document.meshes.iter().map(|m| m.triangles.len()).sum();
        assert_eq!(loaded.scene.triangles.len(), count);
        assert_eq!(loaded.scene.lights.len(), 2);
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
