//! Exports scenes for Mitsuba 3, an independent renderer, to compare pictures.
//!
//! What Mitsuba does not support in the same way is an error, not approximated: pictures should
//! differ by noise only.
//!
//! Mitsuba computes in single precision, and its rays start at a distance from surfaces that fits
//! scenes of some units (`Units`). So the scene is moved and scaled before it is written.

use crate::{DirectSampling, Job, LightSettings, nearly_smooth};
use clip::ClipPlanes;
use kit::{Aabb, Light, LitScene, Material, Scene, Spectrum, Triangle, Vec3};
use std::fmt::Write;

mod clip;

/// A file of an exported scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MitsubaFile {
    /// The suffix after the stem of the file name, such as `.xml` or `.3.ply`.
    pub suffix: String,
    /// The content.
    pub text: String,
}

/// The largest difference of a pixel's aspect ratio from 1: Mitsuba's pixels are square.
const SQUARE_TOLERANCE: f64 = 1e-6;

/// An exported scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MitsubaScene {
    /// The scene, and then its meshes.
    pub files: Vec<MitsubaFile>,
    /// What Mitsuba computes in another way.
    pub warnings: Vec<String>,
}

/// From this depth on so few paths are truncated that pictures are the same up to noise, also with
/// mirrors and glass.
const UNTRUNCATED_DEPTH: u32 = 100;

/// The coordinates of the exported scene: the camera is at the origin, and a power of two makes the
/// scene some units large.
#[derive(Clone, Copy, Debug)]
struct Units {
    origin: Vec3,
    scale: f64,
}

/// The size to which scenes are scaled, up to a factor of two.
const EXPORTED_SIZE: f64 = 32.0;

/// The largest distance of the camera from the centre of the scene, relative to the diagonal of its
/// box: farther away, single precision moves the points that rays hit.
const MAX_DISTANCE: f64 = 300.0;

/// The largest angle in degrees between the normal of a vertex and that of its triangle. In
/// Mitsuba, light passes where only shading normals face it, and surfaces are black where their
/// shading normals face away from the camera. Below this angle, light from behind alone shows it.
const MAX_TILT: f64 = 45.0;

/// From this angle on, in degrees, a warning tells how far normals are tilted.
const SMALL_TILT: f64 = 0.1;

/// The smallest size of an object in exported units: Mitsuba's rays start at a ten-thousandth of a
/// unit, or more, from surfaces.
const MIN_SIZE: f64 = 0.01;

/// Characters that Mitsuba's scenes give another meaning in the name of a file.
const SPECIAL: [char; 5] = ['"', '<', '>', '&', '$'];

impl Units {
    fn of(scene: &Scene, camera: Vec3) -> Units {
        let bounds = scene.bounds();
        let size = if bounds.is_empty() {
            1.0
        } else {
            bounds.extent().length()
        };
        let exponent = (EXPORTED_SIZE / size).log2().floor();
        Units {
            origin: camera,
            scale: if exponent.is_finite() {
                exponent.exp2()
            } else {
                1.0
            },
        }
    }

    fn point(&self, p: Vec3) -> Vec3 {
        (p - self.origin) * self.scale
    }
}

