//! `<node>`: the tree of the scene, walked from the root, every instance placed in the world.

use super::bake::{self, Placer, SphereError};
use super::document::{Document, Element, child, children, describe, name_of, tag};
use super::geometry::{self, Shape};
use super::light::{self, LocalLight};
use super::limits::{MAX_DEPTH, MAX_INSTANCES, MAX_PRIMITIVES};
use super::material;
use super::optics::{self, Optics};
use super::polygon::Effort;
use super::transform::{self, Affine};
use crate::diagnostic::SceneError;
use kit::Scene;
use kit::scene::{NamedLight, NamedMaterial, Object};
use roxmltree::NodeId;
use std::collections::HashMap;
use std::rc::Rc;

/// A node as it stands in the file, read once however often it is placed.
struct Node<'a> {
    name: String,
    transform: Affine,
    contents: Vec<Content<'a>>,
}

/// What a node holds.
enum Content<'a> {
    /// A child, or an instance of a node: which, and where that is said.
    Node {
        node: Element<'a>,
        said_by: Element<'a>,
    },
    /// A shape and, for each of its parts, the material's index in the scene.
    Shape {
        shape: Rc<Shape<'a>>,
        materials: Vec<u32>,
        said_by: Element<'a>,
    },
    Light {
        light: LocalLight,
        said_by: Element<'a>,
    },
    Camera {
        optics: Optics,
        said_by: Element<'a>,
    },
}

/// Builds the scene.
pub(super) struct Builder<'r, 'a> {
    doc: &'r Document<'a>,
    scene: Scene,
    nodes: HashMap<NodeId, Rc<Node<'a>>>,
    shapes: HashMap<NodeId, Rc<Shape<'a>>>,
    /// Index in the scene's materials, by the id of the `<material>`; the default grey is under `None`.
    materials: HashMap<Option<NodeId>, u32>,
    lights: HashMap<NodeId, Option<LocalLight>>,
    /// Nodes from the root to the one being placed, to find cycles.
    path: Vec<NodeId>,
    instances: usize,
    effort: Effort,
    sphere_objects: Vec<u32>,
}

