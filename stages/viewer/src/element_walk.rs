//! From one vertex, edge or face to the next, for the keyboard.

use crate::topology::{Element, Topology};

/// A kind of element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// A vertex.
    Vertex,
    /// An edge.
    Edge,
    /// A triangle or a sphere.
    Face,
}

impl ElementKind {
    /// The kind of an element.
    pub fn of(element: Element) -> ElementKind {
        match element {
            Element::Vertex(_) => ElementKind::Vertex,
            Element::Edge(..) => ElementKind::Edge,
            Element::Face(_) | Element::Sphere(_) => ElementKind::Face,
        }
    }
}

/// The element of `kind` after `from`, or before it; the first or the last one if `from` is of another
/// kind. Faces are the triangles, then the `spheres`. After the last one comes the first. `None` if
/// there is none of the kind.
pub fn next(
    topology: &Topology,
    spheres: u32,
    kind: ElementKind,
    from: Option<Element>,
    forward: bool,
) -> Option<Element> {
    let triangles = topology.triangle_count() as u32;
    // Edges are numbered by their places: three of each triangle.
    let (count, at) = match (kind, from) {
        (ElementKind::Vertex, from) => (
            topology.vertex_count() as u32,
            match from {
                Some(Element::Vertex(v)) => Some(v),
                _ => None,
            },
        ),
        (ElementKind::Face, from) => (
            triangles + spheres,
            match from {
                Some(Element::Face(t)) => Some(t),
                Some(Element::Sphere(s)) => Some(triangles + s),
                _ => None,
            },
        ),
        (ElementKind::Edge, from) => (
            3 * triangles,
            match from {
                Some(Element::Edge(a, b)) => place_of_edge(topology, a, b),
                _ => None,
            },
        ),
    };
    if count == 0 {
        return None;
    }
    let step = |at: Option<u32>| match (at, forward) {
        (None, true) => 0,
        (None, false) => count - 1,
        (Some(at), true) => (at + 1) % count,
        (Some(at), false) => (at + count - 1) % count,
    };
    let mut at = step(at);
    Some(match kind {
        ElementKind::Vertex => Element::Vertex(at),
        ElementKind::Face if at >= triangles => Element::Sphere(at - triangles),
        ElementKind::Face => Element::Face(at),
        ElementKind::Edge => loop {
            let (a, b) = edge_at(topology, at);
            // An edge of two triangles has two places; only the first one counts.
            if place_of_edge(topology, a, b) == Some(at) {
                break Element::Edge(a, b);
            }
            at = step(Some(at));
        },
    })
}

/// The edge at a place: its vertices, the smaller one first.
fn edge_at(topology: &Topology, place: u32) -> (u32, u32) {
    let vertices = topology.vertices_of(place / 3);
    let [a, b] = [place, place + 1].map(|i| vertices[i as usize % 3]);
    (a.min(b), a.max(b))
}

/// The first place of an edge.
fn place_of_edge(topology: &Topology, a: u32, b: u32) -> Option<u32> {
    let triangles = topology.corners_at(a).iter().map(|corner| corner.triangle);
    let places = triangles.flat_map(|t| 3 * t..3 * t + 3);
    places
        .filter(|&place| edge_at(topology, place) == (a, b))
        .min()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{Scene, Sphere, Triangle, Vec3};

    /// A square of two triangles, and a sphere.
    fn scene() -> Scene {
        let [a, b, c, d] =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
        Scene {
            triangles: vec![Triangle::flat(a, b, c), Triangle::flat(a, c, d)],
            spheres: vec![Sphere {
                center: Vec3::ZERO,
                radius: 1.0,
            }],
            ..Scene::default()
        }
    }

    #[test]
    fn every_element_comes_once_in_both_directions() {
        let topology = Topology::new(&scene());
        for (kind, count) in [
            (ElementKind::Vertex, 4),
            (ElementKind::Edge, 5),
            (ElementKind::Face, 3),
        ] {
            let mut found = Vec::new();
            let mut at = None;
            for _ in 0..count {
                at = next(&topology, 1, kind, at, true);
                let element = at.expect("there are some");
                assert_eq!(ElementKind::of(element), kind);
                assert!(!found.contains(&element), "{element:?} comes twice");
                found.push(element);
            }
            let again = next(&topology, 1, kind, at, true);
            assert_eq!(again, found.first().copied(), "after the last the first");
            for element in found.iter().rev() {
                assert_eq!(at, Some(*element));
                at = next(&topology, 1, kind, at, false);
            }
        }
    }

    #[test]
    fn nothing_comes_after_nothing() {
        let topology = Topology::new(&Scene::default());
        for kind in [ElementKind::Vertex, ElementKind::Edge, ElementKind::Face] {
            assert_eq!(next(&topology, 0, kind, None, true), None);
        }
    }
}