/// Exports the scene as an `.xml` file and one `.ply` for the triangles of each object. `stem` is
/// the file name without its extension.
///
/// Mitsuba gets its sampler with the least noise, `multijitter`, unless that would take another
/// number of samples than asked for. It counts the edges of a path, so a
/// ray depth of m becomes m + 1. This is equal for diffuse surfaces; mirrors and glass show emitters
/// one depth earlier in Mitsuba, which is a warning unless the depth truncates no path.
///
/// # Errors
///
/// One message for each part of the scene that Mitsuba does not support in the same way.
pub fn to_mitsuba(
    lit: &LitScene,
    job: &Job,
    settings: &LightSettings,
    stem: &str,
) -> Result<MitsubaScene, Vec<String>> {
    let scene = &lit.scene;
    let mut problems = Vec::new();
    let mut xml = String::from("<scene version=\"3.0.0\">\n");
    let depth = i64::from(settings.max_depth) + 1;
    push(
        &mut xml,
        &format!(
            "<integrator type=\"path\"><integer name=\"max_depth\" value=\"{depth}\"/></integrator>"
        ),
    );
    let units = Units::of(scene, job.camera.pos);
    let planes = ClipPlanes::of(scene, job, &mut problems);
    push(
        &mut xml,
        &camera(job, settings, &units, &planes, &mut problems),
    );
    if settings.environment {
        problems.push("the environment: Mitsuba interpolates its pixels: omit -e".into());
    }
    if stem.contains(SPECIAL) {
        problems.push(format!(
            "the name {stem}: Mitsuba reads \" < > & $ otherwise: choose another name"
        ));
    }
    check_distance(scene, job.camera.pos, &mut problems);
    let tilt = check_normals(scene, &mut problems);
    check_sizes(scene, &units, &mut problems);
    for (i, file) in scene.textures.files.iter().enumerate() {
        let mut used = scene.objects.iter().map(|object| object.material);
        if used.any(|material| scene.textures.of_material(material) == Some(i as u32)) {
            problems.push(format!("the texture {file}: textures are not exported"));
        }
    }
    check_brightness(scene, &mut problems);
    for (i, named) in scene.materials.iter().enumerate() {
        match bsdf(&named.material) {
            Ok(text) => push(&mut xml, &text.replace("ID", &format!("id=\"m{i}\""))),
            Err(why) => problems.push(format!("material {}: {why}", named.name)),
        }
    }
    let mut files = Vec::new();
    for (o, object) in scene.objects.iter().enumerate() {
        let triangles: Vec<&Triangle> = scene
            .triangles
            .iter()
            .zip(&scene.object_of)
            .filter(|(_, of)| **of as usize == o)
            .map(|(t, _)| t)
            .collect();
        if triangles.is_empty() {
            continue;
        }
        let material = &scene.materials[object.material as usize].material;
        let emits = !material.emission().is_black();
        let suffix = format!(".{o}.ply");
        let file = format!("<string name=\"filename\" value=\"{stem}{suffix}\"/>");
        push(&mut xml, &shape("ply", &file, object.material, material));
        files.push(MitsubaFile {
            suffix,
            text: ply(&triangles, &units, emits),
        });
    }
    push_spheres(&mut xml, scene, &units);
    push_lights(&mut xml, scene, &units, &mut problems);
    xml.push_str("</scene>\n");
    if !problems.is_empty() {
        return Err(problems);
    }
    files.insert(
        0,
        MitsubaFile {
            suffix: ".xml".into(),
            text: xml,
        },
    );
    Ok(MitsubaScene {
        files,
        warnings: [
            depth_warning(scene, settings),
            tilt,
            samples_warning(job),
            smooth_warning(scene, settings),
        ]
        .into_iter()
        .flatten()
        .collect(),
    })
}

/// What the depth means in Mitsuba, if the scene has a mirror or glass and paths are truncated.
fn depth_warning(scene: &Scene, settings: &LightSettings) -> Option<String> {
    let depth = settings.max_depth;
    if depth >= UNTRUNCATED_DEPTH {
        return None;
    }
    let is_specular = |number: u32| {
        let material = &scene.materials[number as usize].material;
        matches!(material, Material::Mirror { .. } | Material::Glass { .. }) && material.is_delta()
    };
    let object = scene
        .objects
        .iter()
        .find(|object| is_specular(object.material))?;
    Some(format!(
        "-m {depth}: at mirrors and glass, such as {}, Mitsuba finds emitters one bounce earlier, so \
         its picture is brighter, the more so the smaller the depth; compare at -m {UNTRUNCATED_DEPTH}",
        object.name
    ))
}

/// What a single sample means: here it is in the centre of its pixel.
fn samples_warning(job: &Job) -> Option<String> {
    let told = "-s 1: one sample is taken in the centre of each pixel here, anywhere in it in Mitsuba: \
                compare at -s 2 or more";
    (job.samples == 1).then(|| told.to_owned())
}

/// What nearly smooth surfaces without MIS miss in pictures of few samples.
fn smooth_warning(scene: &Scene, settings: &LightSettings) -> Option<String> {
    let object = nearly_smooth(scene)?;
    (settings.direct_sampling != DirectSampling::Mis).then(|| {
        format!(
            "object {object}: without --mis few samples meet the lamps that it shows, so a picture \
             of few samples is darker than Mitsuba's: compare with --mis"
        )
    })
}

