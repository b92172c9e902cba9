//! The region of space that contains a bundle of rays.

use crate::ray_packet::RayPacket;
use crate::vec3x8::{LANES, Vec3x8};
use crate::{Beam, HALF_SPACES, HalfSpace, PathStart, View};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{Sphere, Vec3};
use lanes::camera::CameraAxes;

/// Rays in structure-of-arrays layout. The arrays have a multiple of eight elements.
pub(crate) struct RayBundle<'a> {
    /// The number of rays, at least 1.
    pub(crate) count: usize,
    pub(crate) o: [&'a [f64]; 3],
    pub(crate) d: [&'a [f64]; 3],
    /// The start of all ranges.
    pub(crate) min_t: f64,
    pub(crate) max_t: RangeEnds<'a>,
    /// The numbers of the primitives that the rays cannot hit, or `NONE`.
    pub(crate) skip: &'a [f64],
}

impl RayBundle<'_> {
    /// Eight rays from number `first`, and what they skip. Lanes after the last ray have any
    /// numbers.
    #[inline(always)]
    pub(crate) fn packet<S: Simd>(&self, simd: S, first: usize) -> (RayPacket<S>, f64x8<S>) {
        let rays = RayPacket {
            o: load_vector(simd, &self.o, first),
            d: load_vector(simd, &self.d, first),
            min_t: f64x8::splat(simd, self.min_t),
            max_t: self.max_t.load(simd, first),
        };
        (rays, load(simd, self.skip, first))
    }

    /// The lanes of [`RayBundle::packet`] that have a ray, one bit each.
    #[inline(always)]
    pub(crate) fn active(&self, first: usize) -> u64 {
        (1 << (self.count - first).min(LANES)) - 1
    }
}

/// The ends of the ranges of a [`RayBundle`].
#[derive(Clone, Copy)]
pub(crate) enum RangeEnds<'a> {
    All(f64),
    Each(&'a [f64]),
}

impl RangeEnds<'_> {
    /// The ends of eight rays from number `first`.
    #[inline(always)]
    fn load<S: Simd>(self, simd: S, first: usize) -> f64x8<S> {
        match self {
            RangeEnds::All(max_t) => f64x8::splat(simd, max_t),
            RangeEnds::Each(ends) => load(simd, ends, first),
        }
    }
}

/// The largest number of rays in a beam, a multiple of eight: fewer are closer to each other, but
/// each beam takes time.
pub(crate) const BEAM_SIZE: usize = 64;

/// The rays of a beam have slopes of at most this size against its axis. Wider beams would contain
/// most of a scene.
const MAX_SLOPE: f64 = 2.0;

/// The share of a sum's terms by which a region is enlarged: much more than the rounding errors, so
/// that a point that rounding moved out of the region is still in it.
const MARGIN: f64 = 1e-10;

/// The share of a pixel by which [`Beam::through`] is wider on each side.
const PIXEL_MARGIN: f64 = 1e-3;

/// The least angle of a pixel, and the least cosine between a ray and the axis, in
/// [`Beam::through`].
const MIN_WIDTH: f64 = 1e-8;
const MIN_COSINE: f64 = 0.1;

