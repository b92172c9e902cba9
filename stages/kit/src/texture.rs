//! Pictures on surfaces.

use crate::{Hit, Spectrum, Vec2};

/// A picture that repeats all over the plane: one copy fills [0, 1]², `v` upwards from its bottom left.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    width: usize,
    /// Linear reflectance, row by row from the top left.
    texels: Vec<Spectrum>,
}

impl Texture {
    /// A picture `width` texels wide, row by row from the top left, in linear light. `None` if the texels do not fill
    /// whole rows, or there are none.
    pub fn new(width: usize, texels: Vec<Spectrum>) -> Option<Texture> {
        let is_whole = width > 0 && !texels.is_empty() && texels.len().is_multiple_of(width);
        is_whole.then_some(Texture { width, texels })
    }

    /// One colour everywhere.
    pub fn uniform(color: Spectrum) -> Texture {
        Texture {
            width: 1,
            texels: vec![color],
        }
    }

    /// The colour at `uv`, finite: between the centres of the four nearest texels, each weighed by how near it is
    /// (bilinear). Across the border the picture's next copy goes on.
    pub fn at(&self, uv: Vec2) -> Spectrum {
        let size = Vec2::new(self.width as f64, self.height() as f64);
        let place = uv * size - 0.5;
        let corner = place.floor();
        let part = place - corner;
        let texel = |dx: f64, dy: f64| {
            // Whole numbers, and the remainder of whole numbers is exact.
            let x = (corner.x + dx).rem_euclid(size.x) as usize;
            let y = (corner.y + dy).rem_euclid(size.y) as usize;
            self.texels[(self.height() - 1 - y) * self.width + x]
        };
        let row = |dy: f64| (1.0 - part.x) * texel(0.0, dy) + part.x * texel(1.0, dy);
        (1.0 - part.y) * row(0.0) + part.y * row(1.0)
    }

    fn height(&self) -> usize {
        self.texels.len() / self.width
    }
}

/// Which surfaces of a scene carry which pictures. Empty for most scenes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureMap {
    /// The picture files, as the scene file names them: relative to its folder, or absolute.
    pub files: Vec<String>,
    /// For each triangle, the texture coordinates of its vertices; triangles beyond the end have none.
    pub coordinates: Vec<[Vec2; 3]>,
    /// For each material, the index of its file.
    of_material: Vec<Option<u32>>,
}

impl TextureMap {
    /// Says that the scene's next material carries `file`, or no picture.
    pub fn add_material(&mut self, file: Option<String>) {
        let index = file.map(|file| {
            let known = self.files.iter().position(|other| *other == file);
            known.unwrap_or_else(|| {
                self.files.push(file);
                self.files.len() - 1
            }) as u32
        });
        self.of_material.push(index);
    }

    /// The index of the file that `material` carries.
    #[inline]
    pub fn of_material(&self, material: u32) -> Option<u32> {
        self.of_material.get(material as usize).copied().flatten()
    }

    /// Where on its picture the surface was hit. `None` if the primitive has no texture coordinates.
    #[inline]
    pub fn uv(&self, hit: &Hit) -> Option<Vec2> {
        let [a, b, c] = *self.coordinates.get(hit.prim.0 as usize)?;
        Some((1.0 - hit.uv.x - hit.uv.y) * a + hit.uv.x * b + hit.uv.y * c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Red and green above, blue and white below.
    fn four() -> Texture {
        let (red, green) = (Spectrum::new(1.0, 0.0, 0.0), Spectrum::new(0.0, 1.0, 0.0));
        let blue = Spectrum::new(0.0, 0.0, 1.0);
        Texture::new(2, vec![red, green, blue, Spectrum::WHITE]).expect("two whole rows")
    }

    #[test]
    fn centres_of_texels_show_their_own_colour() {
        let texture = four();
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
    fn between_centres_colours_blend_across_the_border_too() {
        let texture = four();
        assert_eq!(texture.at(Vec2::splat(0.5)), Spectrum::grey(0.5));
        assert_eq!(texture.at(Vec2::ZERO), Spectrum::grey(0.5));
    }

    #[test]
    fn copies_fill_the_plane() {
        let texture = four();
        for (u, v) in [(0.3, 0.6), (0.9, 0.1)] {
            let near = texture.at(Vec2::new(u, v));
            let far = texture.at(Vec2::new(u - 8.0, v + 16.0));
            assert!((near - far).max_channel().abs() < 1e-14);
        }
        assert!(texture.at(Vec2::new(1e300, -1e300)).is_finite());
    }

    #[test]
    fn texels_fill_whole_rows() {
        assert!(Texture::new(2, vec![Spectrum::WHITE; 3]).is_none());
        assert!(Texture::new(0, vec![]).is_none());
        assert_eq!(
            Texture::uniform(Spectrum::grey(0.2)).at(Vec2::ONE),
            Spectrum::grey(0.2)
        );
    }
}
