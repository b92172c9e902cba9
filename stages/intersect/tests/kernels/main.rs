//! What rays do at triangles and spheres.
//!
//! [`triangle`] and [`sphere`] hold the plain cases. The other files go where textbook formulas fail, each test
//! with a line on how; [`truth`] is the slow and exact computation that they are held against.

mod sphere;
mod sphere_grazed;
mod sphere_properties;
mod sphere_roots;
mod triangle;
mod triangle_degenerate;
mod triangle_edges;
mod triangle_meshes;
mod triangle_properties;
mod triangle_range;
mod triangle_scales;
mod truth;
