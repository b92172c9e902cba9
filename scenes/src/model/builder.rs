//! Builds a scene from the meshes of a model.

use crate::Loaded;
use crate::collada::bake::TriangleTransform;
use crate::collada::limits::MAX_PRIMITIVES;
use crate::collada::normals::{SmoothNormals, face_normal, looks_round};
use crate::collada::polygon::{TestCounter, TooComplex, triangulate};
use crate::collada::transform::Affine;
use crate::diagnostic::{Diagnostic, SceneError, Warning};
use kit::scene::{NamedMaterial, Object};
use kit::texture::TextureMap;
use kit::{Material, Scene, Spectrum, Triangle, Vec2, Vec3};

/// Reflectance of surfaces without a material.
const GREY: Material = Material::Diffuse {
    reflectance: Spectrum::grey(0.5),
};

/// The lists that the corners of a mesh refer to, in local space.
#[derive(Default)]
pub(super) struct MeshData {
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    /// With v upwards.
    pub(super) tex_coords: Vec<Vec2>,
    pub(super) triangles: Vec<[Corner; 3]>,
    /// Whether a mesh without normals is smooth; else its triangles are flat.
    pub(super) is_smooth: bool,
}

/// Indices into the lists of a [`MeshData`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) normal: Option<u32>,
    pub(super) tex_coords: Option<u32>,
}

impl Corner {
    /// A corner with one index for all lists of `mesh` that are not empty.
    pub(super) fn of_all(mesh: &MeshData, index: u32) -> Corner {
        Corner {
            position: index,
            normal: (!mesh.normals.is_empty()).then_some(index),
            tex_coords: (!mesh.tex_coords.is_empty()).then_some(index),
        }
    }
}

/// A scene that grows, and what is to be said about its file.
pub(super) struct Builder<'f> {
    pub(super) file: &'f str,
    pub(super) scene: Scene,
    /// Titles, advice, and the parts of the file that each is about.
    warnings: Vec<(String, String, Vec<String>)>,
    smoothed: Vec<String>,
    smooth: SmoothNormals,
    tex_coords: Vec<[Vec2; 3]>,
    pub(super) textures: TextureMap,
    default_material: Option<u32>,
}

