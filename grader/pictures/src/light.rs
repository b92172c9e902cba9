//! Light on the picture of shapes: given code, for a picture that one likes to show.
//!
//! The light comes from the eye, so the brightness of a surface is |n·d|, the cosine between its
//! normal and the ray. The farther a hit, the more of its colour is that of the fog.

use crate::Image;
use crate::tone::tone;
use kit::Vec3;
use wire::picture::{NEAR_AND_FAR, PictureAnswer, PictureWork, Subject, View};

/// The colours of the fog and of the sky far above the line of sight.
const FOG: Vec3 = Vec3::new(0.36, 0.44, 0.52);
const SKY: Vec3 = Vec3::new(0.03, 0.07, 0.19);

/// The colours of surfaces that look up and down.
const UPWARDS: Vec3 = Vec3::new(0.95, 0.58, 0.24);
const DOWNWARDS: Vec3 = Vec3::new(0.30, 0.16, 0.34);

/// The share of the fog at the far end of the range.
const MOST_FOG: f64 = 0.9;

/// The picture of `work` with light: `None` if `work` shows no shapes. The `answer` fits it: the
/// normals of the closest hits, then their distances.
pub fn lit(work: &PictureWork, answer: &PictureAnswer) -> Option<Image> {
    let (Subject::Shapes { view, .. }, [normals, distances]) = (&work.subject, &answer.panels[..])
    else {
        return None;
    };
    let [w, h] = work.size;
    Some(Image::from_fn([w, h], |x, row| {
        let y = h - 1 - row;
        let at = (y * w + x) as usize;
        let colour = match (normals[at], distances[at][0]) {
            ([0.0, 0.0, 0.0], 0.0) => FOG.lerp(SKY, f64::from(y) / f64::from(h)),
            (normal, distance) => surface(normal, distance, direction(view, x, y)),
        };
        tone(colour.to_array())
    }))
}

/// The direction of the ray through the centre of a pixel.
fn direction(view: &View, x: u32, y: u32) -> Vec3 {
    let [corner, right, up] = [view.corner, view.right, view.up].map(Vec3::from);
    (corner + (f64::from(x) + 0.5) * right + (f64::from(y) + 0.5) * up).normalize()
}

/// The colour of a hit: its normal and its distance are those of the panels.
fn surface(normal: [f32; 3], distance: f32, d: Vec3) -> Vec3 {
    let n = 2.0 * Vec3::from(normal.map(f64::from)) - 1.0;
    let [near, far] = NEAR_AND_FAR;
    let share = (near - f64::from(distance)) / (near - far);
    let own = DOWNWARDS.lerp(UPWARDS, 0.5 + 0.5 * n.y) * n.dot(d).abs();
    own.lerp(FOG, MOST_FOG * share * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of one pixel, at which the ray goes along -z.
    fn pixel(normal: Vec3, share: f64) -> [u8; 3] {
        let mut work = judge::pictures::of("part1.task4").expect("a picture").work;
        let Subject::Shapes { view, .. } = &mut work.subject else {
            panic!("it shows shapes");
        };
        *view = View {
            eye: [0.0; 3],
            corner: [-0.5, -0.5, -1.0],
            right: [1.0, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
        };
        work.size = [1, 1];
        let [near, far] = NEAR_AND_FAR;
        let panels = [0.5 * normal + 0.5, Vec3::splat(near - (near - far) * share)];
        let panels = panels.map(|colour| vec![colour.to_array().map(|c| c as f32)]);
        let answer = PictureAnswer {
            panels: panels.into(),
        };
        lit(&work, &answer).expect("it shows shapes").get(0, 0)
    }

    #[test]
    fn brightness_is_the_cosine_and_distance_is_fog() {
        let sum = |colour: [u8; 3]| colour.iter().map(|c| u32::from(*c)).sum::<u32>();
        let tilted = Vec3::new(0.8, 0.0, 0.6);
        assert!(sum(pixel(Vec3::Z, 0.0)) > sum(pixel(tilted, 0.0)) + 100);
        assert_eq!(pixel(Vec3::Z, 0.0), pixel(-Vec3::Z, 0.0));
        // Edge-on: black near, fog far.
        assert!(sum(pixel(Vec3::X, 0.0)) < 9);
        assert!(sum(pixel(Vec3::X, 1.0)) > 300);
        assert_eq!(pixel(Vec3::NAN, 0.5), crate::tone::NAN_COLOUR);
    }
}
