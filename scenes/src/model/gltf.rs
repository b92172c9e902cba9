//! glTF 2.0: `.glb`, and `.gltf` with its buffers in other files or in the text.
//!
//! Read are meshes of triangles, strips and fans, materials ([`super::gltf_material`]), nodes,
//! skins in the pose of their nodes, perspective cameras, and the lights of `KHR_lights_punctual`.
//! A mesh without normals has flat triangles, as the format says.
//!
//! The intensities of lights are photometric. Blender's exporter multiplies watts by 683 lumens;
//! its files are divided by that, so that a lamp is as bright as in Blender.

use super::accessor::Buffers;
use super::builder::{Builder, Corner, MeshData};
use super::gltf_material::{self, ReadMaterial};
use crate::Loaded;
use crate::collada::limits::{MAX_DEPTH, MAX_INSTANCES, MAX_PRIMITIVES};
use crate::collada::transform::Affine;
use crate::collada::truncated;
use crate::collada::uri::{percent_decoded, without_scheme};
use crate::diagnostic::{Diagnostic, SceneError};
use crate::limited_file;
use crate::placement::FAR_AWAY;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::buffer::Source;
use gltf::camera::Projection;
use gltf::json::image::MimeType;
use gltf::json::{Index, Root, validation};
use gltf::khr_lights_punctual::Kind;
use gltf::mesh::Mode;
use gltf::{Accessor, Document, Gltf, Node, Semantic};
use kit::camera::scale_fov;
use kit::scene::NamedLight;
use kit::{Camera, Light, Mat3, Spectrum, Vec3};
use std::collections::HashMap;
use std::path::Path;

/// Lumens per watt in the files of Blender.
const BLENDER_LUMENS: f64 = 683.0;

/// Vertices and indices over all instances: some seconds.
const MAX_ELEMENTS: usize = 4 * MAX_PRIMITIVES;

/// Extensions without which a file is read as it is meant, or with a warning.
const SUPPORTED: [&str; 7] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// A parsed file with its buffers.
pub(super) struct File<'f> {
    name: &'f str,
    folder: &'f Path,
    pub(super) buffers: Buffers,
}

impl File<'_> {
    /// The error for a damaged file.
    pub(super) fn damaged(&self, why: impl std::fmt::Display) -> SceneError {
        damaged(self.name, why)
    }

    /// The bytes of a `data:` URI.
    pub(super) fn data(&self, uri: &str) -> Result<Vec<u8>, SceneError> {
        let encoded = uri.split_once(";base64,").map(|(_, encoded)| encoded);
        let decoded = encoded.and_then(|encoded| STANDARD.decode(encoded.trim()).ok());
        decoded.ok_or_else(|| self.damaged("a data: URI is not base64"))
    }

    /// The path of a file that this one refers to, relative to its folder.
    pub(super) fn path(&self, uri: &str) -> String {
        without_scheme(&percent_decoded(uri).replace('\\', "/")).to_owned()
    }

    fn read_buffers(&mut self, gltf: &Gltf) -> Result<(), SceneError> {
        for buffer in gltf.buffers() {
            let bytes = match buffer.source() {
                Source::Bin => {
                    let blob = gltf.blob.clone();
                    blob.ok_or_else(|| self.damaged("its binary part is missing"))?
                }
                Source::Uri(uri) if is_data(uri) => self.data(uri)?,
                Source::Uri(uri) => {
                    let path = self.folder.join(self.path(uri));
                    limited_file::read(&path).map_err(|why| {
                        let title = format!("its buffer {} cannot be read: {why}", path.display());
                        Diagnostic::about_file(self.name, title)
                            .help("keep the .bin file beside the .gltf file, or export a .glb")
                    })?
                }
            };
            self.buffers.0.push(bytes);
        }
        Ok(())
    }
}

/// Whether a URI holds the bytes themselves. Its scheme may have capital letters.
pub(super) fn is_data(uri: &str) -> bool {
    let scheme = uri.split_once(':').map(|(scheme, _)| scheme);
    scheme.is_some_and(|scheme| scheme.eq_ignore_ascii_case("data"))
}

