//! Path reuse: the eight pixels of a block share what their paths find beyond the first diffuse
//! surface (Bekaert, Sbert and Halton, "Accelerating path tracing by re-using paths", 2002).
//!
//! Sample `s` of pixel `i` reaches its first diffuse surface at `x[i]`, the next one at `y[i]`, and
//! gets the radiance `L[i]` from there. Each `x[k]` that sees `y[i]` could have found it: its
//! density of directions there is `cos(x) cos(y) / (pi r²)`. With the balance heuristic over those
//! densities the estimates are sums of all `L`, and each `L` is divided among the pixels in
//! proportion to the densities: the mean over the samples is the same, and noise that eight pixels
//! share is smaller.

use crate::lane_mask::lanes;
use crate::packet::PathPacket;
use crate::ray_packet::RayPacket;
use crate::shadow_queue::ShadowQueue;
use crate::surface_packet::SurfacePacket;
use crate::vec3x8::{LANES, Vec3x8};
use crate::{PathMemory, PathScene, ScalarFallback};
use fearless_simd::{Simd, f64x8, prelude::*};
use kit::{Spectrum, Vec3};
use lanes::surface::Departure;
use std::mem;

/// The number of paths to whose surfaces rays are sent at once.
const MAX_PENDING: usize = 512;

/// The first diffuse surface of a path and the next surface, as far as other paths need them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Link {
    state: State,
    /// The number of the ray that hits `from`: all that follows has as many rays less.
    bounce: u32,
    from: Vertex,
    /// The primitive that rays from `from` skip.
    skip: f64,
    /// From the camera to the next surface.
    throughput: Vec3,
    to: Vertex,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum State {
    /// No ray leaves a diffuse surface that comes first after mirrors and smooth glass.
    #[default]
    None,
    /// `from` is set; the path has hit nothing else yet, or ended.
    Open,
    /// `from` and `to` are set.
    Shared,
    /// What the path finds is its own: the next surface is not diffuse, or its normal depends on
    /// where it is seen from.
    Own,
}

/// A point on a surface, seen from the side of its normals.
#[derive(Clone, Copy, Debug, Default)]
struct Vertex {
    p: Vec3,
    ng: Vec3,
    n: Vec3,
    /// How far along `ng` the origins of rays are moved off the surface.
    offset: f64,
}

impl Vertex {
    /// The origin of rays that leave towards the viewer's side.
    fn off_surface(&self) -> Vec3 {
        self.p + self.ng * self.offset
    }
}

impl<S: Simd> PathPacket<'_, S> {
    /// Keeps the surfaces in the lanes of `hit` that are the first or the second one of a link.
    /// Those in the lanes of `diffuse` are diffuse. Returns the lanes with a first one.
    pub(crate) fn keep_vertices(
        &self,
        bounce: u32,
        surfaces: &SurfacePacket<S>,
        hit: u64,
        diffuse: u64,
        memory: &mut PathMemory,
    ) -> u64 {
        let (_, skip) = surfaces.leave(self.simd, -self.paths.d);
        // Where roulette is played, the density of paths also depends on how many survive.
        let settings = self.settings;
        let may_open = bounce < settings.max_depth
            && settings.min_bounces.is_none_or(|bounces| bounce <= bounces);
        let mut first = 0;
        for lane in lanes(hit) {
            let link = &mut memory.links[self.paths.index[lane] as usize];
            let comes_first = self.paths.emission_counts[lane] > 0.0;
            let is_diffuse = diffuse >> lane & 1 == 1;
            let vertex = || {
                let wo = -self.paths.d.lane(lane);
                let towards = |v: Vec3| if v.dot(wo) < 0.0 { -v } else { v };
                Vertex {
                    p: surfaces.departure.p.lane(lane),
                    ng: towards(surfaces.departure.ng.lane(lane)),
                    n: towards(surfaces.n.lane(lane)),
                    offset: surfaces.departure.distance[lane],
                }
            };
            match link.state {
                State::None if may_open && comes_first && is_diffuse => {
                    link.state = State::Open;
                    link.bounce = bounce;
                    link.from = vertex();
                    link.skip = skip[lane];
                    first |= 1 << lane;
                }
                State::Open if is_diffuse && !surfaces.is_turned(lane) => {
                    link.state = State::Shared;
                    link.to = vertex();
                }
                State::Open => link.state = State::Own,
                _ => {}
            }
        }
        first
    }

    /// Keeps the throughputs of the lanes in `first`, whose next rays are sampled.
    pub(crate) fn keep_throughputs(&self, first: u64, memory: &mut PathMemory) {
        for lane in lanes(first) {
            let link = &mut memory.links[self.paths.index[lane] as usize];
            link.throughput = self.paths.throughput.lane(lane);
            // Where a channel is 0, the path cannot tell the others what it has found in it.
            let least = link.throughput.min_element();
            if least.is_nan() || least <= 0.0 {
                link.state = State::None;
            }
        }
    }
}