impl<'f> Builder<'f> {
    pub(super) fn new(file: &'f str) -> Builder<'f> {
        Builder {
            file,
            scene: Scene::default(),
            warnings: Vec::new(),
            smoothed: Vec::new(),
            smooth: SmoothNormals::default(),
            tex_coords: Vec::new(),
            textures: TextureMap::default(),
            default_material: None,
        }
    }

    /// An error about the file.
    pub(super) fn error(&self, title: impl Into<String>, help: &str) -> SceneError {
        Diagnostic::about_file(self.file, title).help(help).into()
    }

    /// Adds a warning about the part `of` of the file. Those with the same title are one.
    pub(super) fn warn(&mut self, title: &str, of: &str, result: &str) {
        let known = self.warnings.iter_mut().find(|(other, ..)| other == title);
        let parts = match known {
            Some((.., parts)) => parts,
            None => {
                let (title, result) = (title.to_owned(), result.to_owned());
                self.warnings.push((title, result, Vec::new()));
                &mut self.warnings.last_mut().expect("one was pushed").2
            }
        };
        // Of one part, warnings come one after the other.
        if parts.last().is_none_or(|part| part != of) {
            parts.push(of.to_owned());
        }
    }

    /// Adds a material. `texture` is the name of its image.
    pub(super) fn add_material(
        &mut self,
        name: &str,
        material: Material,
        texture: Option<String>,
    ) -> u32 {
        let index = self.scene.materials.len() as u32;
        self.scene.materials.push(NamedMaterial {
            name: name.to_owned(),
            material,
        });
        self.textures.add_material(texture);
        index
    }

    /// The grey of surfaces without a material.
    pub(super) fn default_material(&mut self) -> u32 {
        match self.default_material {
            Some(index) => index,
            None => {
                let index = self.add_material("grey", GREY, None);
                self.default_material = Some(index);
                index
            }
        }
    }

    /// Adds the triangles of a polygon to `triangles`. One with fewer than three corners has none.
    pub(super) fn triangulate(
        &self,
        mesh: &MeshData,
        polygon: &[Corner],
        counter: &mut TestCounter,
        triangles: &mut Vec<[Corner; 3]>,
    ) -> Result<(), SceneError> {
        if let [a, b, c] = *polygon {
            triangles.push([a, b, c]);
            return Ok(());
        }
        let position = |corner: &Corner| mesh.positions.get(corner.position as usize).copied();
        // An index out of range is found when the mesh is added.
        let points: Vec<Vec3> = polygon
            .iter()
            .map(|corner| position(corner).unwrap_or(Vec3::ZERO))
            .collect();
        if points.len() < 3 {
            return Ok(());
        }
        let triangulation = triangulate(&points, counter).map_err(|TooComplex| {
            let title = "the polygons are too complex to triangulate";
            self.error(title, "triangulate the mesh before the export")
        })?;
        let of_polygon = |corners: [usize; 3]| corners.map(|i| polygon[i]);
        triangles.extend(triangulation.triangles.into_iter().map(of_polygon));
        Ok(())
    }

    /// Adds a mesh to the scene. Triangles without area, or with a position that is not finite, are
    /// left out, with a warning.
    pub(super) fn add_mesh(
        &mut self,
        name: &str,
        mesh: &MeshData,
        material: u32,
        to_world: Affine,
    ) -> Result<(), SceneError> {
        let count = self.scene.triangles.len() + mesh.triangles.len();
        if count > MAX_PRIMITIVES {
            let title = format!("the scene has more than {MAX_PRIMITIVES} triangles");
            return Err(self.error(title, "use fewer instances, or simplify the mesh"));
        }
        let position = |corner: Corner| {
            let position = mesh.positions.get(corner.position as usize);
            position.ok_or_else(|| {
                let title = format!(
                    "`{name}` refers to vertex {}, but has {}",
                    corner.position,
                    mesh.positions.len()
                );
                self.error(title, "the file is damaged: export it again")
            })
        };
        for corners in &mesh.triangles {
            for corner in corners {
                position(*corner)?;
            }
        }
        let smoothed = || {
            (mesh.triangles.iter())
                .filter(|[a, ..]| mesh.is_smooth && a.normal.is_none())
                .map(|corners| corners.map(|corner| corner.position as usize))
        };
        for corners in smoothed() {
            self.smooth.add(&mesh.positions, corners);
        }
        let object = self.scene.objects.len() as u32;
        self.scene.objects.push(Object {
            name: name.to_owned(),
            material,
        });
        let transform = TriangleTransform::new(to_world);
        let has_texture = self.textures.of_material(material).is_some();
        let (mut flat, mut is_smoothed) = (0_usize, false);
        self.scene.triangles.reserve(mesh.triangles.len());
        for corners in &mesh.triangles {
            let positions = corners.map(|corner| corner.position as usize);
            let [p0, p1, p2] = positions.map(|i| mesh.positions[i]);
            let Some(face) = face_normal(p0, p1, p2) else {
                flat += 1;
                continue;
            };
            let given = corners.map(|c| c.normal.and_then(|i| mesh.normals.get(i as usize)));
            let normals = match given {
                [Some(a), Some(b), Some(c)] => [*a, *b, *c],
                _ if mesh.is_smooth && corners[0].normal.is_none() => {
                    self.smooth.at(&mesh.positions, positions, face)
                }
                _ => [face; 3],
            };
            let normals = normals.map(|n| n.try_normalize().unwrap_or(face));
            let local = Triangle::smooth([p0, p1, p2], normals);
            is_smoothed |= given[0].is_none() && mesh.is_smooth && looks_round(face, normals);
            let Some(placed) = transform.triangle(&local) else {
                let title = format!("`{name}` is too far from the origin");
                return Err(self.error(title, "look for a scale with a wrong exponent"));
            };
            if has_texture {
                let of = |corner: Corner| {
                    (corner.tex_coords)
                        .and_then(|i| mesh.tex_coords.get(i as usize).copied())
                        .filter(|uv| uv.is_finite())
                        .unwrap_or(Vec2::ZERO)
                };
                // Triangles of meshes before this one may have none.
                self.tex_coords
                    .resize(self.scene.triangles.len(), [Vec2::ZERO; 3]);
                let coordinates = transform.tex_coords(corners.map(of));
                self.tex_coords.push(coordinates);
            }
            self.scene.triangles.push(placed);
        }
        let count = self.scene.triangles.len();
        self.scene.object_of.resize(count, object);
        for corners in smoothed() {
            self.smooth.forget(corners);
        }
        if has_texture && mesh.tex_coords.is_empty() {
            self.warn(
                "meshes with a texture, but without texture coordinates",
                name,
                "using 0 0",
            );
        }
        if flat > 0 {
            let title = "triangles without area, or with a coordinate that is not finite";
            self.warn(title, name, "they are left out");
        }
        if is_smoothed {
            self.smoothed.push(name.to_owned());
        }
        Ok(())
    }

    /// The finished scene.
    pub(super) fn into_loaded(mut self) -> Loaded {
        if !self.textures.files.is_empty() {
            self.textures.coordinates = self.tex_coords;
            self.scene.textures = self.textures;
        }
        let file = self.file;
        let warning = |(title, help, parts): (String, String, Vec<String>)| {
            let others = match parts.len() {
                0 | 1 => String::new(),
                count => format!(" and {} more", count - 1),
            };
            let place = parts.first().filter(|part| !part.is_empty());
            let diagnostic = Diagnostic::about_file(file, title).help(help);
            Warning(match place {
                Some(part) => diagnostic.note(format!("in `{part}`{others}")),
                None => diagnostic,
            })
        };
        Loaded {
            scene: self.scene,
            warnings: self.warnings.into_iter().map(warning).collect(),
            smoothed: self.smoothed,
            added_light: false,
        }
    }
}
