//! What the front-page pictures need and no scene file of `scenes/dae` contains.
//!
//! Reading order: [`sky`] (a sky map at dusk), [`tree`] (a large mesh and the boxes of its tree),
//! [`collada`] (writes such a scene), [`strip`] (pictures side by side). The commands are in
//! `scenes/pictures/README.md`.

pub mod collada;
pub mod sky;
pub mod strip;
pub mod tree;
