//! `<node>`: the tree of the scene, walked from the root, every instance placed in the world.

use super::bake::{self, Placer, SphereError};
use super::document::{Document, Element, children, describe, tag};
use super::geometry::Shape;
use super::library::{Content, Library, ShapeHere};
use super::light::LocalLight;
use super::limits::{MAX_COORDINATE, MAX_DEPTH, MAX_INSTANCES, MAX_PRIMITIVES};
use super::optics::Optics;
use super::transform::Affine;
use crate::diagnostic::SceneError;
use kit::scene::{NamedLight, Object};
use kit::{Scene, Vec2};
use roxmltree::NodeId;
use std::rc::Rc;

/// Builds the scene.
pub(super) struct Builder<'r, 'a> {
    doc: &'r Document<'a>,
    library: Library<'r, 'a>,
    scene: Scene,
    /// Nodes from the root to the one being placed, to find cycles.
    path: Vec<NodeId>,
    instances: usize,
    /// Triangles and spheres of all shapes to be placed.
    primitives: usize,
    /// Shapes and where they go. They are placed when all are known and counted: a file that asks for too
    /// many is refused before it takes up memory.
    shapes: Vec<(Rc<ShapeHere<'a>>, Affine)>,
    sphere_objects: Vec<u32>,
    /// For each triangle, the texture coordinates of its vertices; shorter if the last ones have none.
    on_texture: Vec<[Vec2; 3]>,
}

impl<'r, 'a> Builder<'r, 'a> {
    pub(super) fn new(doc: &'r Document<'a>) -> Builder<'r, 'a> {
        Builder {
            doc,
            library: Library::new(doc),
            scene: Scene::default(),
            path: Vec::new(),
            instances: 0,
            primitives: 0,
            shapes: Vec::new(),
            sphere_objects: Vec::new(),
            on_texture: Vec::new(),
        }
    }

    /// Places all nodes of a visual scene.
    pub(super) fn build(
        mut self,
        visual_scene: Element<'a>,
        to_world: &Affine,
    ) -> Result<Scene, SceneError> {
        for node in children(visual_scene).filter(|element| tag(*element) == "node") {
            self.place_node(node, node, to_world)?;
        }
        for (shape, to_world) in std::mem::take(&mut self.shapes) {
            self.place_shape(&shape, &to_world)?;
        }
        // Triangles are numbered first, then spheres.
        self.scene.object_of.append(&mut self.sphere_objects);
        let (materials, mut textures) = self.library.into_materials();
        self.scene.materials = materials;
        if !textures.files.is_empty() {
            textures.coordinates = self.on_texture;
            self.scene.textures = textures;
        }
        Ok(self.scene)
    }

    fn place_node(
        &mut self,
        element: Element<'a>,
        said_by: Element<'a>,
        to_world: &Affine,
    ) -> Result<(), SceneError> {
        if self.path.contains(&element.id()) {
            let title = format!("{} contains itself", describe(element));
            return Err(self
                .doc
                .on(said_by, title, "this closes the circle")
                .help("remove this instance: a node cannot stand inside itself")
                .into());
        }
        if self.path.len() >= MAX_DEPTH {
            let title = format!("nodes are nested more than {MAX_DEPTH} deep");
            return Err(self
                .doc
                .on(said_by, title, "this one is too deep")
                .help("flatten the hierarchy: apply the transforms of parents to their children")
                .into());
        }
        self.count(1, said_by)?;
        let node = self.library.node(element)?;
        let to_world = to_world.after(&node.transform);
        if !to_world.stays_in_world() {
            return Err(self.too_large(element));
        }
        self.path.push(element.id());
        for content in &node.contents {
            match content {
                Content::Node { node, said_by } => self.place_node(*node, *said_by, &to_world)?,
                Content::Shape(shape) => {
                    self.count(1 + shape.materials.len(), shape.said_by)?;
                    self.count_primitives(&shape.shape, shape.said_by)?;
                    self.shapes.push((Rc::clone(shape), to_world));
                }
                Content::Light { light, said_by } => {
                    self.place_light(&node.name, light, *said_by, &to_world)?
                }
                Content::Camera { optics, said_by } => {
                    self.place_camera(optics, *said_by, &to_world)?
                }
            }
        }
        self.path.pop();
        Ok(())
    }

    fn count_primitives(
        &mut self,
        shape: &Shape<'a>,
        said_by: Element<'a>,
    ) -> Result<(), SceneError> {
        self.primitives += match shape {
            Shape::Mesh(parts) => parts.iter().map(|part| part.triangles.len()).sum(),
            Shape::Sphere { .. } => 1,
            Shape::Nothing => 0,
        };
        if self.primitives <= MAX_PRIMITIVES {
            return Ok(());
        }
        let title = format!("the scene has more than {MAX_PRIMITIVES} triangles and spheres");
        Err(self
            .doc
            .on(said_by, title, "this instance is one too many")
            .help("place fewer instances, or simplify the mesh")
            .into())
    }

