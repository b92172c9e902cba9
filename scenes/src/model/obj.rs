//! OBJ, with its MTL file beside it.
//!
//! Polygons are triangulated. A surface is a lamp if its `Ke` is not black, glass with `illum` 4,
//! 6, 7 or 9, a mirror of colour `Ks` with `illum` 3 or 5, and else diffuse.
//!
//! `Kd` and `map_Kd` are multiplied, as the format says, and as three.js and assimp do. The texture
//! alone is used beside a black `Kd`, which exporters write for "see the texture", and in files of
//! Blender, whose `Kd` beside a texture is a colour that Blender itself does not show.

use super::builder::{Builder, Corner, MeshData};
use crate::Loaded;
use crate::collada::polygon::TestCounter;
use crate::collada::transform::Affine;
use crate::diagnostic::SceneError;
use crate::limited_file;
use kit::{Material, Spectrum, Vec2, Vec3};
use std::cell::{Cell, RefCell};
use std::io::BufReader;
use std::path::Path;
use tobj::LoadOptions;

/// Reads an OBJ file. `folder` is that of its materials.
pub(super) fn read(name: &str, folder: &Path, bytes: &[u8]) -> Result<Loaded, SceneError> {
    let mut builder = Builder::new(name);
    let options = LoadOptions {
        ignore_points: true,
        ignore_lines: true,
        ..LoadOptions::default()
    };
    let (text, left_out) = plain(bytes);
    if left_out.colors {
        let title = "the colours of vertices are ignored";
        let result = "the material alone gives a surface its colour";
        builder.warn(title, "", result);
    }
    if left_out.lines {
        builder.warn("points and lines", "", "they are left out");
    }
    let problems = RefCell::new(Vec::new());
    let is_of_blender = Cell::new(false);
    let library = |path: &Path| {
        let (text, missing) = libraries(folder, &path.to_string_lossy().replace('\\', "/"));
        let (text, left_out) = plain(&text);
        is_of_blender.set(is_of_blender.get() || text.starts_with("# Blender"));
        let mut problems = problems.borrow_mut();
        problems.extend(missing.into_iter().map(|file| {
            let result = "keep it beside the .obj file; surfaces are grey";
            ("material libraries that cannot be read", file, result)
        }));
        if left_out.damaged {
            let file = path.display().to_string();
            problems.push(("colours without three numbers", file, "they are ignored"));
        }
        tobj::load_mtl_buf(&mut BufReader::new(text.as_bytes()))
    };
    let (models, materials) =
        tobj::load_obj_buf(&mut BufReader::new(text.as_bytes()), &options, library).map_err(
            |why| {
                let title = format!("the file is not a valid OBJ file: {why}");
                builder.error(title, "export the model again")
            },
        )?;
    for (title, file, result) in problems.into_inner() {
        builder.warn(title, &file, result);
    }
    let materials = materials.unwrap_or_else(|why| {
        let title = format!("the material library is damaged: {why}");
        builder.warn(&title, "", "export the model again; surfaces are grey");
        Vec::new()
    });
    let numbers: Vec<u32> = materials
        .iter()
        .map(|m| add_material(&mut builder, m, is_of_blender.get()))
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
            normal: index(&mesh.normal_indices, i).filter(|n| data.normals[*n] != Vec3::ZERO),
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
                    "meshes whose material is in no library, or that have none",
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

/// The contents of the libraries of an `mtllib` line, one name or several, and which of them cannot
/// be read.
fn libraries(folder: &Path, names: &str) -> (Vec<u8>, Vec<String>) {
    if let Ok(bytes) = limited_file::read(&folder.join(names)) {
        return (bytes, Vec::new());
    }
    let (mut all, mut missing) = (Vec::new(), Vec::new());
    let (one, several) = (names.trim(), names.split_whitespace());
    let is_one = !several.clone().any(|name| folder.join(name).is_file());
    for name in if is_one { vec![one] } else { several.collect() } {
        match limited_file::read(&folder.join(name)) {
            Ok(bytes) => all.extend(bytes.into_iter().chain(*b"\n")),
            Err(_) => missing.push(name.to_owned()),
        }
    }
    (all, missing)
}

/// The name of a file after options such as `-s 2 2 1`. It may have blanks.
fn after_options(text: &str) -> String {
    let is_value = |word: &&str| {
        word.starts_with('-') || word.parse::<f64>().is_ok() || ["on", "off"].contains(word)
    };
    let words = text.split_whitespace().skip_while(is_value);
    words.collect::<Vec<_>>().join(" ")
}

/// What [`plain`] leaves out.
#[derive(Default)]
struct Found {
    colors: bool,
    lines: bool,
    damaged: bool,
}

/// The lines of an OBJ or MTL file as `tobj` reads them: in UTF-8, with one kind of line ends, none
/// continued on the next, blanks between words, colours of three numbers, and each material with a
/// name. Vertices lose their colours, which may stand at some of them only. Where there are
/// normals, corners without one have that of length 0: `tobj` would give them another corner's.
fn plain(bytes: &[u8]) -> (String, Found) {
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
    let mut found = Found::default();
    let mut lines = String::with_capacity(text.len());
    let has_normals = text.lines().any(|line| line.trim_start().starts_with("vn"));
    if has_normals {
        lines.push_str("vn 0 0 0\n");
    }
    for line in text.replace("\\\n", " ").lines() {
        let (word, rest) = line
            .trim()
            .split_once(char::is_whitespace)
            .unwrap_or((line.trim(), ""));
        let words = || {
            rest.split_whitespace()
                .take_while(|word| !word.starts_with('#'))
        };
        match (word, words().count()) {
            ("l" | "p", _) => found.lines = true,
            ("v", 6..) => {
                found.colors = true;
                push(&mut lines, word, words().take(3));
            }
            ("f", _) if has_normals => {
                let corners: Vec<String> = words().map(after_no_normal).collect();
                push(&mut lines, word, corners.iter().map(String::as_str));
            }
            ("v" | "vt" | "vn" | "f", _) => push(&mut lines, word, words()),
            // One number is a grey. Others than three are not the colour of a material.
            ("Ka" | "Kd" | "Ks" | "Ke", 1) => push(&mut lines, word, words().cycle().take(3)),
            ("Ka" | "Kd" | "Ks" | "Ke", 0 | 2) => found.damaged = true,
            ("usemtl" | "newmtl", 0) => push(&mut lines, word, ["unnamed"].into_iter()),
            _ => push(&mut lines, word, [rest.trim()].into_iter()),
        }
    }
    (lines, found)
}

/// A corner of a face where the file's normals are numbered from 2, after one for corners without.
fn after_no_normal(corner: &str) -> String {
    let mut numbers = corner.split('/');
    let [p, uv, n] = [(); 3].map(|()| numbers.next().unwrap_or_default());
    let n = match n.parse::<usize>() {
        Ok(n) => (n + 1).to_string(),
        // Some count from the end.
        Err(_) if n.starts_with('-') => n.to_owned(),
        Err(_) => "1".to_owned(),
    };
    format!("{p}/{uv}/{n}")
}

fn push<'a>(lines: &mut String, word: &'a str, rest: impl Iterator<Item = &'a str>) {
    lines.push_str(word);
    lines.extend(rest.flat_map(|word| [" ", word]));
    lines.push('\n');
}

