//! Cases of emission, and of direct light by uniform hemisphere sampling.

use crate::tools::findings::Aspect::{Direction, Mean, Origin, Radiance, Range, Rays, Spread};
use crate::tools::kinds::direct_light::worlds::{
    ceiling, floor, floor_of, lamp, lamps_and_floor, of_panels, random_lamp, random_point, room,
    smooth_point, wall, with_dark_ones, work,
};
use crate::tools::questions::probes::ProbeRng;
use crate::tools::spec::Spec;
use kit::Vec3;
use wire::direct::{DirectWork, ShadedPoint, Strategy};
use wire::kind;
use wire::light::{LitWorld, Material, Panel, Surroundings};

/// The number of estimates in a case about their mean.
const ESTIMATES: usize = 4000;

/// The cases of `part3.task2`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        case(
            "glowing_surface",
            "zero_bounce_radiance is the radiance that the surface emits: on its front side, at \
             any angle; and 0 from behind, edge-on, or where the surface does not emit. The \
             geometric normal decides which side is the front.",
            work(Strategy::ZeroBounce, LitWorld::default(), emitting(), 0, 0),
        ),
        case(
            "rays_start_at_the_surface",
            "Every ray starts at the origin that Surface::leave returns, with its whole range. \
             Pitfall: a ray that starts at the hit point itself may hit the surface again.",
            hemisphere("start", uniform_environment(0.5), 60, 4),
        )
        .only(&[Origin, Range]),
        case(
            "rays_fill_the_hemisphere",
            "One ray a sample, each a unit vector in world space above the surface; together they \
             are distributed uniformly over the hemisphere, down to the plane of the surface (χ² \
             and Poisson tests). A deviation of 12 % is always detected. Pitfall: directions that \
             are kept a little away from the plane.",
            same(uniform_environment(1.0), floor(), 2000, 16),
        )
        .only(&[Rays, Direction, Spread])
        .mainly(&[Direction, Spread]),
        case(
            "side_of_the_viewer",
            "A surface seen from below scatters light from below: directions are sampled on the \
             side of wo. A bias of 9 % is always detected. A deviation of 24 % is always \
             detected.",
            same(uniform_environment(1.0), ceiling(), 2000, 4),
        )
        .only(&[Rays, Direction, Spread, Mean])
        .mainly(&[Direction, Mean]),
        case(
            "tilted_surfaces",
            "Smooth meshes with normals in all directions: f takes local directions, rays have \
             world directions. Pitfall: the cosine is that to the shading normal, as in the local \
             space, not that to the geometric one. A frame made with a fixed vector fails where \
             the normal is parallel to it.",
            tilted(),
        )
        .only(&[Direction, Radiance]),
        case(
            "sum_of_what_is_seen",
            "Given the traced rays, the sum of f · L · |cos θ| · 2π over their number is known \
             exactly: L is what the front of the hit surface emits, or the background where the \
             ray misses. Faint light counts, too: some surfaces are nearly black. Pitfall: \
             dropping contributions below a threshold.",
            DirectWork {
                points: with_dark_ones(hemisphere("sum", room(), 60, 8).points),
                ..hemisphere("sum", room(), 0, 8)
            },
        )
        .only(&[Radiance]),
        case(
            "uniform_environment",
            "The same radiance from every direction: the mean of many estimates is the integral \
             of f times the cosine. A bias of 6 % is always detected.",
            same(uniform_environment(2.0), floor(), ESTIMATES, 4),
        )
        .only(&[Mean]),
        case(
            "square_lamp",
            "A lamp above the floor: the mean of many estimates follows from its form factor. A \
             bias of 15 % is always detected.",
            same(of_panels(vec![lamp(1.0, [5.0; 3])]), floor(), ESTIMATES, 4),
        )
        .only(&[Mean]),
        case(
            "lamp_that_faces_away",
            "A lamp emits on one side; seen from its back, or behind a wall, it adds no light.",
            facing_away(),
        )
        .only(&[Radiance]),
        case(
            "surface_that_emits",
            "A lamp emits and scatters nothing, so its direct light is black. Pitfall: its own \
             emission is the light of zero bounces; added here, it counts twice.",
            work(
                Strategy::Hemisphere,
                uniform_environment(1.0),
                lamps_and_floor(),
                4,
                0,
            ),
        )
        .only(&[Radiance]),
        case(
            "mirrors_ask_for_nothing",
            "A mirror or glass scatters no light from a random direction: the estimate is black, \
             and no ray is traced.",
            work(
                Strategy::Hemisphere,
                uniform_environment(1.0),
                vec![
                    floor_of(Material::Mirror([1.0; 3])),
                    floor_of(Material::Glass(1.5)),
                    floor(),
                ],
                16,
                0,
            ),
        )
        .only(&[Rays, Radiance]),
        case(
            "no_samples",
            "With 0 samples the estimate is black, not 0 / 0.",
            work(
                Strategy::Hemisphere,
                uniform_environment(1.0),
                vec![floor(); 3],
                0,
                0,
            ),
        )
        .only(&[Rays, Radiance]),
        case(
            "fresh_lamps",
            "Random lamps and points that depend on the seed.",
            fresh(seed),
        ),
    ]
}

