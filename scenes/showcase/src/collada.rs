//! Writes a scene of meshes as COLLADA.

use kit::{Triangle, Vec3};
use std::io::{self, Write};

/// What a surface does with light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint {
    /// Diffuse, with this reflectance.
    Matte([f64; 3]),
    /// A mirror with this reflectance.
    Mirror([f64; 3]),
}

/// A mesh of one material.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Its name in the file: letters, digits and `-`.
    pub name: String,
    /// Its material.
    pub paint: Paint,
    /// Its triangles.
    pub triangles: Vec<Triangle>,
}

/// An area light: the unit square in the plane z = 0, emitting to -z, after `placement`.
#[derive(Clone, Debug)]
pub struct AreaLight {
    /// Its name in the file.
    pub name: String,
    /// Its radiance.
    pub radiance: [f64; 3],
    /// `<translate>`, `<rotate>` and `<scale>` elements.
    pub placement: String,
}

/// A light so far away that its rays are parallel.
#[derive(Clone, Copy, Debug)]
pub struct Sun {
    /// The irradiance of a surface that faces it.
    pub irradiance: [f64; 3],
    /// The direction to it.
    pub direction: Vec3,
}

/// A scene.
#[derive(Clone, Debug)]
pub struct Document {
    /// Vertical angle of view in degrees.
    pub yfov: f64,
    /// Width of the picture divided by its height.
    pub aspect: f64,
    /// Camera position and the point that it looks at.
    pub camera: [Vec3; 2],
    /// Radiance from every direction.
    pub ambient: Option<[f64; 3]>,
    /// The sun, if there is one.
    pub sun: Option<Sun>,
    /// The area lights.
    pub lights: Vec<AreaLight>,
    /// The meshes.
    pub meshes: Vec<Mesh>,
}

impl Document {
    /// Writes the file. Numbers have all their digits.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "{HEAD}")?;
        writeln!(
            out,
            "<library_cameras><camera id=\"camera\"><optics><technique_common><perspective>\
             <yfov>{}</yfov><aspect_ratio>{}</aspect_ratio><znear>0.01</znear><zfar>1000</zfar>\
             </perspective></technique_common></optics></camera></library_cameras>\n\
             <library_lights>",
            self.yfov, self.aspect
        )?;
        if let Some(radiance) = self.ambient {
            writeln!(
                out,
                "<light id=\"ambient\"><technique_common><ambient><color>{}</color></ambient>\
                 </technique_common></light>",
                numbers(radiance)
            )?;
        }
        if let Some(sun) = &self.sun {
            let color = numbers(sun.irradiance);
            writeln!(
                out,
                "<light id=\"sun\"><technique_common><directional><color>{color}</color>\
                 </directional></technique_common></light>"
            )?;
        }
        for light in &self.lights {
            let color = numbers(light.radiance);
            writeln!(
                out,
                "<light id=\"{}\"><technique_common><point><color>{color}</color></point>\
                 </technique_common><extra><technique profile=\"CGL\"><area><color>{color}</color>\
                 </area></technique></extra></light>",
                light.name
            )?;
        }
        writeln!(out, "</library_lights>\n<library_effects>")?;
        for mesh in &self.meshes {
            writeln!(out, "{}", effect(&mesh.name, mesh.paint))?;
        }
        writeln!(out, "</library_effects>\n<library_materials>")?;
        for Mesh { name, .. } in &self.meshes {
            writeln!(out, "{}", material(name))?;
        }
        writeln!(out, "</library_materials>\n<library_geometries>")?;
        for mesh in &self.meshes {
            mesh.write(out)?;
        }
        self.write_nodes(out)
    }

    fn write_nodes(&self, out: &mut impl Write) -> io::Result<()> {
        let [position, target] = self.camera.map(|p| numbers(p.to_array()));
        writeln!(
            out,
            "</library_geometries>\n<library_visual_scenes><visual_scene id=\"scene\">\n\
             <node id=\"camera-node\"><lookat>{position} {target} 0 1 0</lookat>\
             <instance_camera url=\"#camera\"/></node>"
        )?;
        if self.ambient.is_some() {
            writeln!(
                out,
                "<node id=\"ambient-node\"><instance_light url=\"#ambient\"/></node>"
            )?;
        }
        if let Some(sun) = &self.sun {
            // The light shines along -z of its node.
            let [from, up] = [sun.direction, sun.direction.any_orthonormal_vector()];
            writeln!(
                out,
                "<node id=\"sun-node\"><lookat>{} 0 0 0 {}</lookat>\
                 <instance_light url=\"#sun\"/></node>",
                numbers(from.to_array()),
                numbers(up.to_array())
            )?;
        }
        for AreaLight {
            name, placement, ..
        } in &self.lights
        {
            writeln!(
                out,
                "<node id=\"{name}-node\">{placement}<instance_light url=\"#{name}\"/></node>"
            )?;
        }
        for Mesh { name, .. } in &self.meshes {
            writeln!(out, "{}", node(name))?;
        }
        writeln!(
            out,
            "</visual_scene></library_visual_scenes>\n\
             <scene><instance_visual_scene url=\"#scene\"/></scene>\n</COLLADA>"
        )
    }
}

