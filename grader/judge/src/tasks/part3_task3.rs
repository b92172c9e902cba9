//! Cases of direct light by sampling the lights.

use crate::tools::findings::Aspect::{Direction, Mean, Origin, Radiance, Range, Rays, Spread};
use crate::tools::kinds::direct_light::worlds::{
    ceiling, floor, floor_of, lamp, lamps_and_floor, of_panels, random_lamp, random_point,
    smooth_point, unit, wall, with_dark_ones, with_grazed_ones, work,
};
use crate::tools::questions::probes::ProbeRng;
use crate::tools::spec::Spec;
use wire::direct::{DirectWork, ShadedPoint, Strategy};
use wire::kind;
use wire::light::{Light, LitWorld, Material, Panel, Surroundings};

/// The number of estimates in a case about their mean.
const ESTIMATES: usize = 4000;

/// The cases of `part3.task3`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        case(
            "point_light",
            "A point light arrives with its intensity divided by the squared distance, times f \
             and the cosine: the result is exact, however dark the surface is and however small \
             the cosine. Pitfall: dropping contributions below a threshold.",
            faint(random_points_lit(vec![point()], Vec::new(), 1)),
        )
        .only(&[Radiance]),
        case(
            "spot_light",
            "A spot light illuminates the inside of its cone only.",
            random_points_lit(vec![spot()], Vec::new(), 1),
        )
        .only(&[Radiance, Rays]),
        case(
            "sun",
            "A directional light is infinitely far away, and its shadow ray has no end.",
            random_points_lit(vec![sun()], Vec::new(), 1),
        )
        .only(&[Radiance, Range]),
        case(
            "one_sample_of_a_point",
            "A light without extent gets one sample, whatever -l is, since all its samples would \
             be equal. Pitfall: its light divided by -l is too dark.",
            random_points_lit(vec![point(), sun()], Vec::new(), 4),
        )
        .only(&[Rays, Radiance]),
        case(
            "shadow_rays",
            "A shadow ray starts at the origin that Surface::leave returns, goes to the light, \
             and ends just before it, so that a lamp does not block its own light.",
            random_points_lit(vec![point()], vec![lamp(3.0, [2.0; 3])], 4),
        )
        .only(&[Origin, Direction, Range]),
        case(
            "in_the_shadow",
            "A wall between the point and a light blocks the light, however far the light is; a \
             wall behind the light does not.",
            shadows(),
        )
        .only(&[Radiance, Rays]),
        case(
            "lamp_overhead",
            "A lamp above the floor: each sample is f · L · |cos θ| / pdf, and their mean follows \
             from the form factor. A bias of 12 % is always detected.",
            same(vec![lamp(1.0, [5.0; 3])], Vec::new(), floor(), 1),
        )
        .only(&[Radiance, Mean]),
        case(
            "several_samples",
            "With -l 4 the light of a lamp is the mean of four different samples. A bias of 4 % \
             is always detected. Pitfall: their sum is four times as bright.",
            same(vec![lamp(1.5, [5.0; 3])], Vec::new(), floor(), 4),
        )
        .only(&[Rays, Radiance, Spread, Mean]),
        case(
            "many_lights",
            "The result is the sum over all lights, each averaged over its own samples; here on \
             smooth meshes. Pitfall: the cosine is that to the shading normal, as in the local \
             space, not that to the geometric one.",
            many_lights(),
        )
        .only(&[Radiance, Rays]),
        case(
            "nothing_arrives",
            "A lamp that faces away, a light below the horizon, a point outside the cone: black, \
             and no shadow ray is traced.",
            no_light(),
        )
        .only(&[Rays, Radiance]),
        case(
            "half_below_the_horizon",
            "A lamp that extends below the horizon: samples of its lower part are 0 and count in \
             the mean. A bias of 16 % is always detected.",
            same(vec![half_below()], Vec::new(), floor(), 2),
        )
        .only(&[Radiance, Mean]),
        case(
            "lamp_with_two_sides",
            "A lamp of two panels that face opposite ways. The samples on the side that faces \
             away send nothing: they are None, and count as 0 in the mean. A bias of 21 % is \
             always detected.",
            same(two_sides(), Vec::new(), floor(), 2),
        )
        .only(&[Radiance, Mean]),
        case(
            "sky",
            "A sky emits from the whole upper hemisphere. A bias of 7 % is always detected.",
            same(Vec::new(), vec![Light::Sky([1.0, 1.5, 2.0])], floor(), 3),
        )
        .only(&[Radiance, Mean]),
        case(
            "environment",
            "An environment map: directions are sampled in proportion to its radiance, so the \
             density differs from texel to texel, and L is the radiance of the texel. A bias of 9 \
             % is always detected.",
            environment(),
        )
        .only(&[Origin, Direction, Range, Rays, Radiance, Mean]),
        case(
            "seen_from_below",
            "A surface seen from below scatters only light from below.",
            below(),
        )
        .only(&[Rays, Radiance]),
        case(
            "surface_that_emits",
            "A lamp emits and scatters nothing, so its direct light is black. Pitfall: its own \
             emission is the light of zero bounces; added here, it counts twice.",
            work(
                Strategy::Lights,
                world(vec![point()], vec![lamp(3.0, [2.0; 3])]),
                lamps_and_floor(),
                4,
                0,
            ),
        )
        .only(&[Radiance, Rays]),
        case(
            "mirrors_ask_for_nothing",
            "A mirror or glass scatters no light from a sampled direction: black, and no shadow \
             ray is traced.",
            mirrors(),
        )
        .only(&[Rays, Radiance]),
        case(
            "no_samples",
            "With -l 0 lamps add nothing (not 0 / 0); point lights and suns still do.",
            random_points_lit(vec![point()], vec![lamp(3.0, [2.0; 3])], 0),
        )
        .only(&[Rays, Radiance]),
        case(
            "fresh_lights",
            "Random lights and points that depend on the seed.",
            fresh(seed),
        ),
    ]
}

