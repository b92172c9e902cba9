//! All tests of the renderer and its program.

mod accel;
mod clamp;
mod command_line;
mod common;
mod empty_pixels;
mod export;
mod far_away;
mod interrupt;
mod lit;
mod lit_program;
mod merge;
mod packet;
mod passes;
mod radiance_files;
mod reference_pictures;
mod replay;
mod shading_normals;
