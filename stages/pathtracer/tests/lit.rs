//! Lit pictures do not depend on threads or forced effects, and all sampling strategies agree.

use kit::effects::Effect;
use kit::film::Cell;
use kit::sampler::{Pattern, Sampling};
use kit::scene::{NamedLight, NamedMaterial, Object};
use kit::{
    Camera, Environment, Film, FilmSize, Light, LitScene, Material, Scene, Spectrum, Sphere, Tally,
    Texture, Triangle, Vec2, Vec3,
};
use pathtracer::{
    Accel, AccelKind, DirectSampling, Job, Lens, LightSettings, Rendered, Textures, render_lit,
};
use statistics::{sidak, two_sided};
use std::sync::atomic::AtomicBool;

const GREY: Material = Material::Diffuse {
    reflectance: Spectrum::grey(0.6),
};
const MIRROR: Material = Material::Mirror {
    reflectance: Spectrum::grey(0.9),
};
const GLASS: Material = Material::Glass {
    reflectance: Spectrum::WHITE,
    transmittance: Spectrum::WHITE,
    roughness: 0.0,
    ior: 1.5,
};
const ROUGH_GLASS: Material = Material::Glass {
    reflectance: Spectrum::WHITE,
    transmittance: Spectrum::WHITE,
    roughness: 0.4,
    ior: 1.5,
};
const REFRACTION: Material = Material::Refraction {
    transmittance: Spectrum::WHITE,
    roughness: 0.0,
    ior: 1.5,
};
const GLOSSY: Material = Material::Glossy {
    reflectance: Spectrum::grey(0.8),
    shininess: 20.0,
};

fn area_light() -> Light {
    Light::Area {
        center: Vec3::new(0.0, 2.0, 0.0),
        edge_x: Vec3::X,
        edge_y: Vec3::Z,
        direction: -Vec3::Y,
        radiance: Spectrum::new(8.0, 6.0, 4.0),
    }
}

fn sky() -> Light {
    Light::Hemisphere {
        radiance: Spectrum::grey(0.5),
    }
}

/// A ball on a floor, with a wall behind it.
fn ball(material: Material, light: Option<Light>) -> Scene {
    let corner = Vec3::new;
    let (a, b) = (corner(-2.0, 0.0, -2.0), corner(2.0, 0.0, -2.0));
    let (c, d) = (corner(2.0, 0.0, 2.0), corner(-2.0, 0.0, 2.0));
    let (e, f) = (corner(2.0, 3.0, -2.0), corner(-2.0, 3.0, -2.0));
    let object = |name: &str, material| Object {
        name: name.into(),
        material,
    };
    let named = |name: &str, material| NamedMaterial {
        name: name.into(),
        material,
    };
    Scene {
        triangles: vec![
            Triangle::flat(a, d, c),
            Triangle::flat(a, c, b),
            Triangle::flat(a, b, e),
            Triangle::flat(a, e, f),
        ],
        spheres: vec![Sphere {
            center: Vec3::new(0.2, 0.6, 0.1),
            radius: 0.6,
        }],
        object_of: vec![0, 0, 0, 0, 1],
        objects: vec![object("room", 0), object("ball", 1)],
        materials: vec![named("grey", GREY), named("ball", material)],
        lights: light
            .map(|light| NamedLight {
                name: "lamp".into(),
                light,
            })
            .into_iter()
            .collect(),
        ..Scene::default()
    }
}

fn job(w: u32, h: u32, samples: u32) -> Job {
    let pos = Vec3::new(0.0, 1.2, 4.0);
    let film = FilmSize { w, h };
    Job {
        camera: Camera {
            pos,
            c2w: Camera::look_at(pos, Vec3::new(0.0, 0.7, 0.0), Vec3::Y).expect("a view"),
            h_fov: 45.0,
            v_fov: 35.0,
            n_clip: 0.0,
            f_clip: f64::INFINITY,
        },
        film,
        cell: film.whole(),
        samples,
        sampling: Sampling::from(7),
    }
}

/// The texture of [`tiled`]: a dark and a bright texel.
fn tiles() -> Textures {
    Textures::from(vec![
        Texture::new(2, vec![Spectrum::grey(0.1), Spectrum::WHITE]).expect("one whole row"),
    ])
}