impl Beam {
    /// The beam around `rays`: along the axis on which the first ray advances most, every ray is
    /// between two slopes on each of the other axes. `None` if the rays go apart too far.
    #[inline(never)]
    pub(crate) fn around<S: Simd>(simd: S, rays: &RayBundle<'_>) -> Option<Beam> {
        simd.vectorize(
            #[inline(always)]
            || {
                let first = [0, 1, 2].map(|axis| rays.d[axis][0]);
                let size = first.map(f64::abs);
                let w = if size[2] >= size[0] && size[2] >= size[1] {
                    2
                } else {
                    usize::from(size[1] >= size[0])
                };
                let sides = [(w + 1) % 3, (w + 2) % 3];
                let sign = 1.0_f64.copysign(first[w]);
                let slopes = slopes(simd, rays, w, sides, sign)?;

                let (low, high) = (
                    f64x8::splat(simd, f64::INFINITY),
                    f64x8::splat(simd, -f64::INFINITY),
                );
                let (mut starts, mut ends) = ([low; 2], [high; 2]);
                let (mut near, mut far, mut reach) = (low, high, high);
                for i in (0..rays.count).step_by(LANES) {
                    let here = first_lanes(simd, rays.count - i);
                    let ow = load(simd, rays.o[w], i) * sign;
                    let dw = load(simd, rays.d[w], i) * sign;
                    let max_t = rays.max_t.load(simd, i);
                    let (start, end) = (ow + dw * rays.min_t, ow + dw * max_t);
                    near = here.select(near.min_precise(start), near);
                    far = here.select(far.max_precise(end), far);
                    let mut sum = ow.abs() * MAX_SLOPE;
                    for side in 0..2 {
                        let o = load(simd, rays.o[sides[side]], i);
                        let [least, greatest] = slopes[side];
                        starts[side] =
                            here.select(starts[side].min_precise(o - ow * least), starts[side]);
                        ends[side] =
                            here.select(ends[side].max_precise(o - ow * greatest), ends[side]);
                        sum += o.abs();
                    }
                    reach = here.select(reach.max_precise(sum), reach);
                }
                let margin = MARGIN * greatest_of(reach);
                let along_w = axis_vector(w) * sign;
                let mut half_spaces = [HalfSpace {
                    normal: Vec3::ZERO,
                    offset: 0.0,
                }; HALF_SPACES];
                for side in 0..2 {
                    let across = axis_vector(sides[side]);
                    let [least, greatest] = slopes[side];
                    half_spaces[2 * side] = HalfSpace {
                        normal: across - along_w * greatest,
                        offset: greatest_of(ends[side]) + margin,
                    };
                    half_spaces[2 * side + 1] = HalfSpace {
                        normal: along_w * least - across,
                        offset: greatest_of(-starts[side]) + margin,
                    };
                }
                let (near, far) = (-greatest_of(-near), greatest_of(far));
                half_spaces[4] = HalfSpace {
                    normal: along_w,
                    offset: far + MARGIN * far.abs() + margin,
                };
                half_spaces[5] = HalfSpace {
                    normal: -along_w,
                    offset: MARGIN * near.abs() - near + margin,
                };
                Some(Beam { half_spaces })
            },
        )
    }

    /// The beam around all camera rays through the pixels of `starts`, in a view without a lens:
    /// a pyramid between the near and the far clip distance. `None` if it would be too wide or too
    /// narrow, or if there are no pixels.
    pub(crate) fn through(view: &View, starts: &[PathStart]) -> Option<Beam> {
        let (camera, film) = (&view.camera, view.film);
        let mut low = [f64::INFINITY; 2];
        let mut high = [-f64::INFINITY; 2];
        for &PathStart { pixel: (x, y), .. } in starts {
            for (axis, at) in [x, y].into_iter().enumerate() {
                low[axis] = low[axis].min(f64::from(at) - PIXEL_MARGIN);
                high[axis] = high[axis].max(f64::from(at) + 1.0 + PIXEL_MARGIN);
            }
        }
        let axes = CameraAxes::of(camera, 0.0);
        let size = [film.w, film.h].map(f64::from);
        let corners = [
            [low[0], low[1]],
            [high[0], low[1]],
            [high[0], high[1]],
            [low[0], high[1]],
        ];
        let corners = corners.map(|[x, y]| {
            let d = axes.direction([x / size[0], y / size[1]]);
            Vec3::new(d.x, d.y, d.z)
        });
        let axis = corners.into_iter().sum::<Vec3>().normalize();
        let mut least_cosine = 1.0_f64;
        let mut half_spaces = [HalfSpace {
            normal: -axis,
            offset: 0.0,
        }; HALF_SPACES];
        for (i, corner) in corners.into_iter().enumerate() {
            let normal = corner.cross(corners[(i + 1) % 4]);
            // The rounding errors of directions are much smaller than the margin of a pixel.
            let pixels = high[i % 2] - low[i % 2];
            let is_in_bounds =
                normal.length() > MIN_WIDTH * pixels && corner.dot(axis) > MIN_COSINE;
            if !is_in_bounds {
                return None;
            }
            least_cosine = least_cosine.min(corner.dot(axis));
            half_spaces[i].normal = -normal * normal.dot(axis).signum();
        }
        half_spaces[4].offset = -camera.n_clip * least_cosine * (1.0 - MARGIN);
        half_spaces[5] = HalfSpace {
            normal: axis,
            offset: camera.f_clip * (1.0 + MARGIN),
        };
        for HalfSpace { normal, offset } in &mut half_spaces {
            let margin = MARGIN * normal.length() * camera.pos.length();
            *offset += normal.dot(camera.pos) + margin;
        }
        Some(Beam { half_spaces })
    }
}

