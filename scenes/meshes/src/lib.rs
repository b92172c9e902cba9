//! Generators of large meshes. The results are identical on every platform, to the last bit.
//!
//! Sines come from [`kit::math`], random numbers from an integer hash. Read [`IndexedMesh`] first,
//! then `noise` and `octasphere` (helpers of the generators), then the files of the meshes, then
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
    /// A closed smooth blob with lobes and folds. Its triangles have similar sizes.
    Smooth,
    /// A rough mountain landscape, open below, with detail at the size of single triangles.
    Terrain,
    /// A rope of closed strands in the shape of a trefoil knot: long, thin triangles in all
    /// directions, whose bounding boxes overlap.
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

    /// Whether the mesh is closed: every edge has exactly two triangles, with consistent winding,
    /// and normals point outwards.
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

/// Generates a mesh of `triangles` triangles inside the cube [-1, 1]³, with smooth vertex normals
/// (`Needles`: geometric normals).
///
/// From 100 triangles on, the number of triangles is exact if it is even, and one fewer if it is
/// odd, because a closed triangle mesh always has an even number of faces. Each kind generates its
/// largest regular mesh that is not too large, and splits some triangles into three. A triangle
/// takes 144 bytes, so 10 million take 1.4 GB.
pub fn generate(kind: MeshKind, triangles: usize) -> Vec<Triangle> {
    let regular = match kind {
        MeshKind::Smooth => smooth::mesh(triangles),
        MeshKind::Terrain => terrain::mesh(triangles),
        MeshKind::Knot => knot::mesh(triangles),
        MeshKind::Needles => needles::mesh(triangles),
    };
    let mesh = regular.split_to(triangles);
    match kind {
        MeshKind::Needles => mesh.flat_triangles(),
        _ => mesh.smooth_triangles(),
    }
}
