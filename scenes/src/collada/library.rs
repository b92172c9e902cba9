//! The contents of nodes. Each element is read only once, even if it has many instances.

use super::binding::Materials;
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
    /// For each part of the shape, the index of its material in the scene.
    pub(super) materials: Vec<u32>,
    pub(super) instance: Element<'a>,
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
    pub(super) fn node(&mut self, element: Element<'a>) -> Result<Rc<Node<'a>>, SceneError> {
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
                    instance: part,
                }),
                "instance_node" => {
                    let node = doc.target(part, "url", "node")?;
                    contents.push(Content::Node {
                        node,
                        instance: part,
                    });
                }
                "instance_geometry" => {
                    let geometry = doc.target(part, "url", "geometry")?;
                    let shape = self.shape(geometry)?;
                    let materials = self.materials.bind(part, &shape)?;
                    contents.push(Content::Shape(Rc::new(ShapeInstance {
                        name: name_of(element),
                        shape,
                        materials,
                        instance: part,
                    })));
                }
                "instance_light" => {
                    let light = doc.target(part, "url", "light")?;
                    if let Some(light) = self.light(light)? {
                        contents.push(Content::Light {
                            light,
                            instance: part,
                        });
                    }
                }
                "instance_camera" => {
                    let camera = doc.target(part, "url", "camera")?;
                    if let Some(optics) = optics::read(doc, camera)? {
                        contents.push(Content::Camera {
                            optics,
                            instance: part,
                        });
                    }
                }
                "asset" | "extra" => {}
                other => doc.warn(|| {
                    let expected = "only nodes, geometries, lights and cameras are supported here";
                    doc.on(part, format!("<{other}> is ignored"), expected)
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
