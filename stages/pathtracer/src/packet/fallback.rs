//! What packets of paths do not handle: the tree, textures, materials that the lanes do not know.

use crate::Counters;
use crate::accel::{closest_in, occluded_in};
use crate::integrator::PathIntegrator;
use crate::tracer::RayOrigin;
use crate::world::{record_hit, test_primitive};
use kit::{Camera, Hit, PixelSampler, PrimId, Ray, Scattering, Spectrum, TriangleHit, Vec3};
use simd_bvh::{StreamMemory, Subset, TestCounts, WideBvh};
use simd_paths::{Beam, NextRay, ScalarFallback, ScalarPath};

/// The scalar code for what the packets do not handle.
pub(super) struct Fallback<'b, 'a> {
    pub(super) integrator: &'b PathIntegrator<'a>,
    pub(super) tree: &'a WideBvh,
    pub(super) camera: &'a Camera,
    /// The tests of rays; the packets count the rays.
    pub(super) counters: Counters,
    /// For rays that are traced together.
    pub(super) stream: &'b mut StreamMemory,
}

impl ScalarFallback for Fallback<'_, '_> {
    #[inline]
    fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
        test_primitive(&self.integrator.lit.scene, id, ray)
    }

    #[inline]
    fn record(&self, id: PrimId, ray: &Ray, hit: TriangleHit) -> Hit {
        record_hit(&self.integrator.lit.scene, id, &mut { *ray }, hit)
            .expect("the same kernel finds the same hit")
    }

    #[inline]
    fn closest(&mut self, ray: &Ray, skip: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
        let scene = &self.integrator.lit.scene;
        closest_in(self.tree, scene, ray, skip, &mut self.counters)
    }

    #[inline]
    fn occluded(&mut self, ray: &Ray, skip: Option<PrimId>) -> bool {
        let scene = &self.integrator.lit.scene;
        occluded_in(self.tree, scene, ray, skip, &mut self.counters)
    }

    fn closest_each(
        &mut self,
        rays: &[(Ray, Option<PrimId>)],
        hits: &mut Vec<Option<(PrimId, TriangleHit)>>,
    ) {
        let scene = &self.integrator.lit.scene;
        let mut tests = TestCounts::default();
        let exact = &mut |id, ray: &Ray| test_primitive(scene, id, ray);
        self.tree
            .closest_each(Subset::Inner, rays, exact, self.stream, &mut tests, hits);
        self.counters += tests;
    }

    fn occluded_each(&mut self, rays: &[(Ray, Option<PrimId>)], occluded: &mut Vec<bool>) {
        let scene = &self.integrator.lit.scene;
        let mut tests = TestCounts::default();
        let exact = &mut |id, ray: &Ray| test_primitive(scene, id, ray);
        self.tree.occluded_each(
            Subset::Inner,
            rays,
            exact,
            self.stream,
            &mut tests,
            occluded,
        );
        self.counters += tests;
    }

    fn primitives_in(&mut self, beam: &Beam, most: usize, ids: &mut Vec<PrimId>) -> bool {
        let region = beam.half_spaces.map(|h| (h.normal, h.offset));
        let mut tests = TestCounts::default();
        let are_all = self
            .tree
            .primitives_in(Subset::Inner, &region, most, ids, &mut tests);
        self.counters += tests;
        are_all
    }

    fn through_lens(&mut self, ray: &Ray, sampler: &mut PixelSampler) -> Ray {
        self.integrator.through_lens(self.camera, ray, sampler)
    }

    fn texture_color(&mut self, hit: &Hit) -> Spectrum {
        self.integrator.texture_color(hit)
    }

    fn scatter(&mut self, path: &mut ScalarPath, d: Vec3, hit: &Hit) -> Option<NextRay> {
        let integrator = self.integrator;
        let surface = integrator.lit.surface(hit);
        let place = integrator.place(hit, &surface);
        let wo = -d;
        if !surface.material.is_delta() {
            let direct = integrator.direct(&surface, place, wo, &mut path.sampler);
            path.radiance += path.throughput * direct;
        }
        if path.bounce == integrator.max_depth {
            return None;
        }
        let (u, choice) = (path.sampler.next_2d(), path.sampler.next_1d());
        let local_wo = surface.frame.to_local(wo);
        let materials = integrator.materials.at(place);
        let sample = materials.sample(surface.material, local_wo, u, choice)?;
        let u = path.sampler.next_1d();
        path.throughput = integrator.roulette(path.throughput * sample.weight(), path.bounce, u)?;
        path.emission_counts = sample.delta;
        let ray = surface.leave(surface.frame.to_world(sample.wi));
        let skip = integrator.skip(Some(RayOrigin::from(&surface)), &ray);
        Some(NextRay { ray, skip })
    }
}
