//! Simple scenes for direct light: a white floor at the origin, seen from straight above.

use super::worlds::{lamp, of_panels, wall};
use wire::direct::{DirectWork, ShadedPoint, Strategy};
use wire::light::{Light, LitWorld, Material, Panel, Surroundings};
use wire::work::Xyz;

const UP: Xyz = [0.0, 1.0, 0.0];
const DOWN: Xyz = [0.0, -1.0, 0.0];

/// The estimates at one point, where only their statistics can be wrong.
const ESTIMATES: usize = 2000;

/// The simple questions to the function that estimates by `strategy`, for a case about `world`:
/// worlds with light of the same kinds come first.
pub(crate) fn questions(strategy: Strategy, world: &LitWorld) -> Vec<DirectWork> {
    let mut worlds = match strategy {
        Strategy::ZeroBounce => return vec![work(strategy, LitWorld::default(), emitting(), 0)],
        Strategy::Lights => [lights(), random_lights()].concat(),
        Strategy::Hemisphere => surroundings(),
    };
    worlds.sort_by_key(|other| kinds_of_light(other) != kinds_of_light(world));
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

/// Worlds with light of radiance or irradiance 1, or intensity 1 at the distance 1.
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
    // Not straight above: its direction has a component along each axis that a mistake may take for
    // the cosine.
    let aside = Light::Point {
        position: [0.0, 3.0, 4.0],
        intensity: [25.0; 3],
    };
    vec![
        of(point(1.0), Vec::new()),
        of(point(2.0), Vec::new()),
        of(aside, Vec::new()),
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

/// Whether a world has light of each kind: point lights, spot lights, directional ones, lamps, an
/// environment.
fn kinds_of_light(world: &LitWorld) -> [bool; 5] {
    let has = |is_of_kind: fn(&Light) -> bool| world.lights.iter().any(is_of_kind);
    let is_lamp =
        |panel: &Panel| matches!(panel.material, Material::Emission(of) if of != [0.0; 3]);
    [
        has(|light| matches!(light, Light::Point { .. })),
        has(|light| matches!(light, Light::Spot { .. })),
        has(|light| matches!(light, Light::Directional { .. })),
        world.panels.iter().any(is_lamp),
        world.environment.is_some() || has(|light| matches!(light, Light::Sky(_))),
    ]
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_of_the_same_kind_as_in_the_case_comes_first() {
        let all = questions(Strategy::Lights, &LitWorld::default()).len();
        for world in lights().into_iter().chain(random_lights()) {
            let questions = questions(Strategy::Lights, &world);
            let first = questions.first().map(|work| kinds_of_light(&work.world));
            assert_eq!(first, Some(kinds_of_light(&world)), "{world:?}");
            assert_eq!(questions.len(), all);
        }
    }
}
