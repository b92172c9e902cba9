//! Parts of self-contained HTML pages: [`html`] escapes text and embeds data, [`picture`] turns answers into pictures.

pub mod html;
pub mod picture;
