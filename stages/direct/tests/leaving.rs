//! Rays that leave surfaces: they do not meet the place they left, nor a lamp its own light, and they jump over nothing.
//!
//! The hits are those of the course's kernels, so these tests are about how the two fit together.

// BEGIN SOLUTION(part3.task3)
use intersect::{intersect_sphere, intersect_triangle};
use kit::emitter::Emitter;
use kit::emitting_mesh::{EmittingMesh, EmittingTriangle};
use kit::{
    Hit, Material, PixelSampler, PrimId, Primitive, Ray, Spectrum, Sphere, Surface, Triangle, Vec2,
    Vec3, warp,
};

const MATTE: Material = Material::Diffuse {
    reflectance: Spectrum::WHITE,
};

/// Random numbers, one after the other.
struct Dice(PixelSampler);

impl Dice {
    fn new(seed: u64) -> Dice {
        Dice(PixelSampler::new(0, 0, seed))
    }
    fn square(&mut self) -> Vec2 {
        self.0.next_2d()
    }
    fn direction(&mut self) -> Vec3 {
        warp::uniform_sphere(self.square())
    }
}

/// Scenes of ordinary size, a speck far from the origin, and a planet.
const PLACES: [(Vec3, f64); 4] = [
    (Vec3::ZERO, 1.0),
    (Vec3::new(1e4, -300.0, 7.0), 1e-3),
    (Vec3::new(-2e6, 5e6, 1e6), 1e6),
    (Vec3::new(0.0, 1e-9, 0.0), 1e-9),
];

fn assert_leaves(
    surface: &Surface,
    dice: &mut Dice,
    mut again: impl FnMut(&mut Ray) -> Option<Hit>,
) {
    for _ in 0..20 {
        let w = dice.direction();
        // Both ways: what is reflected leaves on one side, what is refracted on the other.
        for w in [w, -w] {
            let mut ray = surface.leave(w);
            let side = (ray.o - surface.p).dot(surface.ng);
            assert!(side * w.dot(surface.ng) > 0.0, "on the wrong side: {ray:?}");
            if let Some(hit) = again(&mut ray) {
                panic!("{ray:?} left {surface:?} and met it at {hit:?}");
            }
        }
    }
}

/// Hard case 82.
#[test]
fn a_ray_does_not_meet_the_triangle_it_left() {
    let mut dice = Dice::new(1);
    for (center, size) in PLACES {
        for _ in 0..500 {
            let mut corner = || center + size * dice.direction();
            let tri = Triangle::flat(corner(), corner(), corner());
            let middle = (tri.p0 + tri.p1 + tri.p2) / 3.0;
            let inside = middle + 0.9 * dice.square().x * (tri.p1 - middle);
            let o = inside + 5.0 * size * dice.direction();
            let mut ray = Ray::new(o, (inside - o).normalize());
            let Some(hit) = intersect_triangle(&tri, PrimId(0), &mut ray) else {
                continue;
            };
            let surface = Surface::new(&hit, Primitive::Triangle(&tri), &MATTE);
            assert_leaves(&surface, &mut dice, |ray| {
                intersect_triangle(&tri, PrimId(0), ray)
            });
        }
    }
}

/// Hard case 82, and the way through a ball of glass: outwards the sphere is not met again, inwards its far side is.
#[test]
fn a_ray_meets_a_sphere_again_only_from_inside() {
    let mut dice = Dice::new(2);
    for (center, size) in PLACES {
        let s = Sphere {
            center,
            radius: size,
        };
        for _ in 0..500 {
            let o = center + 3.0 * size * dice.direction();
            let aim = center + 0.95 * size * dice.direction();
            let mut ray = Ray::new(o, (aim - o).normalize());
            let hit = intersect_sphere(&s, PrimId(0), &mut ray).expect("aimed at the inside");
            let surface = Surface::new(&hit, Primitive::Sphere(&s), &MATTE);
            for _ in 0..20 {
                let w = dice.direction();
                let again = intersect_sphere(&s, PrimId(0), &mut surface.leave(w));
                let cos = w.dot(surface.ng);
                if cos > 0.0 {
                    assert_eq!(again, None, "outwards");
                } else {
                    // The chord of a circle: 2 r |cos θ|.
                    let t = again.expect("inwards").t;
                    let chord = 2.0 * size * -cos;
                    // The offset is a share of the largest coordinate, and flat angles magnify it.
                    let slack = 10.0 * surface.error.length() / -cos;
                    assert!((t - chord).abs() <= slack + 1e-9 * size, "{t} {chord}");
                }
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
    (tri, Emitter::Mesh(mesh.expect("it has an area")))
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
    Surface::new(&hit, Primitive::Triangle(&floor), &MATTE)
}

/// Hard case 79, from below the lamp and from far beside it, where shadow rays graze it.
#[test]
fn a_lamp_is_not_in_its_own_light() {
    let mut dice = Dice::new(3);
    for height in [1e-3, 0.75, 40.0] {
        let (tri, emitter) = lamp(height);
        for x in [0.0, 1.0, 10.0, 300.0] {
            let surface = floor_at(Vec3::new(x, 0.0, 0.3));
            for _ in 0..2000 {
                let Some(light) = emitter.sample(surface.p, dice.square()) else {
                    continue;
                };
                let mut ray = surface.shadow_ray(&light);
                assert_eq!(
                    intersect_triangle(&tri, PrimId(0), &mut ray),
                    None,
                    "height {height}, {x} beside"
                );
            }
        }
    }
}

/// Hard case 79 for a round lamp, whose limb is grazed by every other shadow ray.
#[test]
fn a_round_lamp_is_not_in_its_own_light() {
    let mut dice = Dice::new(4);
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
        let light = emitter.sample(surface.p, dice.square()).expect("outside");
        let mut ray = surface.shadow_ray(&light);
        assert_eq!(intersect_sphere(&sphere, PrimId(0), &mut ray), None);
    }
}

/// Hard case 81: what hangs a hundred-thousandth before the lamp, or lies as much above the floor, casts its shadow.
#[test]
fn thin_gaps_do_not_leak() {
    let mut dice = Dice::new(5);
    let (_, emitter) = lamp(2.0);
    let surface = floor_at(Vec3::ZERO);
    for height in [1e-5, 2.0 - 1e-5] {
        let far = 5.0;
        let shade = Triangle::flat(
            Vec3::new(-far, height, -far),
            Vec3::new(far, height, -far),
            Vec3::new(0.0, height, 2.0 * far),
        );
        for _ in 0..10_000 {
            let light = emitter.sample(surface.p, dice.square()).expect("in front");
            let mut ray = surface.shadow_ray(&light);
            assert!(
                intersect_triangle(&shade, PrimId(0), &mut ray).is_some(),
                "leaks through the shade at {height}"
            );
        }
    }
}
// END SOLUTION(part3.task3)
