//! All tests of the renderer and its program.

mod accel;
mod command_line;
mod common;
mod empty_pixels;
mod interrupt;
mod lit;
mod lit_program;
mod merge;
mod packet;
mod passes;
mod reference_pictures;
mod replay;
