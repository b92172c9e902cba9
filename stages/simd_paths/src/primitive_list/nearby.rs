//! The few primitives that the rays of a beam may hit.
//!
//! The camera rays of a pixel, or the shadow rays from one spot to one light, pass the same few
//! primitives. These are found once for all the rays, which then test them as a list.

use super::{ListedTriangle, PrimitiveList};
use crate::beam::{BeamLanes, RayBundle};
use crate::{Beam, PathScene, ScalarFallback};
use fearless_simd::Simd;
use kit::{PrimId, Primitive};

/// The list, and memory that a thread reuses.
#[derive(Clone, Debug, Default)]
pub(crate) struct NearbyPrimitives {
    list: PrimitiveList,
    ids: Vec<PrimId>,
    /// For each vertex of the scene's list the half-spaces that it is outside of, and its number in
    /// this list.
    vertices: Vec<(u64, Option<u32>)>,
}

/// The largest number of primitives that a tree may find. Most of them are then left out.
const MAX_FOUND: usize = 128;

/// The largest number of primitives in the list of a scene with a tree: with more, tracing each ray
/// through the tree takes less time.
const MAX_LISTED: usize = 32;

impl NearbyPrimitives {
    /// All primitives that `rays` may hit; `None` if they are too many or the rays go apart too
    /// far.
    #[inline(always)]
    pub(crate) fn find<S: Simd>(
        &mut self,
        simd: S,
        scene: &PathScene<'_>,
        rays: &RayBundle<'_>,
        fallback: &mut dyn ScalarFallback,
    ) -> Option<&PrimitiveList> {
        let beam = Beam::around(simd, rays)?;
        self.find_in(simd, scene, &beam, MAX_FOUND, fallback)
    }

    /// All primitives of which a part is in `beam`, and few others. `None` if there are more than
    /// `most`, including those that are only near, or too many for a list.
    #[inline(never)]
    pub(crate) fn find_in<S: Simd>(
        &mut self,
        simd: S,
        scene: &PathScene<'_>,
        beam: &Beam,
        most: usize,
        fallback: &mut dyn ScalarFallback,
    ) -> Option<&PrimitiveList> {
        simd.vectorize(
            #[inline(always)]
            || {
                let lanes = BeamLanes::new(simd, beam);
                self.list.clear();
                if let Some(all) = &scene.list {
                    self.keep_of(all, &lanes);
                    return Some(&self.list);
                }
                self.ids.clear();
                if !fallback.primitives_in(beam, most, &mut self.ids) {
                    return None;
                }
                self.ids.sort_unstable();
                self.ids.dedup();
                if let Some(large) = &scene.large {
                    self.keep_of(&large.list, &lanes);
                }
                for &id in &self.ids {
                    if scene.large.as_ref().is_some_and(|large| large.has(id)) {
                        continue;
                    }
                    match scene.lit.scene.primitive(id) {
                        Primitive::Triangle(t) => {
                            let vertices = [t.p0, t.p1, t.p2];
                            let mut outside = lanes.outside(t.p0);
                            outside &= lanes.outside(t.p1);
                            outside &= lanes.outside(t.p2);
                            if outside == 0 {
                                let first = self.list.vertices.len() as u32;
                                self.list.vertices.extend(vertices);
                                self.list.triangles.push(ListedTriangle {
                                    id: id.0,
                                    vertices: [first, first + 1, first + 2],
                                });
                            }
                        }
                        Primitive::Sphere(sphere) => {
                            if !lanes.is_outside(sphere) {
                                self.list.spheres.push((id.0, *sphere));
                            }
                        }
                    }
                    if self.list.len() > MAX_LISTED {
                        return None;
                    }
                }
                self.list.sort();
                Some(&self.list)
            },
        )
    }

    /// Adds the primitives of `all` of which a part is in the beam.
    #[inline(always)]
    fn keep_of<S: Simd>(&mut self, all: &PrimitiveList, beam: &BeamLanes<S>) {
        self.vertices.clear();
        for &p in &all.vertices {
            self.vertices.push((beam.outside(p), None));
        }
        for triangle in &all.triangles {
            let mut outside = u64::MAX;
            for i in triangle.vertices {
                outside &= self.vertices[i as usize].0;
            }
            if outside != 0 {
                continue;
            }
            let mut vertices = triangle.vertices;
            for i in &mut vertices {
                let (_, place) = &mut self.vertices[*i as usize];
                if place.is_none() {
                    *place = Some(self.list.vertices.len() as u32);
                    self.list.vertices.push(all.vertices[*i as usize]);
                }
                *i = place.expect("it was set");
            }
            self.list.triangles.push(ListedTriangle {
                vertices,
                ..*triangle
            });
        }
        for (id, sphere) in &all.spheres {
            if !beam.is_outside(sphere) {
                self.list.spheres.push((*id, *sphere));
            }
        }
    }
}
