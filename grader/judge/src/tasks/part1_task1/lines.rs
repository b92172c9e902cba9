//! Writes the samples of a pixel to a snapshot.

use crate::tools::snapshot::lines::each;
use crate::tools::snapshot::{Forms, field, forms, number, vector};
use wire::answer::PixelAnswer;
use wire::work::PixelWork;

/// Sample count and radiance; full lines also have the first points.
pub(super) fn pixels(work: &PixelWork, answers: &[PixelAnswer]) -> Vec<Forms> {
    each(work.calls(), answers, |(pixel, seed), answer| {
        let mut question = vec![field("pixel", vector(&pixel.map(f64::from)))];
        if work.seeds.len() > 1 {
            question.push(number("seed", seed as f64));
        }
        let short = vec![
            number("samples", f64::from(answer.samples)),
            field("radiance", vector(&answer.radiance)),
        ];
        let mut full = short.clone();
        let points = answer.points.iter().take(4);
        full.extend(points.map(|point| field("at", vector(point))));
        forms(question, short, full)
    })
}
