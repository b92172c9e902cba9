//! One call in words and shown.

use crate::tools::call_text::{holding, point};
use crate::tools::shown::{ShownCall, ShownPixel};
use wire::answer::PixelAnswer;
use wire::work::{PixelWork, PixelWorld};

pub(super) fn input(work: &PixelWork, call: usize) -> Option<String> {
    let ([x, y], seed) = work.calls().nth(call)?;
    let [w, h] = work.film;
    let world = match work.world {
        PixelWorld::Constant(radiance) => format!("; every ray brings {}", point(radiance)),
        PixelWorld::Flicker(radiance) => {
            format!("; rays bring {} and black in turn", point(radiance))
        }
        PixelWorld::Ramp => "; a ray through (u, v) brings (u, v, u v)".into(),
        PixelWorld::Numbers | PixelWorld::Rings => String::new(),
    };
    Some(format!(
        "x = {x}, y = {y}, film = {w} x {h}, ns_aa = {}, seed {seed}{world}",
        work.ns_aa
    ))
}

pub(super) fn circumstances(work: &PixelWork, call: usize) -> Option<Vec<&'static str>> {
    let at = work.pixels.get(call);
    at.map(|at| of_pixel(work, *at))
}

fn of_pixel(work: &PixelWork, [x, y]: [u32; 2]) -> Vec<&'static str> {
    let [w, h] = work.film;
    holding(&[
        (work.ns_aa == 1, "ns_aa is 1"),
        (work.ns_aa > 1, "ns_aa is above 1"),
        (w != h, "the film is not a square"),
        (x > 0, "the pixel is not in the first column"),
        (y > 0, "the pixel is not in the first row"),
        (x != y, "x and y differ"),
    ])
}

pub(super) fn shown(
    work: &PixelWork,
    call: usize,
    answers: Option<&Vec<PixelAnswer>>,
) -> Option<ShownCall> {
    let (pixel, seed) = work.calls().nth(call)?;
    let answer = answers.and_then(|answers| answers.get(call));
    Some(ShownCall::Pixel(ShownPixel {
        film: work.film,
        pixel,
        samples: work.ns_aa,
        seed,
        yours: answer.map_or_else(Vec::new, |answer| answer.points.clone()),
    }))
}
