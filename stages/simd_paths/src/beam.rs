// BEGIN SOLUTION(part6.task2)
//! The region of space that contains a bundle of rays.

use crate::vec3x8::{LANES, Vec3x8};
use crate::{Beam, HALF_SPACES, HalfSpace};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{Sphere, Vec3};

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

/// The ends of the ranges of a [`RayBundle`].
#[derive(Clone, Copy)]
pub(crate) enum RangeEnds<'a> {
    All(f64),
    Each(&'a [f64]),
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

impl Beam {
    /// The beam around `rays`: along the axis on which the first ray advances most, every ray is
    /// between two slopes on each of the other axes. `None` if the rays go apart too far.
    #[inline(always)]
    pub(crate) fn around<S: Simd>(simd: S, rays: &RayBundle<'_>) -> Option<Beam> {
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
            let max_t = match rays.max_t {
                RangeEnds::All(max_t) => f64x8::splat(simd, max_t),
                RangeEnds::Each(ends) => load(simd, ends, i),
            };
            let (start, end) = (ow + dw * rays.min_t, ow + dw * max_t);
            near = here.select(near.min_precise(start), near);
            far = here.select(far.max_precise(end), far);
            let mut sum = ow.abs() * MAX_SLOPE;
            for side in 0..2 {
                let o = load(simd, rays.o[sides[side]], i);
                let [least, greatest] = slopes[side];
                starts[side] = here.select(starts[side].min_precise(o - ow * least), starts[side]);
                ends[side] = here.select(ends[side].max_precise(o - ow * greatest), ends[side]);
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
// END SOLUTION(part6.task2)
