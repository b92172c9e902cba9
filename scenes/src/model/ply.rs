//! PLY, as text and in both binary forms: one mesh of one grey material.

use super::builder::{Builder, Corner, MeshData};
use crate::Loaded;
use crate::collada::polygon::TestCounter;
use crate::collada::transform::Affine;
use crate::diagnostic::SceneError;
use kit::Vec3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};
use std::io;

/// The properties of a vertex that are used. A file has no textures.
struct Vertex {
    p: Vec3,
    n: Vec3,
}

/// A polygon by the numbers of its vertices; `None` if one is negative or not an integer.
struct Face {
    vertices: Option<Vec<u32>>,
}

/// An element whose properties are not used.
struct Other;

impl PropertyAccess for Vertex {
    fn new() -> Vertex {
        Vertex {
            p: Vec3::NAN,
            n: Vec3::ZERO,
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
            _ => return PropertyAccessResult::Ignored,
        };
        *place = match value {
            Property::Double(value) => value,
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
        }
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if !matches!(name, "vertex_indices" | "vertex_index") {
            return PropertyAccessResult::Ignored;
        }
        self.vertices = value.to_u32_list();
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
    let (vertices, faces) = parse(&mut builder, bytes).map_err(|why| {
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
    let mut counter = TestCounter::default();
    for face in faces {
        let Some(vertices) = face.vertices else {
            let help = "indices are integers >= 0: export the model again";
            return Err(builder.error("an index of a face is not a vertex", help));
        };
        let corner = |index: &u32| Corner::of_all(&data, *index as usize);
        let polygon: Vec<Corner> = vertices.iter().map(corner).collect();
        let triangles = builder.triangulated(&data, &polygon, &mut counter)?;
        data.triangles.extend(triangles);
    }
    if data.triangles.is_empty() {
        let help = "clouds of points and strips of triangles are not read: export a mesh of faces";
        return Err(builder.error("the file has no faces", help));
    }
    let material = builder.default_material();
    builder.add_mesh("mesh", &data, material, Affine::IDENTITY)?;
    Ok(builder.into_loaded())
}

fn parse(builder: &mut Builder<'_>, bytes: &[u8]) -> Result<(Vec<Vertex>, Vec<Face>), ParseError> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Vertex>::new().read_header(&mut reader)?;
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
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
                    builder.warn(title, "", "surfaces are grey, 0.5 0.5 0.5");
                }
                let parser = Parser::<Vertex>::new();
                vertices = parser.read_payload_for_element(&mut reader, element, &header)?;
            }
            "face" => {
                if element.properties.contains_key("red") {
                    let title = "the colours of faces are ignored";
                    builder.warn(title, "", "surfaces are grey, 0.5 0.5 0.5");
                }
                let parser = Parser::<Face>::new();
                faces = parser.read_payload_for_element(&mut reader, element, &header)?;
            }
            other => {
                builder.warn(&format!("elements `{other}`"), "", "they are ignored");
                let parser = Parser::<Other>::new();
                parser.read_payload_for_element(&mut reader, element, &header)?;
            }
        }
    }
    Ok((vertices, faces))
}
