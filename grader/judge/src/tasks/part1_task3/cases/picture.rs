//! The picture among the cases, traced pixel by pixel.

use super::heap_case;
use crate::tools::findings::Aspect;
use crate::tools::questions::eye::{SIZE, picture_rays};
use crate::tools::questions::picture_shapes::{behind, octahedron, ring};
use crate::tools::questions::probes::brute_force;
use crate::tools::spec::Spec;
use kit::Vec3;

/// A torus with smooth normals, and an octahedron with flat faces in its hole. One more triangle is
/// behind the eye.
pub(super) fn torus() -> Spec {
    let mut triangles = ring(24, 10);
    triangles.extend(octahedron(Vec3::new(0.0, 0.35, 0.0), 0.55));
    let eye = Vec3::new(1.6, 3.1, 4.2);
    triangles.push(behind(eye, [(-3.0, -1.5), (3.0, -1.5), (0.0, 3.0)]));
    let rays = picture_rays(eye, Vec3::ZERO, 45.0);
    Spec {
        picture: Some(SIZE),
        ..heap_case(
            "picture_of_a_ring",
            "A torus with smooth normals and an octahedron with flat faces, coloured by their \
             normals.",
            brute_force(&triangles, &[], &rays),
        )
        .mainly(&[Aspect::T, Aspect::Position, Aspect::Normal])
    }
}
