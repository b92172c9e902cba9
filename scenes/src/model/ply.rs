//! PLY, as text and in both binary forms: one mesh, grey or with the textures that its comments
//! name (`comment TextureFile wall.png`, as MeshLab writes them).
//!
//! Texture coordinates are properties of vertices, or a list `texcoord` of each face, whose
//! `texnumber` then chooses among several textures.

use super::builder::{Builder, Corner, MeshData};
use crate::Loaded;
use crate::collada::polygon::TestCounter;
use crate::collada::transform::Affine;
use crate::diagnostic::SceneError;
use kit::{Material, Spectrum, Vec2, Vec3};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};
use std::io;

/// The properties of a vertex that are used.
struct Vertex {
    p: Vec3,
    n: Vec3,
    uv: Vec2,
}

/// A polygon by the numbers of its vertices; `None` if one is negative or not an integer.
struct Face {
    vertices: Option<Vec<u32>>,
    /// Two numbers for each corner, or none.
    tex_coords: Vec<f32>,
    texture: usize,
}

/// What is used of a file.
#[derive(Default)]
struct Contents {
    vertices: Vec<Vertex>,
    faces: Vec<Face>,
    /// The names of image files.
    textures: Vec<String>,
}

/// An element whose properties are not used.
struct Other;

impl PropertyAccess for Vertex {
    fn new() -> Vertex {
        Vertex {
            p: Vec3::NAN,
            n: Vec3::ZERO,
            uv: Vec2::NAN,
        }
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let place = match name {
            "x" => &mut self.p.x,
            "y" => &mut self.p.y,
            "z" => &mut self.p.z,
            "nx" => &mut self.n.x,
            "ny" => &mut self.n.y,
            "nz" => &mut self.n.z,
            "s" | "u" | "texture_s" | "texture_u" => &mut self.uv.x,
            "t" | "v" | "texture_t" | "texture_v" => &mut self.uv.y,
            _ => return PropertyAccessResult::Ignored,
        };
        *place = match value {
            Property::Double(value) => value,
            Property::Int(value) => value.into(),
            Property::UInt(value) => value.into(),
            other => match other.to_f32_lossy() {
                Some(value) => f64::from(value),
                None => return PropertyAccessResult::UnsupportedType,
            },
        };
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Face {
    fn new() -> Face {
        Face {
            vertices: Some(Vec::new()),
            tex_coords: Vec::new(),
            texture: 0,
        }
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        match (name, value) {
            ("vertex_indices" | "vertex_index", list) => self.vertices = list.to_u32_list(),
            ("texcoord", Property::ListFloat(list)) => self.tex_coords = list,
            ("texcoord", Property::ListDouble(list)) => {
                self.tex_coords = list.into_iter().map(|x| x as f32).collect();
            }
            ("texnumber", number) => match number.to_f32_lossy() {
                // -1 is none.
                Some(number) if number < 0.0 => self.texture = usize::MAX,
                Some(number) => self.texture = number as usize,
                None => return PropertyAccessResult::UnsupportedType,
            },
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Other {
    fn new() -> Other {
        Other
    }
}

/// Reads a PLY file.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Loaded, SceneError> {
    let mut builder = Builder::new(name);
    let Contents {
        vertices,
        faces,
        textures,
    } = (parse(&mut builder, bytes))
        .or_else(|why| match plain_text(bytes) {
            Some(text) => parse(&mut builder, &text),
            None => Err(why),
        })
        .map_err(|why| {
            // The lines after it are the library's grammar, and may be the whole file.
            let sentences = why.to_string();
            let why = sentences.lines().next().unwrap_or_default();
            let title = format!("the file is not a valid PLY file: {why}");
            builder.error(title, "export the model again, or repeat the download")
        })?;
    let mut data = MeshData {
        positions: vertices.iter().map(|vertex| vertex.p).collect(),
        is_smooth: true,
        ..MeshData::default()
    };
    if vertices.iter().any(|vertex| vertex.n != Vec3::ZERO) {
        data.normals = vertices.iter().map(|vertex| vertex.n).collect();
    }
    if vertices.iter().any(|vertex| vertex.uv.is_finite()) {
        data.tex_coords = vertices.iter().map(|vertex| vertex.uv).collect();
    }
    let mut counter = TestCounter::default();
    // One mesh for each texture, and one without.
    let mut meshes: Vec<Vec<[Corner; 3]>> = vec![Vec::new(); textures.len() + 1];
    let mut polygon: Vec<Corner> = Vec::new();
    for face in faces {
        let Some(vertices) = face.vertices else {
            let help = "indices are integers >= 0: export the model again";
            return Err(builder.error("an index of a face is not a vertex", help));
        };
        polygon.clear();
        polygon.extend((vertices.iter()).map(|index| Corner::of_all(&data, *index)));
        let own = face.tex_coords.as_chunks().0;
        if !textures.is_empty() && own.len() == polygon.len() {
            for (corner, [u, v]) in polygon.iter_mut().zip(own) {
                corner.tex_coords = Some(data.tex_coords.len() as u32);
                data.tex_coords.push(Vec2::new((*u).into(), (*v).into()));
            }
        }
        let mesh = &mut meshes[face.texture.min(textures.len())];
        builder.triangulate(&data, &polygon, &mut counter, mesh)?;
    }
    if meshes.iter().all(Vec::is_empty) {
        let help = "clouds of points and strips of triangles are not read: export a mesh of faces";
        return Err(builder.error("the file has no faces", help));
    }
    for (i, triangles) in meshes.into_iter().enumerate() {
        if triangles.is_empty() {
            continue;
        }
        let reflectance = Spectrum::WHITE;
        let material = match textures.get(i) {
            Some(file) => {
                builder.add_material(file, Material::Diffuse { reflectance }, Some(file.clone()))
            }
            None => builder.default_material(),
        };
        data.triangles = triangles;
        builder.add_mesh("mesh", &data, material, Affine::IDENTITY)?;
    }
    Ok(builder.into_loaded())
}

/// An ASCII file without empty lines, and with its numbers as the library reads them: the numbers
/// `.5`, `1.` and `nan`, which some programs write, are none to it.
fn plain_text(bytes: &[u8]) -> Option<Vec<u8>> {
    let text = String::from_utf8_lossy(bytes);
    let parts = text.split_once("end_header");
    let (header, body) = parts.filter(|(header, _)| header.contains("format ascii"))?;
    let number = |word: &str| match word.parse::<f64>() {
        Ok(number) if number.is_finite() => number.to_string(),
        Ok(_) => "1e999".to_owned(),
        Err(_) => word.to_owned(),
    };
    let line = |line: &str| Vec::from_iter(line.split_whitespace().map(number)).join(" ");
    let lines = body.lines().map(line).filter(|line| !line.is_empty());
    let lines: Vec<String> = [header.to_owned() + "end_header"]
        .into_iter()
        .chain(lines)
        .collect();
    Some((lines.join("\n") + "\n").into_bytes())
}

fn parse(builder: &mut Builder<'_>, bytes: &[u8]) -> Result<Contents, ParseError> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Vertex>::new().read_header(&mut reader)?;
    let mut contents = Contents::default();
    let comments = header.comments.iter();
    let textures = comments.filter_map(|comment| comment.trim().strip_prefix("TextureFile "));
    contents.textures = textures
        .map(|name| name.trim().replace('\\', "/"))
        .collect();
    let colors = match contents.textures.is_empty() {
        true => "surfaces are grey, 0.5 0.5 0.5",
        false => "surfaces have the colour of their texture alone",
    };
    for element in header.elements.values() {
        // Each has a byte at least: the reader would make room for all.
        if element.count > bytes.len() {
            let why = format!(
                "element `{}` has more items than the file has bytes",
                element.name
            );
            return Err(io::Error::new(io::ErrorKind::InvalidData, why).into());
        }
        match element.name.as_str() {
            "vertex" => {
                let is_color = |name: &String| ["r", "red", "diffuse_red"].contains(&name.as_str());
                if element.properties.keys().any(is_color) {
                    let title = "the colours of vertices are ignored";
                    builder.warn(title, "", colors);
                }
                let mut axes = ["x", "y", "z"].iter();
                if let Some(axis) = axes.find(|axis| !element.properties.contains_key(**axis)) {
                    let why = format!("its vertices have no property `{axis}`");
                    return Err(io::Error::new(io::ErrorKind::InvalidData, why).into());
                }
                let parser = Parser::<Vertex>::new();
                contents.vertices =
                    parser.read_payload_for_element(&mut reader, element, &header)?;
            }
            "face" => {
                if element.properties.contains_key("red") {
                    let title = "the colours of faces are ignored";
                    builder.warn(title, "", colors);
                }
                let parser = Parser::<Face>::new();
                contents.faces = parser.read_payload_for_element(&mut reader, element, &header)?;
            }
            other => {
                builder.warn(&format!("elements `{other}`"), "", "they are ignored");
                let parser = Parser::<Other>::new();
                parser.read_payload_for_element(&mut reader, element, &header)?;
            }
        }
    }
    Ok(contents)
}
