//! `grader speedup`: what each step from brute force to a wide tree gains in speed.
//!
//! Reading order: [`Rung`] (one step of the ladder), [`RaySets`] (what is traced), [`measure`] (the
//! times, in turns), [`table`] (what is printed), [`page`] (the plots).
//!
//! Unlike `grader part2`, which times the student's code in a worker, this program links the stages:
//! it measures and judges nothing.

mod clock;
mod measure;
pub mod page;
mod rays;
mod rung;
pub mod table;

pub use measure::{Ladder, LadderRequest, RungCost, measure};
pub use rays::{RayKind, RaySets};
pub use rung::{Rung, RungKind};

#[cfg(test)]
mod tests {
    use grader::cli::programs::MESHES;
    use meshes::MeshKind;

    #[test]
    fn the_command_line_has_every_mesh() {
        let named: Result<Vec<MeshKind>, String> =
            MESHES.iter().map(|name| name.parse::<MeshKind>()).collect();
        let named = named.expect("every name is a mesh");
        assert!(MeshKind::ALL.iter().all(|kind| named.contains(kind)));
    }
}
