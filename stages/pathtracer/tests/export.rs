//! What is exported for Mitsuba, and what is refused.

use kit::sampler::Sampling;
use kit::scene::{NamedLight, NamedMaterial, Object};
use kit::{
    Camera, FilmSize, Light, LitScene, Mat3, Material, Scene, Spectrum, Sphere, Triangle, Vec3,
};
use pathtracer::{Job, LightSettings, to_mitsuba};

const GREY: Material = Material::Diffuse {
    reflectance: Spectrum::grey(0.5),
};
const LAMP: Material = Material::Emission {
    radiance: Spectrum::grey(3.0),
};

/// A sphere of radius 1 with its centre at `center`, and a triangle 10 units behind it.
fn scene(center: Vec3, scale: f64, material: Material, tilt: f64) -> Scene {
    let n = Vec3::new(tilt, 0.0, 1.0).normalize();
    let at = |x: f64, y: f64| center + scale * Vec3::new(x, y, -10.0);
    let mut triangle = Triangle::flat(at(-9.0, -9.0), at(9.0, -9.0), at(0.0, 9.0));
    (triangle.n0, triangle.n1, triangle.n2) = (n, n, n);
    let radius = scale;
    let object = |name: &str, material: u32| Object {
        name: name.to_owned(),
        material,
    };
    let named = |name: &str, material: Material| NamedMaterial {
        name: name.to_owned(),
        material,
    };
    Scene {
        triangles: vec![triangle],
        spheres: vec![Sphere { center, radius }],
        object_of: vec![0, 1],
        objects: vec![object("wall", 0), object("ball", 1)],
        materials: vec![named("paint", material), named("grey", GREY)],
        ..Scene::default()
    }
}

/// Looks along -z from 5 units before `center`.
fn job(center: Vec3, scale: f64, clip: [f64; 2]) -> Job {
    let film = FilmSize { w: 8, h: 8 };
    Job {
        camera: Camera {
            pos: center + scale * Vec3::new(0.0, 0.0, 5.0),
            c2w: Mat3::IDENTITY,
            h_fov: 40.0,
            v_fov: 40.0,
            n_clip: clip[0],
            f_clip: clip[1],
        },
        film,
        cell: film.whole(),
        samples: 16,
        sampling: Sampling::from(0),
    }
}

const ALL: [f64; 2] = [0.0, 1e30];

/// The exported `.xml`, and the mesh of the wall.
fn exported(scene: Scene, job: &Job) -> Result<(String, String), Vec<String>> {
    let settings = LightSettings::default();
    let exported = to_mitsuba(&LitScene::new(scene, None), job, &settings, "a")?;
    let text = |i: usize| exported.files[i].text.clone();
    Ok((text(0), text(1)))
}

/// The value of the element with this `name`.
fn value(xml: &str, name: &str) -> f64 {
    let start = xml.find(&format!("\"{name}\" value=\"")).expect(name);
    let value = xml[start..].split('"').nth(3).expect("a value");
    value.parse().expect("a number")
}

/// Near before and far behind all that is seen, whatever the unit of the file; and the scene is
/// some units large.
#[test]
fn clip_planes_and_units_fit_the_scene() {
    for scale in [1e-4, 1.0, 1e5] {
        let center = Vec3::new(6e6, 0.0, -4e6) * scale;
        let (xml, ply) =
            exported(scene(center, scale, GREY, 0.0), &job(center, scale, ALL)).unwrap();
        let unit = value(&xml, "radius");
        assert!((0.2..8.0).contains(&unit), "{scale}: {unit}");
        let (near, far) = (
            value(&xml, "near_clip") / unit,
            value(&xml, "far_clip") / unit,
        );
        assert!(
            near > 1e-3 && near < 4.0 && far > 15.6 && far < 1e3,
            "{near} {far}"
        );
        assert!(xml.contains("lookat origin=\"0.0, 0.0, 0.0\""), "{xml}");
        let corner = ply
            .lines()
            .find(|line| line.split(' ').count() == 6 && line.starts_with('-'));
        let x: f64 = corner
            .and_then(|line| line.split(' ').next()?.parse().ok())
            .expect("a corner");
        assert!((x / unit + 9.0).abs() < 1e-6, "{x} {unit}");
    }
}