/// The ball on a textured floor.
fn tiled(light: Option<Light>) -> Scene {
    let mut scene = ball(GREY, light);
    scene.textures.add_material(Some("tiles.png".into()));
    let corner = |u: f64, v: f64| Vec2::new(u, v);
    scene.textures.coordinates = vec![
        [corner(0.0, 0.0), corner(0.0, 4.0), corner(4.0, 4.0)],
        [corner(0.0, 0.0), corner(4.0, 4.0), corner(4.0, 0.0)],
    ];
    scene
}

fn render_with(lit: &LitScene, job: &Job, settings: &LightSettings, threads: usize) -> Rendered {
    let textures = if lit.scene.textures.files.is_empty() {
        Textures::default()
    } else {
        tiles()
    };
    let accel = Accel::build(AccelKind::Bvh, &lit.scene);
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads")
        .install(|| {
            render_lit(
                lit,
                &textures,
                &accel,
                job,
                settings,
                &AtomicBool::new(false),
                &|_: Cell, _| (),
            )
        })
}

fn render(lit: &LitScene, job: &Job, settings: &LightSettings) -> Rendered {
    render_with(lit, job, settings, 2)
}

fn settings(max_depth: u32) -> LightSettings {
    LightSettings {
        max_depth,
        ..LightSettings::default()
    }
}

/// One scene for each effect, with all effects that it calls for at depth 5.
fn scenes() -> Vec<(&'static str, LitScene, Vec<Effect>)> {
    use Effect::{Background, Bounces, DirectLight, Fresnel, Glossy, Mirror, Refraction};
    let lit = |material, light| LitScene::new(ball(material, light), None);
    let sunlit = |material| {
        lit(
            material,
            Some(Light::Directional {
                direction: Vec3::new(1.0, -2.0, -1.0).normalize(),
                irradiance: Spectrum::grey(2.0),
            }),
        )
    };
    let map = Environment::new(
        2,
        1,
        vec![Spectrum::grey(0.2), Spectrum::new(1.0, 2.0, 3.0)],
    );
    let environment = LitScene::new(ball(GREY, None), Some(map.expect("two texels")));
    vec![
        ("dark", lit(GREY, None), vec![]),
        (
            "area light",
            lit(GREY, Some(area_light())),
            vec![DirectLight, Bounces],
        ),
        ("sun", sunlit(GREY), vec![DirectLight, Bounces]),
        (
            "sky",
            lit(GREY, Some(sky())),
            vec![DirectLight, Background, Bounces],
        ),
        (
            "environment",
            environment,
            vec![DirectLight, Background, Bounces],
        ),
        (
            "mirror",
            lit(MIRROR, Some(area_light())),
            vec![DirectLight, Bounces, Mirror],
        ),
        (
            "refraction",
            sunlit(REFRACTION),
            vec![DirectLight, Bounces, Refraction],
        ),
        (
            "glass",
            lit(GLASS, Some(area_light())),
            vec![DirectLight, Bounces, Fresnel],
        ),
        ("glossy", sunlit(GLOSSY), vec![DirectLight, Bounces, Glossy]),
        (
            "tiles",
            LitScene::new(tiled(Some(area_light())), None),
            vec![DirectLight, Bounces, Effect::Texture],
        ),
    ]
}

/// Hard cases 87 and 88, for every sampling pattern.
#[test]
fn pictures_do_not_depend_on_threads() {
    let lit = LitScene::new(ball(GLASS, Some(area_light())), None);
    for pattern in [
        Pattern::Independent,
        Pattern::Stratified { samples: 16 },
        Pattern::Sobol,
        Pattern::Sobol4,
    ] {
        for adaptive in [None, Some((16, 0.3))] {
            let mut job = job(40, 30, 16);
            job.sampling.pattern = pattern;
            let settings = LightSettings {
                adaptive,
                ..settings(5)
            };
            let one = render_with(&lit, &job, &settings, 1);
            for threads in [2, 8] {
                let many = render_with(&lit, &job, &settings, threads);
                assert!(many.film == one.film, "{threads} threads, {pattern:?}");
                assert_eq!(many.counters, one.counters);
                assert_eq!(many.effects, one.effects);
            }
        }
    }
}

