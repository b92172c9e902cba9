//! Pictures as bytes.
//!
//! [`Image`] is a picture, [`mod@png`] its files, [`tone`] turns the worker's colours into bytes.
//! [`cause`] says why a pixel of a case differs, [`difference`] compares the picture of a task with
//! its golden, [`light`] lights that of shapes, [`sheet`] puts both beside each other, [`terminal`]
//! prints them. `grader` compiles this crate, so it has few dependencies.

pub mod cause;
pub mod difference;
pub mod image;
pub mod light;
pub mod palette;
pub mod png;
pub mod sheet;
pub mod terminal;
pub mod tone;

pub use image::Image;
