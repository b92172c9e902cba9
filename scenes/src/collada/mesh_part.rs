//! One primitive element of a mesh: converts its index lists to triangles.

use super::document::{Document, Element, describe};
use super::holes;
use super::index_into::{Found, IndexInto};
use super::mesh::TexCoordSet;
use super::polygon::{TestCounter, TooComplex, triangulate};
use super::primitives::{Polygon, Polygons};
use super::vertices::{Sources, Vertices};
use crate::diagnostic::SceneError;
use kit::{Vec2, Vec3};

/// A triangle.
pub(super) struct Corners {
    /// The groups of the corners in the index lists.
    groups: [u32; 3],
    /// Whether the file has normals for them.
    pub(super) has_normals: bool,
}

impl Corners {
    fn groups(&self) -> [usize; 3] {
        self.groups.map(|group| group as usize)
    }
}

/// Converts the index lists of a primitive element to triangles.
pub(super) struct PartReader<'r, 'a> {
    doc: &'r Document<'a>,
    element: Element<'a>,
    polygons: Polygons<'a>,
    positions: IndexInto<'a>,
    /// From a separate input, or from `<vertices>` with the index of the positions.
    normals: Option<IndexInto<'a>>,
    /// The sets of texture coordinates with their numbers, if the file has textures.
    tex_coords: Vec<(u64, IndexInto<'a, Vec2>)>,
}

impl<'r, 'a> PartReader<'r, 'a> {
    /// Reads the inputs and index lists. `None` if the element is empty.
    pub(super) fn new(
        doc: &'r Document<'a>,
        element: Element<'a>,
        vertices: &Vertices<'a>,
        sources: &mut Sources<'a>,
    ) -> Result<Option<PartReader<'r, 'a>>, SceneError> {
        let polygons = Polygons::read(doc, element)?;
        if polygons.polygons.is_empty() {
            return Ok(None);
        }
        let mut vertex_offset = None;
        let mut normals = None;
        let mut tex_coords = Vec::new();
        for input in &polygons.lists.inputs {
            let offset = input.offset;
            match doc.attribute(input.element, "semantic")? {
                "VERTEX" => {
                    check_same_mesh(doc, input.element, vertices)?;
                    vertex_offset = Some(offset);
                }
                "NORMAL" => {
                    let vectors = sources.normals(doc, input.element);
                    normals = vectors.map(|vectors| IndexInto { offset, vectors });
                }
                "TEXCOORD" => {
                    let set = sources.tex_coords(doc, input.element)?;
                    tex_coords.extend(set.map(|(n, vectors)| (n, IndexInto { offset, vectors })));
                }
                "COLOR" => {
                    let title = "the colours of vertices are ignored";
                    doc.on(
                        input.element,
                        title,
                        "the material alone gives a surface its colour",
                    )
                    .warn();
                }
                _ => {}
            }
        }
        let Some(offset) = vertex_offset else {
            return Err(doc
                .on(
                    element,
                    format!("{} has no vertices", describe(element)),
                    "expected <input semantic=\"VERTEX\" source=\"#...\" offset=\"0\"/>",
                )
                .help("refer to the <vertices> of the mesh")
                .into());
        };
        if tex_coords.is_empty() {
            let sets = vertices.tex_coords.iter();
            tex_coords.extend(sets.map(|(n, uv)| (*n, IndexInto::new(offset, uv))));
        }
        polygons.check_count(doc, element);
        Ok(Some(PartReader {
            doc,
            element,
            polygons,
            positions: IndexInto::new(offset, &vertices.positions),
            normals: normals
                .or_else(|| vertices.normals.as_ref().map(|n| IndexInto::new(offset, n))),
            tex_coords,
        }))
    }

    /// The triangles of all polygons.
    pub(super) fn corners(&self, counter: &mut TestCounter) -> Result<Vec<Corners>, SceneError> {
        let lists = &self.polygons.lists;
        let mut corners = Vec::with_capacity(self.polygons.polygons.len());
        let mut problems = Problems::default();
        let mut triangles = Vec::new();
        for polygon in &self.polygons.polygons {
            self.triangulate(polygon, counter, &mut problems, &mut triangles)?;
            for [a, b, c] in triangles.drain(..) {
                // The winding order of a strip alternates: every second triangle is reversed.
                let groups = if polygon.reversed {
                    [a, c, b]
                } else {
                    [a, b, c]
                };
                let normals = match &self.normals {
                    Some(into) => into.values(lists, groups, &mut problems.normals),
                    None => None,
                };
                corners.push(Corners {
                    // A file has less than 2³⁰ bytes.
                    groups: groups.map(|group| group as u32),
                    has_normals: normals.is_some(),
                });
            }
        }
        self.warn(&problems);
        Ok(corners)
    }

    /// The indices of the positions of a triangle.
    pub(super) fn positions_of(&self, corners: &Corners) -> [usize; 3] {
        let lists = &self.polygons.lists;
        (corners.groups()).map(|group| lists.index(group, self.positions.offset))
    }

    /// The normals of a triangle, if the file has them.
    pub(super) fn normals_of(&self, corners: &Corners) -> Option<[Vec3; 3]> {
        let into = self.normals.as_ref().filter(|_| corners.has_normals)?;
        let lists = &self.polygons.lists;
        into.values(lists, corners.groups(), &mut Found::default())
    }

