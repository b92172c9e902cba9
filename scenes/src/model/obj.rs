//! OBJ, with its MTL file beside it.
//!
//! Polygons are triangulated. A surface is a lamp if its `Ke` is not black, glass with `illum` 4,
//! 6, 7 or 9, a mirror of colour `Ks` with `illum` 3 or 5, and else diffuse, with `Kd` or `map_Kd`.

use super::builder::{Builder, Corner, MeshData};
use crate::Loaded;
use crate::collada::polygon::TestCounter;
use crate::collada::transform::Affine;
use crate::diagnostic::SceneError;
use crate::limited_file;
use kit::{Material, Spectrum, Vec2, Vec3};
use std::io::BufReader;
use std::path::Path;
use tobj::{LoadError, LoadOptions};

/// Reads an OBJ file. `folder` is that of its materials.
pub(super) fn read(name: &str, folder: &Path, bytes: &[u8]) -> Result<Loaded, SceneError> {
    let mut builder = Builder::new(name);
    let options = LoadOptions {
        ignore_points: true,
        ignore_lines: true,
        ..LoadOptions::default()
    };
    let library = |path: &Path| {
        let bytes =
            limited_file::read(&folder.join(path)).map_err(|_| LoadError::OpenFileFailed)?;
        tobj::load_mtl_buf(&mut BufReader::new(plain(&bytes).0.as_bytes()))
    };
    let (text, is_colored) = plain(bytes);
    if is_colored {
        let title = "the colours of vertices are ignored";
        let result = "the material alone gives a surface its colour";
        builder.warn(title, "", result);
    }
    let (models, materials) =
        tobj::load_obj_buf(&mut BufReader::new(text.as_bytes()), &options, library).map_err(
            |why| {
                let title = format!("the file is not a valid OBJ file: {why}");
                builder.error(title, "export the model again")
            },
        )?;
    let materials = materials.unwrap_or_else(|why| {
        let title = format!("the material library cannot be read: {why}");
        builder.warn(
            &title,
            "",
            "keep the .mtl file beside the .obj file; surfaces are grey",
        );
        Vec::new()
    });
    let numbers: Vec<u32> = materials
        .iter()
        .map(|m| add_material(&mut builder, m))
        .collect();
    let mut counter = TestCounter::default();
    for model in &models {
        let mesh = &model.mesh;
        let mut data = MeshData {
            positions: vectors(&mesh.positions),
            normals: vectors(&mesh.normals),
            tex_coords: mesh
                .texcoords
                .as_chunks()
                .0
                .iter()
                .map(|[u, v]| Vec2::new(*u, *v))
                .collect(),
            triangles: Vec::new(),
            is_smooth: true,
        };
        let index = |list: &[u32], i: usize| list.get(i).map(|index| *index as usize);
        let corner = |i: usize| Corner {
            position: mesh.indices[i] as usize,
            normal: index(&mesh.normal_indices, i),
            tex_coords: index(&mesh.texcoord_indices, i),
        };
        let corners: Vec<Corner> = (0..mesh.indices.len()).map(corner).collect();
        // No list of sizes: all are triangles.
        let mut rest = &corners[..];
        let mut sizes = mesh.face_arities.iter();
        while !rest.is_empty() {
            let size = sizes
                .next()
                .map_or(3, |size| *size as usize)
                .clamp(1, rest.len());
            let (polygon, others) = rest.split_at(size);
            rest = others;
            let triangles = builder.triangulated(&data, polygon, &mut counter)?;
            data.triangles.extend(triangles);
        }
        let material = match mesh.material_id.and_then(|id| numbers.get(id)) {
            Some(material) => *material,
            None => {
                builder.warn(
                    "meshes without a material",
                    &model.name,
                    "using grey, 0.5 0.5 0.5",
                );
                builder.default_material()
            }
        };
        builder.add_mesh(&model.name, &data, material, Affine::IDENTITY)?;
    }
    Ok(builder.into_loaded())
}

