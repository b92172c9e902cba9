//! The contents of nodes. Each element is read only once, even if it has many instances.

use super::binding::{BoundMaterial, Materials};
use super::controller;
use super::document::{Document, Element, children, name_of, tag};
use super::geometry::{self, Shape};
use super::light::{self, LocalLight};
use super::mesh::MeshReader;
use super::optics::{self, Optics};
use super::transform::{self, Affine};
use crate::diagnostic::SceneError;
use kit::scene::NamedMaterial;
use kit::texture::TextureMap;
use roxmltree::NodeId;
use std::collections::HashMap;
use std::rc::Rc;

/// A node, read once for all its instances.
pub(super) struct Node<'a> {
    pub(super) name: String,
    pub(super) transform: Affine,
    pub(super) contents: Vec<Content<'a>>,
}

/// The contents of a node. `instance` is the element that diagnostics refer to.
pub(super) enum Content<'a> {
    /// A child node, or an instance of a node.
    Node {
        node: Element<'a>,
        instance: Element<'a>,
    },
    Shape(Rc<ShapeInstance<'a>>),
    Light {
        light: LocalLight,
        instance: Element<'a>,
    },
    Camera {
        optics: Optics,
        instance: Element<'a>,
    },
}

/// A shape as instantiated by a node.
pub(super) struct ShapeInstance<'a> {
    /// Name of the node.
    pub(super) name: String,
    pub(super) shape: Rc<Shape<'a>>,
    /// For each part of the shape.
    pub(super) materials: Vec<BoundMaterial>,
    /// For a skin: the transform to the coordinates of the visual scene, in place of the node's.
    pub(super) bind_shape: Option<Affine>,
    pub(super) instance: Element<'a>,
}

/// What the reader does about a camera that it cannot use.
const NO_CAMERA: &str = "the camera is left out: without another one, the scene is framed";

/// What a node can contain other than cameras.
const RENDERED: [&str; 4] = [
    "instance_geometry",
    "instance_controller",
    "instance_light",
    "instance_node",
];

/// Whether a node, or a node inside it, contains an element with one of these tags.
fn contains(node: Element<'_>, tags: &[&str]) -> bool {
    node.descendants()
        .any(|element| element.is_element() && tags.contains(&tag(element)))
}

/// Nodes, shapes, lights and materials that were read so far.
pub(super) struct Library<'r, 'a> {
    doc: &'r Document<'a>,
    nodes: HashMap<NodeId, Rc<Node<'a>>>,
    shapes: HashMap<NodeId, Rc<Shape<'a>>>,
    lights: HashMap<NodeId, Option<LocalLight>>,
    materials: Materials<'r, 'a>,
    meshes: MeshReader<'a>,
}

impl<'r, 'a> Library<'r, 'a> {
    pub(super) fn new(doc: &'r Document<'a>) -> Library<'r, 'a> {
        Library {
            doc,
            nodes: HashMap::new(),
            shapes: HashMap::new(),
            lights: HashMap::new(),
            materials: Materials::new(doc),
            meshes: MeshReader::default(),
        }
    }

    /// The materials of all shapes, and their textures.
    pub(super) fn into_materials(self) -> (Vec<NamedMaterial>, TextureMap) {
        self.materials.into_list()
    }

    /// Reads a node and its contents. Child nodes are not read yet.
    ///
    /// If the transform of a node with nothing to render is invalid, the node is left out, with a
    /// warning. This concerns cameras: without one, the scene is framed.
    pub(super) fn node(&mut self, element: Element<'a>) -> Result<Rc<Node<'a>>, SceneError> {
        if let Some(node) = self.nodes.get(&element.id()) {
            return Ok(Rc::clone(node));
        }
        let mut node = Node {
            name: name_of(element),
            transform: Affine::IDENTITY,
            contents: Vec::new(),
        };
        match transform::of_node(self.doc, element) {
            Ok(transform) => {
                node.transform = transform;
                for part in children(element) {
                    node.contents.extend(self.content(element, part)?);
                }
            }
            Err(error) if !contains(element, &RENDERED) => {
                let result = match contains(element, &["instance_camera"]) {
                    true => NO_CAMERA,
                    false => "the node is left out: it contains nothing to render",
                };
                self.doc.warn_of(error, result);
            }
            Err(error) => return Err(error),
        }
        let node = Rc::new(node);
        self.nodes.insert(element.id(), Rc::clone(&node));
        Ok(node)
    }

    /// The content that the child `part` of a node stands for, if any.
    fn content(
        &mut self,
        node: Element<'a>,
        part: Element<'a>,
    ) -> Result<Option<Content<'a>>, SceneError> {
        let doc = self.doc;
        let instance = part;
        Ok(match tag(part) {
            "node" => Some(Content::Node {
                node: part,
                instance,
            }),
            "instance_node" => Some(Content::Node {
                node: doc.target(part, "url", "node")?,
                instance,
            }),
            "instance_geometry" => {
                let geometry = doc.target(part, "url", "geometry")?;
                Some(self.shape_instance(node, instance, geometry, None)?)
            }
            "instance_controller" => {
                let controller = doc.target(part, "url", "controller")?;
                match controller::read(doc, instance, controller)? {
                    Some(mesh) => {
                        let (geometry, bind_shape) = (mesh.geometry, mesh.bind_shape);
                        Some(self.shape_instance(node, instance, geometry, bind_shape)?)
                    }
                    None => None,
                }
            }
            "instance_light" => match doc.find(doc.attribute(part, "url")?, "light") {
                Some(light) => self
                    .light(light)?
                    .map(|light| Content::Light { light, instance }),
                None => {
                    let finding = doc.unresolved(part, "url", "light");
                    finding.help("the light is left out").warn();
                    None
                }
            },
            "instance_camera" => {
                let camera = doc.target(part, "url", "camera");
                match camera.and_then(|camera| optics::read(doc, camera)) {
                    Ok(optics) => optics.map(|optics| Content::Camera { optics, instance }),
                    Err(error) => {
                        doc.warn_of(error, NO_CAMERA);
                        None
                    }
                }
            }
            "asset" | "extra" => None,
            transform if transform::is_transform(transform) => None,
            other => {
                let expected = "only nodes, shapes, lights and cameras are supported here";
                doc.on(part, format!("<{other}> is ignored"), expected)
                    .warn();
                None
            }
        })
    }

    fn shape_instance(
        &mut self,
        node: Element<'a>,
        instance: Element<'a>,
        geometry: Element<'a>,
        bind_shape: Option<Affine>,
    ) -> Result<Content<'a>, SceneError> {
        let shape = self.shape(geometry)?;
        let materials = self.materials.bind(instance, &shape)?;
        Ok(Content::Shape(Rc::new(ShapeInstance {
            name: name_of(node),
            shape,
            materials,
            bind_shape,
            instance,
        })))
    }

    fn shape(&mut self, geometry: Element<'a>) -> Result<Rc<Shape<'a>>, SceneError> {
        if let Some(shape) = self.shapes.get(&geometry.id()) {
            return Ok(Rc::clone(shape));
        }
        let shape = Rc::new(geometry::read(self.doc, geometry, &mut self.meshes)?);
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
}
