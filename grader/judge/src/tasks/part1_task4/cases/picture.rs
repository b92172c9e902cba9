//! The picture among the cases, traced pixel by pixel.

use super::heap_case;
use crate::tools::findings::Aspect;
use crate::tools::questions::eye::{SIZE, picture_rays};
use crate::tools::questions::picture_shapes::spheres_in_a_pile;
use crate::tools::questions::probes::{brute_force, within};
use crate::tools::spec::Spec;
use kit::{Sphere, Vec3};

/// Ten spheres in a pyramid on a large sphere, with small spheres around them. One more is behind
/// the eye, and one around everything, beyond the end of the rays: only wrong ranges hit them.
pub(super) fn pile_of_spheres() -> Spec {
    let eye = Vec3::new(2.0, 2.6, 6.5);
    let rays = picture_rays(eye, Vec3::new(0.0, 0.85, 0.0), 40.0);
    let rays: Vec<_> = rays.into_iter().map(|r| within(r, 0.0, 20.0)).collect();
    let unseen = [(1.4 * eye, 1.0), (Vec3::ZERO, 40.0)];
    let mut spheres = spheres_in_a_pile();
    spheres.extend(unseen.map(|(center, radius)| Sphere { center, radius }));
    Spec {
        picture: Some(SIZE),
        ..heap_case(
            "picture_of_spheres",
            "A pyramid of spheres on a large sphere, coloured by their normals.",
            brute_force(&[], &spheres, &rays),
        )
        .mainly(&[Aspect::T, Aspect::Position, Aspect::Normal])
    }
}
