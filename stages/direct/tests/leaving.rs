//! Rays that leave a surface. They do not hit the surface that they left, a light does not block
//! itself, and no thin gap is skipped.
//!
//! The hits come from the course's kernels, so these tests check that both work together.

// BEGIN SOLUTION(part3.task3)
use intersect::{intersect_sphere, intersect_triangle};
use kit::emitter::Emitter;
use kit::emitting_mesh::{EmittingMesh, EmittingTriangle};
use kit::{
    Hit, Material, PixelSampler, PrimId, Primitive, Ray, Spectrum, Sphere, Surface, Triangle, Vec2,
    Vec3, warp,
};

const DIFFUSE: Material = Material::Diffuse {
    reflectance: Spectrum::WHITE,
};

/// A sequence of random numbers.
struct Random(PixelSampler);

impl Random {
    fn new(seed: u64) -> Random {
        Random(PixelSampler::new(0, 0, seed))
    }
    fn square(&mut self) -> Vec2 {
        self.0.next_2d()
    }
    fn direction(&mut self) -> Vec3 {
        warp::uniform_sphere(self.square())
    }
}

/// Centre and size of scenes: of ordinary size, very small and far from the origin, and very large.
const SCENES: [(Vec3, f64); 4] = [
    (Vec3::ZERO, 1.0),
    (Vec3::new(1e4, -300.0, 7.0), 1e-3),
    (Vec3::new(-2e6, 5e6, 1e6), 1e6),
    (Vec3::new(0.0, 1e-9, 0.0), 1e-9),
];

fn assert_leaves(
    surface: &Surface,
    random: &mut Random,
    mut intersect: impl FnMut(&mut Ray) -> Option<Hit>,
) {
    for _ in 0..20 {
        let w = random.direction();
        // Both directions: reflected rays leave on one side, refracted rays on the other.
        for w in [w, -w] {
            let mut ray = surface.leave(w);
            let side = (ray.o - surface.p).dot(surface.ng);
            assert!(
                side * w.dot(surface.ng) > 0.0,
                "the origin is on the wrong side: {ray:?}"
            );
            if let Some(hit) = intersect(&mut ray) {
                panic!("{ray:?} left {surface:?} and hit it again: {hit:?}");
            }
        }
    }
}

/// Hard case 82.
#[test]
fn ray_does_not_hit_the_triangle_that_it_left() {
    let mut random = Random::new(1);
    for (center, size) in SCENES {
        for _ in 0..500 {
            let mut corner = || center + size * random.direction();
            let tri = Triangle::flat(corner(), corner(), corner());
            let middle = (tri.p0 + tri.p1 + tri.p2) / 3.0;
            let inside = middle + 0.9 * random.square().x * (tri.p1 - middle);
            let o = inside + 5.0 * size * random.direction();
            let mut ray = Ray::new(o, (inside - o).normalize());
            let Some(hit) = intersect_triangle(&tri, PrimId(0), &mut ray) else {
                continue;
            };
            let surface = Surface::new(&hit, Primitive::Triangle(&tri), &DIFFUSE);
            assert_leaves(&surface, &mut random, |ray| {
                intersect_triangle(&tri, PrimId(0), ray)
            });
        }
    }
}

/// Hard case 82, and the path through a glass sphere: outward rays miss the sphere, inward rays hit
/// the far side.
#[test]
fn ray_hits_the_sphere_that_it_left_only_from_inside() {
    let mut random = Random::new(2);
    for (center, size) in SCENES {
        let s = Sphere {
            center,
            radius: size,
        };
        for _ in 0..500 {
            let o = center + 3.0 * size * random.direction();
            let aim = center + 0.95 * size * random.direction();
            let mut ray = Ray::new(o, (aim - o).normalize());
            let hit =
                intersect_sphere(&s, PrimId(0), &mut ray).expect("the target is inside the sphere");
            let surface = Surface::new(&hit, Primitive::Sphere(&s), &DIFFUSE);
            for _ in 0..20 {
                let w = random.direction();
                let again = intersect_sphere(&s, PrimId(0), &mut surface.leave(w));
                let cos = w.dot(surface.ng);
                if cos > 0.0 {
                    assert_eq!(again, None, "outward rays must miss");
                } else {
                    // The length of a chord of a circle: 2 r |cos θ|.
                    let t = again.expect("inward rays hit").t;
                    let chord = 2.0 * size * -cos;
                    // The offset is relative to the largest coordinate, and its effect grows at
                    // grazing angles.
                    let tolerance = 10.0 * surface.error.length() / -cos;
                    assert!((t - chord).abs() <= tolerance + 1e-9 * size, "{t} {chord}");
                }
            }
        }
    }
}

