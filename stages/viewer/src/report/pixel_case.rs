//! A pixel that is sampled: where the samples are in it, in their order, and when it stopped.

use kit::{Aabb, Vec3};
use wire::adaptive::{AdaptiveAnswer, AdaptivePixel};
use wire::answer::PixelAnswer;
use wire::work::PixelWork;

/// A pixel as a block of edge 1: its square, and above it the order of the samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PixelCase {
    /// Column and row, from the bottom left of the film.
    pub pixel: [u32; 2],
    /// The samples: to the right and up from the lower left corner of the pixel, in pixels; `z` is
    /// the share of [`PixelCase::most`] that was taken before, or 0 where the order says nothing.
    pub samples: Vec<Vec3>,
    /// The most samples that the pixel may take.
    pub most: u32,
    /// How many samples the stage says it took.
    pub taken: u32,
    /// After how many samples the stopping rule was called; empty without one.
    pub checks: Vec<u64>,
}

impl PixelCase {
    /// A pixel that is sampled evenly.
    pub fn of_pixel(work: &PixelWork, call: usize, answer: &PixelAnswer) -> Option<PixelCase> {
        let (pixel, _) = work.calls().nth(call)?;
        let place = place(work.film, pixel);
        Some(PixelCase {
            pixel,
            samples: answer.points.iter().map(|&p| place(p, 0.0)).collect(),
            most: work.ns_aa,
            taken: answer.samples,
            checks: Vec::new(),
        })
    }

    /// A pixel that may stop before it took all samples.
    pub fn of_adaptive(work: &AdaptivePixel, answer: &AdaptiveAnswer) -> PixelCase {
        let place = place(work.film, work.pixel);
        let most = f64::from(work.ns_aa.max(1));
        let points = answer.points.iter().enumerate();
        PixelCase {
            pixel: work.pixel,
            samples: points.map(|(i, &p)| place(p, i as f64 / most)).collect(),
            most: work.ns_aa,
            taken: answer.samples,
            checks: answer.rule_calls.iter().map(|call| call.0).collect(),
        }
    }

    /// The height above the square of a number of samples.
    pub fn height(&self, samples: u64) -> f64 {
        samples as f64 / f64::from(self.most.max(1))
    }

    /// Whether a sample is in the pixel.
    pub fn is_inside(sample: Vec3) -> bool {
        let share = 0.0..1.0;
        share.contains(&sample.x) && share.contains(&sample.y)
    }

    /// How many samples are in the pixel.
    pub fn inside(&self) -> usize {
        let samples = self.samples.iter();
        samples.filter(|sample| Self::is_inside(**sample)).count()
    }

    /// Where a point of the block is seen: the square upright, or lying under the order of the
    /// samples.
    pub fn seen(&self, p: Vec3) -> Vec3 {
        match self.checks.is_empty() {
            true => p,
            false => Vec3::new(p.x, p.z, -p.y),
        }
    }

    /// A box around the pixel and its neighbours: samples may be far away.
    pub fn bounds(&self) -> Aabb {
        let height = if self.checks.is_empty() { 0.0 } else { 1.0 };
        let corners = [
            Vec3::new(-NEIGHBOURS, -NEIGHBOURS, 0.0),
            Vec3::new(1.0 + NEIGHBOURS, 1.0 + NEIGHBOURS, height),
        ];
        Aabb::of(corners.map(|corner| self.seen(corner)))
    }
}

/// How much of the neighbouring pixels is seen.
pub const NEIGHBOURS: f64 = 0.4;

/// Places a point of the sensor relative to the lower left corner of a pixel.
fn place(film: [u32; 2], pixel: [u32; 2]) -> impl Fn([f64; 2], f64) -> Vec3 {
    let [w, h] = film.map(f64::from);
    let [x, y] = pixel.map(f64::from);
    move |[u, v], height| Vec3::new(u * w - x, v * h - y, height)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::adaptive::StopRule;

    #[test]
    fn samples_are_placed_in_their_pixel_and_in_their_order() {
        let work = AdaptivePixel {
            film: [4, 2],
            pixel: [1, 1],
            ns_aa: 4,
            batch: 2,
            tolerance: 0.1,
            seed: 0,
            stream: vec![[1.0; 3]],
            rule: StopRule::Plain,
        };
        let answer = AdaptiveAnswer {
            points: vec![[0.375, 0.75], [0.25, 0.5], [0.9, 0.75]],
            traced: 3,
            foreign: 0,
            rule_calls: vec![(2, 1.0, 0.0, 0.1)],
            radiance: [1.0; 3],
            samples: 3,
        };
        let case = PixelCase::of_adaptive(&work, &answer);
        let [middle, corner, outside] = case.samples[..] else {
            panic!("three samples: {case:?}")
        };
        assert_eq!(middle, Vec3::new(0.5, 0.5, 0.0));
        assert_eq!(corner, Vec3::new(0.0, 0.0, 0.25));
        assert!((outside.x - 2.6).abs() < 1e-12);
        assert_eq!((case.inside(), case.checks.as_slice()), (2, &[2][..]));
        assert_eq!(case.height(2), 0.5);
        // The order of the samples is upwards.
        assert_eq!(case.seen(corner), Vec3::new(0.0, 0.25, 0.0));
    }
}
