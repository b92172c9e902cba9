//! The types and helper functions that all stages share.
//!
//! For Part 1 read [`ray`], [`hit`], [`shapes`] and [`camera`], about 300 lines, and of [`sampler`]
//! only [`PixelSampler::get_sample`]. Read the others when a part needs them:
//!
//! - [`ray`], [`hit`]: the input and the result of an intersection test.
//! - [`shapes`], [`aabb`]: primitives and bounding boxes.
//! - [`camera`], [`sampler`], [`film`], [`budget`]: camera, random numbers, pixels, samples per
//!   pixel.
//! - [`bvh`], [`world`]: the tree, and the tests that its traversal calls.
//! - [`scene`], [`material`], [`texture`], [`light`]: the contents of a scene file.
//! - [`lit`], [`emitter`], [`emitting_mesh`], [`environment`]: light sources that can be sampled.
//! - [`surface`], [`frame`], [`bsdf`], [`shading_normal`], [`warp`]: shading points, scattering,
//!   uniform sampling.
//! - [`effects`]: which effects a scene needs.
//! - [`mod@hole`]: placeholders for tasks that are not written yet.
//!
//! The kit depends on `glam` and `libm` only. It contains one formula that a task asks for,
//! [`camera::half_tan`], because camera files need it.

pub mod aabb;
mod area_lights;
pub mod bsdf;
pub mod budget;
pub mod bvh;
pub mod camera;
pub mod effects;
pub mod emitter;
pub mod emitting_mesh;
mod emitting_sphere;
pub mod environment;
pub mod film;
pub mod frame;
pub mod hit;
pub mod hole;
mod lamps;
pub mod light;
mod light_sample;
pub mod lit;
pub mod material;
pub mod math;
pub mod ray;
pub mod sampler;
pub mod scene;
pub mod shading_normal;
pub mod shapes;
mod sobol;
pub mod spectrum;
mod stratified;
pub mod surface;
mod tally;
pub mod texture;
pub mod warp;
pub mod world;

pub use aabb::Aabb;
pub use bsdf::{BsdfSample, Scattering};
pub use budget::Budget;
pub use bvh::{Bvh, BvhNode, NodeKind};
pub use camera::Camera;
pub use emitter::Emitter;
pub use emitting_mesh::EmittingMesh;
pub use environment::Environment;
pub use film::{Film, FilmSize, PixelEstimate};
pub use frame::Frame;
pub use hit::{Hit, Interval, PrimId, TriangleHit};
pub use lamps::{Lamp, Lamps};
pub use light::Light;
pub use light_sample::LightSample;
pub use lit::LitScene;
pub use material::Material;
pub use math::{Mat3, Vec2, Vec3};
pub use ray::Ray;
pub use sampler::PixelSampler;
pub use scene::{Primitive, Scene};
pub use shapes::{Sphere, Triangle};
pub use spectrum::Spectrum;
pub use surface::Surface;
pub use tally::Tally;
pub use texture::Texture;
pub use world::World;
