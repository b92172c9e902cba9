//! Renders the pictures of tasks: a file for each stage, with given code for all that is not the
//! stage's own. `Eye` generates the rays, `panel` calls a function for each pixel.

mod adaptive;
mod boxes;
mod direct;
mod eye;
mod given_light;
mod lambert;
mod leaves;
mod paths;
mod raygen;
mod roulette;
mod shapes;
mod specular;
mod traversal;

use crate::stages::Stages;
use eye::Eye;
use kit::Vec3;
use wire::picture::NEAR_AND_FAR;
use wire::picture::{PictureAnswer, PictureWork, Subject};

/// Renders a picture on the stage of its task.
pub(crate) fn picture(stages: &Stages, work: &PictureWork) -> Result<PictureAnswer, String> {
    let size = work.size;
    let panels = match &work.subject {
        Subject::SampleLoop { samples } => raygen::sample_loop(stages.raygen()?, size, samples),
        Subject::CameraRays(camera) => raygen::camera_rays(stages.raygen()?, size, camera),
        Subject::Shapes {
            triangles,
            spheres,
            view,
            range,
        } => shapes::closest(stages.intersect()?, size, triangles, spheres, view, *range),
        Subject::Leaves {
            triangles,
            max_leaf_size,
        } => leaves::leaves(stages.bvh()?, size, triangles, *max_leaf_size),
        Subject::Boxes { boxes, view, range } => {
            boxes::boxes(stages.bbox()?, size, boxes, view, *range)
        }
        Subject::Traversal {
            scene,
            tree,
            view,
            hottest,
        } => traversal::closest(stages.of_scenes()?, size, scene, tree, view, *hottest)?,
        Subject::Lambert => lambert::lambert(stages.direct()?, size),
        Subject::Direct {
            world,
            view,
            strategy,
            samples,
            scattering,
        } => direct::direct(
            stages.direct()?,
            size,
            world,
            view,
            *strategy,
            *samples,
            *scattering,
        ),
        Subject::Specular => specular::specular(stages.global()?, size),
        Subject::Paths {
            world,
            view,
            max_depth,
            samples,
            scattering,
        } => paths::paths(
            stages.global()?,
            size,
            world,
            view,
            *max_depth,
            *samples,
            *scattering,
        ),
        Subject::Roulette { bounces } => roulette::roulette(stages.global()?, size, bounces),
        Subject::Adaptive {
            world,
            view,
            ns_aa,
            batch,
            tolerance,
            scattering,
        } => {
            let budget = adaptive::budget(*ns_aa, *batch, *tolerance);
            adaptive::lamp(stages.adaptive()?, size, world, view, budget, *scattering)
        }
        Subject::RareLight {
            ns_aa,
            batch,
            tolerance,
        } => adaptive::rare_light(
            stages.adaptive()?,
            size,
            adaptive::budget(*ns_aa, *batch, *tolerance),
        ),
    };
    Ok(PictureAnswer { panels })
}

/// The colours of a panel, row by row from the bottom left.
type Panel = Vec<[f32; 3]>;

/// A panel of `size` pixels: calls `colour` with the column and the row of each.
fn panel(size: [u32; 2], mut colour: impl FnMut(u32, u32) -> [f64; 3]) -> Panel {
    fill(size, &mut colour)
}

/// [`panel`], compiled once for all pictures.
fn fill([width, height]: [u32; 2], colour: &mut dyn FnMut(u32, u32) -> [f64; 3]) -> Panel {
    let mut panel = Panel::with_capacity(width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            harness::call(panel.len());
            panel.push(colour(x, y).map(|channel| channel as f32));
        }
    }
    panel
}

/// Two panels that are rendered together.
fn two_panels(size: [u32; 2], mut colours: impl FnMut(u32, u32) -> [[f64; 3]; 2]) -> Vec<Panel> {
    let mut second = Panel::with_capacity(size[0] as usize * size[1] as usize);
    let first = panel(size, |x, y| {
        let [first, other] = colours(x, y);
        second.push(other.map(|channel| channel as f32));
        first
    });
    vec![first, second]
}

/// The colour of a normal: each component mapped from -1..1 to 0..1.
fn direction_colour(d: Vec3) -> [f64; 3] {
    (0.5 * d + 0.5).to_array()
}

/// The brightness of a distance between `near` and `far`. A NaN stays one.
fn nearness(t: f64, [near, far]: [f64; 2]) -> f64 {
    let share = (t - near) / (far - near);
    let [brightest, darkest] = NEAR_AND_FAR;
    brightest - (brightest - darkest) * share.clamp(0.0, 1.0)
}

/// The colour of a number from 0 to 1, from dark blue over green and yellow to white.
fn heat(share: f64) -> [f64; 3] {
    const STEPS: [[f64; 3]; 5] = [
        [0.02, 0.01, 0.10],
        [0.03, 0.12, 0.35],
        [0.05, 0.35, 0.15],
        [0.70, 0.50, 0.02],
        [0.75, 0.72, 0.65],
    ];
    let at = share.clamp(0.0, 1.0) * (STEPS.len() - 1) as f64;
    let step = (at as usize).min(STEPS.len() - 2);
    let [from, to] = [STEPS[step], STEPS[step + 1]].map(Vec3::from);
    from.lerp(to, at - step as f64).to_array()
}
