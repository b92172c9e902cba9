//! `<bind_material>`: the materials of a shape's parts in an instance.

use super::document::{Document, Element, children, descendant, describe, name_of, tag, truncated};
use super::geometry::Shape;
use super::limits::MAX_INSTANCES;
use super::material::{self, TexturedMaterial};
use super::mesh::TexCoordSet;
use super::numbers::integer_attribute;
use super::texture::TextureImage;
use crate::diagnostic::SceneError;
use kit::scene::NamedMaterial;
use kit::texture::TextureMap;
use roxmltree::NodeId;
use std::collections::HashMap;

/// What an instance binds to a part of its shape.
pub(super) struct BoundMaterial {
    /// The index of the material in the scene.
    pub(super) material: u32,
    /// The index of the part's set of texture coordinates that the texture uses.
    pub(super) tex_coords: usize,
}

/// The materials of the scene. Each is read once.
pub(super) struct Materials<'r, 'a> {
    doc: &'r Document<'a>,
    list: Vec<NamedMaterial>,
    /// For each material, the image of its texture.
    textures: Vec<Option<TextureImage<'a>>>,
    /// Index in the list by the node id of the `<material>`. The key of the default grey is `None`.
    by_element: HashMap<Option<NodeId>, u32>,
    /// Number of bindings so far, to detect a file with far too many.
    bound: usize,
}

impl<'r, 'a> Materials<'r, 'a> {
    pub(super) fn new(doc: &'r Document<'a>) -> Materials<'r, 'a> {
        Materials {
            doc,
            list: Vec::new(),
            textures: Vec::new(),
            by_element: HashMap::new(),
            bound: 0,
        }
    }

    /// The materials and their textures. The caller adds the texture coordinates.
    pub(super) fn into_list(self) -> (Vec<NamedMaterial>, TextureMap) {
        let mut textures = TextureMap::default();
        for image in self.textures {
            textures.add_material(image.map(|image| image.file));
        }
        (self.list, textures)
    }

    /// The materials of a shape's parts, by the symbols of the `<instance_material>` elements. A
    /// sphere, and a part with an unknown symbol, use the first of these elements.
    pub(super) fn bind(
        &mut self,
        instance: Element<'a>,
        shape: &Shape<'a>,
    ) -> Result<Vec<BoundMaterial>, SceneError> {
        let parts: Vec<(Option<&str>, &[TexCoordSet])> = match shape {
            Shape::Mesh(parts) => parts
                .iter()
                .map(|part| (part.symbol, &part.tex_coords[..]))
                .collect(),
            Shape::Sphere { .. } => vec![(None, &[])],
            Shape::Nothing => Vec::new(),
        };
        self.bound += parts.len();
        if self.bound > MAX_INSTANCES {
            let title = format!("the scene has more than {MAX_INSTANCES} material bindings");
            let diagnostic = self
                .doc
                .on(instance, title, "this instance exceeds the limit");
            return Err(diagnostic
                .help("merge the parts of meshes that have the same material")
                .into());
        }
        let bindings = Bindings::read(instance);
        parts
            .into_iter()
            .map(|(symbol, sets)| {
                let material = self.bind_part(instance, &bindings, symbol)?;
                let binding = bindings.element_of(symbol).unwrap_or(instance);
                let tex_coords = self.choose_set(binding, material, sets)?;
                Ok(BoundMaterial {
                    material,
                    tex_coords,
                })
            })
            .collect()
    }

