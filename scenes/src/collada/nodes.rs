//! `<node>`: traverses the node tree and transforms every instance to world space.

use super::bake::{self, SphereError, TriangleTransform};
use super::document::{Document, Element, children, describe, tag};
use super::geometry::Shape;
use super::library::{Content, Library, ShapeInstance};
use super::light::LocalLight;
use super::limits::{MAX_COORDINATE, MAX_DEPTH, MAX_INSTANCES, MAX_PRIMITIVES};
use super::optics::Optics;
use super::transform::Affine;
use crate::diagnostic::SceneError;
use kit::scene::{NamedLight, Object};
use kit::{Scene, Vec2};
use roxmltree::NodeId;
use std::rc::Rc;

/// Builds the scene from the node tree.
pub(super) struct Builder<'r, 'a> {
    doc: &'r Document<'a>,
    library: Library<'r, 'a>,
    scene: Scene,
    /// From the coordinates of the visual scene to world space.
    scene_to_world: Affine,
    /// Path of nodes from the root to the current one, to detect cycles.
    path: Vec<NodeId>,
    instances: usize,
    /// Triangles and spheres of all shapes to be added.
    primitives: usize,
    /// Shapes and their transforms. They are added after all of them were counted, so that a file
    /// with too many is refused before they use memory.
    shapes: Vec<(Rc<ShapeInstance<'a>>, Affine)>,
    sphere_objects: Vec<u32>,
    /// For each triangle, the texture coordinates of its vertices. Shorter if the last triangles
    /// have none.
    tex_coords: Vec<[Vec2; 3]>,
}

impl<'r, 'a> Builder<'r, 'a> {
    pub(super) fn new(doc: &'r Document<'a>) -> Builder<'r, 'a> {
        Builder {
            doc,
            library: Library::new(doc),
            scene: Scene::default(),
            scene_to_world: Affine::IDENTITY,
            path: Vec::new(),
            instances: 0,
            primitives: 0,
            shapes: Vec::new(),
            sphere_objects: Vec::new(),
            tex_coords: Vec::new(),
        }
    }

    /// Adds all nodes of a visual scene.
    pub(super) fn build(
        mut self,
        visual_scene: Element<'a>,
        to_world: &Affine,
    ) -> Result<Scene, SceneError> {
        self.scene_to_world = *to_world;
        for part in children(visual_scene) {
            let node = match tag(part) {
                "node" => part,
                "instance_node" => self.doc.target(part, "url", "node")?,
                _ => continue,
            };
            self.add_node(node, part, to_world)?;
        }
        for (shape, to_world) in std::mem::take(&mut self.shapes) {
            self.add_shape(&shape, &to_world)?;
        }
        // Triangles come first in the order of ids, then spheres.
        self.scene.object_of.append(&mut self.sphere_objects);
        let (materials, mut textures) = self.library.into_materials();
        self.scene.materials = materials;
        if !textures.files.is_empty() {
            textures.coordinates = self.tex_coords;
            self.scene.textures = textures;
        }
        Ok(self.scene)
    }

    fn add_node(
        &mut self,
        element: Element<'a>,
        instance: Element<'a>,
        to_world: &Affine,
    ) -> Result<(), SceneError> {
        if self.path.contains(&element.id()) {
            let title = format!("{} contains itself", describe(element));
            return Err(self
                .doc
                .on(instance, title, "this instance closes the cycle")
                .help("a node cannot contain itself: remove this instance")
                .into());
        }
        if self.path.len() >= MAX_DEPTH {
            let title = format!("nodes are nested more than {MAX_DEPTH} levels deep");
            return Err(self
                .doc
                .on(instance, title, "this node is too deep")
                .help("flatten the hierarchy: apply the transforms of parents to their children")
                .into());
        }
        self.count(1, instance)?;
        let node = self.library.node(element)?;
        let to_world = to_world.after(&node.transform);
        if !to_world.stays_in_world() {
            return Err(self.too_large(element));
        }
        self.path.push(element.id());
        for content in &node.contents {
            match content {
                Content::Node { node, instance } => self.add_node(*node, *instance, &to_world)?,
                Content::Shape(shape) => {
                    self.count(1 + shape.materials.len(), shape.instance)?;
                    self.count_primitives(&shape.shape, shape.instance)?;
                    let to_world = match &shape.bind_shape {
                        Some(bind_shape) => self.scene_to_world.after(bind_shape),
                        None => to_world,
                    };
                    self.shapes.push((Rc::clone(shape), to_world));
                }
                Content::Light { light, instance } => {
                    self.add_light(&node.name, light, *instance, &to_world)?
                }
                Content::Camera { optics, instance } => {
                    self.add_camera(optics, *instance, &to_world)?
                }
            }
        }
        self.path.pop();
        Ok(())
    }