/// Effects that are not called for have a count of 0, the others a positive one; forcing all
/// effects changes no bit of the picture.
#[test]
fn only_what_a_scene_calls_for_is_simulated() {
    for (name, lit, expected) in scenes() {
        for settings in [settings(5), settings(1), settings(0)] {
            let depth = settings.max_depth;
            let environment = name == "environment";
            let settings = LightSettings {
                environment,
                ..settings
            };
            let job = job(24, 18, 8);
            let plain = render(&lit, &job, &settings);
            let requirements = settings.effects(&lit);
            for requirement in &requirements {
                let counted = plain.effects.of(requirement.effect);
                let what = format!("{name} at depth {depth}: {requirement:?}");
                assert!(
                    requirement.is_called_for() || counted == 0,
                    "{what}: {counted}"
                );
                if depth == 5 {
                    assert_eq!(
                        requirement.is_called_for(),
                        expected.contains(&requirement.effect),
                        "{what}"
                    );
                    assert_eq!(
                        requirement.is_called_for(),
                        counted > 0,
                        "{what}: {counted}"
                    );
                }
            }
            let forced = LightSettings {
                force_effects: true,
                ..settings
            };
            let forced = render(&lit, &job, &forced);
            assert!(forced.film == plain.film, "{name} at depth {depth}");
        }
    }
}

/// Without an effect that a scene calls for, the picture is different.
#[test]
fn removing_an_effect_changes_the_picture() {
    let job = job(24, 18, 8);
    let picture = |scene: Scene, settings: &LightSettings| {
        render(&LitScene::new(scene, None), &job, settings).film
    };
    let lamp_on = |material| picture(ball(material, Some(area_light())), &settings(5));
    let sky_on = |light| picture(ball(GREY, light), &settings(5));
    // Direct light and background: without the light. Bounces: depth 1.
    assert_ne!(lamp_on(GREY), picture(ball(GREY, None), &settings(5)));
    assert_ne!(sky_on(Some(sky())), sky_on(None));
    assert_ne!(
        lamp_on(GREY),
        picture(ball(GREY, Some(area_light())), &settings(1))
    );
    // Materials: a ball that absorbs all light.
    let absorbing = Material::Emission {
        radiance: Spectrum::BLACK,
    };
    for material in [MIRROR, REFRACTION, GLASS, GLOSSY] {
        assert_ne!(lamp_on(material), lamp_on(absorbing), "{material:?}");
    }
    // Fresnel's equations: glass without reflection. Roughness: a mirror.
    let without_fresnel = Material::Refraction {
        transmittance: Spectrum::WHITE,
        roughness: 0.0,
        ior: 1.5,
    };
    assert_ne!(lamp_on(GLASS), lamp_on(without_fresnel));
    let smooth = Material::Mirror {
        reflectance: Spectrum::grey(0.8),
    };
    assert_ne!(lamp_on(GLOSSY), lamp_on(smooth));
    // Textures: a plain floor.
    let with_tiles = picture(tiled(Some(area_light())), &settings(5));
    assert_ne!(with_tiles, lamp_on(GREY));
    // The lens: a pinhole.
    let blurred = LightSettings {
        lens: Lens {
            radius: 0.2,
            focus: 2.0,
        },
        ..settings(1)
    };
    let scene = || ball(GREY, Some(area_light()));
    assert_ne!(picture(scene(), &blurred), picture(scene(), &settings(1)));
    let lit = LitScene::new(scene(), None);
    let counted = render(&lit, &job, &blurred).effects.of(Effect::Lens);
    assert_eq!(counted, 24 * 18 * 8);
    let forced = LightSettings {
        force_effects: true,
        ..blurred
    };
    assert!(render(&lit, &job, &forced).film == render(&lit, &job, &blurred).film);
}

/// A white texture changes nothing; a grey one scales direct light exactly.
#[test]
fn textures_scale_reflected_light() {
    let lit = LitScene::new(tiled(Some(sky())), None);
    let plain = LitScene::new(ball(GREY, Some(sky())), None);
    let (job, settings) = (job(24, 18, 4), settings(1));
    let with = |lit: &LitScene, tint| {
        let accel = Accel::build(AccelKind::Bvh, &lit.scene);
        let textures = Textures::from(vec![Texture::uniform(tint)]);
        let stop = AtomicBool::new(false);
        render_lit(lit, &textures, &accel, &job, &settings, &stop, &|_, _| ()).film
    };
    let untouched = with(&plain, Spectrum::grey(0.5));
    assert!(with(&lit, Spectrum::WHITE) == untouched);
    let halved = with(&lit, Spectrum::grey(0.5));
    // The first row shows the floor; the middle shows the ball, which has no texture.
    let radiance = |film: &Film, y| film.get(13, y).radiance;
    assert_eq!(radiance(&halved, 0), 0.5 * radiance(&untouched, 0));
    assert_eq!(radiance(&halved, 8), radiance(&untouched, 8));
}