fn case(name: &'static str, about: &'static str, work: DirectWork) -> Spec {
    Spec::new::<kind::Direct>("part3.task2", name, about, work)
}

/// A world with only a constant environment.
fn uniform_environment(radiance: f64) -> LitWorld {
    LitWorld {
        environment: Some(Surroundings::uniform([
            radiance,
            2.0 * radiance,
            0.5 * radiance,
        ])),
        ..LitWorld::default()
    }
}

fn hemisphere(name: &str, world: LitWorld, points: usize, samples: u32) -> DirectWork {
    let mut rng = ProbeRng::new(name, 0);
    let points = (0..points).map(|_| random_point(&mut rng)).collect();
    work(Strategy::Hemisphere, world, points, samples, 0)
}

/// Points of smooth meshes, and of flat ones across each axis: some frames around a normal fail for
/// one axis.
fn tilted() -> DirectWork {
    let mut rng = ProbeRng::new("tilted", 0);
    let mut points: Vec<ShadedPoint> = (0..60).map(|_| smooth_point(&mut rng)).collect();
    for axis in Vec3::AXES {
        for n in [axis, -axis] {
            points.push(ShadedPoint {
                n: n.into(),
                ng: n.into(),
                wo: (n + 0.5 * rng.direction()).normalize().into(),
                ..floor()
            });
        }
    }
    work(Strategy::Hemisphere, room(), points, 4, 0)
}

/// Many estimates at the same point.
fn same(world: LitWorld, point: ShadedPoint, estimates: usize, samples: u32) -> DirectWork {
    let points = vec![point; estimates];
    work(Strategy::Hemisphere, world, points, samples, 1)
}

fn emitting() -> Vec<ShadedPoint> {
    let mut rng = ProbeRng::new("glowing", 0);
    let mut points = vec![ShadedPoint {
        // Exactly edge-on.
        wo: [0.6, 0.0, -0.8],
        ..floor_of(Material::Emission([1.0; 3]))
    }];
    let materials = [
        Material::Emission([3.0, 2.0, 0.0]),
        Material::Emission([0.01, 50.0, 7.0]),
        Material::Diffuse([0.5; 3]),
        Material::Mirror([1.0; 3]),
    ];
    for i in 0..60 {
        let point = ShadedPoint {
            material: materials[i % materials.len()],
            ..random_point(&mut rng)
        };
        let wo = point.wo.map(|x| rng.one_of(&[1.0, 1.0, -1.0]) * x);
        points.push(ShadedPoint { wo, ..point });
        points.push(ShadedPoint {
            wo: point.wo.map(|x| -x),
            ..point
        });
        points.push(point);
    }
    // In front of one normal and behind the other.
    for _ in 0..10 {
        let point = ShadedPoint {
            material: materials[0],
            ..random_point(&mut rng)
        };
        let (n, wo) = (Vec3::from(point.n), Vec3::from(point.wo));
        let ng = (n - (n.dot(wo) + 0.2) * wo).normalize();
        points.push(ShadedPoint {
            ng: ng.into(),
            ..point
        });
        points.push(ShadedPoint {
            ng: (-ng).into(),
            n: (-n).into(),
            ..point
        });
    }
    points
}

fn facing_away() -> DirectWork {
    let world = of_panels(vec![
        Panel {
            faces: 1.0,
            ..lamp(1.0, [5.0; 3])
        },
        lamp(2.0, [5.0; 3]),
        wall(Panel {
            min: [-9.0; 2],
            max: [9.0; 2],
            ..lamp(1.5, [0.0; 3])
        }),
    ]);
    work(Strategy::Hemisphere, world, vec![floor(); 20], 16, 0)
}

fn fresh(seed: u64) -> DirectWork {
    let mut rng = ProbeRng::new("fresh_lamps", seed);
    let lamps = (0..3).map(|_| random_lamp(&mut rng)).collect();
    let points = (0..60).map(|_| random_point(&mut rng)).collect();
    work(Strategy::Hemisphere, of_panels(lamps), points, 16, seed)
}