#[test]
fn another_triangle_of_the_plane_does_not_block() {
    let corners = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
    let planes: [fn([f64; 2]) -> Vec3; 4] = [
        |[a, b]| Vec3::new(0.0, a, b),
        |[a, b]| Vec3::new(b, 0.0, a),
        |[a, b]| Vec3::new(a, b, 0.0),
        |[a, b]| Vec3::new(a, b, 0.001 * a),
    ];
    let mut random = Random::new(8);
    for plane in planes {
        let [p0, p1, p2, p3] = corners.map(plane);
        let own = Triangle::flat(p0, p1, p2);
        // The next one, and its own back, as files have it that show both sides.
        for other in [Triangle::flat(p0, p2, p3), Triangle::flat(p0, p2, p1)] {
            for _ in 0..300 {
                let along = 4.0 * random.square().x - 2.0;
                let mut ray = Ray::new(plane([along, along]) + 3.0 * own.n0, -own.n0);
                let Some(hit) = intersect_triangle(&own, PrimId(0), &mut ray) else {
                    continue;
                };
                let surface = Surface::new(&hit, Primitive::Triangle(&own), &DIFFUSE);
                let w = random.direction();
                let mut ray = surface.leave(w);
                let again = intersect_triangle(&other, PrimId(1), &mut ray);
                assert_eq!(again, None, "{ray:?}");
            }
        }
    }
}

fn lamp(height: f64) -> (Triangle, Emitter) {
    let corner = |x: f64, z: f64| Vec3::new(x, height, z);
    let tri = Triangle::flat(corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0));
    let mesh = EmittingMesh::new(
        vec![EmittingTriangle {
            p0: tri.p0,
            e1: tri.p1 - tri.p0,
            e2: tri.p2 - tri.p0,
            front: -Vec3::Y,
        }],
        Spectrum::WHITE,
    );
    (tri, Emitter::Mesh(mesh.expect("the triangle has an area")))
}

fn floor_at(p: Vec3) -> Surface<'static> {
    let floor = Triangle::flat(
        Vec3::new(-9.0, 0.0, -9.0),
        Vec3::new(0.0, 0.0, 9.0),
        Vec3::new(9.0, 0.0, -9.0),
    );
    let hit = Hit {
        t: 1.0,
        p,
        n: Vec3::Y,
        ng: Vec3::Y,
        uv: Vec2::ZERO,
        prim: PrimId(0),
    };
    Surface::new(&hit, Primitive::Triangle(&floor), &DIFFUSE)
}

/// Hard case 79: from below the lamp and from far beside it, where shadow rays reach it at grazing
/// angles.
#[test]
fn triangle_lamp_does_not_block_itself() {
    let mut random = Random::new(3);
    for height in [1e-3, 0.75, 40.0] {
        let (tri, emitter) = lamp(height);
        for x in [0.0, 1.0, 10.0, 300.0] {
            let surface = floor_at(Vec3::new(x, 0.0, 0.3));
            for _ in 0..2000 {
                let Some(light) = emitter.sample(surface.p, random.square()) else {
                    continue;
                };
                let mut ray = surface.shadow_ray(&light);
                assert_eq!(
                    intersect_triangle(&tri, PrimId(0), &mut ray),
                    None,
                    "height {height}, distance {x}"
                );
            }
        }
    }
}

/// Hard case 79 for a spherical lamp: many shadow rays are nearly tangent to it.
#[test]
fn spherical_lamp_does_not_block_itself() {
    let mut random = Random::new(4);
    let sphere = Sphere {
        center: Vec3::new(0.3, 2.0, 0.1),
        radius: 0.5,
    };
    let emitter = Emitter::Sphere {
        sphere,
        radiance: Spectrum::WHITE,
        prim: PrimId(0),
    };
    let surface = floor_at(Vec3::ZERO);
    for _ in 0..100_000 {
        let light = emitter
            .sample(surface.p, random.square())
            .expect("the point is outside the sphere");
        let mut ray = surface.shadow_ray(&light);
        assert_eq!(intersect_sphere(&sphere, PrimId(0), &mut ray), None);
    }
}

/// Hard case 81: an occluder 1e-5 in front of the lamp or above the floor casts a shadow.
#[test]
fn occluders_near_lamp_and_floor_cast_shadows() {
    let mut random = Random::new(5);
    let (_, emitter) = lamp(2.0);
    let surface = floor_at(Vec3::ZERO);
    for height in [1e-5, 2.0 - 1e-5] {
        let far = 5.0;
        let occluder = Triangle::flat(
            Vec3::new(-far, height, -far),
            Vec3::new(far, height, -far),
            Vec3::new(0.0, height, 2.0 * far),
        );
        for _ in 0..10_000 {
            let light = emitter
                .sample(surface.p, random.square())
                .expect("the point is in front of the lamp");
            let mut ray = surface.shadow_ray(&light);
            assert!(
                intersect_triangle(&occluder, PrimId(0), &mut ray).is_some(),
                "no hit with the occluder at height {height}"
            );
        }
    }
}
// END SOLUTION(part3.task3)
