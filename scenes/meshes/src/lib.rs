//! Generators of large meshes. The meshes are the same on every platform, to the last bit.
//!
//! Sines are computed by [`kit::math`], random numbers by an integer hash. Read [`IndexedMesh`]
//! first, then `noise` and `octasphere` (used by several generators), then one file per mesh, then
//! [`cornell_with`].

mod cornell;
mod indexed_mesh;
mod knot;
mod needles;
mod noise;
mod octasphere;
mod smooth;
mod terrain;

pub use cornell::cornell_with;
pub use indexed_mesh::IndexedMesh;

use kit::Triangle;
use std::fmt;
use std::str::FromStr;

/// The meshes that can be generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MeshKind {
    /// A closed, smooth, rounded shape with lobes and folds; all triangles have about the same
    /// size.
    Smooth,
    /// A rough mountain landscape, open at the bottom; its detail goes down to single triangles.
    Terrain,
    /// A rope of closed strands tied into a trefoil knot: long thin triangles in all directions,
    /// whose bounding boxes overlap.
    Knot,
    /// A closed mesh of needles, like a sea urchin.
    Needles,
}

impl MeshKind {
    /// All kinds.
    pub const ALL: [MeshKind; 4] = [
        MeshKind::Smooth,
        MeshKind::Terrain,
        MeshKind::Knot,
        MeshKind::Needles,
    ];

    /// The name in lower case.
    pub fn name(self) -> &'static str {
        match self {
            MeshKind::Smooth => "smooth",
            MeshKind::Terrain => "terrain",
            MeshKind::Knot => "knot",
            MeshKind::Needles => "needles",
        }
    }

    /// Whether the mesh is closed: every edge has exactly two triangles, and all triangles are
    /// counter-clockwise seen from outside.
    pub fn is_closed(self) -> bool {
        self != MeshKind::Terrain
    }
}

impl fmt::Display for MeshKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for MeshKind {
    type Err = String;

    fn from_str(name: &str) -> Result<MeshKind, String> {
        let kind = MeshKind::ALL.into_iter().find(|kind| kind.name() == name);
        kind.ok_or_else(|| {
            let names = MeshKind::ALL.map(MeshKind::name).join(", ");
            format!("there is no mesh `{name}`: choose one of {names}")
        })
    }
}

/// Generates the mesh with `triangles` triangles, inside the cube from -1 to 1. Vertex normals are
/// smooth, those of needles flat.
///
/// From 100 triangles on the number is exact if it is even, and one less if it is odd: a closed
/// triangle mesh always has an even number of faces. Each generator makes the largest regular mesh
/// that has at most `triangles` faces, then divides some faces into three. A triangle takes 144
/// bytes, so 10 million take 1.4 GB.
pub fn generate(kind: MeshKind, triangles: usize) -> Vec<Triangle> {
    let pattern = match kind {
        MeshKind::Smooth => smooth::mesh(triangles),
        MeshKind::Terrain => terrain::mesh(triangles),
        MeshKind::Knot => knot::mesh(triangles),
        MeshKind::Needles => needles::mesh(triangles),
    };
    let mesh = pattern.cut_to(triangles);
    match kind {
        MeshKind::Needles => mesh.flat_triangles(),
        _ => mesh.smooth_triangles(),
    }
}
