//! Large meshes that are computed, not stored: the same on every platform, to the last bit.
//!
//! Sines come from [`kit::math`], randomness from an integer hash. Read [`IndexedMesh`] first, then `noise` and
//! `octasphere` (what the meshes are made with), then one file a mesh, then [`cornell_with`].

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
    /// A closed smooth blob with lobes and folds: triangles of about one size.
    Smooth,
    /// A rough mountain landscape, open below: detail down to the single triangle.
    Terrain,
    /// A rope of closed strands tied into a trefoil: long thin triangles in all directions, whose boxes
    /// overlap.
    Knot,
    /// A sea urchin: a closed mesh that is all needles.
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

    /// Its name in lower case.
    pub fn name(self) -> &'static str {
        match self {
            MeshKind::Smooth => "smooth",
            MeshKind::Terrain => "terrain",
            MeshKind::Knot => "knot",
            MeshKind::Needles => "needles",
        }
    }

    /// Whether the mesh is closed: every edge has exactly two triangles, and they wind outwards.
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

/// The mesh with `triangles` triangles, inside the cube from -1 to 1, with smooth vertex normals (needles: flat
/// ones).
///
/// From 100 triangles up their number is exact if it is even, one fewer if it is odd: the faces of a closed
/// mesh of triangles are always even in number. Each kind takes the largest regular pattern that is not too
/// large and cuts a few triangles in three. A triangle takes 144 bytes, so 10 million take 1.4 GB.
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
