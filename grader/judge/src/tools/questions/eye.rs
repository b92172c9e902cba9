//! The rays of the pictures: how a camera makes them is what `part1.task2` is about, so a handout
//! has them as numbers.

use crate::tools::packed_truth;
use kit::{Ray, Vec3};
use serde::{Deserialize, Serialize};
use wire::picture::View;
use wire::work::Xyz;

/// Width and height of the pictures that are cases.
pub(crate) const SIZE: [u32; 2] = [160, 120];

/// The rays through the pixels' centres, row by row from the bottom left, of a camera at `pos`.
pub(crate) fn picture_rays(pos: Vec3, target: Vec3, h_fov: f64) -> Vec<Ray> {
    let input: (Xyz, Xyz, f64) = (pos.into(), target.into(), h_fov);
    // BEGIN SOLUTION(part1.task2)
    let c2w =
        kit::Camera::look_at(pos, target, Vec3::Y).expect("the pictures do not look along +y");
    let half_w = kit::camera::half_tan(h_fov);
    let [w, h] = SIZE.map(f64::from);
    let mut towards = Vec::new();
    for y in 0..SIZE[1] {
        let up = (2.0 * (f64::from(y) + 0.5) / h - 1.0) * half_w * h / w;
        for x in 0..SIZE[0] {
            let right = (2.0 * (f64::from(x) + 0.5) / w - 1.0) * half_w;
            towards.push(pos + c2w * Vec3::new(right, up, -1.0) - pos);
        }
    }
    let bends = packed_truth::record("part1.task2", "picture", &input, Bends::of(&towards));
    // STUB: let bends: Bends = packed_truth::find("part1.task2", "picture", &input);
    // END SOLUTION(part1.task2)
    let directions = bends.vectors().into_iter().map(Vec3::normalize);
    directions.map(|d| Ray::new(pos, d)).collect()
}

/// Vectors that nearly are a linear function of their number, such as those of a row of pixels, as
/// the second differences of their components in [`UNIT`]s: small whole numbers.
#[derive(Debug, Serialize, Deserialize)]
struct Bends(Vec<i64>);

/// All components are multiples of it: they are differences of numbers from 1 to 16, or lie in that
/// range themselves.
const UNIT: f64 = 1.0 / (1_u64 << 56) as f64;

impl Bends {
    // BEGIN SOLUTION(part1.task2)
    fn of(vectors: &[Vec3]) -> Bends {
        let mut bends = Vec::new();
        for axis in 0..3 {
            let (mut last, mut step) = (0_i64, 0_i64);
            for v in vectors {
                let units = (v[axis] / UNIT) as i64;
                assert!(
                    units as f64 * UNIT == v[axis],
                    "{v} is no multiple of the unit"
                );
                let next_step = units.wrapping_sub(last);
                bends.push(next_step.wrapping_sub(step));
                (last, step) = (units, next_step);
            }
        }
        Bends(bends)
    }
    // END SOLUTION(part1.task2)

    fn vectors(&self) -> Vec<Vec3> {
        let count = self.0.len() / 3;
        let mut vectors = vec![Vec3::ZERO; count];
        for (axis, bends) in self.0.chunks_exact(count.max(1)).enumerate() {
            let (mut units, mut step) = (0_i64, 0_i64);
            for (v, bend) in vectors.iter_mut().zip(bends) {
                step = step.wrapping_add(*bend);
                units = units.wrapping_add(step);
                v[axis] = units as f64 * UNIT;
            }
        }
        vectors
    }
}

/// The view of a camera at `eye` that looks at `target`, with +y up, for panels of a `size`.
pub(crate) fn view(eye: Xyz, target: Xyz, h_fov: f64, size: [u32; 2]) -> View {
    let input = (eye, target, h_fov, size);
    // BEGIN SOLUTION(part1.task2)
    let c2w = kit::Camera::look_at(eye.into(), target.into(), Vec3::Y)
        .expect("the pictures do not look along +y");
    let [w, h] = size.map(f64::from);
    let half_w = kit::camera::half_tan(h_fov);
    let [right, up] = [c2w.x_axis * half_w, c2w.y_axis * (half_w * h / w)];
    let view = View {
        eye,
        corner: (-c2w.z_axis - right - up).into(),
        right: (right * (2.0 / w)).into(),
        up: (up * (2.0 / h)).into(),
    };
    packed_truth::record("part1.task2", "view", &input, view)
    // STUB: packed_truth::find("part1.task2", "view", &input)
    // END SOLUTION(part1.task2)
}
