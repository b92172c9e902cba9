//! `<bind_material>`: which material a part of a shape gets where it is placed.

use super::document::{Document, Element, child, children, describe, name_of, short, tag};
use super::geometry::Shape;
use super::material;
use crate::diagnostic::SceneError;
use kit::scene::NamedMaterial;
use roxmltree::NodeId;
use std::collections::HashMap;

/// The materials of the scene, each read once.
pub(super) struct Materials<'r, 'a> {
    doc: &'r Document<'a>,
    list: Vec<NamedMaterial>,
    /// Index in the list by the id of the `<material>`; the default grey is under `None`.
    by_element: HashMap<Option<NodeId>, u32>,
}

impl<'r, 'a> Materials<'r, 'a> {
    pub(super) fn new(doc: &'r Document<'a>) -> Materials<'r, 'a> {
        Materials {
            doc,
            list: Vec::new(),
            by_element: HashMap::new(),
        }
    }

    pub(super) fn into_list(self) -> Vec<NamedMaterial> {
        self.list
    }

    /// The materials of a shape's parts: by the symbol that `<instance_material>` binds; a part without a
    /// symbol, and a sphere, takes the only or first one.
    pub(super) fn bind(
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
                    let title = format!("no material is bound to `{}`", short(symbol));
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
        if let Some(index) = self.by_element.get(&Some(element.id())) {
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
        match self.by_element.get(&None) {
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
        let index = self.list.len() as u32;
        self.list.push(material);
        self.by_element.insert(key, index);
        index
    }
}