    fn place_shape(&mut self, here: &ShapeHere<'a>, to_world: &Affine) -> Result<(), SceneError> {
        match &*here.shape {
            Shape::Mesh(parts) => {
                let placer = Placer::new(*to_world);
                for (part, material) in parts.iter().zip(&here.materials) {
                    let object = self.add_object(&here.name, *material);
                    if !part.on_texture.is_empty() {
                        // Parts before this one may have none.
                        let first = self.scene.triangles.len();
                        self.on_texture.resize(first, [Vec2::ZERO; 3]);
                        let corners = part.on_texture.iter();
                        self.on_texture
                            .extend(corners.map(|corners| placer.on_texture(*corners)));
                    }
                    for local in &part.triangles {
                        let placed = placer
                            .triangle(local)
                            .ok_or_else(|| self.too_large(here.said_by))?;
                        self.scene.triangles.push(placed);
                    }
                    self.scene
                        .object_of
                        .resize(self.scene.triangles.len(), object);
                }
            }
            Shape::Sphere { radius } => {
                let sphere = bake::sphere(*radius, to_world)
                    .map_err(|why| self.sphere_error(why, here.said_by))?;
                let object = self.add_object(&here.name, here.materials[0]);
                self.scene.spheres.push(sphere);
                self.sphere_objects.push(object);
            }
            Shape::Nothing => {}
        }
        Ok(())
    }

    fn add_object(&mut self, name: &str, material: u32) -> u32 {
        let index = self.scene.objects.len() as u32;
        self.scene.objects.push(Object {
            name: name.to_owned(),
            material,
        });
        index
    }

    fn place_light(
        &mut self,
        name: &str,
        light: &LocalLight,
        said_by: Element<'a>,
        to_world: &Affine,
    ) -> Result<(), SceneError> {
        self.count(1, said_by)?;
        match light.place(to_world) {
            Some(light) => self.scene.lights.push(NamedLight {
                name: name.to_owned(),
                light,
            }),
            None => self.doc.warn(|| {
                let title = "the transform leaves this light no direction or no area";
                self.doc.on(
                    said_by,
                    title,
                    "expected a transform that does not flatten it; it is left out",
                )
            }),
        }
        Ok(())
    }

    /// The first camera counts.
    fn place_camera(
        &mut self,
        optics: &Optics,
        said_by: Element<'a>,
        to_world: &Affine,
    ) -> Result<(), SceneError> {
        self.count(1, said_by)?;
        if self.scene.camera.is_some() {
            self.doc.warn(|| {
                let title = "the scene has more than one camera";
                self.doc.on(
                    said_by,
                    title,
                    "the first one is used, this one is passed over",
                )
            });
            return Ok(());
        }
        self.scene.camera = optics.place(to_world);
        if self.scene.camera.is_none() {
            self.doc.warn(|| {
                let title = "the transform leaves this camera no direction";
                self.doc.on(
                    said_by,
                    title,
                    "expected a transform that does not flatten it; the scene is framed",
                )
            });
        }
        Ok(())
    }

    /// Counts placed things, and stops a file that asks for far too many.
    fn count(&mut self, more: usize, said_by: Element<'a>) -> Result<(), SceneError> {
        self.instances += more;
        if self.instances <= MAX_INSTANCES {
            return Ok(());
        }
        let title = format!("the scene places more than {MAX_INSTANCES} nodes, shapes and lights");
        Err(self
            .doc
            .on(said_by, title, "this instance is one too many")
            .help("nodes that hold nodes that hold nodes multiply: place fewer instances")
            .into())
    }

    fn too_large(&self, element: Element<'a>) -> SceneError {
        let title = format!("{} is placed too far out", describe(element));
        self.doc
            .on(
                element,
                title,
                format!("expected coordinates up to {MAX_COORDINATE:e} after all transforms"),
            )
            .help("look for a scale or a coordinate with a wrong exponent")
            .into()
    }

    fn sphere_error(&self, why: SphereError, said_by: Element<'a>) -> SceneError {
        match why {
            SphereError::TooLarge => self.too_large(said_by),
            SphereError::Ellipsoid([x, y, z]) => self
                .doc
                .on(
                    said_by,
                    format!(
                        "the transform makes the sphere an ellipsoid: {x:.3} by {y:.3} by {z:.3}"
                    ),
                    "expected the same scale along every axis",
                )
                .help("scale it evenly, or use a mesh instead of a sphere")
                .into(),
        }
    }
}