    /// The sets of texture coordinates of these triangles.
    pub(super) fn tex_coords(&self, triangles: &[Corners]) -> Vec<TexCoordSet> {
        let set = |(number, into): &(u64, IndexInto<'a, Vec2>)| {
            let mut missing = Found::default();
            let of = |corners: &Corners| {
                let values = into.values(&self.polygons.lists, corners.groups(), &mut missing);
                values.unwrap_or([Vec2::ZERO; 3])
            };
            let coordinates = triangles.iter().map(of).collect();
            let label = format!("{}; using 0 0", into.vectors.expected_index());
            let what = "triangles with a texture coordinate out of range";
            self.warn_of(&missing, into.offset, what, &label);
            TexCoordSet {
                number: *number,
                coordinates,
            }
        };
        self.tex_coords.iter().map(set).collect()
    }

    /// Adds the triangles of a polygon, as the groups of their corners. None if a position is NaN.
    fn triangulate(
        &self,
        polygon: &Polygon,
        counter: &mut TestCounter,
        problems: &mut Problems,
        triangles: &mut Vec<[usize; 3]>,
    ) -> Result<(), SceneError> {
        if let Some(groups) = self.polygons.as_triangle(polygon) {
            let [a, b, c] = groups;
            let points = [self.position(a)?, self.position(b)?, self.position(c)?];
            triangles.extend(points.iter().all(|p| !p.is_nan()).then_some(groups));
            return Ok(());
        }
        let mut groups: Vec<usize> = polygon.groups().collect();
        let outline = groups.len();
        let mut holes = Vec::new();
        for hole in self.polygons.holes(polygon) {
            let first = groups.len();
            groups.extend(hole.clone());
            holes.push(first..groups.len());
        }
        let position = |group: &usize| self.position(*group);
        let mut points = groups
            .iter()
            .map(position)
            .collect::<Result<Vec<Vec3>, SceneError>>()?;
        if points.iter().any(|p| p.is_nan()) {
            return Ok(());
        }
        if !holes.is_empty() {
            let boundary = holes::connect(&points, outline, &holes, counter)
                .map_err(|TooComplex| self.too_complex())?;
            problems.holes.add(boundary.ignored, polygon.first);
            points = boundary.corners.iter().map(|i| points[*i]).collect();
            groups = boundary.corners.iter().map(|i| groups[*i]).collect();
        }
        let triangulation =
            triangulate(&points, counter).map_err(|TooComplex| self.too_complex())?;
        let intersects = usize::from(!triangulation.simple);
        problems.self_intersections.add(intersects, polygon.first);
        let of_polygon = |corners: [usize; 3]| corners.map(|corner| groups[corner]);
        triangles.extend(triangulation.triangles.into_iter().map(of_polygon));
        Ok(())
    }

    /// The position of a corner. An error if its index is out of range.
    fn position(&self, group: usize) -> Result<Vec3, SceneError> {
        let IndexInto { offset, vectors } = &self.positions;
        let index = self.polygons.lists.index(group, *offset);
        if let Some(position) = vectors.values.get(index) {
            return Ok(*position);
        }
        let (source, count) = (describe(vectors.element), vectors.values.len());
        let title = format!("index {index} is out of range: {source} has {count} entries");
        let range = self.polygons.lists.range(self.doc, group, *offset);
        let help = "the source or the index list is damaged: export the file again";
        let finding = self.doc.at(range, title, vectors.expected_index());
        Err(finding.help(help).into())
    }

    fn too_complex(&self) -> SceneError {
        let described = describe(self.element);
        let title = format!("the polygons of {described} are too complex to triangulate");
        let expected = "expected triangles, or polygons of fewer corners";
        self.doc
            .on(self.element, title, expected)
            .help("triangulate the mesh in the modelling program before the export")
            .into()
    }

    fn warn(&self, problems: &Problems) {
        self.warn_of(
            &problems.self_intersections,
            0,
            "polygons that intersect themselves or have no area",
            "the first one starts here; its triangles may overlap",
        );
        self.warn_of(
            &problems.holes,
            0,
            "holes outside of their polygon",
            "the first such polygon starts here; these holes are ignored",
        );
        if let Some(IndexInto { offset, vectors }) = &self.normals {
            let label = format!(
                "{}; the normals of these triangles are computed",
                vectors.expected_index()
            );
            let what = "triangles with a normal out of range";
            self.warn_of(&problems.normals, *offset, what, &label);
        }
    }

    /// Warns of what was found, if anything, at the first index.
    fn warn_of(&self, found: &Found, offset: usize, what: &str, label: &str) {
        if let Some(group) = found.first {
            let range = self.polygons.lists.range(self.doc, group, offset);
            let title = format!("{what}: {}", found.count);
            self.doc.at(range, title, label).warn();
        }
    }
}

/// What was repaired in the polygons of an element.
#[derive(Default)]
struct Problems {
    self_intersections: Found,
    holes: Found,
    normals: Found,
}

/// Checks that the input VERTEX does not refer to the vertices of another mesh. A reference to no
/// vertices can only mean those of this mesh.
fn check_same_mesh<'a>(
    doc: &Document<'a>,
    input: Element<'a>,
    vertices: &Vertices<'a>,
) -> Result<(), SceneError> {
    let Some(target) = doc.find(doc.attribute(input, "source")?, "vertices") else {
        let used = format!("using {}", describe(vertices.element));
        doc.unresolved(input, "source", "vertices")
            .relabel(used)
            .warn();
        return Ok(());
    };
    if target == vertices.element {
        return Ok(());
    }
    let title = format!(
        "VERTEX refers to the vertices of another mesh, {}",
        describe(target)
    );
    let expected = format!("expected {}", describe(vertices.element));
    Err(doc
        .on_attribute(input, "source", title, expected)
        .help("refer to the <vertices> of the same mesh")
        .into())
}