/// The number of pairs of pictures that this file compares.
const COMPARED: u32 = 18;

/// The relative bias that comparisons of light sampling always detect.
const DETECTED: f64 = 0.2;

/// The relative bias that comparisons with hemisphere sampling, which has more noise, always
/// detect.
const DETECTED_BY_HEMISPHERE: f64 = 0.6;

/// Blocks along a side of a picture that is compared.
const BLOCKS: u32 = 4;

/// Compares the means of the blocks of two pictures by z-tests. The probability that any test of
/// this file fails for a correct estimate is 1e-6. Also asserts that at least one block detects a
/// picture that is brighter or darker by the fraction `detected`.
fn assert_agree(
    what: &str,
    lit: &LitScene,
    [a, b]: [&LightSettings; 2],
    samples: u32,
    detected: f64,
) {
    let render_blocks = |settings: &LightSettings, seed| {
        let mut job = job(8 * BLOCKS, 8 * BLOCKS, samples);
        job.sampling.seed = seed;
        render(lit, &job, settings).film
    };
    let (a, b) = (render_blocks(a, 1), render_blocks(b, 2));
    let alarm = sidak(1e-6, (BLOCKS * BLOCKS * COMPARED) as usize);
    // The block with the least p-value: the value, the block and its differences.
    let worst = |factor: f64| {
        let compared = (0..BLOCKS * BLOCKS).map(|block| {
            let differences = block_of(block)
                .map(|(x, y)| {
                    let [a, b] = [&a, &b].map(|film| film.get(x, y).radiance.luminance());
                    factor * a - b
                })
                .collect::<Tally>();
            (two_sided(differences.z_against(0.0)), block, differences)
        });
        compared
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .expect("there are blocks")
    };
    let (p, block, differences) = worst(1.0);
    assert!(
        p > alarm,
        "{what}, block {block}: differ by {} ± {}",
        differences.mean(),
        differences.standard_error()
    );
    for factor in [1.0 + detected, 1.0 - detected] {
        let (p, ..) = worst(factor);
        assert!(
            p < alarm,
            "{what}: a factor of {factor} is not detected, p = {p:e}"
        );
    }
}

/// The pixels of a block. Tallying differences pixel by pixel excludes the variation of the picture
/// itself.
fn block_of(block: u32) -> impl Iterator<Item = (u32, u32)> {
    let (x0, y0) = (8 * (block % BLOCKS), 8 * (block / BLOCKS));
    (0..64).map(move |i| (x0 + i % 8, y0 + i / 8))
}

#[test]
fn all_direct_sampling_strategies_agree() {
    for light in [area_light(), sky()] {
        for material in [GREY, GLOSSY, MIRROR, ROUGH_GLASS] {
            let lit = LitScene::new(ball(material, Some(light)), None);
            let by = |direct_sampling| LightSettings {
                direct_sampling,
                ..settings(3)
            };
            let (lights, mis) = (by(DirectSampling::Lights), by(DirectSampling::Mis));
            let hemisphere = LightSettings {
                light_samples: 4,
                ..by(DirectSampling::Hemisphere)
            };
            let what = format!("{material:?} lit by {light:?}");
            assert_agree(
                &format!("hemisphere: {what}"),
                &lit,
                [&hemisphere, &lights],
                64,
                DETECTED_BY_HEMISPHERE,
            );
            assert_agree(&format!("mis: {what}"), &lit, [&mis, &lights], 64, DETECTED);
        }
    }
}

#[test]
fn roulette_samplers_and_adaptive_agree() {
    let lit = LitScene::new(ball(GLASS, Some(area_light())), None);
    let plain = settings(12);
    let no_roulette = LightSettings {
        roulette: false,
        ..plain
    };
    assert_agree("roulette", &lit, [&plain, &no_roulette], 64, DETECTED);
    let longer = LightSettings {
        roulette_factor: 4,
        ..plain
    };
    assert_agree("roulette", &lit, [&longer, &no_roulette], 64, DETECTED);
    let adaptive = LightSettings {
        adaptive: Some((32, 0.2)),
        ..plain
    };
    assert_agree("adaptive", &lit, [&adaptive, &plain], 512, DETECTED);
}
