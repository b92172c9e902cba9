//! What the lanes ask others.

use kit::{Hit, PixelSampler, PrimId, Ray, Spectrum, TriangleHit, Vec3};

/// A path that has come to a surface of which the lanes do not know what it does with light.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// What it has seen so far.
    pub radiance: Spectrum,
    /// By what factor light counts that it sees from here on.
    pub throughput: Spectrum,
    /// Its random numbers.
    pub sampler: PixelSampler,
    /// Which of its rays has come here, counted from 1.
    pub bounce: u32,
    /// Whether what is emitted at its next hit counts.
    pub sees_light: bool,
}

/// The plain way, for whatever is not done eight at a time.
pub trait Neighbours {
    /// The plain kernel: a ray's hit with a primitive in the ray's range (a sphere's with weights of 0).
    fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit>;

    /// The record of what `test` or `closest` found.
    fn record(&self, id: PrimId, ray: &Ray, hit: TriangleHit) -> Hit;

    /// The closest hit of all but `left`; of hits at equal `t` the one with the lowest id.
    fn closest(&mut self, ray: &Ray, left: Option<PrimId>) -> Option<(PrimId, TriangleHit)>;

    /// Whether anything but `left` is in the ray's range.
    fn occluded(&mut self, ray: &Ray, left: Option<PrimId>) -> bool;

    /// The camera's `ray`, sent through its lens: asked where [`View::has_lens`](crate::View::has_lens).
    fn aim(&mut self, ray: &Ray, sampler: &mut PixelSampler) -> Ray;

    /// By what the reflectance counts of a surface that was hit: what the picture on it shows there, white without one.
    /// Asked where [`PathSettings::has_textures`](crate::PathSettings::has_textures), of surfaces that no path is taken
    /// on from.
    fn tint(&mut self, hit: &Hit) -> Spectrum;

    /// Takes `path`, which came along the unit direction `d` to `hit`, one bounce on, with direct light and all: the ray that
    /// it goes on with, if it does, and the primitive that this leaves for good.
    fn go_on(&mut self, path: &mut Path, d: Vec3, hit: &Hit) -> Option<(Ray, Option<PrimId>)>;
}
