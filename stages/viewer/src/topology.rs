//! The vertices and edges of a scene's triangles: what can be selected, and what belongs together.

use kit::{Scene, Triangle, Vec3};
use std::collections::HashMap;

/// A corner of a triangle: the triangle and which of its vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    /// Index of the triangle.
    pub triangle: u32,
    /// 0, 1 or 2.
    pub vertex: u8,
}

/// What can be selected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Element {
    /// A vertex: all corners at one position.
    Vertex(u32),
    /// An edge: its two vertices, the smaller index first.
    Edge(u32, u32),
    /// A triangle.
    Face(u32),
    /// A sphere, by its index in [`Scene::spheres`].
    Sphere(u32),
}

/// The vertices of a scene. Corners with equal coordinates are one vertex.
#[derive(Clone, Debug, Default)]
pub struct Topology {
    /// For each triangle its three vertices.
    vertices_of: Vec<[u32; 3]>,
    /// The position of each vertex.
    positions: Vec<Vec3>,
    /// Where the corners of each vertex start in `corners`, and the end.
    starts: Vec<u32>,
    corners: Vec<Corner>,
}

/// Facts about an element, as the panel shows them.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementInfo {
    /// "vertex", "edge", "face" or "sphere", and its index.
    pub kind: String,
    /// Number of edges at a vertex, of faces at an edge, or of edges of a face.
    pub degree: usize,
    /// The position; of an edge and a face the centre.
    pub position: Vec3,
    /// Whether it is on the boundary of its mesh: an edge that only one face has.
    pub is_boundary: bool,
    /// The name of the node of the scene.
    pub node: String,
    /// The name of the material.
    pub material: String,
}

/// The corner positions of a triangle.
pub fn corners(triangle: &Triangle) -> [Vec3; 3] {
    [triangle.p0, triangle.p1, triangle.p2]
}