/// A clip distance that hides whole surfaces is a plane in Mitsuba; one that cuts a surface has no
/// equivalent.
#[test]
fn clip_distances_are_exported_or_refused() {
    let planes = |clip: [f64; 2]| {
        let (xml, _) = exported(
            scene(Vec3::ZERO, 1.0, GREY, 0.0),
            &job(Vec3::ZERO, 1.0, clip),
        )?;
        let unit = value(&xml, "radius");
        Ok::<_, Vec<String>>([
            value(&xml, "near_clip") / unit,
            value(&xml, "far_clip") / unit,
        ])
    };
    // The ball is from 4 to 6, the wall at a depth of 15 and up to 16.9 away.
    assert_eq!(planes([7.0, 1e30]).unwrap()[0], 7.0);
    assert_eq!(planes([0.0, 9.0]).unwrap()[1], 9.0);
    let [near, far] = planes([0.5, 100.0]).unwrap();
    assert!(near < 4.0 && far > 17.0, "{near} {far}");
    for (clip, message) in [
        ([4.5, 1e30], "znear 4.5 cuts ball"),
        ([0.0, 15.2], "zfar 15.2 cuts wall"),
        ([0.0, 5.0], "zfar 5 cuts ball"),
    ] {
        let problems = planes(clip).expect_err(message);
        assert!(problems[0].contains(message), "{problems:?}");
    }
}

/// Lamps shine by the geometric normal here, and by the shading normal in Mitsuba.
#[test]
fn emitting_triangles_are_exported_flat() {
    let normal = |material: Material, tilt: f64| -> Result<f64, Vec<String>> {
        let (_, ply) = exported(
            scene(Vec3::ZERO, 1.0, material, tilt),
            &job(Vec3::ZERO, 1.0, ALL),
        )?;
        let vertex = ply
            .lines()
            .find(|line| line.split(' ').count() == 6 && line.starts_with('-'));
        let x = vertex.and_then(|line| line.split(' ').nth(3)?.parse().ok());
        Ok(x.expect("a normal"))
    };
    assert_eq!(normal(LAMP, 0.5), Ok(0.0));
    assert!(normal(GREY, 0.5).unwrap() > 0.4);
    assert!(normal(GREY, 3.0).unwrap_err()[0].contains("object wall: normals of vertices"));
}

#[test]
fn the_number_of_samples_is_kept() {
    let center = Vec3::ZERO;
    for (samples, sampler) in [
        (16, "multijitter"),
        (17, "independent"),
        (12, "multijitter"),
        (1, "multijitter"),
    ] {
        let job = Job {
            samples,
            ..job(center, 1.0, ALL)
        };
        let (xml, _) = exported(scene(center, 1.0, GREY, 0.0), &job).unwrap();
        assert!(
            xml.contains(&format!("<sampler type=\"{sampler}\">")),
            "{samples}"
        );
        assert_eq!(value(&xml, "sample_count"), f64::from(samples));
    }
}

/// The light of a point falls off with the square of the distance, which the export scales.
#[test]
fn point_lights_are_scaled_with_the_scene() {
    let center = Vec3::ZERO;
    let mut small = scene(center, 0.125, GREY, 0.0);
    small.lights = vec![NamedLight {
        name: "lamp".into(),
        light: Light::Point {
            position: Vec3::ZERO,
            intensity: Spectrum::grey(1.0),
        },
    }];
    let (xml, _) = exported(small, &job(center, 0.125, ALL)).unwrap();
    let scale = value(&xml, "radius") / 0.125;
    assert!(scale > 1.0);
    let start = xml.find("\"intensity\" value=\"").expect("a lamp");
    let intensity = xml[start..].split('"').nth(3).expect("a value");
    assert_eq!(
        intensity.split(',').next(),
        Some(&*format!("{:?}", scale * scale))
    );
}

