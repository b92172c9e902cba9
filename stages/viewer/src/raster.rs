//! Draws egui's meshes on the CPU, for snapshots and for tests without a GPU.
//!
//! A picture depends on the meshes alone, not on a driver. Textures are sampled bilinearly, colours
//! are blended as bytes, as `egui_glow` does it.

use egui::epaint::{ClippedPrimitive, ImageData, ImageDelta, Mesh, Primitive, Vertex};
use egui::{Color32, ColorImage, Pos2, Rect, TextureId, TexturesDelta};
use std::collections::HashMap;

/// The textures of an egui context.
#[derive(Default)]
pub struct Rasteriser {
    textures: HashMap<TextureId, Texture>,
}

struct Texture {
    image: ColorImage,
    is_linear: bool,
}

impl Rasteriser {
    /// Takes over the changes of textures.
    pub fn update(&mut self, delta: &TexturesDelta) {
        for (id, changes) in &delta.set {
            changes.iter().for_each(|change| self.set(*id, change));
        }
        for id in &delta.free {
            self.textures.remove(id);
        }
    }

    fn set(&mut self, id: TextureId, delta: &ImageDelta) {
        let ImageData::Color(image) = &delta.image;
        match delta.pos {
            None => {
                let texture = Texture {
                    image: ColorImage::clone(image),
                    is_linear: delta.options.magnification == egui::TextureFilter::Linear,
                };
                self.textures.insert(id, texture);
            }
            Some([left, top]) => {
                if let Some(texture) = self.textures.get_mut(&id) {
                    let (width, part) = (texture.image.width(), image.width());
                    for (row, pixels) in image.pixels.chunks(part.max(1)).enumerate() {
                        let start = (top + row) * width + left;
                        texture.image.pixels[start..start + part].copy_from_slice(pixels);
                    }
                }
            }
        }
    }

    /// Draws `primitives` over `background` into a picture of `size` pixels.
    pub fn draw(
        &self,
        size: [usize; 2],
        pixels_per_point: f32,
        background: Color32,
        primitives: &[ClippedPrimitive],
    ) -> ColorImage {
        let mut target = ColorImage::filled(size, background);
        for ClippedPrimitive {
            clip_rect,
            primitive,
        } in primitives
        {
            if let Primitive::Mesh(mesh) = primitive {
                let clip = Rect {
                    min: (clip_rect.min.to_vec2() * pixels_per_point)
                        .round()
                        .to_pos2(),
                    max: (clip_rect.max.to_vec2() * pixels_per_point)
                        .round()
                        .to_pos2(),
                };
                self.draw_mesh(&mut target, clip, pixels_per_point, mesh);
            }
        }
        target
    }

    fn draw_mesh(&self, target: &mut ColorImage, clip: Rect, scale: f32, mesh: &Mesh) {
        let texture = self.textures.get(&mesh.texture_id);
        for corners in mesh.indices.chunks_exact(3) {
            let corners = [corners[0], corners[1], corners[2]].map(|i| mesh.vertices[i as usize]);
            draw_triangle(target, clip, scale, texture, corners);
        }
    }
}

/// Draws one triangle. Pixel centres on an edge belong to the triangle that has it on its top or
/// left, so two triangles with a common edge never draw a pixel twice.
fn draw_triangle(
    target: &mut ColorImage,
    clip: Rect,
    scale: f32,
    texture: Option<&Texture>,
    [a, mut b, mut c]: [Vertex; 3],
) {
    let at = |v: &Vertex| v.pos.to_vec2() * scale;
    let cross = |p: egui::Vec2, q: egui::Vec2| p.x * q.y - p.y * q.x;
    let mut area = cross(at(&b) - at(&a), at(&c) - at(&a));
    if area == 0.0 || !area.is_finite() {
        return;
    }
    if area < 0.0 {
        std::mem::swap(&mut b, &mut c);
        area = -area;
    }
    let points = [at(&a), at(&b), at(&c)];
    let bounds = Rect::from_points(&points.map(egui::Vec2::to_pos2)).intersect(clip);
    let [width, height] = target.size;
    let range = |from: f32, to: f32, limit: usize| {
        let first = (from - 0.5).ceil().max(0.0) as usize;
        let end = ((to - 0.5).floor() + 1.0).max(0.0) as usize;
        first..end.min(limit)
    };
    let edges = [(1, 2), (2, 0), (0, 1)].map(|(i, j): (usize, usize)| {
        let d = points[j] - points[i];
        let is_top_left = d.y < 0.0 || (d.y == 0.0 && d.x > 0.0);
        (points[i], d, is_top_left)
    });
    let colors = [a, b, c].map(|v| v.color.to_array().map(f32::from));
    for y in range(bounds.min.y, bounds.max.y, height) {
        for x in range(bounds.min.x, bounds.max.x, width) {
            let p = egui::vec2(x as f32 + 0.5, y as f32 + 0.5);
            let weights = edges.map(|(from, d, _)| cross(d, p - from));
            let inside = |i: usize| weights[i] > 0.0 || (weights[i] == 0.0 && edges[i].2);
            if !(0..3).all(inside) {
                continue;
            }
            let [u, v, w] = weights.map(|weight| weight / area);
            let mix = |of: [f32; 3]| u * of[0] + v * of[1] + w * of[2];
            let mut color = [0, 1, 2, 3].map(|i| mix([colors[0][i], colors[1][i], colors[2][i]]));
            if let Some(texture) = texture {
                let uv = Pos2::new(mix([a.uv.x, b.uv.x, c.uv.x]), mix([a.uv.y, b.uv.y, c.uv.y]));
                let texel = texture.sample(uv);
                for (channel, texel) in color.iter_mut().zip(texel) {
                    *channel *= texel / 255.0;
                }
            }
            let below = &mut target.pixels[y * width + x];
            *below = blend(*below, color);
        }
    }
}

