//! All tests of the renderer and its program.

mod accel;
mod clamp;
mod command_line;
mod common;
mod export;
mod far_away;
mod interrupt;
mod lamp_edge;
mod lit;
mod lit_program;
mod merge;
mod packet;
mod passes;
mod pixel_contents;
mod radiance_files;
mod reference_pictures;
mod replay;
mod reuse_paths;
mod shading_normals;
