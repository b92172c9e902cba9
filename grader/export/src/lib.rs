//! Writes what a course system needs to grade a part of the course.
//!
//! [`systems`] says which files each system gets: [`templates`], and for those that grade in a
//! container of the instructor, [`course_files`]. [`archive`] packs them as a zip.

pub mod archive;
pub mod choices;
pub mod course_files;
pub mod systems;
pub mod templates;