fn push(xml: &mut String, line: &str) {
    xml.push_str("  ");
    xml.push_str(line);
    xml.push('\n');
}

fn triple(v: Vec3) -> String {
    format!("{:?}, {:?}, {:?}", v.x, v.y, v.z)
}

fn rgb(name: &str, c: Spectrum) -> String {
    let Spectrum { r, g, b } = c;
    format!("<rgb name=\"{name}\" value=\"{r:?}, {g:?}, {b:?}\"/>")
}

/// A problem if the camera is so far away that single precision moves what it sees.
fn check_distance(scene: &Scene, camera: Vec3, problems: &mut Vec<String>) {
    let bounds = scene.bounds();
    let distance = bounds.centroid().distance(camera);
    if !bounds.is_empty() && distance > MAX_DISTANCE * bounds.extent().length() {
        problems.push(format!(
            "the camera: more than {MAX_DISTANCE} times as far away as the scene is large, and Mitsuba \
             computes in single precision: move it nearer and make its angle larger"
        ));
    }
}

/// A problem for the object whose vertex normals disagree most with its triangles, or a warning if
/// they do so a little.
fn check_normals(scene: &Scene, problems: &mut Vec<String>) -> Option<String> {
    let (mut least, mut most_tilted) = (SMALL_TILT.to_radians().cos(), None);
    for (t, object) in scene.triangles.iter().zip(&scene.object_of) {
        let object = &scene.objects[*object as usize];
        let emits = !scene.materials[object.material as usize]
            .material
            .emission()
            .is_black();
        let plane = front(t);
        if emits || plane == Vec3::ZERO {
            continue;
        }
        for cos in [t.n0, t.n1, t.n2].map(|n| n.dot(plane)) {
            if cos < least {
                (least, most_tilted) = (cos, Some(&object.name));
            }
        }
    }
    let name = most_tilted?;
    let tilt = kit::math::acos(least.clamp(-1.0, 1.0)).to_degrees();
    if tilt > MAX_TILT {
        problems.push(format!(
            "object {name}: normals of vertices are {tilt:.0} degrees from those of the triangles, where \
             Mitsuba lets light through: use --normals flat"
        ));
        return None;
    }
    Some(format!(
        "object {name}: normals of vertices are up to {tilt:.1} degrees from those of the triangles; \
         Mitsuba lets light through where the two disagree (on half spheres lit from behind, its mean \
         is larger by 0.3 % at 20 degrees and by 0.9 % at 40, dark places are brighter by more); with \
         --normals flat the pictures agree"
    ))
}

/// A problem for the first lamp that is brighter than single precision can say.
fn check_brightness(scene: &Scene, problems: &mut Vec<String>) {
    let of_light = |light: &Light| match *light {
        Light::Point { intensity, .. } | Light::Spot { intensity, .. } => intensity,
        Light::Directional { irradiance, .. } => irradiance,
        Light::Area { radiance, .. } | Light::Hemisphere { radiance } => radiance,
    };
    let lights = scene.lights.iter().map(|l| (&l.name, of_light(&l.light)));
    let materials = scene.materials.iter();
    let mut lamps = lights.chain(materials.map(|m| (&m.name, m.material.emission())));
    if let Some((name, _)) = lamps.find(|(_, c)| c.max_channel() > f64::from(f32::MAX)) {
        problems.push(format!(
            "{name}: too bright for Mitsuba's single precision: make it darker and use --exposure"
        ));
    }
}

/// A problem for the first object that is too small beside the scene.
fn check_sizes(scene: &Scene, units: &Units, problems: &mut Vec<String>) {
    let mut bounds = vec![Aabb::EMPTY; scene.objects.len()];
    for (primitive, object) in scene.primitives().zip(&scene.object_of) {
        let object = &mut bounds[*object as usize];
        *object = object.union(primitive.bounds());
    }
    let is_small = |b: &Aabb| !b.is_empty() && b.extent().length() * units.scale < MIN_SIZE;
    let small = bounds.iter().position(is_small);
    if let Some(object) = small {
        problems.push(format!(
            "object {}: thousands of times smaller than the scene, and Mitsuba's rays start too far from \
             its surface: leave out what is large or far away",
            scene.objects[object].name
        ));
    }
}

