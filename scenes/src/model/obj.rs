//! OBJ, with its MTL files beside it ([`super::mtl`]).
//!
//! Polygons are triangulated. Without normals they are smooth, but flat after `s off`; which group
//! of smoothing they are in does not matter. A mesh is what has the same name (`o`, `g`) and the
//! same material.

use super::builder::{Builder, Corner, MeshData};
use super::mtl::{self, split};
use crate::Loaded;
use crate::collada::polygon::TestCounter;
use crate::collada::transform::Affine;
use crate::diagnostic::SceneError;
use crate::limited_file;
use kit::{Vec2, Vec3};
use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

/// Polygons of one name and one material.
#[derive(Default)]
struct Group<'t> {
    name: &'t str,
    material: Option<&'t str>,
    /// Whether `s off` is in force: without normals the polygons are flat.
    is_flat: bool,
    corners: Vec<Corner>,
    /// For each polygon its line, and how many of the corners it has.
    polygons: Vec<(usize, usize)>,
}

/// Reads an OBJ file. `folder` is that of its materials.
pub(super) fn read(name: &str, folder: &Path, bytes: &[u8]) -> Result<Loaded, SceneError> {
    let mut builder = Builder::new(name);
    let text = decoded(bytes);
    let is_of_blender = text.starts_with("# Blender");
    let mut data = MeshData::default();
    let (mut materials, mut libraries) = (HashMap::new(), HashSet::new());
    // Of each name, material and smoothness the index in the list of groups.
    let mut known = HashMap::from([(("", None, false), 0)]);
    let (mut groups, mut current) = (vec![Group::default()], 0);
    for (line, word, value) in statements(&text) {
        let invalid = |builder: &Builder<'_>, expected: &str| {
            let title = format!("line {line} is not valid: expected {expected}");
            builder.error(title, "export the model again, or correct this line")
        };
        match word {
            "v" | "vn" => match numbers(value) {
                Some((p, count @ 3..)) => {
                    let list = match word {
                        "v" => &mut data.positions,
                        _ => &mut data.normals,
                    };
                    list.push(Vec3::from(p));
                    if word == "v" && count >= 6 {
                        let title = "the colours of vertices are ignored";
                        let result = "the material alone gives a surface its colour";
                        builder.warn(title, "", result);
                    }
                }
                _ => return Err(invalid(&builder, "three numbers")),
            },
            "vt" => match numbers(value) {
                Some(([u, v, _], 1..)) => data.tex_coords.push(Vec2::new(u, v)),
                _ => return Err(invalid(&builder, "one number, or more")),
            },
            "f" | "fo" => {
                let group = &mut groups[current];
                let before = group.corners.len();
                for corner in value.split_whitespace() {
                    let expected = "vertices such as 1, 1/2, 1//3 or 1/2/3, none of them 0 or above 4294967295";
                    let corner = corner_of(corner, &data);
                    group
                        .corners
                        .push(corner.ok_or_else(|| invalid(&builder, expected))?);
                }
                let size = group.corners.len() - before;
                if size < 3 {
                    let place = format!("line {line}");
                    let title = "faces of fewer than three corners";
                    builder.warn(title, &place, "they are left out");
                }
                group.polygons.push((line, size));
            }
            "o" | "g" | "usemtl" | "s" => {
                let Group {
                    mut name,
                    mut material,
                    mut is_flat,
                    ..
                } = groups[current];
                match word {
                    "usemtl" => material = Some(value),
                    "s" => is_flat = matches!(value, "off" | "0"),
                    // Blender writes no `usemtl` for an object without a material.
                    "o" if is_of_blender => (name, material) = (value, None),
                    _ => name = value,
                }
                // Edges are smooth within a group only.
                current = *known.entry((name, material, is_flat)).or_insert_with(|| {
                    groups.push(Group {
                        name,
                        material,
                        is_flat,
                        ..Group::default()
                    });
                    groups.len() - 1
                });
            }
            "mtllib" => {
                if libraries.insert(value) {
                    materials.extend(read_libraries(&mut builder, folder, value));
                }
            }
            "l" | "p" => builder.warn("points and lines", "", "they are left out"),
            _ => builder.warn("statements that are not read", word, "they are ignored"),
        }
    }
    let mut counter = TestCounter::default();
    for group in groups.iter().filter(|group| !group.polygons.is_empty()) {
        let name = if group.name.is_empty() {
            "mesh"
        } else {
            group.name
        };
        let mut absent = [false; 2];
        let mut rest = &group.corners[..];
        let mut triangles = std::mem::take(&mut data.triangles);
        triangles.clear();
        data.is_smooth = !group.is_flat;
        for (line, size) in &group.polygons {
            let (polygon, others) = rest.split_at(*size);
            rest = others;
            for corner in polygon {
                let (at, count) = (corner.position as usize, data.positions.len());
                if at >= count {
                    let at = at + 1;
                    let title = format!("line {line} refers to vertex {at}, but there are {count}");
                    return Err(builder.error(title, "the file is damaged: export it again"));
                }
                let is_absent =
                    |index: Option<u32>, count| index.is_some_and(|i| i as usize >= count);
                absent[0] |= is_absent(corner.tex_coords, data.tex_coords.len());
                absent[1] |= is_absent(corner.normal, data.normals.len());
            }
            builder.triangulate(&data, polygon, &mut counter, &mut triangles)?;
        }
        data.triangles = triangles;
        for (is_absent, what, result) in [
            (absent[0], "texture coordinates", "using 0 0"),
            (absent[1], "normals", "using those of the faces"),
        ] {
            if is_absent {
                let title = format!("faces refer to {what} that are not in the file");
                builder.warn(&title, name, result);
            }
        }
        let known = group.material.and_then(|name| materials.get(name));
        let material = known.copied().unwrap_or_else(|| {
            if group.material.is_some() {
                let title = "meshes whose material is in no library";
                builder.warn(title, name, "using grey, 0.5 0.5 0.5");
            }
            builder.default_material()
        });
        builder.add_mesh(name, &data, material, Affine::IDENTITY)?;
    }
    Ok(builder.into_loaded())
}

