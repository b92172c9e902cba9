//! Parts of self-contained HTML pages: [`html`] escapes text and embeds data, [`picture`] converts
//! the worker's answers to pictures.

pub mod html;
pub mod picture;

pub use pictures::palette::OF_PAGES as PALETTE;