/// The normal of a triangle's plane on the side of its vertex normals, from which it emits.
fn front(t: &Triangle) -> Vec3 {
    let plane = Triangle::flat(t.p0, t.p1, t.p2).n0;
    if plane.dot(t.n0 + t.n1 + t.n2) < 0.0 {
        -plane
    } else {
        plane
    }
}

fn camera(
    job: &Job,
    settings: &LightSettings,
    units: &Units,
    planes: &ClipPlanes,
    problems: &mut Vec<String>,
) -> String {
    let camera = &job.camera;
    let tan = |degrees: f64| kit::math::tan((0.5 * degrees).to_radians());
    let aspect = f64::from(job.film.w) / f64::from(job.film.h);
    if (tan(camera.h_fov) / tan(camera.v_fov) / aspect - 1.0).abs() > SQUARE_TOLERANCE {
        problems.push(
            "the camera: its pixels are not square: choose -r with the aspect ratio of its angles"
                .into(),
        );
    }
    if settings.lens.radius > 0.0 {
        problems.push("the lens: omit --lens-radius".into());
    }
    if planes.near >= planes.far {
        let far = camera.f_clip;
        problems.push(format!(
            "the camera: nothing is nearer than zfar {far}: make the scene smaller"
        ));
    }
    let (forward, up) = (-camera.c2w.z_axis, camera.c2w.y_axis);
    format!(
        "<sensor type=\"perspective\"><string name=\"fov_axis\" value=\"x\"/><float name=\"fov\" value=\"{:?}\"/>\
         <float name=\"near_clip\" value=\"{:?}\"/><float name=\"far_clip\" value=\"{:?}\"/>\
         <transform name=\"to_world\"><lookat origin=\"{}\" target=\"{}\" up=\"{}\"/></transform>\
         <sampler type=\"{}\"><integer name=\"sample_count\" value=\"{}\"/></sampler>\
         <film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/><integer name=\"height\" value=\"{}\"/>\
         <rfilter type=\"box\"/></film></sensor>",
        camera.h_fov,
        planes.near * units.scale,
        planes.far * units.scale,
        triple(units.point(camera.pos)),
        triple(units.point(camera.pos) + forward),
        triple(up),
        sampler(job.samples),
        job.samples,
        job.film.w,
        job.film.h,
    )
}

/// The sampler with the least noise that takes this number of samples: `multijitter` needs a grid
/// that is nearly square.
fn sampler(samples: u32) -> &'static str {
    if samples.is_multiple_of(samples.isqrt().max(1)) {
        "multijitter"
    } else {
        "independent"
    }
}

/// A material, with `ID` as a placeholder for its id.
fn bsdf(material: &Material) -> Result<String, &'static str> {
    match *material {
        Material::Diffuse { reflectance: c } | Material::Mirror { reflectance: c }
            if c.r.max(c.g).max(c.b) > 1.0 =>
        {
            Err("Mitsuba allows no reflectance above 1")
        }
        Material::Diffuse { reflectance } => Ok(format!(
            "<bsdf type=\"twosided\" ID><bsdf type=\"diffuse\">{}</bsdf></bsdf>",
            rgb("reflectance", reflectance)
        )),
        Material::Emission { .. } => Ok(format!(
            "<bsdf type=\"diffuse\" ID>{}</bsdf>",
            rgb("reflectance", Spectrum::BLACK)
        )),
        Material::Mirror { reflectance } => Ok(format!(
            "<bsdf type=\"twosided\" ID><bsdf type=\"conductor\"><string name=\"material\" value=\"none\"/>{}</bsdf></bsdf>",
            rgb("specular_reflectance", reflectance)
        )),
        Material::Glass {
            reflectance,
            transmittance,
            roughness,
            ior,
        } if !material.is_delta() => Ok(format!(
            "<bsdf type=\"roughdielectric\" ID><string name=\"distribution\" value=\"ggx\"/><float name=\"alpha\" value=\"{:?}\"/><float name=\"int_ior\" value=\"{ior:?}\"/><float name=\"ext_ior\" value=\"1\"/>{}{}</bsdf>",
            roughness.min(1.0),
            rgb("specular_reflectance", reflectance),
            rgb("specular_transmittance", transmittance)
        )),
        Material::Glass {
            reflectance,
            transmittance,
            ior,
            ..
        } => Ok(format!(
            "<bsdf type=\"dielectric\" ID><float name=\"int_ior\" value=\"{ior:?}\"/><float name=\"ext_ior\" value=\"1\"/>{}{}</bsdf>",
            rgb("specular_reflectance", reflectance),
            rgb("specular_transmittance", transmittance)
        )),
        Material::Glossy { .. } => {
            Err("Mitsuba uses another microfacet shadowing term, so glossy surfaces differ")
        }
        Material::Refraction { .. } => Err("Mitsuba has no boundary without reflection"),
    }
}

