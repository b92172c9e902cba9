//! The code that the packets call for what they do not handle.

use kit::{Hit, PixelSampler, PrimId, Ray, Spectrum, TriangleHit, Vec3};

/// A path that has hit a material that the packets do not handle.
#[derive(Clone, Debug, PartialEq)]
pub struct ScalarPath {
    /// The radiance that it has accumulated.
    pub radiance: Spectrum,
    /// The product of the weights so far, by which further radiance is multiplied.
    pub throughput: Spectrum,
    /// Its random numbers.
    pub sampler: PixelSampler,
    /// The number of the ray that hit the surface, counted from 1.
    pub bounce: u32,
    /// Whether emission at the next hit counts; else direct light has counted it already.
    pub emission_counts: bool,
}

/// The ray with which a path continues.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NextRay {
    /// The ray.
    pub ray: Ray,
    /// The primitive that the ray leaves and cannot hit again.
    pub skip: Option<PrimId>,
}

/// The number of half-spaces of a [`Beam`].
pub const HALF_SPACES: usize = 6;

/// A half-space: the points `p` with `normal·p <= offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// A normal of its plane, pointing out of the half-space; not normalised.
    pub normal: Vec3,
    /// May be infinite: then all points are inside.
    pub offset: f64,
}

/// A convex region that contains all points of many rays in their ranges, with a margin for
/// rounding errors: the intersection of half-spaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// The half-spaces, in world space.
    pub half_spaces: [HalfSpace; HALF_SPACES],
}

/// One ray or path at a time, or many rays with a tree, for what the packets do not handle.
pub trait ScalarFallback {
    /// Intersects `ray` with primitive `id`, in the ray's range. A sphere's weights are 0.
    fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit>;

    /// Records a hit that `test` or `closest` found.
    fn record(&self, id: PrimId, ray: &Ray, hit: TriangleHit) -> Hit;

    /// The closest hit with any primitive but `skip`; at equal `t` the one with the lowest id.
    fn closest(&mut self, ray: &Ray, skip: Option<PrimId>) -> Option<(PrimId, TriangleHit)>;

    /// Whether any primitive but `skip` is hit in the ray's range.
    fn occluded(&mut self, ray: &Ray, skip: Option<PrimId>) -> bool;

    /// Replaces the contents of `hits` by [`ScalarFallback::closest`] of each of `rays`, in their
    /// order. A ray comes with the primitive that it cannot hit. The primitives that are apart (see
    /// [`PathScene::new`](crate::PathScene::new)) may be left out.
    fn closest_each(
        &mut self,
        rays: &[(Ray, Option<PrimId>)],
        hits: &mut Vec<Option<(PrimId, TriangleHit)>>,
    ) {
        hits.clear();
        hits.extend(rays.iter().map(|(ray, skip)| self.closest(ray, *skip)));
    }

    /// Replaces the contents of `occluded` by [`ScalarFallback::occluded`] of each of `rays`, in
    /// their order. The primitives that are apart may be left out.
    fn occluded_each(&mut self, rays: &[(Ray, Option<PrimId>)], occluded: &mut Vec<bool>) {
        occluded.clear();
        occluded.extend(rays.iter().map(|(ray, skip)| self.occluded(ray, *skip)));
    }

    /// Adds at least the primitives of which a part is in `beam` to `ids`, in any order; some may
    /// be added twice, and those that are apart may be left out. Returns false if there are more
    /// than `most`, or if finding them would take as long as tracing the rays: then `ids` has no
    /// meaning.
    fn primitives_in(&mut self, beam: &Beam, most: usize, ids: &mut Vec<PrimId>) -> bool;

    /// Refracts the camera's `ray` by its lens. Called if
    /// [`View::has_lens`](crate::View::has_lens).
    fn through_lens(&mut self, ray: &Ray, sampler: &mut PixelSampler) -> Ray;

    /// The texture colour at `hit`, by which the reflectance is multiplied; white without a
    /// texture. Called if [`PathSettings::has_textures`](crate::PathSettings::has_textures), where
    /// [`ScalarFallback::scatter`] is not.
    fn texture_color(&mut self, hit: &Hit) -> Spectrum;

    /// Continues `path`, whose ray along the unit direction `d` found `hit`, by one bounce: adds
    /// direct light and samples the next ray, if there is one.
    fn scatter(&mut self, path: &mut ScalarPath, d: Vec3, hit: &Hit) -> Option<NextRay>;
}
