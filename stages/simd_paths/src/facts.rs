// BEGIN SOLUTION(part6.task2)
//! What shading asks about each primitive and does not have to work out at every hit.

use kit::{Hit, LitScene, Material, PrimId, Spectrum, Vec2, Vec3};

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

/// A primitive beyond its shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facts {
    /// A triangle's geometric normal.
    pub(crate) ng: Vec3,
    /// 1 if that is on the side of the vertex normals, else -1.
    pub(crate) side: f64,
    /// How far rays are moved off a triangle.
    pub(crate) distance: f64,
    /// No coordinate of a hit point is farther from the true surface.
    pub(crate) error: Vec3,
    /// Which of the scene's materials it is made of.
    pub(crate) material: u32,
}

impl Facts {
    /// Those of primitive `id`; `ng` is a triangle's geometric normal.
    pub(crate) fn of(lit: &LitScene, id: PrimId, ng: Vec3) -> Facts {
        // Anywhere on it: this says where its surface faces and how far off points on it may be.
        let anywhere = lit.surface(&Hit {
            t: 0.0,
            p: Vec3::ZERO,
            n: ng,
            ng,
            uv: Vec2::ZERO,
            prim: id,
        });
        Facts {
            ng,
            side: if anywhere.ng == ng { 1.0 } else { -1.0 },
            distance: anywhere.error.dot(ng.abs()),
            error: anywhere.error,
            material: lit.scene.objects[lit.scene.object_of[id.0 as usize] as usize].material,
        }
    }
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
