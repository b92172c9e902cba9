//! The families of test rays.

use serde::{Deserialize, Serialize};

/// The families of test rays, by what makes them hard.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RayFamily {
    /// Hits and misses in equal parts. Times are measured on ordinary rays.
    Ordinary,
    /// Aimed at an edge; of a sphere, at the rim.
    Edge,
    /// Aimed at a vertex; of a box, at a corner.
    Vertex,
    /// A triangle whose vertices are almost collinear; a flat box.
    Sliver,
    /// A triangle with one very short edge; a box that is flat on two axes.
    Needle,
    /// Almost parallel to the triangle or a face of the box; almost tangent to the sphere.
    Grazing,
    /// Everything is far from the world's origin; a sphere is far from the ray's origin.
    #[serde(rename = "far offset")]
    FarOffset,
    /// Everything is very small.
    #[serde(rename = "tiny scale")]
    TinyScale,
    /// Everything is very large.
    #[serde(rename = "huge scale")]
    HugeScale,
    /// The ray starts inside the shape.
    Inside,
    /// The ray starts on the shape, as a shadow ray does.
    #[serde(rename = "on the surface")]
    OnTheSurface,
}

impl RayFamily {
    /// All families, in the order of the columns.
    pub const ALL: [RayFamily; 11] = [
        RayFamily::Ordinary,
        RayFamily::Edge,
        RayFamily::Vertex,
        RayFamily::Sliver,
        RayFamily::Needle,
        RayFamily::Grazing,
        RayFamily::FarOffset,
        RayFamily::TinyScale,
        RayFamily::HugeScale,
        RayFamily::Inside,
        RayFamily::OnTheSurface,
    ];

    /// The name, as in the JSON.
    pub fn name(self) -> &'static str {
        match self {
            RayFamily::Ordinary => "ordinary",
            RayFamily::Edge => "edge",
            RayFamily::Vertex => "vertex",
            RayFamily::Sliver => "sliver",
            RayFamily::Needle => "needle",
            RayFamily::Grazing => "grazing",
            RayFamily::FarOffset => "far offset",
            RayFamily::TinyScale => "tiny scale",
            RayFamily::HugeScale => "huge scale",
            RayFamily::Inside => "inside",
            RayFamily::OnTheSurface => "on the surface",
        }
    }
}