/// The least and the greatest slope against axis `w` on each of `sides`. `None` if a ray does not
/// advance along `w`, or if a slope is too large.
#[inline(always)]
fn slopes<S: Simd>(
    simd: S,
    rays: &RayBundle<'_>,
    w: usize,
    sides: [usize; 2],
    sign: f64,
) -> Option<[[f64; 2]; 2]> {
    let mut least = [f64x8::splat(simd, f64::INFINITY); 2];
    let mut greatest = [f64x8::splat(simd, -f64::INFINITY); 2];
    for i in (0..rays.count).step_by(LANES) {
        let here = first_lanes(simd, rays.count - i);
        let dw = load(simd, rays.d[w], i) * sign;
        let advances = f64x8::splat(simd, 0.0).simd_lt(dw);
        if (here & !advances).to_bitmask() != 0 {
            return None;
        }
        let inverse = f64x8::splat(simd, 1.0) / dw;
        for side in 0..2 {
            let slope = load(simd, rays.d[sides[side]], i) * inverse;
            let widest = f64x8::splat(simd, MAX_SLOPE);
            if (here & !slope.abs().simd_le(widest)).to_bitmask() != 0 {
                return None;
            }
            least[side] = here.select(least[side].min_precise(slope), least[side]);
            greatest[side] = here.select(greatest[side].max_precise(slope), greatest[side]);
        }
    }
    let mut slopes = [[0.0; 2]; 2];
    for side in 0..2 {
        slopes[side] = [
            -greatest_of(-least[side]) - MARGIN,
            greatest_of(greatest[side]) + MARGIN,
        ];
    }
    Some(slopes)
}

/// The lanes below `count`.
#[inline(always)]
fn first_lanes<S: Simd>(simd: S, count: usize) -> mask64x8<S> {
    mask64x8::from_bitmask(simd, (1 << count.min(LANES)) - 1)
}

#[inline(always)]
fn load<S: Simd>(simd: S, numbers: &[f64], first: usize) -> f64x8<S> {
    f64x8::from_slice(simd, &numbers[first..first + LANES])
}

#[inline(always)]
fn load_vector<S: Simd>(simd: S, fields: &[&[f64]; 3], first: usize) -> Vec3x8<S> {
    Vec3x8 {
        x: load(simd, fields[0], first),
        y: load(simd, fields[1], first),
        z: load(simd, fields[2], first),
    }
}

#[inline(always)]
fn greatest_of<S: Simd>(lanes: f64x8<S>) -> f64 {
    let mut greatest = lanes[0];
    for lane in 1..LANES {
        greatest = greatest.max(lanes[lane]);
    }
    greatest
}

#[inline(always)]
fn axis_vector(axis: usize) -> Vec3 {
    [Vec3::X, Vec3::Y, Vec3::Z][axis]
}

/// The half-spaces of a beam, one per lane; no point is outside of the others.
pub(crate) struct BeamLanes<S: Simd> {
    simd: S,
    normal: Vec3x8<S>,
    offset: f64x8<S>,
    length: f64x8<S>,
}