/// The lines of an OBJ or MTL file as `tobj` reads them: in UTF-8, with one kind of line ends, none
/// continued on the next, and each material with a name. Vertices lose their colours, which may
/// stand at some of them only: the second answer is whether there were some.
fn plain(bytes: &[u8]) -> (String, bool) {
    let utf16 = |unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes.as_chunks().0.iter().map(|pair| unit(*pair)).collect();
        String::from_utf16_lossy(&units)
    };
    let text = match bytes {
        [0xfe, 0xff, ..] => utf16(u16::from_be_bytes),
        [0xff, 0xfe, ..] => utf16(u16::from_le_bytes),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    };
    let text = text
        .trim_start_matches('\u{feff}')
        .replace("\r\n", "\n")
        .replace('\r', "\n");
    let mut is_colored = false;
    let mut lines = String::with_capacity(text.len());
    for line in text.replace("\\\n", " ").lines() {
        let mut words = line.split_whitespace();
        match (words.next(), words.clone().count()) {
            (Some("v"), 6..) => {
                is_colored = true;
                lines.push('v');
                lines.extend(words.take(3).flat_map(|word| [" ", word]));
            }
            (Some(word @ ("usemtl" | "newmtl")), 0) => lines.extend([word, " unnamed"]),
            _ => lines.push_str(line),
        }
        lines.push('\n');
    }
    (lines, is_colored)
}

fn add_material(builder: &mut Builder<'_>, given: &tobj::Material) -> u32 {
    let color = |channels: Option<[f64; 3]>, default: f64| {
        Spectrum::from(
            channels
                .unwrap_or([default; 3])
                .map(|channel| channel.max(0.0)),
        )
    };
    let reflected = |c: Spectrum| Spectrum::new(c.r.min(1.0), c.g.min(1.0), c.b.min(1.0));
    let emission = color(given.emissive, 0.0);
    let specular = reflected(color(given.specular, 1.0));
    let material = match given.illumination_model {
        _ if !emission.is_black() => Material::Emission { radiance: emission },
        Some(3 | 5) => Material::Mirror {
            reflectance: specular,
        },
        Some(4 | 6 | 7 | 9) => Material::Glass {
            reflectance: Spectrum::WHITE,
            transmittance: Spectrum::WHITE,
            roughness: 0.0,
            ior: given
                .optical_density
                .filter(|ior| *ior >= 1.0)
                .unwrap_or(1.5),
        },
        _ => Material::Diffuse {
            reflectance: match given.diffuse_texture {
                Some(_) => Spectrum::WHITE,
                None => reflected(color(given.diffuse, 0.5)),
            },
        },
    };
    let is_diffuse = matches!(material, Material::Diffuse { .. });
    let mut warn = |is_so: bool, title: &str, result: &str| {
        if is_so {
            builder.warn(title, &given.name, result);
        }
    };
    let is_glass = matches!(material, Material::Glass { .. });
    let transparent = given.dissolve.is_some_and(|d| d < 0.99) || given.dissolve_texture.is_some();
    warn(
        transparent && !is_glass,
        "materials with transparent parts",
        "they are opaque",
    );
    warn(
        given.normal_texture.is_some(),
        "normal maps",
        "they are ignored",
    );
    let is_plain = given.specular_texture.is_none()
        && (given.illumination_model == Some(1)
            || given
                .specular
                .is_none_or(|c| c == [0.5; 3] || c.iter().all(|x| *x < 0.1)));
    warn(
        is_diffuse && !is_plain,
        "highlights of materials",
        "they are ignored: `illum` 3 makes a mirror",
    );
    warn(
        !is_diffuse && given.diffuse_texture.is_some(),
        "textures of lamps, glass and mirrors",
        "only the texture of a diffuse surface is used",
    );
    // Options, such as `-s 2 2 1`, stand before the name of the file.
    let texture = given.diffuse_texture.as_deref().filter(|_| is_diffuse);
    if texture.is_some_and(|file| file.starts_with('-')) {
        builder.warn("options of map_Kd", &given.name, "they are ignored");
    }
    let file = texture.map(|file| match file.strip_prefix('-') {
        Some(_) => file.rsplit(' ').next().unwrap_or(file).to_owned(),
        None => file.replace('\\', "/"),
    });
    builder.add_material(&given.name, material, file)
}

fn vectors(numbers: &[f64]) -> Vec<Vec3> {
    numbers
        .as_chunks()
        .0
        .iter()
        .copied()
        .map(Vec3::from_array)
        .collect()
}