/// Premultiplied `color` over `below`.
fn blend(below: Color32, color: [f32; 4]) -> Color32 {
    let through = 1.0 - color[3] / 255.0;
    let [r, g, b, a] = below.to_array();
    let mix = |over: f32, under: u8| (over + through * f32::from(under) + 0.5).min(255.0) as u8;
    Color32::from_rgba_premultiplied(
        mix(color[0], r),
        mix(color[1], g),
        mix(color[2], b),
        mix(color[3], a),
    )
}

impl Texture {
    fn sample(&self, uv: Pos2) -> [f32; 4] {
        let [w, h] = self.image.size;
        let (x, y) = (uv.x * w as f32, uv.y * h as f32);
        let texel = |x: f32, y: f32| {
            let clamped = |i: f32, size: usize| i.clamp(0.0, size as f32 - 1.0) as usize;
            let index = clamped(y, h) * w + clamped(x, w);
            self.image.pixels[index].to_array().map(f32::from)
        };
        if !self.is_linear {
            return texel(x.floor(), y.floor());
        }
        let (x, y) = (x - 0.5, y - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (right, bottom) = (x - left, y - top);
        let corners = [
            (texel(left, top), (1.0 - right) * (1.0 - bottom)),
            (texel(left + 1.0, top), right * (1.0 - bottom)),
            (texel(left, top + 1.0), (1.0 - right) * bottom),
            (texel(left + 1.0, top + 1.0), right * bottom),
        ];
        let mut sum = [0.0; 4];
        for (texel, weight) in corners {
            for (sum, channel) in sum.iter_mut().zip(texel) {
                *sum += weight * channel;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::epaint::Mesh;

    #[test]
    fn a_rectangle_covers_its_pixels_once() {
        let rect = Rect::from_min_max(Pos2::new(1.0, 1.0), Pos2::new(4.0, 3.0));
        let mut mesh = Mesh::default();
        mesh.add_colored_rect(rect, Color32::from_rgba_premultiplied(100, 0, 0, 128));
        let primitive = ClippedPrimitive {
            clip_rect: Rect::EVERYTHING,
            primitive: Primitive::Mesh(mesh),
        };
        let picture = Rasteriser::default().draw([6, 4], 1.0, Color32::BLACK, &[primitive]);
        for (i, pixel) in picture.pixels.iter().enumerate() {
            let (x, y) = (i % 6, i / 6);
            let inside = (1..4).contains(&x) && (1..3).contains(&y);
            let red = if inside { 100 } else { 0 };
            assert_eq!(pixel.r(), red, "{x} {y}");
        }
    }

    #[test]
    fn nearest_and_linear_textures() {
        let texture = |is_linear| Texture {
            image: ColorImage::new([2, 1], vec![Color32::BLACK, Color32::WHITE]),
            is_linear,
        };
        let red = |is_linear, u| texture(is_linear).sample(Pos2::new(u, 0.5))[0];
        assert_eq!((red(false, 0.49), red(false, 0.51)), (0.0, 255.0));
        assert_eq!(
            (red(true, 0.25), red(true, 0.5), red(true, 1.0)),
            (0.0, 127.5, 255.0)
        );
    }
}