    fn count_primitives(
        &mut self,
        shape: &Shape<'a>,
        instance: Element<'a>,
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
            .on(instance, title, "this instance exceeds the limit")
            .help("use fewer instances, or simplify the mesh")
            .into())
    }

    fn add_shape(
        &mut self,
        shape: &ShapeInstance<'a>,
        to_world: &Affine,
    ) -> Result<(), SceneError> {
        match &*shape.shape {
            Shape::Mesh(parts) => {
                let transform = TriangleTransform::new(*to_world);
                let first = self.scene.triangles.len();
                for (part, bound) in parts.iter().zip(&shape.materials) {
                    let object = self.add_object(&shape.name, bound.material);
                    if let Some(set) = part.tex_coords.get(bound.tex_coords) {
                        // Triangles of parts before this one may have none.
                        let first = self.scene.triangles.len();
                        self.tex_coords.resize(first, [Vec2::ZERO; 3]);
                        let corners = set.coordinates.iter();
                        self.tex_coords
                            .extend(corners.map(|corners| transform.tex_coords(*corners)));
                    }
                    self.scene.triangles.reserve(part.triangles.len());
                    for local in &part.triangles {
                        let placed = transform
                            .triangle(local)
                            .ok_or_else(|| self.too_large(shape.instance))?;
                        self.scene.triangles.push(placed);
                    }
                    self.scene
                        .object_of
                        .resize(self.scene.triangles.len(), object);
                }
                let placed = &self.scene.triangles[first..];
                if !placed.is_empty() && placed.iter().all(bake::is_flat) {
                    let title = "this shape has no area after its transform";
                    self.doc
                        .on(shape.instance, title, "no ray hits it")
                        .help("look for a scale of 0")
                        .warn();
                }
            }
            Shape::Sphere { radius } => {
                let sphere = bake::sphere(*radius, to_world)
                    .map_err(|error| self.sphere_error(error, shape.instance))?;
                let object = self.add_object(&shape.name, shape.materials[0].material);
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

    fn add_light(
        &mut self,
        name: &str,
        light: &LocalLight,
        instance: Element<'a>,
        to_world: &Affine,
    ) -> Result<(), SceneError> {
        self.count(1, instance)?;
        match light.place(to_world) {
            Some(light) => self.scene.lights.push(NamedLight {
                name: name.to_owned(),
                light,
            }),
            None => {
                let title = "this light has no direction or no area after its transform";
                let expected = "expected an invertible transform; the light is ignored";
                self.doc.on(instance, title, expected).warn();
            }
        }
        Ok(())
    }

    /// Adds a camera. Only the first one of the file is used.
    fn add_camera(
        &mut self,
        optics: &Optics,
        instance: Element<'a>,
        to_world: &Affine,
    ) -> Result<(), SceneError> {
        self.count(1, instance)?;
        if self.scene.camera.is_some() {
            let title = "the scene has more than one camera";
            let result = "the first one is used, this one is ignored";
            self.doc.on(instance, title, result).warn();
            return Ok(());
        }
        self.scene.camera = optics.place(to_world);
        if self.scene.camera.is_none() {
            let title = "this camera has no direction after its transform";
            let expected =
                "expected an invertible transform; without another camera, the scene is framed";
            self.doc.on(instance, title, expected).warn();
        } else if to_world.mirrors() {
            let title = "this camera is mirrored by its transform";
            self.doc
                .on(instance, title, "the picture is not mirrored")
                .warn();
        }
        Ok(())
    }

    /// Counts instances. An error if there are far too many.
    fn count(&mut self, more: usize, instance: Element<'a>) -> Result<(), SceneError> {
        self.instances += more;
        if self.instances <= MAX_INSTANCES {
            return Ok(());
        }
        let title = format!(
            "the scene has more than {MAX_INSTANCES} instances of nodes, shapes and lights"
        );
        Err(self
            .doc
            .on(instance, title, "this instance exceeds the limit")
            .help("instances of nodes that contain instances multiply: use fewer of them")
            .into())
    }

    fn too_large(&self, element: Element<'a>) -> SceneError {
        let title = format!("{} is too far from the origin", describe(element));
        self.doc
            .on(
                element,
                title,
                format!("expected coordinates up to {MAX_COORDINATE:e} after all transforms"),
            )
            .help("look for a scale or a coordinate with a wrong exponent")
            .into()
    }

    fn sphere_error(&self, error: SphereError, instance: Element<'a>) -> SceneError {
        match error {
            SphereError::TooLarge => self.too_large(instance),
            SphereError::Ellipsoid([x, y, z]) => self
                .doc
                .on(
                    instance,
                    format!(
                        "the transform makes the sphere an ellipsoid: {x:.3} by {y:.3} by {z:.3}"
                    ),
                    "expected the same scale along every axis",
                )
                .help("use the same scale on every axis, or a mesh instead of a sphere")
                .into(),
        }
    }
}