/// The `<effect>` of a material.
pub(crate) fn effect(name: &str, paint: Paint) -> String {
    let (Paint::Matte(color) | Paint::Mirror(color)) = paint;
    let color = numbers(color);
    let extra = match paint {
        Paint::Matte(_) => String::new(),
        Paint::Mirror(_) => format!(
            "<extra><technique profile=\"CGL\"><mirror><reflectance>{color}</reflectance></mirror>\
             </technique></extra>"
        ),
    };
    format!(
        "<effect id=\"{name}-effect\"><profile_COMMON><technique sid=\"common\"><lambert>\
         <diffuse><color>{color} 1</color></diffuse></lambert></technique></profile_COMMON>{extra}\
         </effect>"
    )
}

/// The `<material>` of the effect with this name.
pub(crate) fn material(name: &str) -> String {
    format!("<material id=\"{name}-paint\"><instance_effect url=\"#{name}-effect\"/></material>")
}

/// The `<node>` of the mesh with this name.
pub(crate) fn node(name: &str) -> String {
    format!(
        "<node id=\"{name}\"><instance_geometry url=\"#{name}-mesh\"><bind_material>\
         <technique_common><instance_material symbol=\"paint\" target=\"#{name}-paint\"/>\
         </technique_common></bind_material></instance_geometry></node>"
    )
}

impl Mesh {
    /// Three vertices for each triangle, with their normals.
    pub(crate) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let Mesh {
            name, triangles, ..
        } = self;
        let count = 3 * triangles.len();
        writeln!(out, "<geometry id=\"{name}-mesh\"><mesh>")?;
        for source in ["positions", "normals"] {
            writeln!(
                out,
                "<source id=\"{name}-{source}\"><float_array id=\"{name}-{source}-array\" \
                 count=\"{}\">",
                3 * count
            )?;
            for t in triangles {
                let corners = match source {
                    "positions" => [t.p0, t.p1, t.p2],
                    _ => [t.n0, t.n1, t.n2],
                };
                let [a, b, c] = corners.map(|corner| numbers(corner.to_array()));
                writeln!(out, "{a} {b} {c}")?;
            }
            writeln!(
                out,
                "</float_array><technique_common><accessor source=\"#{name}-{source}-array\" \
                 count=\"{count}\" stride=\"3\"><param name=\"X\" type=\"float\"/>\
                 <param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>\
                 </technique_common></source>"
            )?;
        }
        writeln!(
            out,
            "<vertices id=\"{name}-vertices\"><input semantic=\"POSITION\" \
             source=\"#{name}-positions\"/><input semantic=\"NORMAL\" source=\"#{name}-normals\"/>\
             </vertices><triangles count=\"{}\" material=\"paint\"><input semantic=\"VERTEX\" \
             source=\"#{name}-vertices\" offset=\"0\"/><p>",
            triangles.len()
        )?;
        for i in 0..triangles.len() {
            writeln!(out, "{} {} {}", 3 * i, 3 * i + 1, 3 * i + 2)?;
        }
        writeln!(out, "</p></triangles></mesh></geometry>")
    }
}

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n\
    <COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n\
    <asset><created>2026-01-01T00:00:00</created><modified>2026-01-01T00:00:00</modified>\
    <up_axis>Y_UP</up_axis></asset>";

fn numbers([x, y, z]: [f64; 3]) -> String {
    format!("{x} {y} {z}")
}

/// What is read of a scene file that `write` has written; it is read without a warning.
#[cfg(test)]
pub(crate) fn read_again(
    write: impl FnOnce(&mut std::fs::File) -> io::Result<()>,
) -> scenes::Loaded {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.dae");
    write(&mut std::fs::File::create(&path).expect("a file")).expect("it is written");
    let loaded = scenes::load(&path).expect("a scene");
    assert_eq!(loaded.warnings.len(), 0);
    loaded
}
