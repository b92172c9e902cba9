//! A rope in the shape of a trefoil knot: strands of long, thin triangles with overlapping bounding
//! boxes.

use super::indexed_mesh::IndexedMesh;
use kit::{Vec3, math};
use std::f64::consts::TAU;

/// Radius of the rope, in units of the torus of the knot: its tube has radius 1 around a circle of
/// radius 2.
const ROPE: f64 = 0.42;
/// Scale from these units to the cube [-1, 1]³.
const SCALE: f64 = 0.275;
/// Full turns of the strands around the rope: an integer, so that each strand is closed.
const TWISTS: f64 = 2.0;
/// Angle between successive strands. The golden angle distributes them evenly over the
/// cross-section (H. Vogel, "A better way to construct the sunflower head", 1979).
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
/// Number of sides of a strand.
const SIDES: usize = 3;

/// The largest knot of at most `triangles` triangles: 6 for each segment of each strand. The number
/// of segments grows slowly and that of strands quickly, so triangles become thinner.
pub(super) fn mesh(triangles: usize) -> IndexedMesh {
    let target = triangles.max(1) as f64;
    let segments = (60.0 * math::pow(target / 1e5, 0.2)).round().max(12.0) as usize;
    let strands = (target / (2 * SIDES * segments) as f64).floor().max(1.0) as usize;
    let mut mesh = IndexedMesh::default();
    mesh.positions.reserve(strands * segments * SIDES);
    mesh.faces.reserve(2 * strands * segments * SIDES);
    let section: Vec<Section> = (0..segments)
        .map(|i| Section::at(TAU * i as f64 / segments as f64))
        .collect();
    for strand in 0..strands {
        add_strand(&mut mesh, &section, strand, strands);
    }
    mesh
}

/// A cross-section of the rope.
struct Section {
    center: Vec3,
    /// Two directions perpendicular to the rope, rotated by the twist.
    across: [Vec3; 2],
}

impl Section {
    /// The section at parameter `t` of the trefoil, which winds twice around the torus and three
    /// times around its tube.
    fn at(t: f64) -> Section {
        let (sin2, cos2) = (math::sin(2.0 * t), math::cos(2.0 * t));
        let (sin3, cos3) = (math::sin(3.0 * t), math::cos(3.0 * t));
        let center = Vec3::new((2.0 + cos3) * cos2, (2.0 + cos3) * sin2, sin3);
        let along = Vec3::new(
            -3.0 * sin3 * cos2 - 2.0 * (2.0 + cos3) * sin2,
            -3.0 * sin3 * sin2 + 2.0 * (2.0 + cos3) * cos2,
            3.0 * cos3,
        );
        // The normal of the torus is perpendicular to every curve on it.
        let out = Vec3::new(cos3 * cos2, cos3 * sin2, sin3);
        let side = along.normalize().cross(out);
        let (sin, cos) = (math::sin(TWISTS * t), math::cos(TWISTS * t));
        Section {
            center,
            across: [cos * out + sin * side, cos * side - sin * out],
        }
    }
}

fn add_strand(mesh: &mut IndexedMesh, sections: &[Section], strand: usize, strands: usize) {
    let share = (strand as f64 + 0.5) / strands as f64;
    let from_axis = if strands == 1 {
        0.0
    } else {
        ROPE * share.sqrt()
    };
    let angle = GOLDEN_ANGLE * strand as f64;
    // With this radius the strands fill the cross-section and touch.
    let radius = 0.8 * ROPE / (strands as f64).sqrt();
    let first = mesh.positions.len();
    for Section {
        center,
        across: [u, v],
    } in sections
    {
        let middle = *center + from_axis * (math::cos(angle) * *u + math::sin(angle) * *v);
        for side in 0..SIDES {
            let around = TAU * side as f64 / SIDES as f64;
            let offset = radius * (math::cos(around) * *u + math::sin(around) * *v);
            mesh.positions.push(SCALE * (middle + offset));
        }
    }
    let vertex = |segment: usize, side: usize| {
        (first + segment % sections.len() * SIDES + side % SIDES) as u32
    };
    for segment in 0..sections.len() {
        for side in 0..SIDES {
            let (a, b) = (vertex(segment, side), vertex(segment, side + 1));
            let (c, d) = (vertex(segment + 1, side + 1), vertex(segment + 1, side));
            mesh.faces.extend([[a, b, c], [a, c, d]]);
        }
    }
}
