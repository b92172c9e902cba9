//! Points, lamps and walls for cases of direct light.

use crate::tools::questions::probes::ProbeRng;
use kit::Vec3;
use wire::direct::{DirectWork, ShadedPoint, Strategy};
use wire::light::{Light, LitWorld, Material, Panel, Surroundings};
use wire::work::Xyz;

/// The error bound of the points: far larger than rounding, so that a ray's origin shows whether it
/// is offset by this bound, and far smaller than the gap between a shadow ray's end and its light.
const POINT_ERROR: f64 = 2e-12;

/// A lamp at the height `at` that emits downward, from -1 to 1 along x and z.
pub(crate) fn lamp(at: f64, radiance: Xyz) -> Panel {
    Panel {
        axis: 1,
        at,
        min: [-1.0; 2],
        max: [1.0; 2],
        faces: -1.0,
        material: Material::Emission(radiance),
    }
}

/// The same panel, as a wall that does not emit.
pub(crate) fn wall(panel: Panel) -> Panel {
    Panel {
        material: Material::Diffuse([0.5; 3]),
        ..panel
    }
}

/// A point of a diffuse surface in the plane y = 0, seen from above.
pub(crate) fn floor() -> ShadedPoint {
    ShadedPoint {
        p: [0.3, 0.0, -0.2],
        n: [0.0, 1.0, 0.0],
        ng: [0.0, 1.0, 0.0],
        error: POINT_ERROR,
        material: Material::Diffuse([0.8, 0.5, 0.25]),
        wo: [0.48, 0.64, 0.6],
    }
}

/// The floor with another material.
pub(crate) fn floor_of(material: Material) -> ShadedPoint {
    ShadedPoint {
        material,
        ..floor()
    }
}

/// Lamps in the plane y = 0, seen from the front and from behind, and the floor, so that code which
/// is always black does not pass.
pub(crate) fn lamps_and_floor() -> Vec<ShadedPoint> {
    let lamps =
        [[1.0; 3], [0.25, 3.0, 20.0]].map(|radiance| floor_of(Material::Emission(radiance)));
    let seen = lamps.map(|lamp| {
        let behind = ShadedPoint {
            wo: ceiling().wo,
            ..lamp
        };
        [lamp, behind]
    });
    seen.into_iter().flatten().chain([floor()]).collect()
}

/// The same points, of which every fourth reflects a billionth as much light.
pub(crate) fn with_dark_ones(mut points: Vec<ShadedPoint>) -> Vec<ShadedPoint> {
    for point in points.iter_mut().step_by(4) {
        if let Material::Diffuse(reflectance) = &mut point.material {
            *reflectance = reflectance.map(|rho| 1e-9 * rho);
        }
    }
    points
}

/// The same points, of which every fourth, from the third on, is turned until light from `position`
/// arrives at an angle of a hundred-thousandth of a radian to the surface.
pub(crate) fn with_grazed_ones(mut points: Vec<ShadedPoint>, position: Vec3) -> Vec<ShadedPoint> {
    const COSINE: f64 = 1e-5;
    for point in points.iter_mut().skip(2).step_by(4) {
        let wi = (position - Vec3::from(point.p)).normalize();
        let across = Vec3::from(point.n).reject_from_normalized(wi).normalize();
        let n = (across + COSINE * wi).normalize();
        let wo = (n + 0.5 * across.cross(wi)).normalize();
        *point = ShadedPoint {
            n: n.into(),
            ng: n.into(),
            wo: wo.into(),
            ..*point
        };
    }
    points
}

/// The floor seen from below.
pub(crate) fn ceiling() -> ShadedPoint {
    let [x, y, z] = floor().wo;
    ShadedPoint {
        wo: [x, -y, z],
        ..floor()
    }
}

/// A point of a diffuse surface near the origin (0.8 or less along each axis), with a random
/// normal, seen from the side of its normal.
pub(crate) fn random_point(rng: &mut ProbeRng) -> ShadedPoint {
    let n = rng.direction();
    let wo = loop {
        let wo = rng.direction();
        if wo.dot(n) > 0.1 {
            break wo;
        }
    };
    ShadedPoint {
        p: (0.8 * rng.in_cube()).into(),
        n: n.into(),
        ng: n.into(),
        error: POINT_ERROR,
        material: Material::Diffuse([0.7, 0.4, 0.2].map(|rho: f64| rho * rng.range(0.5, 1.0))),
        wo: wo.into(),
    }
}

/// A random point of a mesh with smooth normals: the geometric normal is up to a third of a right
/// angle off the shading normal, and `wo` is in front of both.
pub(crate) fn smooth_point(rng: &mut ProbeRng) -> ShadedPoint {
    let point = random_point(rng);
    let ng = loop {
        let ng = (Vec3::from(point.n) + 0.5 * rng.direction()).normalize();
        if ng.dot(point.wo.into()) > 0.05 {
            break ng;
        }
    };
    ShadedPoint {
        ng: ng.into(),
        ..point
    }
}

/// A room of six panels around the origin, some of which emit, with a hole in the roof that shows
/// the sky.
pub(crate) fn room() -> LitWorld {
    let side = |axis: usize, sign: f64, material: Material| Panel {
        axis,
        at: 3.0 * sign,
        min: [-3.0; 2],
        max: [3.0; 2],
        faces: -sign,
        material,
    };
    let grey = Material::Diffuse([0.5; 3]);
    let roof = Panel {
        min: [-3.0, -3.0],
        max: [3.0, 1.0],
        ..side(1, 1.0, Material::Emission([4.0, 2.0, 1.0]))
    };
    LitWorld {
        panels: vec![
            side(0, 1.0, Material::Emission([0.0, 3.0, 0.5])),
            side(0, -1.0, grey),
            roof,
            side(1, -1.0, grey),
            side(2, 1.0, grey),
            // Its dark side faces the room.
            Panel {
                faces: -1.0,
                ..side(2, -1.0, Material::Emission([9.0; 3]))
            },
        ],
        // Only rays that go up see it.
        lights: vec![Light::Sky([6.0, 2.0, 1.0])],
        environment: Some(Surroundings::uniform([0.5, 1.0, 2.0])),
    }
}

/// The work of estimating direct light at `points`.
pub(crate) fn work(
    strategy: Strategy,
    world: LitWorld,
    points: Vec<ShadedPoint>,
    samples: u32,
    seed: u64,
) -> DirectWork {
    DirectWork {
        world,
        strategy,
        points,
        samples,
        seed,
    }
}

/// A world of panels without other lights.
pub(crate) fn of_panels(panels: Vec<Panel>) -> LitWorld {
    LitWorld {
        panels,
        ..LitWorld::default()
    }
}

/// A random lamp that faces the origin.
pub(crate) fn random_lamp(rng: &mut ProbeRng) -> Panel {
    let axis = rng.below(3);
    let faces = rng.one_of(&[-1.0, 1.0]);
    let corner = [rng.range(-2.0, 0.0), rng.range(-2.0, 0.0)];
    Panel {
        axis,
        at: -faces * rng.range(1.5, 3.0),
        min: corner,
        max: corner.map(|least| least + rng.range(0.5, 2.0)),
        faces,
        material: Material::Emission([1.0, 2.0, 3.0].map(|most| rng.range(0.1, most))),
    }
}

/// The normalised vector.
pub(crate) fn unit(v: [f64; 3]) -> Xyz {
    Vec3::from(v).normalize().into()
}
