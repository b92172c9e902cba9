//! The light of the lamps that the camera sees, in the pixels that the edge of a lamp crosses.
//!
//! A lamp is many times brighter than what it lights. Where its edge crosses a pixel, a sample hits
//! either the lamp or what is beside it, so the few pixels along the edges of the lamps have a
//! large share of the error of a whole picture, half of it in many rooms with a lamp. A camera ray
//! alone takes little time. In these pixels each sample therefore takes the lamps' own light as the
//! mean of several camera rays, in place of the one that its path starts with. The mean of the
//! picture stays the same.

use crate::integrator::PathIntegrator;
use crate::pixel_contents::PixelContents;
use crate::tracer::{RayRole, RayTracer};
use crate::{Counters, Job};
use direct::zero_bounce_radiance;
use kit::sampler::{Pattern, Sampling, mix};
use kit::shading_normal::towards_viewer;
use kit::{PixelSampler, Ray, Spectrum, Vec2};
use raygen::generate_ray;

/// A pixel that the edge of a lamp crosses.
pub(crate) struct LampEdge<'a> {
    job: &'a Job,
    pixel: (u32, u32),
    /// Camera rays for each sample.
    rays: u32,
}

/// The random numbers of these rays are not those of the paths.
const SEED: u64 = 0x6c61_6d70_6564_6765;

/// The rays that look for an edge in a pixel, besides those through its corners. In each direction
/// one of them is in each sixteenth of the pixel.
const PROBES: u32 = 16;

/// The name of black.
const NO_LIGHT: u32 = 0;

/// A number for a light: two lights very seldom have the same.
fn name_of(light: Spectrum) -> u32 {
    if light == Spectrum::BLACK {
        return NO_LIGHT;
    }
    let channels = light.to_array().into_iter();
    channels.fold(0, |name, channel| mix(name ^ channel.to_bits())) as u32 | 1
}

impl<T: RayTracer> PathIntegrator<'_, T> {
    /// `None` if no edge of a lamp is found in the pixel: the rays through its corners and through
    /// some points find the same light. A long straight edge has corners on both sides. Inside of a
    /// lamp the corners are enough: those of the pixels around it find the lamp, too. The samples
    /// have no influence: without bias, the mean may not depend on what they find.
    pub(crate) fn lamp_edge<'a>(
        &self,
        job: &'a Job,
        contents: &PixelContents,
        pixel: (u32, u32),
    ) -> Option<LampEdge<'a>> {
        // A single sample goes through the centre of its pixel.
        if job.samples < 2 {
            return None;
        }
        let edge = LampEdge {
            job,
            pixel,
            rays: self.settings.lamp_rays,
        };
        // These rays belong to no sample: they are not counted.
        let light = |ray| name_of(self.lamp_light(&ray, &mut Counters::default()));
        let corner = |[right, up]: [u32; 2]| {
            let x = (pixel.0 + right).saturating_sub(1).min(job.film.w);
            let y = (pixel.1 + up).saturating_sub(1).min(job.film.h);
            let place = Vec2::new(f64::from(x), f64::from(y));
            contents.light_at_corner((x, y), || light(edge.ray_at(place)))
        };
        let find = || {
            let first = corner([1, 1]);
            let differs = |at| corner(at) != first;
            if [[2, 1], [1, 2], [2, 2]].into_iter().any(differs) {
                return true;
            }
            let may_be_between = first == NO_LIGHT && contents.has_small_lamp(pixel);
            if !may_be_between && !(0..16).map(|i| [i % 4, i / 4]).any(differs) {
                return false;
            }
            let mut sampler = edge.sampler(Pattern::Sobol, !SEED, 0);
            (0..PROBES).any(|_| light(edge.ray(sampler.get_sample())) != first)
        };
        contents.has_lamp_edge(pixel, find).then_some(edge)
    }

    /// The light of the lamp that `ray`, a camera ray, hits; black if it hits none.
    fn lamp_light(&self, ray: &Ray, counters: &mut Counters) -> Spectrum {
        counters.rays += 1;
        counters.lamp_rays += 1;
        let Some(hit) = self
            .tracer
            .unrecorded()
            .closest(RayRole::Camera, ray, None, counters)
        else {
            return Spectrum::BLACK;
        };
        let hit = towards_viewer(self.lit, hit, ray.d);
        zero_bounce_radiance(&self.lit.surface(&hit), -ray.d)
    }
}

impl LampEdge<'_> {
    fn sampler(&self, pattern: Pattern, seed: u64, first_sample: u32) -> PixelSampler {
        let (x, y) = self.pixel;
        let sampling = Sampling {
            pattern,
            seed,
            first_sample,
        };
        PixelSampler::new(x, y, sampling)
    }

    /// The camera ray through the point `place` in the pixel, in [0, 1]².
    fn ray(&self, place: Vec2) -> Ray {
        let (x, y) = self.pixel;
        self.ray_at(Vec2::new(f64::from(x), f64::from(y)) + place)
    }

    /// The camera ray through the point `place` on the film, in pixels.
    fn ray_at(&self, place: Vec2) -> Ray {
        let film = self.job.film;
        let size = Vec2::new(f64::from(film.w), f64::from(film.h));
        generate_ray(&self.job.camera, place / size)
    }

    /// `radiance`, that of the last of `started` samples, along `ray`, with the light of the lamps
    /// as the mean of several rays.
    pub(crate) fn smooth<T: RayTracer>(
        &self,
        integrator: &PathIntegrator<'_, T>,
        started: u32,
        ray: &Ray,
        radiance: Spectrum,
    ) -> Spectrum {
        let Sampling { pattern, seed, .. } = self.job.sampling;
        let pattern = match pattern {
            Pattern::Independent => Pattern::Independent,
            Pattern::Stratified { samples } => Pattern::Stratified {
                samples: samples.saturating_mul(self.rays),
            },
            Pattern::Sobol | Pattern::Sobol4 => Pattern::Sobol,
        };
        let first = started.wrapping_sub(1).wrapping_mul(self.rays);
        let mut sampler = self.sampler(pattern, seed ^ SEED, first);
        integrator.counting(|counters| {
            let mut sum = Spectrum::BLACK;
            for _ in 0..self.rays {
                sum += integrator.lamp_light(&self.ray(sampler.get_sample()), counters);
            }
            radiance - integrator.lamp_light(ray, counters) + sum / f64::from(self.rays)
        })
    }

    /// The same for the next samples of the pixel in its row, whose positions `sampler` draws.
    pub(crate) fn smooth_all<T: RayTracer>(
        &self,
        integrator: &PathIntegrator<'_, T>,
        sampler: &PixelSampler,
        samples: &mut [Spectrum],
    ) {
        let mut sampler = sampler.clone();
        for radiance in samples {
            let ray = self.ray(sampler.get_sample());
            *radiance = self.smooth(integrator, sampler.samples_started(), &ray, *radiance);
        }
    }
}
