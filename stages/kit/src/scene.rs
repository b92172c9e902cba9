//! The scene: all geometry in world space.

use crate::texture::TextureMap;
use crate::{Aabb, Camera, Light, Material, PrimId, Sphere, Triangle, Vec3};

/// Geometry, materials, lights and the camera of one scene file.
///
/// The ids of primitives count triangles first, then spheres.
///
/// ```
/// use kit::{PrimId, Primitive, Scene, Triangle, Vec3};
/// let triangle = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
/// let scene = Scene {
///     triangles: vec![triangle],
///     ..Scene::default()
/// };
/// assert_eq!(scene.len(), 1);
/// assert_eq!(scene.primitive(PrimId(0)), Primitive::Triangle(&triangle));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// All triangles, with instances transformed to world space.
    pub triangles: Vec<Triangle>,
    /// All spheres, with instances transformed to world space.
    pub spheres: Vec<Sphere>,
    /// For each primitive, the index of its object in [`Scene::objects`].
    pub object_of: Vec<u32>,
    /// The objects of the file.
    pub objects: Vec<Object>,
    /// The materials that the objects refer to.
    pub materials: Vec<NamedMaterial>,
    /// The textures of the materials.
    pub textures: TextureMap,
    /// The lights.
    pub lights: Vec<NamedLight>,
    /// The camera of the file, if it has a usable one.
    pub camera: Option<Camera>,
}

/// A part of the scene with a single material.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Name of the node in the file.
    pub name: String,
    /// Index in [`Scene::materials`].
    pub material: u32,
}

/// A material and its name in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMaterial {
    /// Name in the file.
    pub name: String,
    /// The material.
    pub material: Material,
}

/// A light and its name in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedLight {
    /// Name of the node in the file.
    pub name: String,
    /// The light.
    pub light: Light,
}

/// One primitive of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Primitive<'a> {
    /// A triangle.
    Triangle(&'a Triangle),
    /// A sphere.
    Sphere(&'a Sphere),
}

impl Primitive<'_> {
    /// The bounding box of the primitive.
    pub fn bounds(&self) -> Aabb {
        match self {
            Primitive::Triangle(triangle) => triangle.bounds(),
            Primitive::Sphere(sphere) => sphere.bounds(),
        }
    }
}

impl Scene {
    /// Number of primitives.
    pub fn len(&self) -> usize {
        self.triangles.len() + self.spheres.len()
    }

    /// Whether there are no primitives.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The primitive `id`. Panics if there is none.
    #[inline]
    pub fn primitive(&self, id: PrimId) -> Primitive<'_> {
        let i = id.0 as usize;
        match self.triangles.get(i) {
            Some(triangle) => Primitive::Triangle(triangle),
            None => Primitive::Sphere(&self.spheres[i - self.triangles.len()]),
        }
    }

    /// All primitives, in the order of their ids.
    pub fn primitives(&self) -> impl Iterator<Item = Primitive<'_>> {
        let triangles = self.triangles.iter().map(Primitive::Triangle);
        triangles.chain(self.spheres.iter().map(Primitive::Sphere))
    }

    /// The bounding boxes of all primitives, in the order of their ids.
    pub fn primitive_bounds(&self) -> Vec<Aabb> {
        self.primitives()
            .map(|primitive| primitive.bounds())
            .collect()
    }

    /// The bounding box of the scene.
    pub fn bounds(&self) -> Aabb {
        let boxes = self.primitives().map(|primitive| primitive.bounds());
        boxes.fold(Aabb::EMPTY, Aabb::union)
    }

    /// Gives every triangle the normal of its plane, on the side of its vertex normals. A triangle
    /// without area keeps its normals.
    pub fn flatten_normals(&mut self) {
        for triangle in &mut self.triangles {
            let plane = Triangle::flat(triangle.p0, triangle.p1, triangle.p2).n0;
            let side = plane.dot(triangle.n0 + triangle.n1 + triangle.n2);
            if plane != Vec3::ZERO {
                let n = if side < 0.0 { -plane } else { plane };
                (triangle.n0, triangle.n1, triangle.n2) = (n, n, n);
            }
        }
    }

    /// The material of primitive `id`. Panics if the scene has no objects.
    #[inline]
    pub fn material_of(&self, id: PrimId) -> &Material {
        &self.materials[self.material_number(id)].material
    }

    /// The index of the material of primitive `id` in [`Scene::materials`].
    #[inline]
    pub fn material_number(&self, id: PrimId) -> usize {
        self.objects[self.object_of[id.0 as usize] as usize].material as usize
    }
}
