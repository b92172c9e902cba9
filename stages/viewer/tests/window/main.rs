//! The window without a display: every key, click and drag, and pictures of every mode.
//!
//! Pictures are drawn by [`viewer::raster`], so they are the same on every machine with the same
//! fonts. They are in `tests/snapshots`; `UPDATE_SNAPSHOTS=1 cargo test -p viewer` accepts new
//! ones.

mod common;
mod comparisons;
mod contrast;
mod files;
mod keyboard;
mod keys;
mod mouse;
mod pictures;
mod replays;
mod reports;
mod sessions;
mod views;
