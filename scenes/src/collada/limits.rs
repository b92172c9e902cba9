//! Limits for the contents of a file. A node can contain two instances of another node, that node
//! two of a third, and so on: without limits a file of forty lines could exceed any memory.

use kit::Vec3;

/// Largest file size, in bytes.
pub(crate) const MAX_FILE_BYTES: u64 = 1 << 30;

/// Attributes of a tag. Files have up to about five.
pub(super) const MAX_ATTRIBUTES: usize = 1000;

/// Namespace declarations of a file. Files have one or two.
pub(super) const MAX_NAMESPACES: usize = 100;

/// Levels of nested nodes.
pub(crate) const MAX_DEPTH: usize = 256;

/// Instances of nodes, meshes, spheres, lights and cameras together.
pub(crate) const MAX_INSTANCES: usize = 1 << 20;

/// Triangles and spheres in world space, over all instances: about 2.4 GB.
pub(crate) const MAX_PRIMITIVES: usize = 1 << 24;

/// Largest coordinate in world space. Sums of a few squared lengths must stay finite.
pub(crate) const MAX_COORDINATE: f64 = 1e150;

/// Whether no coordinate is NaN or too large.
pub(crate) fn in_world(p: Vec3) -> bool {
    p.abs().cmple(Vec3::splat(MAX_COORDINATE)).all()
}