fn damaged(name: &str, why: impl std::fmt::Display) -> SceneError {
    Diagnostic::about_file(name, format!("the file is not a valid glTF file: {why}"))
        .help("export the scene again")
        .into()
}

/// Whether a file that cannot be read as glTF 2 is of version 1, whose lists are objects.
fn is_version_1(bytes: &[u8]) -> bool {
    if let Some(version) = bytes.strip_prefix(b"glTF") {
        return version.starts_with(&1_u32.to_le_bytes());
    }
    let text = String::from_utf8_lossy(bytes);
    let is_of = |major: &str| {
        text.split("\"version\"").skip(1).any(|rest| {
            let value = rest.trim_start().trim_start_matches(':').trim_start();
            value.starts_with(major)
        })
    };
    is_of("\"1.") && !is_of("\"2.")
}

/// Whether a finding of the library at this place of a file is none: nothing here needs the bounds
/// of positions, which some exporters leave out, accessors without a view are zeros, and the
/// extensions have been checked.
fn is_accepted(path: &str, why: &validation::Error) -> bool {
    let is_zeros = path.starts_with("accessors") && path.ends_with(".bufferView");
    path.ends_with(".min")
        || path.ends_with(".max")
        || path.starts_with("extensionsRequired")
        || (is_zeros && *why == validation::Error::Missing)
}

/// Gives images what the library takes for granted: a type, which is not used here, and a place. A
/// texture of an image that is nowhere has no image.
fn repair(json: &mut Root) {
    for image in &mut json.images {
        let png = || MimeType("image/png".to_owned());
        image.mime_type.get_or_insert_with(png);
    }
    let images = &json.images;
    for texture in &mut json.textures {
        let image = images.get(texture.source.value());
        if image.is_some_and(|image| image.uri.is_none() && image.buffer_view.is_none()) {
            texture.source = Index::new(u32::MAX);
        }
    }
}

/// Reads a `.glb` or a `.gltf` file.
pub(super) fn read(name: &str, folder: &Path, bytes: &[u8]) -> Result<Loaded, SceneError> {
    let unchecked = Gltf::from_slice_without_validation(bytes).map_err(|why| {
        if is_version_1(bytes) {
            let title = "the file is of glTF 1, which is not supported";
            let help = "export the scene again as glTF 2.0";
            return Diagnostic::about_file(name, title).help(help).into();
        }
        damaged(name, why)
    })?;
    let mut required = unchecked.extensions_required();
    if let Some(unknown) = required.find(|extension| !SUPPORTED.contains(extension)) {
        let title = format!("the file requires {unknown}, which is not supported");
        let help = "export it without this extension, such as without compression";
        return Err(Diagnostic::about_file(name, title).help(help).into());
    }
    let blob = unchecked.blob;
    let mut json = unchecked.document.into_json();
    repair(&mut json);
    let primitives = json.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let mut indices = primitives.flat_map(|primitive| primitive.attributes.values());
    if indices.any(|index| index.value() >= json.accessors.len()) {
        let why = "a mesh refers to an accessor that is not in the file";
        return Err(damaged(name, why));
    }
    let document = match Document::from_json(json.clone()) {
        Err(gltf::Error::Validation(list))
            if list
                .iter()
                .all(|(path, why)| is_accepted(path.as_str(), why)) =>
        {
            Document::from_json_without_validation(json)
        }
        checked => checked.map_err(|why| damaged(name, why))?,
    };
    let gltf = Gltf { document, blob };
    let mut file = File {
        name,
        folder,
        buffers: Buffers(Vec::new()),
    };
    file.read_buffers(&gltf)?;
    let generator = gltf.document.as_json().asset.generator.as_deref();
    let mut reader = Reader {
        builder: Builder::new(name),
        file,
        materials: HashMap::new(),
        to_world: HashMap::new(),
        elements: 0,
        lumens: match generator {
            Some(generator) if generator.contains("Blender") => BLENDER_LUMENS,
            _ => 1.0,
        },
    };
    reader.build(&gltf)?;
    Ok(reader.builder.into_loaded())
}

