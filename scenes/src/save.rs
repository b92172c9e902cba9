//! Writes a scene as COLLADA, so that [`load`](crate::load) reads it again.
//!
//! All geometry is written in world space, one node for each object. Numbers have all their digits.

use kit::{Camera, Light, Material, Scene, Spectrum, Vec3};
use std::fmt::{self, Display, Formatter, Write};

/// A scene as the text of a COLLADA file.
#[derive(Clone, Copy, Debug)]
pub struct SceneFile<'a>(pub &'a Scene);

impl Display for SceneFile<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let scene = self.0;
        f.write_str(HEAD)?;
        if let Some(camera) = &scene.camera {
            write_camera(f, camera)?;
        }
        section(
            f,
            "library_lights",
            scene.lights.iter().enumerate(),
            |f, (i, of)| write_light(f, i, &of.light),
        )?;
        let images = scene.textures.files.iter().enumerate();
        section(f, "library_images", images, |f, (i, file)| {
            let file = escaped(file);
            writeln!(
                f,
                "<image id=\"image-{i}\"><init_from>{file}</init_from></image>"
            )
        })?;
        let materials = || scene.materials.iter().enumerate();
        section(f, "library_effects", materials(), |f, (i, of)| {
            write_effect(f, i, &of.material, scene.textures.of_material(i as u32))
        })?;
        section(f, "library_materials", materials(), |f, (i, of)| {
            let name = escaped(&of.name);
            writeln!(
                f,
                "<material id=\"material-{i}\" name=\"{name}\"><instance_effect url=\"#effect-{i}\"/></material>"
            )
        })?;
        let primitives = by_object(scene);
        let shapes = || primitives.iter().enumerate();
        section(f, "library_geometries", shapes(), |f, (i, of)| {
            write_mesh(f, scene, i, &of.triangles)?;
            of.spheres.iter().try_for_each(|&sphere| {
                let radius = scene.spheres[sphere].radius;
                writeln!(
                    f,
                    "<geometry id=\"sphere-{sphere}\"><extra><technique profile=\"CGL\"><sphere>\
                     <radius>{radius}</radius></sphere></technique></extra></geometry>"
                )
            })
        })?;
        f.write_str("<library_visual_scenes><visual_scene id=\"scene\">\n")?;
        if let Some(camera) = &scene.camera {
            let [x, y, z] = [camera.c2w.x_axis, camera.c2w.y_axis, camera.c2w.z_axis];
            let matrix = matrix([x, y, z], camera.pos);
            node(f, "camera", &matrix, "<instance_camera url=\"#camera\"/>")?;
        }
        for (i, of) in scene.lights.iter().enumerate() {
            let instance = format!("<instance_light url=\"#light-{i}\"/>");
            node(f, &of.name, &placement(&of.light), &instance)?;
        }
        for (i, (object, of)) in scene.objects.iter().zip(&primitives).enumerate() {
            let instance = |shape: String| {
                let material = object.material;
                format!(
                    "<instance_geometry url=\"#{shape}\"><bind_material><technique_common>\
                     <instance_material symbol=\"paint\" target=\"#material-{material}\"/>\
                     </technique_common></bind_material></instance_geometry>"
                )
            };
            if !of.triangles.is_empty() {
                node(f, &object.name, "", &instance(format!("mesh-{i}")))?;
            }
            for &sphere in &of.spheres {
                let place = format!(
                    "<translate>{}</translate>",
                    numbers(scene.spheres[sphere].center)
                );
                node(
                    f,
                    &object.name,
                    &place,
                    &instance(format!("sphere-{sphere}")),
                )?;
            }
        }
        f.write_str(TAIL)
    }
}

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n\
    <COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n\
    <asset><created>2026-01-01T00:00:00</created><modified>2026-01-01T00:00:00</modified>\
    <up_axis>Y_UP</up_axis></asset>\n";

const TAIL: &str = "</visual_scene></library_visual_scenes>\n\
    <scene><instance_visual_scene url=\"#scene\"/></scene>\n</COLLADA>\n";

