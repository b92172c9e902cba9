//! The window: the scene, the tree over it, the picture in progress, and the rays of a pixel.
//!
//! Everything but the drawing works without a display and is tested there. Reading order:
//! [`command`] (what a key, a click or a drag does, as a value), [`keys`] (the one list of keys),
//! [`session`] (the state, and what commands do to it). What the state consists of: [`scene_data`],
//! [`settings`], [`orbit`] (the camera), [`topology`] (vertices and edges), [`element_walk`], [`tree_walk`],
//! [`view_picture`], [`view3d`], [`cut`] and [`pace`] (the ray-traced view), [`render_control`]
//! (the picture), [`inspector`] (the replay of a pixel) with [`lobe`] and [`convergence`],
//! [`truth`] (the exact answers), [`compare`] and [`picture_pair`] (A and B), [`luminance`] (false
//! colours), [`picture_layer`] (layers of a file), [`features`] (what waits for a task), [`report`]
//! (a report of the grader), [`ray_test`], [`remembered`] (from one start to the next),
//! [`path_use`]. [`task`] runs work in the background and catches the holes of stages that are not
//! written yet; [`project`] is the projection of lines, [`digits`] shortens numbers.
//!
//! [`app`] draws it with egui. [`snapshot`] writes pictures of it without a display, with
//! [`raster`], which draws egui's shapes without a GPU. [`cli`] has the flags of the program.

pub mod app;
pub mod cli;
pub mod command;
pub mod compare;
pub mod convergence;
pub mod cut;
pub mod digits;
pub mod element_walk;
pub mod features;
pub mod inspector;
pub mod keys;
pub mod lobe;
pub mod luminance;
mod luminance_view;
pub mod orbit;
pub mod pace;
pub mod path_use;
pub mod picture_layer;
pub mod picture_pair;
pub mod project;
pub mod raster;
pub mod ray_test;
pub mod remembered;
pub mod render_control;
pub mod report;
pub mod scene_data;
pub mod session;
pub mod settings;
pub mod snapshot;
pub mod task;
pub mod topology;
pub mod tree_walk;
pub mod truth;
pub mod view3d;
pub mod view_picture;