fn case(name: &'static str, about: &'static str, work: DirectWork) -> Spec {
    Spec::new::<kind::Direct>("part3.task3", name, about, work)
}

fn point() -> Light {
    Light::Point {
        position: [0.5, 2.0, -1.0],
        intensity: [6.0, 3.0, 1.0],
    }
}

fn spot() -> Light {
    Light::Spot {
        position: [0.0, 3.0, 0.5],
        direction: [0.0, -1.0, 0.0],
        intensity: [8.0, 4.0, 4.0],
        falloff_angle: 40.0,
        falloff_exponent: 2.0,
    }
}

fn sun() -> Light {
    Light::Directional {
        direction: unit([1.0, -2.0, -2.0]),
        irradiance: [1.5, 1.0, 0.5],
    }
}

fn side_lamp() -> Panel {
    Panel {
        axis: 0,
        at: -2.5,
        faces: 1.0,
        ..lamp(0.0, [0.5, 2.0, 2.0])
    }
}

fn world(lights: Vec<Light>, panels: Vec<Panel>) -> LitWorld {
    LitWorld {
        lights,
        ..of_panels(panels)
    }
}

/// Points near the origin with random normals.
fn random_points_lit(lights: Vec<Light>, panels: Vec<Panel>, samples: u32) -> DirectWork {
    let mut rng = ProbeRng::new("points under lights", 0);
    let points = (0..80).map(|_| random_point(&mut rng)).collect();
    work(Strategy::Lights, world(lights, panels), points, samples, 0)
}

/// The same work, with points that are nearly black and points that [`point`] only grazes.
fn faint(work: DirectWork) -> DirectWork {
    let Light::Point { position, .. } = point() else {
        unreachable!("it is a point light")
    };
    DirectWork {
        points: with_grazed_ones(with_dark_ones(work.points), position.into()),
        ..work
    }
}

/// Points of smooth meshes near the origin, under lights of every kind.
fn many_lights() -> DirectWork {
    let mut rng = ProbeRng::new("points under lights", 0);
    let points = (0..80).map(|_| smooth_point(&mut rng)).collect();
    let panels = vec![lamp(2.5, [3.0, 1.0, 0.5]), side_lamp()];
    let world = world(vec![point(), sun(), spot()], panels);
    work(Strategy::Lights, world, points, 3, 0)
}

/// Many estimates at the same point.
fn same(panels: Vec<Panel>, lights: Vec<Light>, point: ShadedPoint, samples: u32) -> DirectWork {
    let points = vec![point; ESTIMATES];
    work(Strategy::Lights, world(lights, panels), points, samples, 1)
}