/// The first three numbers of a text, 0 where there are fewer, and how many it has. `None` if a
/// word is not a number.
fn numbers(text: &str) -> Option<([f64; 3], usize)> {
    let (mut first, mut count) = ([0.0; 3], 0);
    for word in text.split_whitespace() {
        let number = word.parse().ok()?;
        if let Some(place) = first.get_mut(count) {
            *place = number;
        }
        count += 1;
    }
    Some((first, count))
}

/// A corner of a face: `position/texture/normal`, counted from 1, or backwards from the last one.
fn corner_of(text: &str, data: &MeshData) -> Option<Corner> {
    let mut parts = text.split('/');
    let mut index = |count: usize| -> Option<Option<u32>> {
        match parts.next().unwrap_or_default() {
            "" => Some(None),
            number => match number.parse::<i64>().ok()? {
                0 => None,
                back @ ..0 => Some(Some(
                    (count as u32).checked_add_signed(back.try_into().ok()?)?,
                )),
                number => Some(Some((number - 1).try_into().ok()?)),
            },
        }
    };
    Some(Corner {
        position: index(data.positions.len())??,
        tex_coords: index(data.tex_coords.len())?,
        normal: index(data.normals.len())?,
    })
}

/// The materials of the libraries of an `mtllib` line: one name, which may have blanks, or several.
fn read_libraries(builder: &mut Builder<'_>, folder: &Path, names: &str) -> Vec<(String, u32)> {
    let names = names.replace('\\', "/").replace('"', "");
    let is_several = find(folder, &names).is_none()
        && (names.split_whitespace()).any(|name| find(folder, name).is_some());
    let several = names.split_whitespace().collect();
    let mut materials = Vec::new();
    for name in if is_several { several } else { vec![&*names] } {
        let found = find(folder, name).unwrap_or_else(|| folder.join(name));
        match limited_file::read(&found) {
            Ok(bytes) => materials.extend(mtl::add(builder, folder, name, &bytes)),
            Err(_) => {
                let result = "keep it beside the .obj file; surfaces are grey";
                builder.warn("material libraries that cannot be read", name, result);
            }
        }
    }
    materials
}

/// A file relative to `folder`; else one of its name in `folder`, also in other letters.
fn find(folder: &Path, name: &str) -> Option<PathBuf> {
    let path = folder.join(name);
    if path.is_file() {
        return Some(path);
    }
    let last = name.rsplit('/').next()?;
    let here = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let entries = here.read_dir().ok()?.filter_map(Result::ok);
    let mut files = entries.filter(|entry| {
        let name = entry.file_name();
        name.to_str()
            .is_some_and(|name| name.eq_ignore_ascii_case(last))
    });
    files.next().map(|entry| entry.path())
}

/// The text of a file in UTF-8, UTF-16 or nearly so, with one kind of line ends.
pub(super) fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let utf16 = |unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes.as_chunks().0.iter().map(|pair| unit(*pair)).collect();
        String::from_utf16_lossy(&units)
    };
    let text = match bytes {
        [0xfe, 0xff, ..] => utf16(u16::from_be_bytes).into(),
        [0xff, 0xfe, ..] => utf16(u16::from_le_bytes).into(),
        _ => String::from_utf8_lossy(bytes),
    };
    let has = |byte| text.as_bytes().contains(&byte);
    if !(text.starts_with('\u{feff}') || has(b'\r') || has(b'\\')) {
        return text;
    }
    let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n");
    // A line that is continued on the next stays one, of the same number. A comment is not.
    let text = text.replace('\r', "\n");
    let is_statement = |start: &str| {
        let line = start.rsplit('\n').next().unwrap_or_default();
        without_comment(line) == line
    };
    let joined =
        (text.split_inclusive("\\\n")).flat_map(|piece| match piece.strip_suffix("\\\n") {
            Some(start) if is_statement(start) => [start, " \u{b}"],
            _ => [piece, ""],
        });
    joined.collect::<String>().into()
}

/// A line up to its comment.
fn without_comment(line: &str) -> &str {
    let mut marks = line.match_indices('#').map(|(at, _)| at);
    let comment = marks.find(|at| *at == 0 || line[..*at].ends_with(char::is_whitespace));
    &line[..comment.unwrap_or(line.len())]
}

/// The statements of an OBJ or MTL file: line, first word and the rest, without comments.
pub(super) fn statements(text: &str) -> impl Iterator<Item = (usize, &str, &str)> {
    let mut continued = 0;
    text.lines().enumerate().filter_map(move |(i, line)| {
        let number = i + 1 + continued;
        continued += line.matches('\u{b}').count();
        let (word, rest) = split(without_comment(line).trim());
        (!word.is_empty()).then_some((number, word, rest))
    })
}