    /// The index of the set of texture coordinates that a `<bind_vertex_input>` of `binding`
    /// chooses for the texture of `material`. Without one, the set whose number ends the name that
    /// the texture has for its coordinates, such as `CHANNEL1`. The first if there is no such set.
    fn choose_set(
        &self,
        binding: Element<'a>,
        material: u32,
        sets: &[TexCoordSet],
    ) -> Result<usize, SceneError> {
        let doc = self.doc;
        let Some(image) = &self.textures[material as usize] else {
            return Ok(0);
        };
        let vertex_input = children(binding).find(|input| {
            tag(*input) == "bind_vertex_input" && input.attribute("semantic") == image.texcoord
        });
        let Some(input) = vertex_input else {
            let named = image.texcoord.and_then(number_at_end);
            let chosen = sets.iter().position(|set| Some(set.number) == named);
            if sets.len() > 1 && chosen.is_none() {
                let title = format!("the mesh has {} sets of texture coordinates", sets.len());
                let label = "expected a <bind_vertex_input> that chooses one; using the first";
                doc.on(binding, title, label).warn();
            }
            return Ok(chosen.unwrap_or(0));
        };
        let number = integer_attribute(doc, input, "input_set")?.unwrap_or(0);
        let chosen = sets.iter().position(|set| set.number == number);
        if chosen.is_none() && !sets.is_empty() {
            let title = format!("the mesh has no set {number} of texture coordinates");
            let label = format!("expected set {}; using it", sets[0].number);
            doc.on_attribute(input, "input_set", title, label).warn();
        }
        Ok(chosen.unwrap_or(0))
    }

    /// The material of the part with this symbol. An unbound symbol that is the id of a material
    /// stands for this material, as some exporters write it.
    fn bind_part(
        &mut self,
        instance: Element<'a>,
        bindings: &Bindings<'a>,
        symbol: Option<&str>,
    ) -> Result<u32, SceneError> {
        let doc = self.doc;
        if let Some(symbol) = symbol.filter(|symbol| !bindings.by_symbol.contains_key(symbol)) {
            if let Some(material) = doc.find(&format!("#{symbol}"), "material") {
                return self.material(material);
            }
            if let Some(first) = bindings.first {
                let title = format!("no material is bound to `{}`", truncated(symbol));
                let label =
                    "expected an <instance_material> with this symbol; using this one instead";
                doc.on(first, title, label).warn();
            }
        }
        if let (None, Some(first), 2..) = (symbol, bindings.first, bindings.by_symbol.len()) {
            let title = "a part of the shape names none of its materials";
            let label = "expected a part with this symbol; using this one";
            doc.on(first, title, label).warn();
        }
        let Some(binding) = bindings.element_of(symbol) else {
            let title = format!("{} has no material", describe(instance));
            let label = "expected <bind_material>; using grey, 0.5 0.5 0.5";
            doc.on(instance, title, label).warn();
            return Ok(self.default_material());
        };
        match doc.find(doc.attribute(binding, "target")?, "material") {
            Some(material) => self.material(material),
            None => {
                let label = "the surface uses grey, 0.5 0.5 0.5";
                let finding = doc.unresolved(binding, "target", "material");
                finding.relabel(label).warn();
                Ok(self.default_material())
            }
        }
    }

    fn material(&mut self, element: Element<'a>) -> Result<u32, SceneError> {
        if let Some(index) = self.by_element.get(&Some(element.id())) {
            return Ok(*index);
        }
        let material = material::read(self.doc, element)?;
        Ok(self.add_material(Some(element.id()), name_of(element), material))
    }

    fn default_material(&mut self) -> u32 {
        match self.by_element.get(&None) {
            Some(index) => *index,
            None => self.add_material(None, "grey".to_owned(), TexturedMaterial::DEFAULT),
        }
    }

    fn add_material(
        &mut self,
        key: Option<NodeId>,
        name: String,
        textured: TexturedMaterial<'a>,
    ) -> u32 {
        let index = self.list.len() as u32;
        let material = textured.material;
        self.list.push(NamedMaterial { name, material });
        self.textures.push(textured.texture);
        self.by_element.insert(key, index);
        index
    }
}

/// The number at the end of a name, such as 1 of `CHANNEL1`.
fn number_at_end(name: &str) -> Option<u64> {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    name[letters.len()..].parse().ok()
}

/// The `<instance_material>` elements of one instance.
struct Bindings<'a> {
    first: Option<Element<'a>>,
    by_symbol: HashMap<&'a str, Element<'a>>,
}

impl<'a> Bindings<'a> {
    fn read(instance: Element<'a>) -> Bindings<'a> {
        let technique = descendant(instance, &["bind_material", "technique_common"]);
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

    fn element_of(&self, symbol: Option<&str>) -> Option<Element<'a>> {
        let bound = symbol.and_then(|symbol| self.by_symbol.get(symbol));
        bound.copied().or(self.first)
    }
}