/// One wall blocks the lights for half of the plane; another is behind the lights.
fn shadows() -> DirectWork {
    let half = wall(Panel {
        min: [-9.0, 0.0],
        max: [9.0, 9.0],
        ..lamp(1.0, [0.0; 3])
    });
    let behind = wall(Panel {
        min: [-9.0; 2],
        max: [9.0; 2],
        ..lamp(3.5, [0.0; 3])
    });
    // Behind all walls: no light arrives from there.
    let far = Panel {
        min: [-1e6; 2],
        max: [1e6; 2],
        ..lamp(3e6, [4.0; 3])
    };
    let mut rng = ProbeRng::new("shadows", 0);
    let points = (0..80).map(|_| ShadedPoint {
        p: [rng.range(-3.0, 3.0), 0.0, rng.range(-3.0, 3.0)],
        ..floor()
    });
    let world = world(vec![point()], vec![lamp(3.0, [4.0; 3]), half, behind, far]);
    work(Strategy::Lights, world, points.collect(), 4, 0)
}

fn no_light() -> DirectWork {
    let up = Panel {
        faces: 1.0,
        ..lamp(2.0, [5.0; 3])
    };
    let deep = Panel {
        faces: 1.0,
        ..lamp(-2.0, [5.0; 3])
    };
    let low = Light::Point {
        position: [0.5, -2.0, 0.0],
        intensity: [5.0; 3],
    };
    let aside = Light::Spot {
        position: [9.0, 3.0, 0.0],
        direction: [0.0, -1.0, 0.0],
        intensity: [5.0; 3],
        falloff_angle: 30.0,
        falloff_exponent: 0.0,
    };
    let risen = Light::Directional {
        direction: [0.0, 1.0, 0.0],
        irradiance: [1.0; 3],
    };
    let world = world(vec![low, aside, risen], vec![up, deep]);
    work(Strategy::Lights, world, vec![floor(); 20], 2, 0)
}

/// A sunset: bright low in one direction, dim above, dark below.
fn environment() -> DirectWork {
    let texel = |x: i32, y: i32| {
        let towards_the_sun = f64::from(if x == 5 { 6 } else { x.min(1) });
        let high = f64::from(4 - y);
        if y < 4 {
            [0.3 * towards_the_sun + 0.2 * high, 0.4 * high, 0.9 * high]
        } else {
            [0.1 * f64::from(x), 0.0, 0.0]
        }
    };
    let rows = (0..8).flat_map(|y| (0..8).map(move |x| (x, y)));
    let world = LitWorld {
        environment: Some(Surroundings {
            width: 8,
            texels: rows.map(|(x, y)| texel(x, y)).collect(),
        }),
        ..LitWorld::default()
    };
    work(Strategy::Lights, world, vec![floor(); ESTIMATES], 2, 1)
}

fn half_below() -> Panel {
    Panel {
        axis: 0,
        at: -1.5,
        min: [-1.0; 2],
        max: [1.0; 2],
        faces: 1.0,
        material: Material::Emission([5.0; 3]),
    }
}

/// One lamp: a panel that faces down, and behind it a larger one that faces up.
fn two_sides() -> Vec<Panel> {
    let material = Material::PartOfLamp([4.0; 3]);
    let down = Panel {
        material,
        ..lamp(1.5, [0.0; 3])
    };
    let up = Panel {
        at: 1.75,
        max: [2.0; 2],
        faces: 1.0,
        ..down
    };
    vec![down, up]
}

fn below() -> DirectWork {
    let deep = Panel {
        faces: 1.0,
        ..lamp(-2.0, [5.0; 3])
    };
    let world = world(vec![point()], vec![deep]);
    work(Strategy::Lights, world, vec![ceiling(); 20], 2, 0)
}

fn mirrors() -> DirectWork {
    let points = vec![
        floor_of(Material::Mirror([1.0; 3])),
        floor_of(Material::Glass(1.5)),
        floor(),
    ];
    let world = world(vec![point()], vec![lamp(3.0, [4.0; 3])]);
    work(Strategy::Lights, world, points, 8, 0)
}

fn fresh(seed: u64) -> DirectWork {
    let mut rng = ProbeRng::new("fresh_lights", seed);
    let lamps = (0..2).map(|_| random_lamp(&mut rng)).collect();
    let lights = (0..2).map(|_| Light::Point {
        position: (4.0 * rng.direction()).into(),
        intensity: [1.0, 4.0, 9.0].map(|most| rng.range(0.5, most)),
    });
    let lights = lights.collect();
    let points = (0..80).map(|_| random_point(&mut rng)).collect();
    work(Strategy::Lights, world(lights, lamps), points, 3, seed)
}
