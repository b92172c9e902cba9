// BEGIN SOLUTION(part6.task2)
//! One bounce of eight paths, as the stage `global` computes it.

use crate::lanes::lanes;
use crate::material_class::MaterialClass;
use crate::queue::PathLanes;
use crate::ray_packet::{HitPacket, RayPacket, prim_id};
use crate::surface_packet::SurfacePacket;
use crate::vec3x8::{LANES, Vec3x8};
use crate::{PathScene, PathSettings, ScalarFallback, Workspace};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::sampler::PixelSamplers;
use kit::{Spectrum, Vec3};

/// Eight paths that are traced together.
pub(crate) struct PathPacket<'a, S: Simd> {
    pub(crate) simd: S,
    pub(crate) scene: &'a PathScene<'a>,
    pub(crate) settings: &'a PathSettings,
    /// The lanes that hold a path, one bit each.
    pub(crate) alive: u64,
    pub(crate) paths: PathLanes<S>,
    pub(crate) samplers: PixelSamplers<LANES>,
}

impl<S: Simd> PathPacket<'_, S> {
    /// Traces ray number `bounce` of each path, counted from 1, in `range`; accumulates the
    /// radiance at its hit and samples the next ray. Returns the lanes whose paths continue.
    #[inline(always)]
    pub(crate) fn bounce(
        &mut self,
        bounce: u32,
        range: [f64; 2],
        workspace: &mut Workspace,
        fallback: &mut dyn ScalarFallback,
    ) -> u64 {
        let simd = self.simd;
        let zero = f64x8::splat(simd, 0.0);
        let rays = RayPacket {
            o: self.paths.o,
            d: self.paths.d,
            min_t: f64x8::splat(simd, range[0]),
            max_t: f64x8::splat(simd, range[1]),
        };
        let hits = self.closest(&rays, workspace, fallback);
        let hit = self.alive & !hits.is_none().to_bitmask();
        if self.scene.has_background && hit != self.alive {
            self.add_background(self.alive & !hit, workspace);
        }
        if hit == 0 {
            return 0;
        }
        let ids: [usize; LANES] = std::array::from_fn(|lane| hits.prim[lane].max(0.0) as usize);
        let materials = std::array::from_fn(|lane| self.scene.material_of(ids[lane]));
        let [diffuse, emissive, other] = lanes_by_class(&materials, hit);
        let color = Vec3x8::gather(simd, |lane| materials[lane].1.to_array());
        let mut surfaces =
            SurfacePacket::at(simd, self.scene, &rays, &hits, &ids, hit, color, fallback);
        if self.settings.has_textures {
            // A texture does not change emission, but it is looked up on every surface.
            for lane in lanes(diffuse | emissive) {
                let tint = fallback.texture_color(&surfaces.hit(lane, &hits));
                if diffuse >> lane & 1 == 1 {
                    let color = surfaces.color.lane(lane) * Vec3::from(tint.to_array());
                    surfaces.color.set(lane, color.to_array());
                }
            }
        }
        // Before the other lanes draw random numbers: these paths draw their own.
        let scattered =
            (other != 0).then(|| self.scatter_others(other, bounce, &surfaces, &hits, fallback));
        let wo = -self.paths.d;
        if emissive != 0 {
            let counts = f64x8::splat(simd, 0.5).simd_lt(self.paths.emission_counts);
            let in_front = zero.simd_lt(wo.dot(surfaces.departure.ng));
            let visible = mask64x8::from_bitmask(simd, emissive) & counts & in_front;
            let radiance = self.paths.radiance + self.paths.throughput * surfaces.color;
            self.paths.radiance = radiance.masked_or(visible, self.paths.radiance);
        }
        let mut survivors = 0;
        if diffuse != 0 {
            let wo_z = wo.dot(surfaces.n);
            let direct = self.direct(&surfaces, wo_z, diffuse, workspace, fallback);
            let radiance = self.paths.radiance + self.paths.throughput * direct;
            let mask = mask64x8::from_bitmask(simd, diffuse);
            self.paths.radiance = radiance.masked_or(mask, self.paths.radiance);
            if bounce < self.settings.max_depth {
                survivors = self.scatter(bounce, &surfaces, wo_z, diffuse, workspace);
            }
        }
        survivors | scattered.map_or(0, |scattered| self.merge(scattered))
    }

    #[inline(always)]
    fn closest(
        &self,
        rays: &RayPacket<S>,
        workspace: &mut Workspace,
        fallback: &mut dyn ScalarFallback,
    ) -> HitPacket<S> {
        let count = u64::from(self.alive.count_ones());
        workspace.counts.rays += count;
        let skip = self.paths.skip;
        if let Some(list) = &self.scene.list {
            workspace.counts.prim_tests += count * list.len() as u64;
            let scratch = &mut workspace.scratch;
            return list.closest(self.simd, rays, self.alive, skip, scratch, fallback);
        }
        let mut hits = HitPacket::none(self.simd, rays.max_t);
        for lane in lanes(self.alive) {
            if let Some((id, hit)) = fallback.closest(&rays.lane(lane), prim_id(skip[lane])) {
                hits.set(lane, id, hit);
            }
        }
        hits
    }

    /// The lanes in `active` whose ray hits any primitive but `skip`.
    #[inline(always)]
    pub(crate) fn occluded(
        &self,
        rays: &RayPacket<S>,
        active: u64,
        skip: f64x8<S>,
        workspace: &mut Workspace,
        fallback: &mut dyn ScalarFallback,
    ) -> u64 {
        let count = u64::from(active.count_ones());
        workspace.counts.rays += count;
        workspace.counts.light_rays += count;
        if let Some(list) = &self.scene.list {
            let scratch = &mut workspace.scratch;
            let (blocked, tests) = list.occluded(self.simd, rays, active, skip, scratch, fallback);
            workspace.counts.prim_tests += tests;
            return blocked;
        }
        lanes(active)
            .filter(|&lane| fallback.occluded(&rays.lane(lane), prim_id(skip[lane])))
            .map(|lane| 1 << lane)
            .sum()
    }

    /// Adds the background to the lanes in `missed`, unless direct light has counted it.
    fn add_background(&mut self, missed: u64, workspace: &mut Workspace) {
        workspace.counts.background += u64::from(missed.count_ones());
        for lane in lanes(missed).filter(|&lane| self.paths.emission_counts[lane] > 0.5) {
            let light = self.scene.lit.background(self.paths.d.lane(lane));
            let throughput = self.paths.throughput.lane(lane);
            let radiance =
                self.paths.radiance.lane(lane) + throughput * Vec3::from(light.to_array());
            self.paths.radiance.set(lane, radiance.to_array());
        }
    }
}

/// The lanes in `hit` by the class of their material: diffuse, emission, other.
#[inline(always)]
fn lanes_by_class(materials: &[(MaterialClass, Spectrum); LANES], hit: u64) -> [u64; 3] {
    let mut masks = [0; 3];
    for (lane, &(class, _)) in materials.iter().enumerate() {
        masks[0] |= u64::from(class == MaterialClass::Diffuse) << lane;
        masks[1] |= u64::from(class == MaterialClass::Emission) << lane;
        masks[2] |= u64::from(class == MaterialClass::Other) << lane;
    }
    [masks[0] & hit, masks[1] & hit, masks[2] & hit]
}
// END SOLUTION(part6.task2)
