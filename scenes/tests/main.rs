//! All tests of reading scenes, in one program.

mod collada;
mod course_files;
mod generators;
mod models;
mod mutations;
mod own_scenes;