/// The primitives of an object, by their places in the scene.
#[derive(Clone, Debug, Default)]
struct OfObject {
    triangles: Vec<usize>,
    spheres: Vec<usize>,
}

fn by_object(scene: &Scene) -> Vec<OfObject> {
    let mut objects = vec![OfObject::default(); scene.objects.len()];
    let triangles = scene.triangles.len();
    for (prim, &object) in scene.object_of.iter().enumerate() {
        let of = &mut objects[object as usize];
        match prim.checked_sub(triangles) {
            None => of.triangles.push(prim),
            Some(sphere) => of.spheres.push(sphere),
        }
    }
    objects
}

/// An element with these parts; nothing without parts, because a library must not be empty.
fn section<T>(
    f: &mut Formatter<'_>,
    name: &str,
    parts: impl Iterator<Item = T>,
    mut write: impl FnMut(&mut Formatter<'_>, T) -> fmt::Result,
) -> fmt::Result {
    let mut parts = parts.peekable();
    if parts.peek().is_none() {
        return Ok(());
    }
    writeln!(f, "<{name}>")?;
    parts.try_for_each(|part| write(f, part))?;
    writeln!(f, "</{name}>")
}

fn node(f: &mut Formatter<'_>, name: &str, placement: &str, instance: &str) -> fmt::Result {
    let name = escaped(name);
    writeln!(f, "<node name=\"{name}\">{placement}{instance}</node>")
}

fn write_camera(f: &mut Formatter<'_>, camera: &Camera) -> fmt::Result {
    writeln!(
        f,
        "<library_cameras><camera id=\"camera\"><optics><technique_common><perspective>\
         <xfov>{}</xfov><yfov>{}</yfov><znear>{}</znear><zfar>{}</zfar></perspective>\
         </technique_common></optics></camera></library_cameras>",
        camera.h_fov, camera.v_fov, camera.n_clip, camera.f_clip
    )
}

fn write_light(f: &mut Formatter<'_>, i: usize, light: &Light) -> fmt::Result {
    let of = |color: &Spectrum| format!("<color>{}</color>", color_numbers(*color));
    let common = match light {
        Light::Area { radiance, .. } => format!("<point>{}</point>", of(radiance)),
        Light::Point { intensity, .. } => format!("<point>{}</point>", of(intensity)),
        Light::Spot {
            intensity,
            falloff_angle,
            falloff_exponent,
            ..
        } => format!(
            "<spot>{}<falloff_angle>{falloff_angle}</falloff_angle>\
             <falloff_exponent>{falloff_exponent}</falloff_exponent></spot>",
            of(intensity)
        ),
        Light::Directional { irradiance, .. } => {
            format!("<directional>{}</directional>", of(irradiance))
        }
        Light::Hemisphere { radiance } => format!("<ambient>{}</ambient>", of(radiance)),
    };
    // COLLADA has no area light: the course's extension.
    let extra = match light {
        Light::Area { radiance, .. } => format!(
            "<extra><technique profile=\"CGL\"><area>{}</area></technique></extra>",
            of(radiance)
        ),
        _ => String::new(),
    };
    writeln!(
        f,
        "<light id=\"light-{i}\"><technique_common>{common}</technique_common>{extra}</light>"
    )
}

/// The matrix of a light's node: it shines along -z, and an area light is a square in x and y.
fn placement(light: &Light) -> String {
    let along = |direction: Vec3| {
        let (x, y) = direction.any_orthonormal_pair();
        [x, y, -direction]
    };
    match *light {
        Light::Area {
            center,
            edge_x,
            edge_y,
            direction,
            ..
        } => matrix([edge_x, edge_y, -direction], center),
        Light::Point { position, .. } => matrix([Vec3::X, Vec3::Y, Vec3::Z], position),
        Light::Spot {
            position,
            direction,
            ..
        } => matrix(along(direction), position),
        Light::Directional { direction, .. } => matrix(along(direction), Vec3::ZERO),
        Light::Hemisphere { .. } => String::new(),
    }
}

fn write_effect(
    f: &mut Formatter<'_>,
    i: usize,
    material: &Material,
    image: Option<u32>,
) -> fmt::Result {
    let value = |name: &str, value: String| format!("<{name}>{value}</{name}>");
    let color = |name: &str, of: Spectrum| value(name, color_numbers(of));
    let number = |name: &str, of: f64| value(name, of.to_string());
    let mut diffuse = color("color", Spectrum::WHITE);
    let course = match *material {
        Material::Diffuse { reflectance } => {
            diffuse = color("color", reflectance);
            String::new()
        }
        Material::Emission { radiance } => value("emission", color("radiance", radiance)),
        Material::Mirror { reflectance } => value("mirror", color("reflectance", reflectance)),
        Material::Glossy {
            reflectance,
            shininess,
        } => value(
            "glossy",
            color("reflectance", reflectance) + &number("shininess", shininess),
        ),
        Material::Refraction {
            transmittance,
            roughness,
            ior,
        } => value(
            "refraction",
            color("transmittance", transmittance)
                + &number("roughness", roughness)
                + &number("ior", ior),
        ),
        Material::Glass {
            reflectance,
            transmittance,
            roughness,
            ior,
        } => value(
            "glass",
            color("reflectance", reflectance)
                + &color("transmittance", transmittance)
                + &number("roughness", roughness)
                + &number("ior", ior),
        ),
    };
    if let Some(image) = image {
        diffuse = format!("<texture texture=\"image-{image}\" texcoord=\"uv\"/>");
    }
    let extra = match course.as_str() {
        "" => String::new(),
        course => format!("<extra><technique profile=\"CGL\">{course}</technique></extra>"),
    };
    writeln!(
        f,
        "<effect id=\"effect-{i}\"><profile_COMMON><technique sid=\"common\"><lambert><diffuse>\
         {diffuse}</diffuse></lambert></technique></profile_COMMON>{extra}</effect>"
    )
}

/// Three vertices for each triangle, with their normals, and with texture coordinates if all have
/// some. Nothing without triangles.
fn write_mesh(f: &mut Formatter<'_>, scene: &Scene, i: usize, of: &[usize]) -> fmt::Result {
    if of.is_empty() {
        return Ok(());
    }
    let id = format!("mesh-{i}");
    let triangles = || of.iter().map(|&t| &scene.triangles[t]);
    writeln!(f, "<geometry id=\"{id}\"><mesh>")?;
    let positions = triangles().flat_map(|t| [t.p0, t.p1, t.p2]).map(numbers);
    source(f, &format!("{id}-positions"), &["X", "Y", "Z"], positions)?;
    let normals = triangles().flat_map(|t| [t.n0, t.n1, t.n2]).map(numbers);
    source(f, &format!("{id}-normals"), &["X", "Y", "Z"], normals)?;
    let coordinates: Option<Vec<_>> = of
        .iter()
        .map(|&t| scene.textures.coordinates.get(t).copied())
        .collect();
    let mut inputs = format!(
        "<input semantic=\"VERTEX\" source=\"#{id}-vertices\" offset=\"0\"/>\
         <input semantic=\"NORMAL\" source=\"#{id}-normals\" offset=\"0\"/>"
    );
    if let Some(coordinates) = coordinates {
        let values = coordinates
            .iter()
            .flatten()
            .map(|uv| format!("{} {}", uv.x, uv.y));
        source(f, &format!("{id}-uv"), &["S", "T"], values)?;
        inputs +=
            &format!("<input semantic=\"TEXCOORD\" source=\"#{id}-uv\" offset=\"0\" set=\"0\"/>");
    }
    let mut indices = String::new();
    for vertex in 0..3 * of.len() {
        write!(indices, "{vertex} ")?;
    }
    writeln!(
        f,
        "<vertices id=\"{id}-vertices\"><input semantic=\"POSITION\" source=\"#{id}-positions\"/>\
         </vertices>\n<triangles count=\"{}\" material=\"paint\">{inputs}<p>{}</p></triangles>\
         </mesh></geometry>",
        of.len(),
        indices.trim_end()
    )
}

fn source(
    f: &mut Formatter<'_>,
    id: &str,
    params: &[&str],
    values: impl Iterator<Item = String>,
) -> fmt::Result {
    let values: Vec<String> = values.collect();
    let (stride, count) = (params.len(), values.len());
    writeln!(
        f,
        "<source id=\"{id}\"><float_array id=\"{id}-array\" count=\"{}\">",
        stride * count
    )?;
    values.iter().try_for_each(|value| writeln!(f, "{value}"))?;
    write!(
        f,
        "</float_array><technique_common><accessor source=\"#{id}-array\" count=\"{count}\" \
         stride=\"{stride}\">"
    )?;
    for param in params {
        write!(f, "<param name=\"{param}\" type=\"float\"/>")?;
    }
    writeln!(f, "</accessor></technique_common></source>")
}

/// A matrix with these columns, row by row.
fn matrix([x, y, z]: [Vec3; 3], t: Vec3) -> String {
    let row = |i: usize| format!("{} {} {} {}", x[i], y[i], z[i], t[i]);
    format!("<matrix>{} {} {} 0 0 0 1</matrix>", row(0), row(1), row(2))
}

fn numbers(v: Vec3) -> String {
    format!("{} {} {}", v.x, v.y, v.z)
}

fn color_numbers(color: Spectrum) -> String {
    color.to_array().map(|c| c.to_string()).join(" ")
}

/// A text that may stand in XML.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// Normals are normalised and directions computed again: a rounding error apart.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn every_scene_of_the_course_is_the_same_when_it_is_read_again() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("dae");
        let mut count = 0;
        for file in std::fs::read_dir(folder).expect("a folder") {
            let path = file.expect("a file").path();
            let name = path.display().to_string();
            if path.extension().is_none_or(|end| end != "dae") {
                continue;
            }
            let before = crate::load(&path).expect("a scene").scene;
            let text = SceneFile(&before).to_string();
            let read = crate::parse(&name, &text).unwrap_or_else(|why| panic!("{name}: {why}"));
            assert_eq!(read.warnings.len(), 0, "{name}");
            assert_same(&before, &read.scene, &name);
            count += 1;
        }
        assert!(count >= 10, "{count} scenes");
    }

    fn assert_same(a: &Scene, b: &Scene, name: &str) {
        assert_eq!(a.triangles.len(), b.triangles.len(), "{name}");
        for (a, b) in a.triangles.iter().zip(&b.triangles) {
            assert_eq!([a.p0, a.p1, a.p2], [b.p0, b.p1, b.p2], "{name}");
            for (a, b) in [(a.n0, b.n0), (a.n1, b.n1), (a.n2, b.n2)] {
                assert!(a.distance(b) < ROUNDING, "{name}: {a} {b}");
            }
        }
        assert!(a.spheres == b.spheres, "{name}");
        assert!(a.textures.coordinates == b.textures.coordinates, "{name}");
        for (prim, (&a_object, &b_object)) in a.object_of.iter().zip(&b.object_of).enumerate() {
            let of = |scene: &Scene, object: u32| {
                let object = &scene.objects[object as usize];
                let material = &scene.materials[object.material as usize];
                (object.name.clone(), material.material)
            };
            assert_eq!(of(a, a_object), of(b, b_object), "{name}: primitive {prim}");
        }
        assert_eq!(a.lights.len(), b.lights.len(), "{name}");
        let fields = |scene: &Scene| -> Vec<f64> {
            let lights = format!("{:?} {:?}", scene.lights, scene.camera);
            let words = lights.split(|c: char| !(c.is_ascii_digit() || ".-e".contains(c)));
            words.filter_map(|word| word.parse().ok()).collect()
        };
        for (a, b) in fields(a).iter().zip(&fields(b)) {
            assert!(
                (a - b).abs() <= ROUNDING * a.abs().max(1.0),
                "{name}: {a} {b}"
            );
        }
    }

    #[test]
    fn names_with_markup_are_escaped() {
        assert_eq!(escaped("a<b> & \"c\""), "a&lt;b&gt; &amp; &quot;c&quot;");
    }
}