struct Reader<'f> {
    builder: Builder<'f>,
    file: File<'f>,
    materials: HashMap<Option<usize>, ReadMaterial>,
    /// For each node of the scene, the path to world space.
    to_world: HashMap<usize, Affine>,
    /// The vertices and indices of meshes so far, over all instances.
    elements: usize,
    /// What intensities of lights are divided by.
    lumens: f64,
}

impl Reader<'_> {
    fn build(&mut self, gltf: &Gltf) -> Result<(), SceneError> {
        let Some(scene) = gltf.default_scene().or_else(|| gltf.scenes().next()) else {
            return Err(self.file.damaged("it has no scene"));
        };
        // The old glossiness has a warning of its own.
        let is_known = |name: &&str| SUPPORTED.contains(name) || name.ends_with("Glossiness");
        let unknown: Vec<&str> = gltf.extensions_used().filter(|n| !is_known(n)).collect();
        if !unknown.is_empty() {
            let names = truncated(&unknown.join(", "));
            let result = "the scene is shown without them";
            self.builder
                .warn("extensions that are not read", &names, result);
        }
        if gltf.scenes().len() > 1 {
            let result = "the default scene is shown, or the first";
            self.builder.warn("other scenes of the file", "", result);
        }
        if gltf.animations().next().is_some() {
            let result = "the scene is shown as its nodes are placed";
            self.builder.warn("animations are ignored", "", result);
        }
        // All transforms first: a skin refers to nodes that may come later.
        let mut nodes: Vec<Node<'_>> = Vec::new();
        for root in scene.nodes() {
            self.place(root, Affine::IDENTITY, 0, &mut nodes)?;
        }
        for node in &nodes {
            let to_world = self.to_world[&node.index()];
            let name = node
                .name()
                .map_or(format!("node {}", node.index()), str::to_owned);
            if let Some(mesh) = node.mesh() {
                self.add_mesh(&name, node, &mesh, to_world)?;
            }
            if let Some(light) = node.light() {
                self.add_light(&name, &light, &to_world);
            }
            if let Some(camera) = node.camera() {
                self.add_camera(&name, &camera, &to_world);
            }
        }
        Ok(())
    }

    fn place<'a>(
        &mut self,
        node: Node<'a>,
        parent: Affine,
        depth: usize,
        nodes: &mut Vec<Node<'a>>,
    ) -> Result<(), SceneError> {
        if depth > MAX_DEPTH || nodes.len() > MAX_INSTANCES {
            let why = "its nodes are nested too deeply, or without end";
            return Err(self.file.damaged(why));
        }
        let to_world = parent.after(&affine(node.transform().matrix().as_flattened()));
        if !to_world.stays_in_world() {
            return Err(self.file.damaged("a transform is not finite, or too large"));
        }
        self.to_world.insert(node.index(), to_world);
        nodes.push(node.clone());
        for child in node.children() {
            self.place(child, to_world, depth + 1, nodes)?;
        }
        Ok(())
    }

    fn numbers<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
    ) -> Result<Vec<[f64; N]>, SceneError> {
        let numbers = self.file.buffers.numbers(accessor);
        numbers.map_err(|why| self.file.damaged(why))
    }

    fn add_mesh(
        &mut self,
        name: &str,
        node: &Node<'_>,
        mesh: &gltf::Mesh<'_>,
        to_world: Affine,
    ) -> Result<(), SceneError> {
        for primitive in mesh.primitives() {
            if primitive.morph_targets().next().is_some() {
                self.builder
                    .warn("blend shapes", name, "the mesh is shown without them");
            }
            let material = match self.materials.get(&primitive.material().index()) {
                Some(material) => *material,
                None => {
                    let given = primitive.material();
                    let material = gltf_material::add(&mut self.builder, &self.file, &given)?;
                    self.materials.insert(given.index(), material);
                    material
                }
            };
            if primitive.get(&Semantic::Colors(0)).is_some() {
                let title = "the colours of vertices are ignored";
                let result = "the material alone gives a surface its colour";
                self.builder.warn(title, name, result);
            }
            let Some(positions) = primitive.get(&Semantic::Positions) else {
                continue;
            };
            let indices = primitive.indices().map_or(0, |indices| indices.count());
            self.elements = (self.elements)
                .saturating_add(positions.count())
                .saturating_add(indices);
            if self.elements > MAX_ELEMENTS {
                let title = format!("the scene has more than {MAX_ELEMENTS} vertices and indices");
                let help = "use fewer instances, or simplify the mesh";
                return Err(self.builder.error(title, help));
            }
            let mut data = MeshData {
                positions: vectors(&self.numbers(&positions)?),
                ..MeshData::default()
            };
            if let Some(normals) = primitive.get(&Semantic::Normals) {
                data.normals = vectors(&self.numbers(&normals)?);
            }
            let placement = material.placement;
            if let Some(coordinates) = primitive.get(&Semantic::TexCoords(placement.set)) {
                let coordinates = self.numbers::<2>(&coordinates)?;
                data.tex_coords = coordinates
                    .into_iter()
                    .map(|uv| placement.apply(uv))
                    .collect();
            }
            let indices: Vec<u32> = match primitive.indices() {
                Some(indices) => {
                    let indices = self.numbers::<1>(&indices)?;
                    indices.into_iter().map(|[index]| index as u32).collect()
                }
                None => (0..data.positions.len() as u32).collect(),
            };
            let corners = |list: [u32; 3]| list.map(|i| Corner::of_all(&data, i));
            let triangles: Vec<[u32; 3]> = match primitive.mode() {
                Mode::Triangles => indices.as_chunks().0.to_vec(),
                Mode::TriangleStrip => (indices.windows(3).enumerate())
                    .map(|(i, w)| {
                        if i % 2 == 0 {
                            [w[0], w[1], w[2]]
                        } else {
                            [w[0], w[2], w[1]]
                        }
                    })
                    .collect(),
                Mode::TriangleFan => (indices.windows(2).skip(1))
                    .map(|w| [indices[0], w[0], w[1]])
                    .collect(),
                Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => {
                    self.builder
                        .warn("points and lines", name, "they are left out");
                    continue;
                }
            };
            data.triangles = triangles.into_iter().map(corners).collect();
            let mut placed = to_world;
            if let Some(skin) = node.skin() {
                self.deform(&mut data, &primitive, &skin)?;
                // The joints alone place a skin.
                placed = Affine::IDENTITY;
            }
            self.builder.add_mesh(name, &data, material.index, placed)?;
        }
        Ok(())
    }

    /// Moves the vertices of a skin as its joints are placed.
    fn deform(
        &mut self,
        data: &mut MeshData,
        primitive: &gltf::Primitive<'_>,
        skin: &gltf::Skin<'_>,
    ) -> Result<(), SceneError> {
        let (joints, weights) = (Semantic::Joints(0), Semantic::Weights(0));
        let (Some(joints), Some(weights)) = (primitive.get(&joints), primitive.get(&weights))
        else {
            return Ok(());
        };
        if primitive.get(&Semantic::Joints(1)).is_some() {
            let result = "the first four place it, as if there were no more";
            let name = skin.name().unwrap_or_default();
            self.builder
                .warn("vertices with more than four joints", name, result);
        }
        let (joints, weights) = (self.numbers::<4>(&joints)?, self.numbers::<4>(&weights)?);
        let inverses = match skin.inverse_bind_matrices() {
            Some(accessor) => self.numbers::<16>(&accessor)?,
            None => Vec::new(),
        };
        let place = |(i, joint): (usize, Node<'_>)| {
            let known = self.to_world.get(&joint.index()).copied();
            let to_world = known.unwrap_or(Affine::IDENTITY);
            let inverse = inverses.get(i).map(|m| affine(&m.map(|x| x as f32)));
            to_world.after(&inverse.unwrap_or(Affine::IDENTITY))
        };
        let matrices: Vec<Affine> = skin.joints().enumerate().map(place).collect();
        for (i, (joints, weights)) in joints.iter().zip(&weights).enumerate() {
            let total: f64 = weights.iter().sum();
            if i >= data.positions.len() || total <= 0.0 {
                continue;
            }
            let mut blended = Affine {
                m: Mat3::ZERO,
                t: Vec3::ZERO,
            };
            for (joint, weight) in joints.iter().zip(weights) {
                let Some(matrix) = matrices.get(*joint as usize) else {
                    return Err(self
                        .file
                        .damaged("a vertex refers to a joint that its skin lacks"));
                };
                blended.m += matrix.m * (weight / total);
                blended.t += matrix.t * (weight / total);
            }
            data.positions[i] = blended.point(data.positions[i]);
            if let Some(normal) = data.normals.get_mut(i) {
                *normal = blended.for_normals() * *normal;
            }
        }
        Ok(())
    }

    fn add_light(
        &mut self,
        name: &str,
        light: &gltf::khr_lights_punctual::Light<'_>,
        to_world: &Affine,
    ) {
        let color = Spectrum::from(light.color().map(|channel| f64::from(channel).max(0.0)));
        let strength = color * (f64::from(light.intensity()).max(0.0) / self.lumens);
        if light.range().is_some() {
            let result = "they light at any distance";
            self.builder.warn("lights with a range", name, result);
        }
        let position = to_world.t;
        let direction = to_world.direction(Vec3::NEG_Z).normalize_or(Vec3::NEG_Z);
        let light = match light.kind() {
            Kind::Directional => Light::Directional {
                direction,
                irradiance: strength,
            },
            Kind::Point => Light::Point {
                position,
                intensity: strength,
            },
            Kind::Spot {
                inner_cone_angle,
                outer_cone_angle,
            } => {
                if inner_cone_angle < outer_cone_angle {
                    let result = "they light their whole cone evenly";
                    self.builder
                        .warn("spot lights with a soft edge", name, result);
                }
                Light::Spot {
                    position,
                    direction,
                    intensity: strength,
                    falloff_angle: (2.0 * f64::from(outer_cone_angle).to_degrees())
                        .clamp(1e-3, 180.0),
                    falloff_exponent: 0.0,
                }
            }
        };
        self.builder.scene.lights.push(NamedLight {
            name: name.to_owned(),
            light,
        });
    }

    fn add_camera(&mut self, name: &str, camera: &gltf::Camera<'_>, to_world: &Affine) {
        let Projection::Perspective(perspective) = camera.projection() else {
            let result = "without another camera, the scene is framed";
            self.builder
                .warn("cameras that are not perspective", name, result);
            return;
        };
        if self.builder.scene.camera.is_some() {
            self.builder
                .warn("more than one camera", name, "the first one is used");
            return;
        }
        let v_fov = f64::from(perspective.yfov()).to_degrees();
        let aspect = f64::from(perspective.aspect_ratio().unwrap_or(4.0 / 3.0));
        let axes = to_world
            .direction(Vec3::Z)
            .try_normalize()
            .zip(to_world.direction(Vec3::Y).try_normalize());
        let c2w = axes.and_then(|(backward, up)| Camera::look_at(backward, Vec3::ZERO, up).ok());
        let is_valid = (0.001..=179.999).contains(&v_fov) && (0.001..=1000.0).contains(&aspect);
        let Some(c2w) = c2w.filter(|_| is_valid) else {
            let result = "without another camera, the scene is framed";
            self.builder
                .warn("cameras without a valid angle or direction", name, result);
            return;
        };
        if to_world.m.determinant() < 0.0 {
            self.builder
                .warn("cameras that their node mirrors", name, "not mirrored");
        }
        let near = f64::from(perspective.znear()).max(0.0);
        let far = perspective.zfar().map_or(FAR_AWAY, f64::from);
        self.builder.scene.camera = Some(Camera {
            pos: to_world.t,
            c2w,
            h_fov: scale_fov(v_fov, aspect),
            v_fov,
            n_clip: near,
            f_clip: if far > near { far } else { FAR_AWAY },
        });
    }
}

/// The affine part of a matrix in column-major order.
fn affine(m: &[f32]) -> Affine {
    let column = |i: usize| Vec3::from([m[4 * i], m[4 * i + 1], m[4 * i + 2]].map(f64::from));
    Affine {
        m: Mat3::from_cols(column(0), column(1), column(2)),
        t: column(3),
    }
}

fn vectors(numbers: &[[f64; 3]]) -> Vec<Vec3> {
    numbers.iter().copied().map(Vec3::from_array).collect()
}
