//! Renders the pictures of tasks: a file for each stage, with given code for all that is not the
//! stage's own. `Eye` generates the rays, `panel` calls a function for each pixel.

#[cfg(feature = "adaptive")]
mod adaptive;
#[cfg(feature = "bbox")]
mod boxes;
#[cfg(feature = "direct")]
mod direct;
#[cfg(any(
    feature = "intersect",
    feature = "bbox",
    feature = "direct",
    feature = "global",
    feature = "adaptive"
))]
mod eye;
#[cfg(any(feature = "global", feature = "adaptive"))]
mod given_light;
#[cfg(feature = "direct")]
mod lambert;
#[cfg(feature = "bvh")]
mod leaves;
#[cfg(feature = "global")]
mod paths;
#[cfg(feature = "raygen")]
mod raygen;
#[cfg(feature = "global")]
mod roulette;
#[cfg(feature = "intersect")]
mod shapes;
#[cfg(feature = "global")]
mod specular;
#[cfg(feature = "meshes")]
mod traversal;

#[cfg(any(
    feature = "intersect",
    feature = "bbox",
    feature = "direct",
    feature = "global",
    feature = "adaptive"
))]
use eye::Eye;
#[cfg(any(feature = "intersect", feature = "raygen", feature = "bvh"))]
use kit::Vec3;
#[cfg(any(feature = "intersect", feature = "bbox"))]
use wire::picture::NEAR_AND_FAR;
use wire::picture::{PictureAnswer, PictureWork, Subject};

/// Renders a picture on the linked stage.
pub(crate) fn picture(work: &PictureWork) -> Result<PictureAnswer, String> {
    let size = work.size;
    let panels = match &work.subject {
        #[cfg(feature = "raygen")]
        Subject::SampleLoop { samples } => raygen::sample_loop(size, samples),
        #[cfg(feature = "raygen")]
        Subject::CameraRays(camera) => raygen::camera_rays(size, camera),
        #[cfg(feature = "intersect")]
        Subject::Shapes {
            triangles,
            spheres,
            view,
            range,
        } => shapes::closest(size, triangles, spheres, view, *range),
        #[cfg(feature = "bvh")]
        Subject::Leaves {
            triangles,
            max_leaf_size,
        } => leaves::leaves(size, triangles, *max_leaf_size),
        #[cfg(feature = "bbox")]
        Subject::Boxes { boxes, view, range } => boxes::boxes(size, boxes, view, *range),
        #[cfg(feature = "meshes")]
        Subject::Traversal {
            scene,
            tree,
            view,
            hottest,
        } => traversal::closest(size, scene, tree, view, *hottest)?,
        #[cfg(feature = "direct")]
        Subject::Lambert => lambert::lambert(size),
        #[cfg(feature = "direct")]
        Subject::Direct {
            world,
            view,
            strategy,
            samples,
            scattering,
        } => direct::direct(size, world, view, *strategy, *samples, *scattering),
        #[cfg(feature = "global")]
        Subject::Specular => specular::specular(size),
        #[cfg(feature = "global")]
        Subject::Paths {
            world,
            view,
            max_depth,
            samples,
            scattering,
        } => paths::paths(size, world, view, *max_depth, *samples, *scattering),
        #[cfg(feature = "global")]
        Subject::Roulette { bounces } => roulette::roulette(size, bounces),
        #[cfg(feature = "adaptive")]
        Subject::Adaptive {
            world,
            view,
            ns_aa,
            batch,
            tolerance,
            scattering,
        } => {
            let budget = adaptive::budget(*ns_aa, *batch, *tolerance);
            adaptive::lamp(size, world, view, budget, *scattering)
        }
        #[cfg(feature = "adaptive")]
        Subject::RareLight {
            ns_aa,
            batch,
            tolerance,
        } => adaptive::rare_light(size, adaptive::budget(*ns_aa, *batch, *tolerance)),
        #[allow(
            unreachable_patterns,
            reason = "a worker with every stage has an arm for each subject"
        )]
        _ => return Err("this worker was built without the stage of this picture".into()),
    };
    Ok(PictureAnswer { panels })
}

/// The colours of a panel, row by row from the bottom left.
type Panel = Vec<[f32; 3]>;

/// A panel of `size` pixels: calls `colour` with the column and the row of each.
#[cfg(any(
    feature = "raygen",
    feature = "intersect",
    feature = "bbox",
    feature = "direct",
    feature = "global",
    feature = "adaptive"
))]
fn panel(size: [u32; 2], mut colour: impl FnMut(u32, u32) -> [f64; 3]) -> Panel {
    let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
    let each = pixels.enumerate().map(|(i, (x, y))| {
        harness::call(i);
        colour(x, y).map(|channel| channel as f32)
    });
    each.collect()
}

/// Two panels that are rendered together.
#[cfg(any(
    feature = "intersect",
    feature = "bbox",
    feature = "meshes",
    feature = "adaptive"
))]
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
#[cfg(any(feature = "intersect", feature = "raygen"))]
fn direction_colour(d: Vec3) -> [f64; 3] {
    (0.5 * d + 0.5).to_array()
}

/// The brightness of a distance between `near` and `far`. A NaN stays one.
#[cfg(any(feature = "intersect", feature = "bbox"))]
fn nearness(t: f64, [near, far]: [f64; 2]) -> f64 {
    let share = (t - near) / (far - near);
    let [brightest, darkest] = NEAR_AND_FAR;
    brightest - (brightest - darkest) * share.clamp(0.0, 1.0)
}

/// The colour of a number from 0 to 1, from dark blue over green and yellow to white.
#[cfg(feature = "bvh")]
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
