//! A scene: everything in world space, ready to be traced.

use crate::texture::TextureMap;
use crate::{Aabb, Camera, Light, Material, PrimId, Sphere, Triangle};

/// Geometry, materials, lights and the camera of one file.
///
/// Primitives are numbered through: triangles first, then spheres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// All triangles, instances baked in.
    pub triangles: Vec<Triangle>,
    /// All spheres, instances baked in.
    pub spheres: Vec<Sphere>,
    /// For each primitive, its object's index in [`Scene::objects`].
    pub object_of: Vec<u32>,
    /// What the file calls its parts.
    pub objects: Vec<Object>,
    /// The materials that objects name.
    pub materials: Vec<NamedMaterial>,
    /// Which surfaces carry pictures.
    pub textures: TextureMap,
    /// The lights.
    pub lights: Vec<NamedLight>,
    /// The camera that the file places, if it has a usable one.
    pub camera: Option<Camera>,
}

/// A part of the scene with one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Name of the node in the file.
    pub name: String,
    /// Index in [`Scene::materials`].
    pub material: u32,
}

/// A material and what the file calls it.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMaterial {
    /// Name in the file.
    pub name: String,
    /// What it does.
    pub material: Material,
}

/// A light and what the file calls it.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedLight {
    /// Name of the node in the file.
    pub name: String,
    /// What it does.
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

impl Scene {
    /// How many primitives there are.
    pub fn len(&self) -> usize {
        self.triangles.len() + self.spheres.len()
    }

    /// Whether there is nothing to hit.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The primitive with number `id`. Panics if there is none.
    #[inline]
    pub fn primitive(&self, id: PrimId) -> Primitive<'_> {
        let i = id.0 as usize;
        match self.triangles.get(i) {
            Some(triangle) => Primitive::Triangle(triangle),
            None => Primitive::Sphere(&self.spheres[i - self.triangles.len()]),
        }
    }

    /// All primitives, by number.
    pub fn primitives(&self) -> impl Iterator<Item = Primitive<'_>> {
        let triangles = self.triangles.iter().map(Primitive::Triangle);
        triangles.chain(self.spheres.iter().map(Primitive::Sphere))
    }

    /// The boxes of all primitives, by number.
    pub fn primitive_bounds(&self) -> Vec<Aabb> {
        let triangles = self.triangles.iter().map(Triangle::bounds);
        triangles
            .chain(self.spheres.iter().map(Sphere::bounds))
            .collect()
    }

    /// The box around everything.
    pub fn bounds(&self) -> Aabb {
        self.primitive_bounds()
            .into_iter()
            .fold(Aabb::EMPTY, Aabb::union)
    }

    /// The material of primitive `id`. Panics if the scene has no objects.
    #[inline]
    pub fn material_of(&self, id: PrimId) -> &Material {
        &self.materials[self.material_number(id)].material
    }

    /// Which of the materials that is.
    #[inline]
    pub fn material_number(&self, id: PrimId) -> usize {
        self.objects[self.object_of[id.0 as usize] as usize].material as usize
    }
}
