//! How the rays of a path are traced: directly, or with everything recorded.

use crate::{Accel, Counters};
use kit::{Hit, PrimId, Ray, Scene, Spectrum, Surface, Vec2, Vec3};

/// Why a ray is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RayRole {
    /// From the camera.
    Camera,
    /// From a surface, along a sampled direction: it continues the path.
    Bounce,
    /// From a surface to a point on a light: is anything between them?
    Shadow,
    /// From a surface, along a direction sampled to find light
    /// ([`DirectSampling::Hemisphere`](crate::DirectSampling::Hemisphere) and
    /// [`Mis`](crate::DirectSampling::Mis)). The path does not continue there.
    Light,
}

impl RayRole {
    /// The role of a ray of a path: the first one comes from the camera.
    #[inline]
    pub(crate) fn of_path(starts_on_surface: bool) -> RayRole {
        if starts_on_surface {
            RayRole::Bounce
        } else {
            RayRole::Camera
        }
    }
}

/// The surface that a ray starts on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayOrigin {
    prim: PrimId,
    /// Geometric normal. On a sphere it points outwards.
    ng: Vec3,
}

impl RayOrigin {
    /// The primitive that a ray along `d` leaves and cannot hit again: a triangle, because it is
    /// flat, or a sphere if the ray goes outwards.
    #[inline]
    pub(crate) fn skip(self, scene: &Scene, d: Vec3) -> Option<PrimId> {
        let is_triangle = (self.prim.0 as usize) < scene.triangles.len();
        (is_triangle || d.dot(self.ng) > 0.0).then_some(self.prim)
    }
}

impl From<&Surface<'_>> for RayOrigin {
    #[inline]
    fn from(surface: &Surface<'_>) -> RayOrigin {
        RayOrigin {
            prim: surface.prim,
            ng: surface.ng,
        }
    }
}

impl From<&Hit> for RayOrigin {
    #[inline]
    fn from(hit: &Hit) -> RayOrigin {
        RayOrigin {
            prim: hit.prim,
            ng: hit.ng,
        }
    }
}

/// Traces single rays through one scene, and counts the tests (not the rays).
///
/// Integrators are generic over it: [`SceneTracer`] compiles to calls of [`Accel`], so recording
/// costs nothing while nothing is recorded.
pub(crate) trait RayTracer {
    /// The closest hit of `ray` with a primitive other than `skip`.
    fn closest(
        &self,
        role: RayRole,
        ray: &Ray,
        skip: Option<PrimId>,
        counters: &mut Counters,
    ) -> Option<Hit>;

    /// The same for rays that are not part of a path: it records nothing.
    fn unrecorded(&self) -> SceneTracer<'_>;

    /// Whether any primitive other than `skip` is hit in the range of `ray`, a shadow ray.
    fn occluded(&self, ray: &Ray, skip: Option<PrimId>, counters: &mut Counters) -> bool;

    /// Called before the camera ray of a sample at `sensor` on the film, in [0, 1]².
    #[inline]
    fn sample_starts(&self, sensor: Vec2) {
        let _ = sensor;
    }

    /// Called when roulette was played at the last hit of a path: with the throughput before and
    /// after; `None` if the path ends.
    #[inline]
    fn roulette_played(&self, throughput: Spectrum, survivor: Option<Spectrum>) {
        let _ = (throughput, survivor);
    }

    /// Called when a sample is finished: with the radiance of its path, and with that of the
    /// sample, in which the light of lamps may be the mean of several camera rays.
    #[inline]
    fn sample_ends(&self, of_path: Spectrum, radiance: Spectrum) {
        let _ = (of_path, radiance);
    }
}

/// Traces rays and records nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SceneTracer<'a> {
    pub(crate) scene: &'a Scene,
    /// Built over `scene`.
    pub(crate) accel: &'a Accel,
}

impl RayTracer for SceneTracer<'_> {
    #[inline]
    fn closest(
        &self,
        _: RayRole,
        ray: &Ray,
        skip: Option<PrimId>,
        counters: &mut Counters,
    ) -> Option<Hit> {
        self.accel
            .closest(self.scene, &mut { *ray }, skip, counters)
    }

    #[inline]
    fn unrecorded(&self) -> SceneTracer<'_> {
        *self
    }

    #[inline]
    fn occluded(&self, ray: &Ray, skip: Option<PrimId>, counters: &mut Counters) -> bool {
        self.accel.occluded(self.scene, ray, skip, counters)
    }
}
