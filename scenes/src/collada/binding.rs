//! `<bind_material>`: which material a part of a shape gets where it is placed.

use super::document::{Document, Element, children, descend, describe, name_of, short, tag};
use super::geometry::Shape;
use super::limits::MAX_INSTANCES;
use super::material::{self, Finish};
use crate::diagnostic::SceneError;
use kit::scene::NamedMaterial;
use kit::texture::TextureMap;
use roxmltree::NodeId;
use std::collections::HashMap;

/// The materials of the scene, each read once.
pub(super) struct Materials<'r, 'a> {
    doc: &'r Document<'a>,
    list: Vec<NamedMaterial>,
    /// For each material, the file of its picture.
    pictures: Vec<Option<String>>,
    /// Index in the list by the id of the `<material>`; the default grey is under `None`.
    by_element: HashMap<Option<NodeId>, u32>,
    /// How many parts got their material so far, to stop a file that asks for far too many.
    bound: usize,
}

impl<'r, 'a> Materials<'r, 'a> {
    pub(super) fn new(doc: &'r Document<'a>) -> Materials<'r, 'a> {
        Materials {
            doc,
            list: Vec::new(),
            pictures: Vec::new(),
            by_element: HashMap::new(),
            bound: 0,
        }
    }

    /// The materials, and which pictures they carry. The coordinates are for others to add.
    pub(super) fn into_list(self) -> (Vec<NamedMaterial>, TextureMap) {
        let mut textures = TextureMap::default();
        for picture in self.pictures {
            textures.add_material(picture);
        }
        (self.list, textures)
    }

    /// The materials of a shape's parts: by the symbol that `<instance_material>` binds; a sphere and a part
    /// whose symbol is not bound take the first one.
    pub(super) fn bind(
        &mut self,
        instance: Element<'a>,
        shape: &Shape<'a>,
    ) -> Result<Vec<u32>, SceneError> {
        let symbols: Vec<Option<&str>> = match shape {
            Shape::Mesh(parts) => parts.iter().map(|part| part.symbol).collect(),
            Shape::Sphere { .. } => vec![None],
            Shape::Nothing => Vec::new(),
        };
        self.bound += symbols.len();
        if self.bound > MAX_INSTANCES {
            let title = format!("the scene binds more than {MAX_INSTANCES} materials");
            let finding = self
                .doc
                .on(instance, title, "this instance is one too many");
            return Err(finding
                .help("join the parts of meshes that have the same material")
                .into());
        }
        let bindings = Bindings::read(instance);
        symbols
            .into_iter()
            .map(|symbol| match bindings.of(symbol) {
                Some(binding) => {
                    if let Some(symbol) = symbol.filter(|symbol| !bindings.by_symbol.contains_key(symbol)) {
                        self.doc.warn(|| {
                            let title = format!("no material is bound to `{}`", short(symbol));
                            let done = "expected an <instance_material> with this symbol; this one is taken";
                            self.doc.on(binding, title, done)
                        });
                    }
                    self.bound_material(binding)
                }
                None => {
                    self.doc.warn(|| {
                        let title = format!("{} has no material", describe(instance));
                        let done = "expected <bind_material>; taken as grey, 0.5 0.5 0.5";
                        self.doc.on(instance, title, done)
                    });
                    Ok(self.default_material())
                }
            })
            .collect()
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
        if let Some(index) = self.by_element.get(&Some(element.id())) {
            return Ok(*index);
        }
        let finish = material::read(doc, element)?;
        Ok(self.add_material(Some(element.id()), name_of(element), finish))
    }

    fn default_material(&mut self) -> u32 {
        match self.by_element.get(&None) {
            Some(index) => *index,
            None => self.add_material(None, "grey".to_owned(), Finish::DEFAULT),
        }
    }

    fn add_material(&mut self, key: Option<NodeId>, name: String, finish: Finish) -> u32 {
        let index = self.list.len() as u32;
        let material = finish.material;
        self.list.push(NamedMaterial { name, material });
        self.pictures.push(finish.picture);
        self.by_element.insert(key, index);
        index
    }
}

/// The `<instance_material>` elements of one instance.
struct Bindings<'a> {
    first: Option<Element<'a>>,
    by_symbol: HashMap<&'a str, Element<'a>>,
}

impl<'a> Bindings<'a> {
    fn read(instance: Element<'a>) -> Bindings<'a> {
        let technique = descend(instance, &["bind_material", "technique_common"]);
        let elements = technique
            .into_iter()
            .flat_map(children)
            .filter(|element| tag(*element) == "instance_material");
        let mut bindings = Bindings {
            first: None,
            by_symbol: HashMap::new(),
        };
        for element in elements {
            bindings.first.get_or_insert(element);
            if let Some(symbol) = element.attribute("symbol") {
                bindings.by_symbol.entry(symbol).or_insert(element);
            }
        }
        bindings
    }

    fn of(&self, symbol: Option<&str>) -> Option<Element<'a>> {
        let bound = symbol.and_then(|symbol| self.by_symbol.get(symbol));
        bound.copied().or(self.first)
    }
}
