//! One call in words and shown.

use crate::tools::call_text::{direction, few, holding, material, point, ray_and};
use crate::tools::shown::{ShownCall, ShownPath};
use wire::global::{PathAnswer, ScriptedPath, Step};
use wire::light::Material;

pub(super) fn input(paths: &[ScriptedPath], call: usize) -> Option<String> {
    let path = paths.get(call)?;
    let depth = format!("max_depth = {}", path.max_depth);
    let around = background(path);
    let hits = match few(path.steps.iter().map(surface), "; ") {
        Some(surfaces) if !surfaces.is_empty() => format!("; hits {surfaces}"),
        Some(_) => "; hits nothing".into(),
        None => String::new(),
    };
    Some(ray_and(&path.ray, &format!("{depth}; {around}{hits}")))
}

/// What rays see that miss.
fn background(path: &ScriptedPath) -> String {
    let [above, below] = [path.background, path.below].map(point);
    if above == below {
        return format!("a background of {above}");
    }
    format!("a background of {above} above (d.y > 0), {below} below")
}

/// A surface of a path.
fn surface(step: &Step) -> String {
    let sample = step.sample.map_or_else(
        || "no sample".into(),
        |sample| {
            let (f, wi, pdf) = (point(sample.f), direction(sample.wi), sample.pdf);
            format!("sample f = {f}, wi = {wi}, pdf = {pdf:?}")
        },
    );
    format!(
        "{}, direct light {}, {sample}",
        material(&step.material),
        point(step.direct)
    )
}

pub(super) fn circumstances(paths: &[ScriptedPath], call: usize) -> Option<Vec<&'static str>> {
    let path = paths.get(call);
    path.map(|path| of_path(&path.steps, path.max_depth))
}

fn is_lamp(step: &Step) -> bool {
    matches!(step.material, Material::Emission(_))
}

fn of_path(steps: &[Step], max_depth: u32) -> Vec<&'static str> {
    let meets = |is: fn(&Step) -> bool| steps.iter().any(is);
    holding(&[
        (max_depth <= 1, "max_depth is at most 1"),
        (max_depth > 1, "max_depth is above 1"),
        (steps.is_empty(), "the first ray meets nothing"),
        (steps.len() > 1, "the path meets more than one surface"),
        (
            meets(|step| step.sample.is_some_and(|sample| sample.delta)),
            "the path meets a mirror or glass",
        ),
        (
            meets(|step| step.roulette.is_none()),
            "roulette ends the path",
        ),
        (meets(is_lamp), "the path meets a lamp"),
        (
            // A lamp scatters nothing: that it gives no sample says nothing of the code.
            meets(|step| step.sample.is_none() && !is_lamp(step)),
            "a surface that is no lamp gives no sample",
        ),
    ])
}

/// The surfaces of a path, and how many rays the code traced.
pub(super) fn shown(
    paths: &[ScriptedPath],
    call: usize,
    answers: Option<&Vec<PathAnswer>>,
) -> Option<ShownCall> {
    let path = paths.get(call)?;
    let answer = answers.and_then(|answers| answers.get(call));
    let name = |step: &Step| match step.material {
        Material::Diffuse(_) => "diffuse",
        Material::Mirror(_) => "mirror",
        Material::Emission(_) => "lamp",
        _ => "surface",
    };
    (path.steps.len() <= MOST_SURFACES).then(|| {
        ShownCall::Path(ShownPath {
            surfaces: path.steps.iter().map(name).collect(),
            yours: answer.map(|answer| answer.rays.len()),
        })
    })
}

/// The most surfaces of a path that can be drawn.
const MOST_SURFACES: usize = 6;