#[test]
fn cameras_too_far_away_and_environments_are_refused() {
    let center = Vec3::ZERO;
    let mut far = job(center, 1.0, ALL);
    far.camera.pos = Vec3::new(0.0, 0.0, 1e6);
    let problems = exported(scene(center, 1.0, GREY, 0.0), &far).unwrap_err();
    assert!(problems[0].contains("single precision"), "{problems:?}");
    let settings = LightSettings {
        environment: true,
        ..LightSettings::default()
    };
    let lit = LitScene::new(scene(center, 1.0, GREY, 0.0), None);
    let problems = to_mitsuba(&lit, &job(center, 1.0, ALL), &settings, "a").unwrap_err();
    assert!(problems[0].contains("omit -e"), "{problems:?}");
}

#[test]
fn what_mitsuba_shows_otherwise_is_refused_or_told() {
    let (center, job) = (Vec3::ZERO, job(Vec3::ZERO, 1.0, ALL));
    let export = |scene: Scene, stem: &str| {
        let lit = LitScene::new(scene, None);
        to_mitsuba(&lit, &job, &LightSettings::default(), stem)
    };
    // Normals that are tilted a little, and by more.
    let flat = export(scene(center, 1.0, GREY, 0.0), "a").unwrap();
    assert_eq!(flat.warnings, [""; 0]);
    let tilted = export(scene(center, 1.0, GREY, 0.2), "a").unwrap();
    let expected = "object wall: normals of vertices are up to 11.3 degrees";
    assert!(
        tilted.warnings[0].starts_with(expected),
        "{:?}",
        tilted.warnings
    );
    // One sample, and nearly smooth glass without MIS.
    let mut single = job;
    single.samples = 1;
    let told = |roughness| {
        let glass = Material::Glass {
            reflectance: Spectrum::WHITE,
            transmittance: Spectrum::WHITE,
            roughness,
            ior: 1.5,
        };
        let lit = LitScene::new(scene(center, 1.0, glass, 0.0), None);
        to_mitsuba(&lit, &single, &LightSettings::default(), "a").unwrap()
    };
    let rough = told(4.0);
    assert_eq!(rough.warnings.len(), 1, "{:?}", rough.warnings);
    assert!(rough.files[0].text.contains("\"alpha\" value=\"1.0\""));
    let told = told(0.01);
    assert!(
        told.warnings[0].starts_with("-s 1: one sample"),
        "{:?}",
        told.warnings
    );
    assert!(
        told.warnings[1].contains("compare with --mis"),
        "{:?}",
        told.warnings
    );
    let problem = |scene: Scene, stem: &str| export(scene, stem).unwrap_err().join("\n");
    let turned = problem(scene(center, 1.0, GREY, 1.2), "a");
    assert!(
        turned.contains("wall: normals of vertices are 50 degrees"),
        "{turned}"
    );
    let dazzling = Material::Emission {
        radiance: Spectrum::grey(1e39),
    };
    let dazzled = problem(scene(center, 1.0, dazzling, 0.0), "a");
    assert!(dazzled.contains("too bright for Mitsuba"), "{dazzled}");
    // The texture of a material without surfaces.
    let mut unused = scene(center, 1.0, GREY, 0.0);
    unused.textures.files = vec!["a.png".into()];
    assert!(export(unused, "a").is_ok());
    // A ball that is lost in the scene.
    let mut large = scene(center, 1.0, GREY, 0.0);
    let wall = &mut large.triangles[0];
    wall.p2.y = 3e4;
    let small = problem(large, "a");
    assert!(
        small.contains("object ball: thousands of times smaller"),
        "{small}"
    );
    let bright = Material::Diffuse {
        reflectance: Spectrum::new(2.0, 1.0, 0.0),
    };
    assert!(problem(scene(center, 1.0, bright, 0.0), "a").contains("no reflectance above 1"));
    for stem in ["$a", "a\"b", "a&b"] {
        assert!(problem(scene(center, 1.0, GREY, 0.0), stem).contains("choose another name"));
    }
}
