//! Textures: images on surfaces.

use crate::{Hit, Spectrum, Vec2};
use std::collections::HashMap;

/// An image that repeats over the plane. One copy fills [0, 1]², with `v` pointing up from the
/// bottom left.
///
/// ```
/// use kit::{Spectrum, Texture, Vec2};
/// let checker = [Spectrum::BLACK, Spectrum::WHITE, Spectrum::WHITE, Spectrum::BLACK];
/// let texture = Texture::new(2, checker.to_vec()).expect("two full rows");
/// assert_eq!(texture.at(Vec2::new(0.25, 0.25)), Spectrum::WHITE);
/// assert_eq!(texture.at(Vec2::splat(0.5)), Spectrum::grey(0.5));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    width: usize,
    /// Linear reflectance, row by row from the top left.
    texels: Vec<Spectrum>,
}

impl Texture {
    /// A texture of `width` texels per row, row by row from the top left, in linear colour. `None`
    /// if there are no texels, or if the last row is not full.
    pub fn new(width: usize, texels: Vec<Spectrum>) -> Option<Texture> {
        let is_whole = width > 0 && !texels.is_empty() && texels.len().is_multiple_of(width);
        is_whole.then_some(Texture { width, texels })
    }

    /// A texture with one colour everywhere.
    pub fn uniform(color: Spectrum) -> Texture {
        Texture {
            width: 1,
            texels: vec![color],
        }
    }

    /// The colour at `uv`, by bilinear interpolation between the centres of the four nearest
    /// texels. Finite for finite `uv`. The image repeats across its borders.
    pub fn at(&self, uv: Vec2) -> Spectrum {
        let size = Vec2::new(self.width as f64, self.height() as f64);
        let position = uv * size - 0.5;
        let corner = position.floor();
        let fraction = position - corner;
        let texel = |dx: f64, dy: f64| {
            // The remainder of integers is exact.
            let x = (corner.x + dx).rem_euclid(size.x) as usize;
            let y = (corner.y + dy).rem_euclid(size.y) as usize;
            self.texels[(self.height() - 1 - y) * self.width + x]
        };
        let row = |dy: f64| (1.0 - fraction.x) * texel(0.0, dy) + fraction.x * texel(1.0, dy);
        (1.0 - fraction.y) * row(0.0) + fraction.y * row(1.0)
    }

    fn height(&self) -> usize {
        self.texels.len() / self.width
    }
}

/// The textures of a scene's materials. Empty for most scenes.
///
/// ```
/// use kit::texture::TextureMap;
/// let mut map = TextureMap::default();
/// map.add_material(Some("wood.png".into()));
/// map.add_material(None);
/// map.add_material(Some("wood.png".into()));
/// assert_eq!(map.files, ["wood.png"]);
/// assert_eq!([0, 1, 2].map(|material| map.of_material(material)), [Some(0), None, Some(0)]);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureMap {
    /// The image files as named in the scene file: relative to its folder, or absolute.
    pub files: Vec<String>,
    /// The bytes of those image files that are inside of the scene file, by their names.
    pub embedded: HashMap<String, Vec<u8>>,
    /// For each triangle, the texture coordinates of its vertices. The list may end early: later
    /// triangles have none.
    pub coordinates: Vec<[Vec2; 3]>,
    /// For each material, the index of its image file.
    of_material: Vec<Option<u32>>,
}

impl TextureMap {
    /// Adds the next material of the scene, with the image `file` or without a texture.
    pub fn add_material(&mut self, file: Option<String>) {
        let index = file.map(|file| {
            let existing = self.files.iter().position(|other| *other == file);
            existing.unwrap_or_else(|| {
                self.files.push(file);
                self.files.len() - 1
            }) as u32
        });
        self.of_material.push(index);
    }

    /// The index of the image file of `material`.
    #[inline]
    pub fn of_material(&self, material: u32) -> Option<u32> {
        self.of_material.get(material as usize).copied().flatten()
    }

    /// The texture coordinates at a hit. `None` if the primitive has none.
    #[inline]
    pub fn uv(&self, hit: &Hit) -> Option<Vec2> {
        let [a, b, c] = *self.coordinates.get(hit.prim.0 as usize)?;
        Some((1.0 - hit.uv.x - hit.uv.y) * a + hit.uv.x * b + hit.uv.y * c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Red and green in the top row, blue and white in the bottom row.
    fn four_texels() -> Texture {
        let (red, green) = (Spectrum::new(1.0, 0.0, 0.0), Spectrum::new(0.0, 1.0, 0.0));
        let blue = Spectrum::new(0.0, 0.0, 1.0);
        Texture::new(2, vec![red, green, blue, Spectrum::WHITE]).expect("two whole rows")
    }

    #[test]
    fn texel_centres_have_the_colour_of_the_texel() {
        let texture = four_texels();
        assert_eq!(
            texture.at(Vec2::new(0.25, 0.25)),
            Spectrum::new(0.0, 0.0, 1.0)
        );
        assert_eq!(texture.at(Vec2::new(0.75, 0.25)), Spectrum::WHITE);
        assert_eq!(
            texture.at(Vec2::new(0.25, 0.75)),
            Spectrum::new(1.0, 0.0, 0.0)
        );
        assert_eq!(
            texture.at(Vec2::new(0.75, 0.75)),
            Spectrum::new(0.0, 1.0, 0.0)
        );
    }

    #[test]
    fn colours_are_interpolated_also_across_borders() {
        let texture = four_texels();
        assert_eq!(texture.at(Vec2::splat(0.5)), Spectrum::grey(0.5));
        assert_eq!(texture.at(Vec2::ZERO), Spectrum::grey(0.5));
    }

    #[test]
    fn texture_repeats_over_the_plane() {
        let texture = four_texels();
        for (u, v) in [(0.3, 0.6), (0.9, 0.1)] {
            let near = texture.at(Vec2::new(u, v));
            let far = texture.at(Vec2::new(u - 8.0, v + 16.0));
            assert!((near - far).max_channel().abs() < 1e-14);
        }
        assert!(texture.at(Vec2::new(1e300, -1e300)).is_finite());
    }

    #[test]
    fn incomplete_rows_are_rejected() {
        assert!(Texture::new(2, vec![Spectrum::WHITE; 3]).is_none());
        assert!(Texture::new(0, vec![]).is_none());
        assert_eq!(
            Texture::uniform(Spectrum::grey(0.2)).at(Vec2::ONE),
            Spectrum::grey(0.2)
        );
    }
}
