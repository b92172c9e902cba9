//! The picture among the cases, traced pixel by pixel.

use super::heap_case;
use crate::tools::findings::Aspect;
use crate::tools::questions::eye::{SIZE, picture_rays};
use crate::tools::questions::picture_shapes::spheres_in_a_pile;
use crate::tools::questions::probes::brute_force;
use crate::tools::spec::Spec;
use kit::Vec3;

/// Ten spheres in a pyramid on a large sphere, with small spheres around them.
pub(super) fn pile_of_spheres() -> Spec {
    let rays = picture_rays(Vec3::new(2.0, 2.6, 6.5), Vec3::new(0.0, 0.85, 0.0), 40.0);
    Spec {
        picture: Some(SIZE),
        ..heap_case(
            "picture_of_spheres",
            "A pyramid of spheres on a large sphere, coloured by their normals.",
            brute_force(&[], &spheres_in_a_pile(), &rays),
        )
        .mainly(&[Aspect::T, Aspect::Normal])
    }
}