impl Topology {
    /// Finds the vertices of `scene`.
    pub fn new(scene: &Scene) -> Topology {
        let mut index: HashMap<[u64; 3], u32> = HashMap::with_capacity(scene.triangles.len());
        let mut topology = Topology::default();
        for triangle in &scene.triangles {
            let of_triangle = corners(triangle).map(|p| {
                // -0 and 0 are the same position.
                let key = (p + Vec3::ZERO).to_array().map(f64::to_bits);
                *index.entry(key).or_insert_with(|| {
                    topology.positions.push(p);
                    topology.positions.len() as u32 - 1
                })
            });
            topology.vertices_of.push(of_triangle);
        }
        // Counting sort of the corners by vertex.
        let mut starts = vec![0_u32; topology.positions.len() + 1];
        for vertex in topology.vertices_of.iter().flatten() {
            starts[*vertex as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let none = Corner {
            triangle: 0,
            vertex: 0,
        };
        let mut next = starts.clone();
        topology.corners = vec![none; 3 * topology.vertices_of.len()];
        for (triangle, vertices) in (0..).zip(&topology.vertices_of) {
            for (vertex, v) in (0..).zip(vertices) {
                let slot = &mut next[*v as usize];
                topology.corners[*slot as usize] = Corner { triangle, vertex };
                *slot += 1;
            }
        }
        topology.starts = starts;
        topology
    }

    /// The number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// The number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.vertices_of.len()
    }

    /// The position of vertex `v`.
    pub fn position(&self, v: u32) -> Vec3 {
        self.positions[v as usize]
    }

    /// The vertices of triangle `t`.
    pub fn vertices_of(&self, t: u32) -> [u32; 3] {
        self.vertices_of[t as usize]
    }

    /// The corners at vertex `v`.
    pub fn corners_at(&self, v: u32) -> &[Corner] {
        let range = self.starts[v as usize] as usize..self.starts[v as usize + 1] as usize;
        &self.corners[range]
    }

    /// How many triangles have the edge from `a` to `b`.
    pub fn faces_at_edge(&self, a: u32, b: u32) -> usize {
        let has_b = |corner: &&Corner| self.vertices_of(corner.triangle).contains(&b);
        self.corners_at(a).iter().filter(has_b).count()
    }

    /// The vertices at the other ends of the edges at `v`, sorted.
    pub fn neighbours(&self, v: u32) -> Vec<u32> {
        let triangles = self.corners_at(v).iter().map(|corner| corner.triangle);
        let mut others: Vec<u32> = triangles
            .flat_map(|t| self.vertices_of(t))
            .filter(|&other| other != v)
            .collect();
        others.sort_unstable();
        others.dedup();
        others
    }

    /// The element of triangle `t` at the barycentric weights `weights` of its vertices: a vertex
    /// if its weight is above 0.9, an edge if the weight of the opposite vertex is below 0.1, else
    /// the face.
    pub fn element_at(&self, t: u32, weights: [f64; 3]) -> Element {
        let vertices = self.vertices_of(t);
        if let Some(i) = (0..3).find(|&i| weights[i] > VERTEX_WEIGHT) {
            return Element::Vertex(vertices[i]);
        }
        let nearest = (0..3).min_by(|&i, &j| weights[i].total_cmp(&weights[j]));
        match nearest.filter(|&i| weights[i] < EDGE_WEIGHT) {
            Some(i) => {
                let (a, b) = (vertices[(i + 1) % 3], vertices[(i + 2) % 3]);
                Element::Edge(a.min(b), a.max(b))
            }
            None => Element::Face(t),
        }
    }

    /// What is known about `element` of `scene`, which this is the topology of.
    pub fn info(&self, scene: &Scene, element: Element) -> ElementInfo {
        let of_triangle = |t: u32| names(scene, t as usize);
        match element {
            Element::Vertex(v) => {
                let neighbours = self.neighbours(v);
                let is_boundary = neighbours.iter().any(|&n| self.faces_at_edge(v, n) == 1);
                let (node, material) = of_triangle(self.corners_at(v)[0].triangle);
                ElementInfo {
                    kind: format!("vertex {v}"),
                    degree: neighbours.len(),
                    position: self.position(v),
                    is_boundary,
                    node,
                    material,
                }
            }
            Element::Edge(a, b) => {
                let faces = self.faces_at_edge(a, b);
                let (node, material) = of_triangle(self.corners_at(a)[0].triangle);
                ElementInfo {
                    kind: format!("edge {a} {b}"),
                    degree: faces,
                    position: 0.5 * (self.position(a) + self.position(b)),
                    is_boundary: faces == 1,
                    node,
                    material,
                }
            }
            Element::Face(t) => {
                let [a, b, c] = self.vertices_of(t);
                let edges = [(a, b), (b, c), (c, a)];
                let (node, material) = of_triangle(t);
                let sum = self.position(a) + self.position(b) + self.position(c);
                ElementInfo {
                    kind: format!("face {t}"),
                    degree: 3,
                    position: sum / 3.0,
                    is_boundary: edges.iter().any(|&(a, b)| self.faces_at_edge(a, b) == 1),
                    node,
                    material,
                }
            }
            Element::Sphere(s) => {
                let (node, material) = names(scene, scene.triangles.len() + s as usize);
                ElementInfo {
                    kind: format!("sphere {s}"),
                    degree: 0,
                    position: scene.spheres[s as usize].center,
                    is_boundary: false,
                    node,
                    material,
                }
            }
        }
    }
}

/// The smallest weight at which a vertex is picked: the assignment's program's.
const VERTEX_WEIGHT: f64 = 0.9;
/// The weight of the opposite vertex below which an edge is picked: the assignment's program's.
const EDGE_WEIGHT: f64 = 0.1;

/// The names of the node and the material of a primitive.
fn names(scene: &Scene, prim: usize) -> (String, String) {
    let object = scene
        .object_of
        .get(prim)
        .map(|&o| &scene.objects[o as usize]);
    let node = object.map_or_else(String::new, |object| object.name.clone());
    let material = object.and_then(|object| scene.materials.get(object.material as usize));
    (node, material.map_or_else(String::new, |m| m.name.clone()))
}

/// The triangles of `scene` with vertex `v` at `position`. Flat triangles stay flat. Where vertex
/// normals were interpolated, those of the changed triangles become area-weighted means.
pub fn move_vertex(scene: &mut Scene, topology: &Topology, v: u32, position: Vec3) {
    let moved: Vec<u32> = topology.corners_at(v).iter().map(|c| c.triangle).collect();
    let is_flat = |t: &Triangle| t.n0 == t.n1 && t.n1 == t.n2;
    let flat: Vec<bool> = moved
        .iter()
        .map(|&t| is_flat(&scene.triangles[t as usize]))
        .collect();
    for corner in topology.corners_at(v) {
        *position_of(
            &mut scene.triangles[corner.triangle as usize],
            corner.vertex,
        ) = position;
    }
    for (&t, flat) in moved.iter().zip(flat) {
        let triangle = &mut scene.triangles[t as usize];
        if flat {
            *triangle = Triangle::flat(triangle.p0, triangle.p1, triangle.p2);
            continue;
        }
        for (i, u) in (0..3).zip(topology.vertices_of(t)) {
            let n = smooth_normal(scene, topology, u, t, i);
            *normal_of(&mut scene.triangles[t as usize], i) = n;
        }
    }
}

/// The area-weighted mean of the face normals at vertex `u` of the triangles that share the vertex
/// normal of corner `i` of triangle `t`.
fn smooth_normal(scene: &Scene, topology: &Topology, u: u32, t: u32, i: u8) -> Vec3 {
    let normal = |t: u32, i: u8| *normal_of(&mut scene.triangles[t as usize].clone(), i);
    let shared = normal(t, i);
    let mut sum = Vec3::ZERO;
    for corner in topology.corners_at(u) {
        // The triangles of area lights are not part of the scene file.
        let Some(triangle) = scene.triangles.get(corner.triangle as usize) else {
            continue;
        };
        // Normals that were equal before one of them was updated still point about the same way.
        if normal(corner.triangle, corner.vertex).dot(shared) > SAME_SURFACE {
            sum += (triangle.p1 - triangle.p0).cross(triangle.p2 - triangle.p0);
        }
    }
    sum.try_normalize().unwrap_or(shared)
}

/// Cosine of the angle between two vertex normals below which there is a crease between them.
const SAME_SURFACE: f64 = 0.7;

fn position_of(triangle: &mut Triangle, vertex: u8) -> &mut Vec3 {
    match vertex {
        0 => &mut triangle.p0,
        1 => &mut triangle.p1,
        _ => &mut triangle.p2,
    }
}

fn normal_of(triangle: &mut Triangle, vertex: u8) -> &mut Vec3 {
    match vertex {
        0 => &mut triangle.n0,
        1 => &mut triangle.n1,
        _ => &mut triangle.n2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of two triangles in the plane z = 0.
    fn square() -> Scene {
        let [a, b, c, d] =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
        Scene {
            triangles: vec![Triangle::flat(a, b, c), Triangle::flat(a, c, d)],
            ..Scene::default()
        }
    }

    #[test]
    fn corners_at_one_place_are_one_vertex() {
        let topology = Topology::new(&square());
        assert_eq!(topology.vertex_count(), 4);
        assert_eq!(topology.corners_at(0).len(), 2);
        assert_eq!(topology.neighbours(0), [1, 2, 3]);
        assert_eq!(topology.faces_at_edge(0, 2), 2);
        assert_eq!(topology.faces_at_edge(0, 1), 1);
    }

    #[test]
    fn weights_pick_vertices_edges_and_faces() {
        let topology = Topology::new(&square());
        assert_eq!(
            topology.element_at(1, [0.02, 0.95, 0.03]),
            Element::Vertex(2)
        );
        assert_eq!(
            topology.element_at(0, [0.5, 0.05, 0.45]),
            Element::Edge(0, 2)
        );
        assert_eq!(topology.element_at(0, [0.3, 0.3, 0.4]), Element::Face(0));
    }

    #[test]
    fn infos_name_degree_and_boundary() {
        let scene = square();
        let topology = Topology::new(&scene);
        let vertex = topology.info(&scene, Element::Vertex(0));
        assert_eq!((vertex.degree, vertex.is_boundary), (3, true));
        let diagonal = topology.info(&scene, Element::Edge(0, 2));
        assert_eq!((diagonal.degree, diagonal.is_boundary), (2, false));
        assert_eq!(diagonal.position, Vec3::new(0.5, 0.5, 0.0));
    }

    #[test]
    fn moving_a_vertex_moves_all_its_corners() {
        let mut scene = square();
        let topology = Topology::new(&scene);
        let up = Vec3::new(1.0, 1.0, 1.0);
        move_vertex(&mut scene, &topology, 2, up);
        assert_eq!((scene.triangles[0].p2, scene.triangles[1].p1), (up, up));
        assert_eq!(scene.triangles[1].p2, Vec3::new(0.0, 1.0, 0.0));
        let [a, b] = [scene.triangles[0], scene.triangles[1]];
        assert_eq!(a, Triangle::flat(a.p0, a.p1, a.p2));
        assert_eq!(b, Triangle::flat(b.p0, b.p1, b.p2));
        assert_ne!(a.n0, b.n0);
    }
}