impl<'r, 'a> Builder<'r, 'a> {
    pub(super) fn new(doc: &'r Document<'a>) -> Builder<'r, 'a> {
        Builder {
            doc,
            scene: Scene::default(),
            nodes: HashMap::new(),
            shapes: HashMap::new(),
            materials: HashMap::new(),
            lights: HashMap::new(),
            path: Vec::new(),
            instances: 0,
            effort: Effort::default(),
            sphere_objects: Vec::new(),
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
        // Triangles are numbered first, then spheres.
        self.scene.object_of.append(&mut self.sphere_objects);
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
        let node = self.node(element)?;
        let to_world = to_world.after(&node.transform);
        if !to_world.is_finite() {
            return Err(self.too_large(element));
        }
        self.path.push(element.id());
        for content in &node.contents {
            match content {
                Content::Node { node, said_by } => self.place_node(*node, *said_by, &to_world)?,
                Content::Shape {
                    shape,
                    materials,
                    said_by,
                } => {
                    self.place_shape(&node.name, shape, materials, *said_by, &to_world)?;
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

    fn node(&mut self, element: Element<'a>) -> Result<Rc<Node<'a>>, SceneError> {
        if let Some(node) = self.nodes.get(&element.id()) {
            return Ok(Rc::clone(node));
        }
        let doc = self.doc;
        let mut transform = Affine::IDENTITY;
        let mut contents = Vec::new();
        for part in children(element) {
            if let Some(next) = transform::read(doc, part)? {
                transform = transform.after(&next);
                continue;
            }
            match tag(part) {
                "node" => contents.push(Content::Node {
                    node: part,
                    said_by: part,
                }),
                "instance_node" => {
                    let node = doc.target(part, "url", "node")?;
                    contents.push(Content::Node {
                        node,
                        said_by: part,
                    });
                }
                "instance_geometry" => {
                    let geometry = doc.target(part, "url", "geometry")?;
                    let shape = self.shape(geometry)?;
                    let materials = self.bind_materials(part, &shape)?;
                    contents.push(Content::Shape {
                        shape,
                        materials,
                        said_by: part,
                    });
                }
                "instance_light" => {
                    let light = doc.target(part, "url", "light")?;
                    if let Some(light) = self.light(light)? {
                        contents.push(Content::Light {
                            light,
                            said_by: part,
                        });
                    }
                }
                "instance_camera" => {
                    let camera = doc.target(part, "url", "camera")?;
                    if let Some(optics) = optics::read(doc, camera)? {
                        contents.push(Content::Camera {
                            optics,
                            said_by: part,
                        });
                    }
                }
                "asset" | "extra" => {}
                other => doc.warn(|| {
                    let expected = "only nodes, geometries, lights and cameras are placed";
                    doc.on(part, format!("<{other}> is passed over"), expected)
                }),
            }
        }
        let node = Rc::new(Node {
            name: name_of(element),
            transform,
            contents,
        });
        self.nodes.insert(element.id(), Rc::clone(&node));
        Ok(node)
    }

    fn shape(&mut self, geometry: Element<'a>) -> Result<Rc<Shape<'a>>, SceneError> {
        if let Some(shape) = self.shapes.get(&geometry.id()) {
            return Ok(Rc::clone(shape));
        }
        let shape = Rc::new(geometry::read(self.doc, geometry, &mut self.effort)?);
        self.shapes.insert(geometry.id(), Rc::clone(&shape));
        Ok(shape)
    }

    fn light(&mut self, light: Element<'a>) -> Result<Option<LocalLight>, SceneError> {
        if let Some(light) = self.lights.get(&light.id()) {
            return Ok(*light);
        }
        let read = light::read(self.doc, light)?;
        self.lights.insert(light.id(), read);
        Ok(read)
    }

    /// The materials of a shape's parts: by the symbol that `<instance_material>` binds; a part without a
    /// symbol, and a sphere, takes the only or first one.
    fn bind_materials(
        &mut self,
        instance: Element<'a>,
        shape: &Shape<'a>,
    ) -> Result<Vec<u32>, SceneError> {
        let bind =
            child(instance, "bind_material").and_then(|bind| child(bind, "technique_common"));
        let bound: Vec<Element<'a>> = bind
            .into_iter()
            .flat_map(children)
            .filter(|element| tag(*element) == "instance_material")
            .collect();
        let mut by_symbol: HashMap<&str, Element<'a>> = HashMap::new();
        for element in &bound {
            if let Some(symbol) = element.attribute("symbol") {
                by_symbol.entry(symbol).or_insert(*element);
            }
        }
        let symbols: Vec<Option<&str>> = match shape {
            Shape::Mesh(parts) => parts.iter().map(|part| part.symbol).collect(),
            Shape::Sphere { .. } => vec![None],
            Shape::Nothing => Vec::new(),
        };
        let mut materials = Vec::with_capacity(symbols.len());
        for symbol in symbols {
            let binding = symbol
                .and_then(|symbol| by_symbol.get(symbol))
                .or(bound.first());
            if let (Some(symbol), Some(binding)) = (symbol, binding)
                && !by_symbol.contains_key(symbol)
            {
                self.doc.warn(|| {
                    let title = format!(
                        "no material is bound to `{}`",
                        super::document::short(symbol)
                    );
                    let expected =
                        "expected an <instance_material> with this symbol; this one is taken";
                    self.doc.on(*binding, title, expected)
                });
            }
            materials.push(match binding {
                Some(binding) => self.bound_material(*binding)?,
                None => {
                    self.doc.warn(|| {
                        let title = format!("{} has no material", describe(instance));
                        let expected = "expected <bind_material>; taken as grey, 0.5 0.5 0.5";
                        self.doc.on(instance, title, expected)
                    });
                    self.default_material()
                }
            });
        }
        Ok(materials)
    }

    fn bound_material(&mut self, binding: Element<'a>) -> Result<u32, SceneError> {
        let doc = self.doc;
        let reference = doc.attribute(binding, "target")?;
        let Some(element) = doc.find(reference, "material") else {
            doc.warn(|| {
                let label = "the surface is taken as grey, 0.5 0.5 0.5";
                doc.dangling(binding, "target", "material").relabel(label)
            });
            return Ok(self.default_material());
        };
        if let Some(index) = self.materials.get(&Some(element.id())) {
            return Ok(*index);
        }
        let material = material::read(doc, element)?;
        Ok(self.add_material(
            Some(element.id()),
            NamedMaterial {
                name: name_of(element),
                material,
            },
        ))
    }

    fn default_material(&mut self) -> u32 {
        match self.materials.get(&None) {
            Some(index) => *index,
            None => self.add_material(
                None,
                NamedMaterial {
                    name: "grey".to_owned(),
                    material: material::DEFAULT,
                },
            ),
        }
    }

    fn add_material(&mut self, key: Option<NodeId>, material: NamedMaterial) -> u32 {
        let index = self.scene.materials.len() as u32;
        self.scene.materials.push(material);
        self.materials.insert(key, index);
        index
    }

    fn place_shape(
        &mut self,
        name: &str,
        shape: &Shape<'a>,
        materials: &[u32],
        said_by: Element<'a>,
        to_world: &Affine,
    ) -> Result<(), SceneError> {
        self.count(1 + materials.len(), said_by)?;
        let new = match shape {
            Shape::Mesh(parts) => parts.iter().map(|part| part.triangles.len()).sum(),
            Shape::Sphere { .. } => 1,
            Shape::Nothing => 0,
        };
        if self.scene.len() + new > MAX_PRIMITIVES {
            let title = format!("the scene has more than {MAX_PRIMITIVES} triangles and spheres");
            return Err(self
                .doc
                .on(said_by, title, "this instance is one too many")
                .help("place fewer instances, or simplify the mesh")
                .into());
        }
        match shape {
            Shape::Mesh(parts) => {
                let placer = Placer::new(*to_world);
                for (part, material) in parts.iter().zip(materials) {
                    let object = self.add_object(name, *material);
                    for local in &part.triangles {
                        let placed = placer
                            .triangle(local)
                            .ok_or_else(|| self.too_large(said_by))?;
                        self.scene.triangles.push(placed);
                    }
                    self.scene
                        .object_of
                        .resize(self.scene.triangles.len(), object);
                }
            }
            Shape::Sphere { radius } => {
                let sphere = bake::sphere(*radius, to_world)
                    .map_err(|why| self.sphere_error(why, said_by))?;
                let object = self.add_object(name, materials[0]);
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
        let title = format!(
            "{} is placed outside of the range of numbers",
            describe(element)
        );
        self.doc
            .on(
                element,
                title,
                "expected coordinates below 1e308 after all transforms",
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
