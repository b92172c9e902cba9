//! One call in words and shown.

use super::world_text;
use crate::tools::call_text::{direction, few, point};
use crate::tools::plural;
use crate::tools::shown::{ShownCall, ShownPoint};
use wire::direct::{DirectAnswer, DirectWork, Strategy};

pub(super) fn input(work: &DirectWork, call: usize) -> Option<String> {
    let at = work.points.get(call)?;
    let p = point(at.p);
    let [n, wo] = [at.n, at.wo].map(direction);
    let world = &work.world;
    let lights = world.lights.iter().map(world_text::light);
    let panels = world.panels.iter().map(world_text::panel);
    let background = world.environment.iter();
    let background = background.map(|around| match around.texels[..] {
        [radiance] => format!("a background of {}", point(radiance)),
        _ => "an environment map".into(),
    });
    let lights = few(lights.chain(panels).chain(background), "; ");
    let lights = lights.filter(|lights| !lights.is_empty());
    let lights = lights.map_or_else(String::new, |lights| format!("; {lights}"));
    Some(format!(
        "p = {p}, n = {n}, wo = {wo}, {}, samples = {}{lights}",
        world_text::material(&at.material),
        work.samples
    ))
}

pub(super) fn shown(
    work: &DirectWork,
    call: usize,
    answers: Option<&Vec<DirectAnswer>>,
) -> Option<ShownCall> {
    let answer = answers.and_then(|answers| answers.get(call));
    Some(ShownCall::LitPoint(ShownPoint {
        world: work.world.clone(),
        point: *work.points.get(call)?,
        rays: answer.map_or_else(Vec::new, |answer| answer.rays.clone()),
    }))
}

/// A sentence about all points.
pub(super) fn overview(work: &DirectWork) -> String {
    let function = match work.strategy {
        Strategy::ZeroBounce => "zero_bounce_radiance",
        Strategy::Hemisphere => "estimate_direct_lighting_hemisphere",
        Strategy::Lights => "estimate_direct_lighting_importance",
    };
    format!(
        "{} with {}: {} in a world of {}, {}{}",
        function,
        plural(work.samples as usize, "sample", "samples"),
        plural(work.points.len(), "point", "points"),
        plural(work.world.panels.len(), "rectangle", "rectangles"),
        plural(work.world.lights.len(), "further light", "further lights"),
        match work.world.environment {
            Some(_) => ", an environment",
            None => "",
        }
    )
}
