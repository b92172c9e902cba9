//! What every stage is given.
//!
//! Read in this order: [`ray`] and [`hit`] (what goes in and what comes out), [`shapes`]
//! and [`aabb`] (what is hit), [`camera`], [`sampler`] and [`film`] (where rays come from
//! and where their colours go), [`budget`] (how many samples a pixel may take), [`bvh`] and [`world`] (the tree and what it hangs in),
//! [`scene`], [`material`], [`texture`] and [`light`] (what a file describes), [`lit`], [`emitter`], [`emitting_mesh`] and [`environment`]
//! (where light comes from), [`surface`], [`frame`] and [`bsdf`] (where it is scattered), [`warp`]
//! (uniform points), [`effects`] (what of all this a scene needs), [`statistics`] and [`chi_square`] (how random answers are judged), and [`mod@hole`]
//! (how a task that is not written yet says so).
//!
//! The kit knows vectors and threads and nothing else of the course: it holds no formula
//! that a student is asked to find.

pub mod aabb;
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
pub mod light;
pub mod lit;
pub mod material;
pub mod math;
pub mod ray;
pub mod sampler;
pub mod scene;
pub mod shapes;
mod shown_light;
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
pub use emitter::{Emitter, LightSample};
pub use emitting_mesh::EmittingMesh;
pub use environment::Environment;
pub use film::{Film, FilmSize, PixelEstimate};
pub use frame::Frame;
pub use hit::{Hit, Interval, PrimId, TriangleHit};
pub use light::Light;
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
