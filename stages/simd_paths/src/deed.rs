// BEGIN SOLUTION(part6.task2)
//! What surfaces do with light.

use kit::{Material, Spectrum};

/// What a surface does with light, as far as the lanes know it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Does {
    /// Scatters it as a matte surface.
    Scatter,
    /// Emits it, and ends the path.
    Emit,
    /// Something else: it is asked path by path.
    Else,
}

/// What a material does, and the colour it does it with: reflectance of what scatters, radiance of what emits.
pub(crate) fn deed(material: &Material) -> (Does, Spectrum) {
    match *material {
        Material::Diffuse { reflectance } => (Does::Scatter, reflectance),
        Material::Emission { radiance } => (Does::Emit, radiance),
        _ => (Does::Else, Spectrum::BLACK),
    }
}
// END SOLUTION(part6.task2)
