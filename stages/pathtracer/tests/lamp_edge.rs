//! Several camera rays for each sample at the edges of lamps: the same mean, with far less error,
//! and no other pixel changes.

use crate::common::own_scenes;
use kit::sampler::{Pattern, Sampling};
use kit::{Camera, FilmSize, LitScene, Material, Spectrum, Vec3};
use pathtracer::{Accel, AccelKind, Job, LightSettings, Rendered, Textures, render_lit};
use scenes::placement;
use std::sync::atomic::AtomicBool;

const FILM: FilmSize = FilmSize { w: 40, h: 30 };

/// A room with a lamp, and a camera that sees it.
fn room() -> (LitScene, Camera) {
    let file = own_scenes().join("cornell_spheres.dae");
    let scene = scenes::load(&file).expect("a scene").scene;
    let camera = placement::place(&scene, FILM).camera;
    (LitScene::new(scene, None), camera)
}

/// The picture of `samples` samples of emitted light alone.
fn emission(
    (lit, camera): &(LitScene, Camera),
    (samples, seed): (u32, u64),
    pattern: Pattern,
    lamp_rays: u32,
) -> Rendered {
    let job = Job {
        camera: *camera,
        film: FILM,
        cell: FILM.whole(),
        samples,
        sampling: Sampling {
            pattern,
            seed,
            first_sample: 0,
        },
    };
    let settings = LightSettings {
        max_depth: 0,
        lamp_rays,
        ..LightSettings::default()
    };
    let accel = Accel::build(AccelKind::Bvh, &lit.scene);
    let (textures, stop) = (Textures::default(), AtomicBool::new(false));
    render_lit(lit, &textures, &accel, &job, &settings, &stop, &|_, _| {})
}

/// The mean over the pixels of the squared difference of luminances.
fn squared_error(a: &Rendered, b: &Rendered) -> f64 {
    let pairs = a.film.pixels().iter().zip(b.film.pixels());
    let squares = pairs.map(|(a, b)| (a.radiance.luminance() - b.radiance.luminance()).powi(2));
    squares.sum::<f64>() / a.film.pixels().len() as f64
}

#[test]
fn eight_rays_a_sample_reduce_the_error_of_edges_and_keep_the_mean() {
    let room = room();
    let exact = emission(&room, (1 << 11, 99), Pattern::Sobol, 1);
    for pattern in [
        Pattern::Independent,
        Pattern::Stratified { samples: 16 },
        Pattern::Sobol,
        Pattern::Sobol4,
    ] {
        let error = |lamp_rays| -> f64 {
            let of = |seed| squared_error(&emission(&room, (16, seed), pattern, lamp_rays), &exact);
            (0..8).map(of).sum()
        };
        let ratio = error(8) / error(1);
        // Independent rays have 1/8 of the variance; it is a sum of few pixels.
        let most = if pattern == Pattern::Independent {
            0.25
        } else {
            0.1
        };
        assert!(ratio < most, "{pattern:?}: {ratio}");
    }
}

#[test]
fn no_pixel_changes_but_those_at_edges() {
    let room = room();
    let [one, eight] = [1, 8].map(|rays| emission(&room, (16, 3), Pattern::Sobol4, rays));
    let exact = emission(&room, (1 << 11, 99), Pattern::Sobol, 1);
    let luminances = |rendered: &Rendered| -> Vec<f64> {
        let pixels = rendered.film.pixels().iter();
        pixels.map(|pixel| pixel.radiance.luminance()).collect()
    };
    let exact = luminances(&exact);
    let materials = room.0.scene.materials.iter();
    let of_lamp = materials
        .map(|named| named.material.emission().luminance())
        .fold(0.0, f64::max);
    let mut changed = 0;
    for ((one, eight), exact) in luminances(&one).iter().zip(luminances(&eight)).zip(exact) {
        if *one != eight {
            changed += 1;
            assert!(0.0 < exact && exact < of_lamp, "{one} {eight} {exact}");
        }
    }
    assert!((4..60).contains(&changed), "{changed} pixels changed");
    // Each of 16 samples has nine rays more, of which one takes the light of its path away.
    let more = eight.counters.rays - one.counters.rays;
    assert!(more >= changed * 16 * 9, "{more} more rays");
}

#[test]
fn a_scene_without_a_visible_lamp_has_no_edges() {
    let (mut lit, camera) = room();
    let away = Camera {
        c2w: Camera::look_at(camera.pos, camera.pos - 9.0 * Vec3::Y, Vec3::X).expect("a direction"),
        ..camera
    };
    let rays = |room: &(LitScene, Camera), lamp_rays| {
        emission(room, (4, 1), Pattern::Sobol, lamp_rays)
            .counters
            .rays
    };
    let room = (lit.clone(), away);
    assert_eq!(rays(&room, 8), rays(&room, 1));
    for named in &mut lit.scene.materials {
        if named.material.emission() != Spectrum::BLACK {
            named.material = Material::Diffuse {
                reflectance: Spectrum::WHITE,
            };
        }
    }
    let room = (lit, camera);
    assert_eq!(rays(&room, 8), rays(&room, 1));
}