fn add_material(builder: &mut Builder<'_>, given: &tobj::Material, is_of_blender: bool) -> u32 {
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
    // That of a texture.
    let diffuse = reflected(color(given.diffuse, 1.0));
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
                Some(_) if is_of_blender || diffuse.is_black() => Spectrum::WHITE,
                Some(_) => diffuse,
                None => reflected(color(given.diffuse, 0.5)),
            },
        },
    };
    let is_diffuse = matches!(material, Material::Diffuse { .. });
    let is_tinted = is_diffuse && given.diffuse_texture.is_some() && diffuse != Spectrum::WHITE;
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
        is_tinted && diffuse.is_black(),
        "a black `Kd` beside `map_Kd`",
        "the texture alone is used",
    );
    warn(
        is_tinted && !diffuse.is_black() && !is_of_blender,
        "`Kd` beside `map_Kd`",
        "they are multiplied; some programs show the texture alone: `Kd 1 1 1` does the same here",
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
    let mut unknown: Vec<&String> = given.unknown_param.keys().collect();
    unknown.sort();
    for name in unknown {
        let title = format!("the parameter `{name}` of materials");
        builder.warn(&title, &given.name, "it is ignored");
    }
    // Options, such as `-s 2 2 1`, stand before the name of the file.
    let texture = given.diffuse_texture.as_deref().filter(|_| is_diffuse);
    if texture.is_some_and(|file| file.starts_with('-')) {
        builder.warn("options of map_Kd", &given.name, "they are ignored");
    }
    let file = texture.map(|file| match file.strip_prefix('-') {
        Some(_) => after_options(file),
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
