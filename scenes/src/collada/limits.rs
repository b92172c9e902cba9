//! Bounds on what one file may ask for. A short file can name the same node twice, that node another twice,
//! and so on: without bounds forty lines make a scene that no memory holds.

use kit::Vec3;

/// Largest file that is read, in bytes.
pub(super) const MAX_FILE_BYTES: u64 = 1 << 30;

/// Attributes of one tag: files have up to about five.
pub(super) const MAX_ATTRIBUTES: usize = 1000;

/// Namespaces that a file declares: files have one or two.
pub(super) const MAX_NAMESPACES: usize = 100;

/// Nodes inside nodes.
pub(super) const MAX_DEPTH: usize = 256;

/// Placed nodes, meshes, spheres, lights and cameras together.
pub(super) const MAX_INSTANCES: usize = 1 << 20;

/// Triangles and spheres after all instances are placed: about 2.4 GB.
pub(super) const MAX_PRIMITIVES: usize = 1 << 24;

/// Largest coordinate in world space. Squares of lengths must stay finite, and a sum of a few.
pub(crate) const MAX_COORDINATE: f64 = 1e150;

/// Whether no coordinate is NaN or too large.
pub(crate) fn in_world(p: Vec3) -> bool {
    p.abs().cmple(Vec3::splat(MAX_COORDINATE)).all()
}
