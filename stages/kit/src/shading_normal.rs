//! Shading normals that disagree with the surface.
//!
//! Vertex normals of a file may be far from the plane of their triangle. Then a direction may be on
//! one side of the surface by the geometric normal, and on the other by the shading normal.
//!
//! - The viewer: a shading normal that faces away from a viewer in front of the surface is mirrored
//!   at the plane across the line of sight ([`towards_viewer`]). Without this the surface is black.
//!   The change is continuous: it starts at normals across the line of sight.
//! - The light: an opaque surface scatters no light from one side of the geometric normal to the
//!   other ([`Sides`]): `f` is 0. Without this, light shines through it (Veach, "Non-symmetric
//!   scattering in light transport algorithms", 1996).
//!
//! So where light grazes the surface, each triangle of a smooth mesh is dark or bright as a whole:
//! the terminator, the edge of the part that faces away from a light, shows the facets. A factor
//! that depends on both normals softens it, if the user wants it ([`Sides::terminator`]).
//!
//! The renderer does this between the functions of the stages, which see hits and a
//! [`Scattering`](crate::Scattering) only. The lanes of `simd_paths` compute the same bits.

use crate::{Hit, LitScene, Material, Surface, Vec3};

/// `hit` of a ray along the unit vector `d`, with a shading normal on the viewer's side of the
/// surface.
///
/// ```
/// use kit::{shading_normal::towards_viewer, Hit, LitScene, Material, PrimId, Scene, Spectrum};
/// use kit::{Triangle, Vec2, Vec3};
/// # use kit::scene::{NamedMaterial, Object};
/// # let grey = Material::Diffuse { reflectance: Spectrum::grey(0.5) };
/// let mut sheet = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
/// let tilted = Vec3::new(0.8, 0.0, 0.6);
/// (sheet.n0, sheet.n1, sheet.n2) = (tilted, tilted, tilted);
/// let scene = Scene {
///     triangles: vec![sheet],
///     object_of: vec![0],
///     objects: vec![Object { name: "sheet".into(), material: 0 }],
///     materials: vec![NamedMaterial { name: "grey".into(), material: grey }],
///     ..Scene::default()
/// };
/// let (p, uv) = (Vec3::new(0.25, 0.25, 0.0), Vec2::splat(0.25));
/// let hit = Hit { t: 1.0, p, n: tilted, ng: Vec3::Z, uv, prim: PrimId(0) };
/// let lit = LitScene::new(scene, None);
/// // A viewer in front of the sheet, from whom the normal faces away.
/// let to_viewer = Vec3::new(-0.8, 0.0, 0.6);
/// assert!(tilted.dot(to_viewer) < 0.0);
/// assert!(towards_viewer(&lit, hit, -to_viewer).n.dot(to_viewer) > 0.0);
/// ```
#[inline]
pub fn towards_viewer(lit: &LitScene, hit: Hit, d: Vec3) -> Hit {
    let along = hit.n.dot(d);
    if along * lit.surface(&hit).ng.dot(d) < 0.0 {
        let n = hit.n - d * (along * 2.0);
        return Hit { n, ..hit };
    }
    hit
}

/// The sides of a surface, in the local space of its shading normal.
#[derive(Clone, Copy, Debug)]
pub struct Sides {
    /// The geometric normal.
    ng: Vec3,
}

impl Sides {
    /// A surface whose normals agree.
    pub const FLAT: Sides = Sides { ng: Vec3::Z };

    /// The sides of `surface`.
    #[inline]
    pub fn of(surface: &Surface<'_>) -> Sides {
        Sides {
            ng: surface.frame.to_local(surface.ng),
        }
    }

    /// Whether light from `wi` to `wo` would pass through a surface of an opaque material.
    #[inline]
    pub fn block(&self, material: &Material, wo: Vec3, wi: Vec3) -> bool {
        !material.lets_light_through() && self.ng.dot(wo) * self.ng.dot(wi) <= 0.0
    }

    /// A factor of `f` for light from `wi`: 0 in the plane of the surface, 1 from where `wi` is as
    /// far from this plane as the two normals let expect, and smooth between (Chiang, Li and
    /// Burley, "Taming the shadow terminator", SIGGRAPH 2019 talks). It takes light away and
    /// adds none.
    ///
    /// With `g = |ng·wi| / (|ng·n| |n·wi|)`, at most 1, the factor is `g + g² - g³`, whose
    /// derivative at 1 is 0.
    #[inline]
    pub fn terminator(&self, wi: Vec3) -> f64 {
        let (height, expected) = (self.ng.dot(wi).abs(), (self.ng.z * wi.z).abs());
        let g = if expected <= height {
            1.0
        } else {
            height / expected
        };
        g * (1.0 + g * (1.0 - g))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_terminator_is_smooth_from_the_plane_to_the_expected_height() {
        // 60 degrees between the normals; `wi` turns from the plane of the surface to `ng`.
        let sides = Sides {
            ng: Vec3::new(0.75_f64.sqrt(), 0.0, 0.5),
        };
        let along = Vec3::new(-0.5, 0.0, 0.75_f64.sqrt());
        let at = |height: f64| {
            sides.terminator((along * (1.0 - height * height).sqrt()) + sides.ng * height)
        };
        assert!(at(0.0).abs() < 1e-15);
        let steps: Vec<f64> = (0..=1000).map(|i| at(f64::from(i) / 1000.0)).collect();
        assert!(steps.is_sorted() && steps[1000] == 1.0, "{steps:?}");
        // No step and no corner at the end of the soft part.
        let slopes: Vec<f64> = steps.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let bends = slopes.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        assert!(bends.fold(0.0, f64::max) < 5e-5, "{slopes:?}");
    }

    #[test]
    fn where_the_normals_agree_the_terminator_changes_nothing() {
        for wi in [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::X] {
            assert_eq!(Sides::FLAT.terminator(wi), 1.0);
        }
    }
}
