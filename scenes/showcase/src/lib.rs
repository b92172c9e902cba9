//! What the front-page pictures need and no scene file of `scenes/dae` contains.
//!
//! Reading order: [`sky`] (a sky map at dusk), [`tree`] (a landscape and the boxes of its tree),
//! [`street`] (steps in the sun), [`dusk`] (a lake behind `scenes/dae/dusk.dae`), [`forest`] (pines
//! in the coordinates of a map), `shapes`, [`collada`] (writes such scenes), [`strip`] and
//! [`letters`] (labelled pictures beside each other). The commands are in
//! `scenes/pictures/README.md`.

pub mod collada;
pub mod dusk;
pub mod forest;
pub mod letters;
mod shapes;
pub mod sky;
pub mod street;
pub mod strip;
pub mod tree;
