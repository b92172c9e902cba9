//! The light of a path, multiplied.

use crate::tools::kinds::direct_light::of_material;
use wire::global::{ScriptedPath, Step};
use wire::work::Xyz;

/// The path with all light that reaches it multiplied by `times`. Its radiance is proportional to
/// it.
pub(super) fn multiplied(path: &ScriptedPath, mut times: impl FnMut(Xyz) -> Xyz) -> ScriptedPath {
    let mut steps = Vec::new();
    for step in &path.steps {
        steps.push(Step {
            material: of_material(step.material, &mut times),
            direct: times(step.direct),
            ..*step
        });
    }
    ScriptedPath {
        steps,
        background: times(path.background),
        below: times(path.below),
        ..path.clone()
    }
}