/// A shape with its material and its emission.
fn shape(kind: &str, geometry: &str, material: u32, what: &Material) -> String {
    let emitter = match what {
        Material::Emission { radiance } => {
            format!(
                "<emitter type=\"area\">{}</emitter>",
                rgb("radiance", *radiance)
            )
        }
        _ => String::new(),
    };
    format!("<shape type=\"{kind}\">{geometry}<ref id=\"m{material}\"/>{emitter}</shape>")
}

fn push_spheres(xml: &mut String, scene: &Scene, units: &Units) {
    let first = scene.triangles.len();
    for (sphere, object) in scene.spheres.iter().zip(&scene.object_of[first..]) {
        let material = scene.objects[*object as usize].material;
        let geometry = format!(
            "<float name=\"radius\" value=\"{:?}\"/><point name=\"center\" value=\"{}\"/>",
            sphere.radius * units.scale,
            triple(units.point(sphere.center))
        );
        push(
            xml,
            &shape(
                "sphere",
                &geometry,
                material,
                &scene.materials[material as usize].material,
            ),
        );
    }
}

fn push_lights(xml: &mut String, scene: &Scene, units: &Units, problems: &mut Vec<String>) {
    for named in &scene.lights {
        match named.light {
            // Exported as an emitting surface.
            Light::Area { .. } => {}
            Light::Point {
                position,
                intensity,
            } => push(
                xml,
                &format!(
                    "<emitter type=\"point\"><point name=\"position\" value=\"{}\"/>{}</emitter>",
                    triple(units.point(position)),
                    // Its light falls off with the square of the distance.
                    rgb("intensity", intensity * (units.scale * units.scale))
                ),
            ),
            Light::Directional {
                direction,
                irradiance,
            } => push(
                xml,
                &format!(
                    "<emitter type=\"directional\"><vector name=\"direction\" value=\"{}\"/>{}</emitter>",
                    triple(direction),
                    rgb("irradiance", irradiance)
                ),
            ),
            Light::Spot { .. } => problems.push(format!(
                "light {}: Mitsuba has another falloff for spot lights",
                named.name
            )),
            Light::Hemisphere { .. } => problems.push(format!(
                "light {}: Mitsuba's constant light also comes from below",
                named.name
            )),
        }
    }
}

/// Triangles with their vertex normals, as text. Those that emit are flat: Mitsuba's lamps shine by
/// the shading normal, ours by the geometric one.
fn ply(triangles: &[&Triangle], units: &Units, emit: bool) -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\n",
        3 * triangles.len()
    );
    for property in ["x", "y", "z", "nx", "ny", "nz"] {
        text += &format!("property double {property}\n");
    }
    text += &format!(
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        triangles.len()
    );
    for t in triangles {
        let mut normals = [t.n0, t.n1, t.n2];
        if emit && front(t) != Vec3::ZERO {
            normals = [front(t); 3];
        }
        for (p, n) in [t.p0, t.p1, t.p2].into_iter().zip(normals) {
            let line = triple(units.point(p)) + ", " + &triple(n);
            text += &line.replace(',', "");
            text.push('\n');
        }
    }
    for i in 0..triangles.len() {
        writeln!(text, "3 {} {} {}", 3 * i, 3 * i + 1, 3 * i + 2)
            .expect("writing to a string succeeds");
    }
    text
}