impl<S: Simd> BeamLanes<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, beam: &Beam) -> BeamLanes<S> {
        let mut half_spaces = [HalfSpace {
            normal: Vec3::ZERO,
            offset: f64::INFINITY,
        }; LANES];
        half_spaces[..HALF_SPACES].copy_from_slice(&beam.half_spaces);
        let normal = Vec3x8::gather(simd, |lane| half_spaces[lane].normal.to_array());
        BeamLanes {
            simd,
            normal,
            offset: f64x8::from_fn(simd, |lane| half_spaces[lane].offset),
            length: normal.length(),
        }
    }

    /// The half-spaces, one bit each, that `p` is outside of for certain.
    #[inline(always)]
    pub(crate) fn outside(&self, p: Vec3) -> u64 {
        self.outside_by(p, f64x8::splat(self.simd, 0.0))
    }

    /// Whether the whole sphere is outside for certain.
    #[inline(always)]
    pub(crate) fn is_outside(&self, sphere: &Sphere) -> bool {
        let reach = self.length * (sphere.radius.abs() * (1.0 + MARGIN));
        self.outside_by(sphere.center, reach) != 0
    }

    /// The half-spaces that all points up to a distance of `reach` from `p` are outside of.
    #[inline(always)]
    fn outside_by(&self, p: Vec3, reach: f64x8<S>) -> u64 {
        let terms = self.normal * Vec3x8::splat(self.simd, p);
        let size = terms.x.abs() + terms.y.abs() + terms.z.abs();
        let least = terms.x + terms.y + terms.z - size * MARGIN - reach;
        self.offset.simd_lt(least).to_bitmask()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{Camera, FilmSize, PixelSampler};

    /// Cameras near the origin and far away, with wide and narrow fields of view.
    fn views() -> Vec<View> {
        let mut views = Vec::new();
        for (pos, h_fov) in [(Vec3::ZERO, 60.0), (Vec3::new(4e5, -3.0, 0.1), 8.0)] {
            for target in [pos + Vec3::Z, pos + Vec3::new(0.3, -1.0, 0.2)] {
                let camera = Camera {
                    pos,
                    c2w: Camera::look_at(pos, target, Vec3::new(0.1, 1.0, 0.3)).unwrap(),
                    h_fov,
                    v_fov: 0.7 * h_fov,
                    n_clip: 0.25,
                    f_clip: 900.0,
                };
                views.push(View {
                    camera,
                    film: FilmSize { w: 480, h: 360 },
                    has_lens: false,
                    centered: false,
                });
            }
        }
        views
    }

    fn start(x: u32, y: u32) -> PathStart {
        PathStart {
            pixel: (x, y),
            sampler: PixelSampler::new(x, y, 1),
        }
    }

    /// The point at `t` on the camera ray through `at`, in pixels.
    fn point(view: &View, at: [f64; 2], t: f64) -> Vec3 {
        let axes = CameraAxes::of(&view.camera, 0.0);
        let d = axes.direction([at[0] / 480.0, at[1] / 360.0]);
        view.camera.pos + t * Vec3::new(d.x, d.y, d.z)
    }

    #[test]
    fn a_beam_through_pixels_is_around_their_rays_and_no_others() {
        for view in views() {
            let starts = [start(100, 200), start(107, 200), start(103, 203)];
            let beam = Beam::through(&view, &starts).expect("a narrow beam");
            let is_inside = |p: Vec3| {
                let mut half_spaces = beam.half_spaces.iter();
                half_spaces.all(|h| h.normal.dot(p) <= h.offset)
            };
            let mut sampler = PixelSampler::new(3, 4, 5);
            for _ in 0..1000 {
                let u = sampler.next_2d();
                // On the borders, too.
                let u = (1.2 * u - 0.1).clamp(kit::Vec2::ZERO, kit::Vec2::ONE);
                let at = [100.0 + 8.0 * u.x, 200.0 + 4.0 * u.y];
                for t in [0.25, 0.3, 7.0, 900.0] {
                    assert!(is_inside(point(&view, at, t)), "{view:?} {at:?} {t}");
                }
                for (x, y) in [(-8.1, 0.0), (8.1, 0.0), (0.0, -4.1), (0.0, 4.1)] {
                    let beside = [at[0] + x, at[1] + y];
                    assert!(!is_inside(point(&view, beside, 7.0)), "{beside:?}");
                }
                assert!(!is_inside(point(&view, at, 0.2)));
                assert!(!is_inside(point(&view, at, 910.0)));
            }
        }
    }

    #[test]
    fn there_is_no_beam_through_pixels_that_are_too_small_or_too_wide() {
        let view = views().swap_remove(0);
        assert_eq!(Beam::through(&view, &[]), None);
        for h_fov in [1e-7, 179.0] {
            let mut view = view;
            view.camera.h_fov = h_fov;
            let starts = [start(0, 0), start(479, 359)];
            assert_eq!(Beam::through(&view, &starts), None);
        }
    }
}
