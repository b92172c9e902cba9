//! Simple scenes for direct light: a white floor at the origin, seen from straight above.

use super::worlds::{lamp, of_panels, wall};
use wire::direct::{DirectWork, ShadedPoint, Strategy};
use wire::light::{Light, LitWorld, Material, Panel, Surroundings};
use wire::work::Xyz;

const UP: Xyz = [0.0, 1.0, 0.0];
const DOWN: Xyz = [0.0, -1.0, 0.0];

/// The estimates at one point, where only their statistics can be wrong.
const ESTIMATES: usize = 2000;

/// The simple questions to the function that estimates by `strategy`.
pub(crate) fn questions(strategy: Strategy) -> Vec<DirectWork> {
    let worlds = match strategy {
        Strategy::ZeroBounce => return vec![work(strategy, LitWorld::default(), emitting(), 0)],
        Strategy::Lights => [lights(), random_lights()].concat(),
        Strategy::Hemisphere => surroundings(),
    };
    let few = worlds
        .iter()
        .flat_map(|world| [1, 2].map(|samples| work(strategy, world.clone(), points(), samples)));
    // What only the statistics of many estimates can tell.
    let many = random_lights().into_iter().map(|world| {
        let same = vec![floor(WHITE, UP); ESTIMATES];
        work(strategy, world, same, 1)
    });
    few.chain(many).collect()
}

/// A surface that emits and one that does not, from both sides.
fn emitting() -> Vec<ShadedPoint> {
    let materials = [Material::Emission([1.0; 3]), WHITE];
    let seen = materials
        .iter()
        .flat_map(|&material| [UP, DOWN].map(|wo| floor(material, wo)));
    seen.collect()
}

const WHITE: Material = Material::Diffuse([1.0; 3]);

/// The floor from above and from below, slanted, tilted, and as a mirror.
fn points() -> Vec<ShadedPoint> {
    let slanted = [0.6, 0.8, 0.0];
    vec![
        floor(WHITE, UP),
        floor(WHITE, slanted),
        floor(Material::Diffuse([1.0, 0.5, 0.0]), UP),
        ShadedPoint {
            n: slanted,
            ng: slanted,
            ..floor(WHITE, UP)
        },
        floor(WHITE, DOWN),
        floor(Material::Mirror([1.0; 3]), UP),
    ]
}

/// The origin on a floor.
fn floor(material: Material, wo: Xyz) -> ShadedPoint {
    ShadedPoint {
        p: [0.0; 3],
        n: UP,
        ng: UP,
        // A power of two near the bounds of real scenes.
        error: 2.0_f64.powi(-39),
        material,
        wo,
    }
}

/// Worlds with one light of radiance, intensity or irradiance 1.
fn lights() -> Vec<LitWorld> {
    let of = |light: Light, panels: Vec<Panel>| LitWorld {
        lights: vec![light],
        ..of_panels(panels)
    };
    let point = |height: f64| Light::Point {
        position: [0.0, height, 0.0],
        intensity: [1.0; 3],
    };
    let sun = Light::Directional {
        direction: DOWN,
        irradiance: [1.0; 3],
    };
    vec![
        of(point(1.0), Vec::new()),
        of(point(2.0), Vec::new()),
        of(sun, Vec::new()),
        of(point(-1.0), Vec::new()),
        of(point(2.0), vec![wall(lamp(1.0, [0.0; 3]))]),
        of(point(1.0), vec![wall(lamp(2.0, [0.0; 3]))]),
        of_panels(vec![Panel {
            faces: 1.0,
            ..lamp(1.0, [1.0; 3])
        }]),
        LitWorld {
            lights: vec![point(1.0), sun],
            ..LitWorld::default()
        },
    ]
}

/// Worlds whose light comes from random directions, so that only the mean of many estimates is
/// certain: a white background, and a lamp overhead.
fn random_lights() -> Vec<LitWorld> {
    let white = LitWorld {
        environment: Some(Surroundings::uniform([1.0; 3])),
        ..LitWorld::default()
    };
    vec![white, of_panels(vec![lamp(1.0, [1.0; 3])])]
}

/// Worlds that are seen by rays in all directions.
fn surroundings() -> Vec<LitWorld> {
    // A lamp that covers half of the sky.
    let large = |faces: f64| Panel {
        min: [-1000.0; 2],
        max: [1000.0, 0.0],
        faces,
        ..lamp(1.0, [1.0; 3])
    };
    let large = [-1.0, 1.0].map(|faces| of_panels(vec![large(faces)]));
    random_lights().into_iter().chain(large).collect()
}

fn work(strategy: Strategy, world: LitWorld, points: Vec<ShadedPoint>, samples: u32) -> DirectWork {
    DirectWork {
        world,
        strategy,
        points,
        samples,
        seed: 0,
    }
}