/// Shares between the pixels of each block of eight, sample by sample, what their paths have found;
/// pixels after the last whole block keep their own.
///
/// `radiance` has the `samples` of the first pixel, then those of the second one.
#[inline(never)]
pub(crate) fn share<S: Simd>(
    simd: S,
    scene: &PathScene<'_>,
    samples: usize,
    memory: &mut PathMemory,
    fallback: &mut dyn ScalarFallback,
    radiance: &mut [Spectrum],
) {
    simd.vectorize(
        #[inline(always)]
        || {
            let mut rays = mem::take(&mut memory.shadows);
            let mut traced = mem::take(&mut memory.traced);
            let mut nearby = mem::take(&mut memory.nearby);
            let mut pending = Vec::with_capacity(MAX_PENDING + LANES);
            rays.clear(1);
            let blocks = radiance.len() / (LANES * samples.max(1)) * samples;
            let counts = memory.counts;
            for number in 0..blocks {
                let block = Block {
                    first: number / samples * samples * LANES + number % samples,
                    samples,
                };
                block.send_rays(simd, memory, radiance, &mut rays, &mut pending);
                if pending.len() < MAX_PENDING && number + 1 < blocks {
                    continue;
                }
                rays.trace(
                    simd,
                    scene,
                    false,
                    &mut nearby,
                    &mut traced,
                    memory,
                    fallback,
                );
                for (i, found) in pending.drain(..).enumerate() {
                    let (densities, visible) = rays.sample(i);
                    found.divide(densities, visible, memory, radiance);
                }
                rays.clear(1);
            }
            // They do not lead to lights.
            memory.counts.light_rays = counts.light_rays;
            memory.counts.reuse_rays += memory.counts.rays - counts.rays;
            memory.shadows = rays;
            memory.traced = traced;
            memory.nearby = nearby;
        },
    )
}

/// Sample after sample of eight pixels: the paths `first`, `first + samples` and so on.
#[derive(Clone, Copy)]
struct Block {
    first: usize,
    samples: usize,
}

/// What the path in `lane` of a block has found.
struct Found {
    block: Block,
    lane: usize,
    /// The radiance that leaves the surface.
    radiance: Vec3,
}

impl Block {
    #[inline(always)]
    fn path(self, lane: usize) -> usize {
        self.first + lane * self.samples
    }

    /// Sends rays from the first surface of all paths to the second one of each, and takes away
    /// what each has found there.
    #[inline(always)]
    fn send_rays<S: Simd>(
        self,
        simd: S,
        memory: &PathMemory,
        radiance: &mut [Spectrum],
        rays: &mut ShadowQueue,
        pending: &mut Vec<Found>,
    ) {
        let links: [&Link; LANES] = std::array::from_fn(|lane| &memory.links[self.path(lane)]);
        // Paths find light of as many bounces only where they have as many left.
        let partners = |link: &Link| {
            let is_partner =
                |other: &Link| other.state != State::None && other.bounce == link.bounce;
            let mask = |(lane, other): (usize, &&Link)| u64::from(is_partner(other)) << lane;
            links.iter().enumerate().map(mask).sum::<u64>()
        };
        let zero = f64x8::splat(simd, 0.0);
        let p = Vec3x8::gather(simd, |lane| links[lane].from.p.to_array());
        let n = Vec3x8::gather(simd, |lane| links[lane].from.n.to_array());
        let ng = Vec3x8::gather(simd, |lane| links[lane].from.ng.to_array());
        let distance = f64x8::from_fn(simd, |lane| links[lane].from.offset);
        let skip = f64x8::from_fn(simd, |lane| links[lane].skip);
        let departure = Departure { p, ng, distance };
        let o = p + ng * distance;
        for (lane, link) in links.into_iter().enumerate() {
            let path = self.path(lane);
            let Some(direct) = memory.direct[path].filter(|_| link.state == State::Shared) else {
                continue;
            };
            let found = Vec3::from((radiance[path] - direct).to_array()) / link.throughput;
            if found == Vec3::ZERO || !found.is_finite() {
                continue;
            }
            let to = link.to;
            let between = Vec3x8::splat(simd, to.p) - p;
            let squared = between.dot(between);
            let at_to = [to.ng, to.n].map(|n| -between.dot(Vec3x8::splat(simd, n)));
            let at_from = [ng, n].map(|n| between.dot(n));
            let faces = zero.simd_lt(at_to[0])
                & zero.simd_lt(at_to[1])
                & zero.simd_lt(at_from[0])
                & zero.simd_lt(at_from[1]);
            let density = at_from[1] * at_to[0] / (squared * squared);
            // In scenes of extreme size it overflows or rounds to 0.
            let sound = zero.simd_lt(density) & density.simd_lt(f64x8::splat(simd, f64::INFINITY));
            let may_see = partners(link) & (faces & sound).to_bitmask();
            let others = may_see & !(1 << lane);
            if others == may_see || others == 0 {
                continue;
            }
            let d = Vec3x8::splat(simd, to.off_surface()) - o;
            let length = d.length();
            let packet = RayPacket {
                o,
                d: d / length,
                min_t: zero,
                max_t: departure.shadow_end(length),
            };
            // The queue keeps a light for each lane; here it is the density.
            rays.push(
                0,
                &packet,
                skip,
                others,
                Vec3x8 {
                    x: density,
                    y: zero,
                    z: zero,
                },
            );
            radiance[path] = direct;
            pending.push(Found {
                block: self,
                lane,
                radiance: found,
            });
        }
    }
}

impl Found {
    /// Divides it among the paths in the lanes of `visible`, and its own, in proportion to
    /// `densities`.
    #[inline(always)]
    fn divide(
        &self,
        densities: &[f64; LANES],
        visible: u64,
        memory: &PathMemory,
        radiance: &mut [Spectrum],
    ) {
        let sharing = visible | 1 << self.lane;
        let total: f64 = lanes(sharing).map(|lane| densities[lane]).sum();
        for lane in lanes(sharing) {
            let path = self.block.path(lane);
            let share = self.radiance * (densities[lane] / total);
            let light = memory.links[path].throughput * share;
            radiance[path] += Spectrum::from(light.to_array());
        }
    }
}
