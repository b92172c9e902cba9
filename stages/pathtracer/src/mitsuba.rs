//! Scenes in the words of Mitsuba 3, a renderer that nobody here wrote: to check pictures against its own.
//!
//! What Mitsuba cannot say in the same way is refused, not approximated: a comparison should have one cause of
//! differences only.

use crate::{Job, LightSettings};
use kit::{Emitter, Light, LitScene, Material, Scene, Spectrum, Triangle, Vec3};
use std::fmt::Write;

/// A file of an exported scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MitsubaFile {
    /// What is added to the name of the scene file, `.xml` or `.3.ply`.
    pub ending: String,
    /// What is in it.
    pub text: String,
}

/// Width over height of a pixel may differ from 1 by this much: Mitsuba's pixels are square.
const SQUARE: f64 = 1e-6;

/// The scene as an `.xml` file and one `.ply` for the triangles of each object, or a sentence for everything that
/// Mitsuba has no equal for. `stem` is the name of the file without its ending.
///
/// Mitsuba counts the edges of a path, so the ray depth m becomes m + 1: the same for matte surfaces, while mirrors and
/// glass show lamps one depth earlier there. Compare those with a depth that cuts nothing off.
pub fn to_mitsuba(
    lit: &LitScene,
    job: &Job,
    settings: &LightSettings,
    stem: &str,
) -> Result<Vec<MitsubaFile>, Vec<String>> {
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
    push(&mut xml, &camera(job, settings, &mut problems));
    for file in &scene.textures.files {
        problems.push(format!(
            "the texture {file}: pictures on surfaces are not exported"
        ));
    }
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
        let ending = format!(".{o}.ply");
        let file = format!("<string name=\"filename\" value=\"{stem}{ending}\"/>");
        push(
            &mut xml,
            &shape(
                "ply",
                &file,
                object.material,
                &scene.materials[object.material as usize].material,
            ),
        );
        files.push(MitsubaFile {
            ending,
            text: ply(&triangles),
        });
    }
    push_spheres(&mut xml, scene);
    push_lights(&mut xml, lit, &mut problems);
    xml.push_str("</scene>\n");
    if !problems.is_empty() {
        return Err(problems);
    }
    files.insert(
        0,
        MitsubaFile {
            ending: ".xml".into(),
            text: xml,
        },
    );
    Ok(files)
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

fn camera(job: &Job, settings: &LightSettings, problems: &mut Vec<String>) -> String {
    let camera = &job.camera;
    let tan = |degrees: f64| kit::math::tan((0.5 * degrees).to_radians());
    let aspect = f64::from(job.film.w) / f64::from(job.film.h);
    if (tan(camera.h_fov) / tan(camera.v_fov) / aspect - 1.0).abs() > SQUARE {
        problems.push(
            "the camera: its pixels are not square: choose -r in the proportion of its angles"
                .into(),
        );
    }
    if settings.lens.radius > 0.0 {
        problems.push("the lens: leave out --lens-radius".into());
    }
    let (forward, up) = (-camera.c2w.z_axis, camera.c2w.y_axis);
    format!(
        "<sensor type=\"perspective\"><string name=\"fov_axis\" value=\"x\"/><float name=\"fov\" value=\"{:?}\"/>\
         <float name=\"near_clip\" value=\"0.001\"/>\
         <transform name=\"to_world\"><lookat origin=\"{}\" target=\"{}\" up=\"{}\"/></transform>\
         <sampler type=\"independent\"><integer name=\"sample_count\" value=\"{}\"/></sampler>\
         <film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/><integer name=\"height\" value=\"{}\"/>\
         <rfilter type=\"box\"/></film></sensor>",
        camera.h_fov,
        triple(camera.pos),
        triple(camera.pos + forward),
        triple(up),
        job.samples,
        job.film.w,
        job.film.h,
    )
}

/// A material, with `ID` where its id goes.
fn bsdf(material: &Material) -> Result<String, &'static str> {
    match *material {
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
            "<bsdf type=\"roughdielectric\" ID><string name=\"distribution\" value=\"ggx\"/><float name=\"alpha\" value=\"{roughness:?}\"/><float name=\"int_ior\" value=\"{ior:?}\"/><float name=\"ext_ior\" value=\"1\"/>{}{}</bsdf>",
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
            Err("Mitsuba hides small mirrors by another formula, so glossy surfaces differ")
        }
        Material::Refraction { .. } => Err("Mitsuba has no boundary that does not reflect"),
    }
}

/// A shape with its material, and the light that it emits.
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

fn push_spheres(xml: &mut String, scene: &Scene) {
    let first = scene.triangles.len();
    for (sphere, object) in scene.spheres.iter().zip(&scene.object_of[first..]) {
        let material = scene.objects[*object as usize].material;
        let geometry = format!(
            "<float name=\"radius\" value=\"{:?}\"/><point name=\"center\" value=\"{}\"/>",
            sphere.radius,
            triple(sphere.center)
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

fn push_lights(xml: &mut String, lit: &LitScene, problems: &mut Vec<String>) {
    for named in &lit.scene.lights {
        match named.light {
            // A surface by now.
            Light::Area { .. } => {}
            Light::Point {
                position,
                intensity,
            } => push(
                xml,
                &format!(
                    "<emitter type=\"point\"><point name=\"position\" value=\"{}\"/>{}</emitter>",
                    triple(position),
                    rgb("intensity", intensity)
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
                "light {}: the edge of a spot is softer in Mitsuba",
                named.name
            )),
            Light::Hemisphere { .. } => problems.push(format!(
                "light {}: Mitsuba's constant light comes from below, too",
                named.name
            )),
        }
    }
    if lit
        .emitters
        .iter()
        .any(|e| matches!(e, Emitter::Environment(_)))
    {
        problems.push("the environment: Mitsuba blends its pixels: leave out -e".into());
    }
}

/// Triangles with the normals of their corners, as text.
fn ply(triangles: &[&Triangle]) -> String {
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
        for (p, n) in [(t.p0, t.n0), (t.p1, t.n1), (t.p2, t.n2)] {
            let line = triple(p) + ", " + &triple(n);
            text += &line.replace(',', "");
            text.push('\n');
        }
    }
    for i in 0..triangles.len() {
        writeln!(text, "3 {} {} {}", 3 * i, 3 * i + 1, 3 * i + 2).expect("a string takes all");
    }
    text
}
