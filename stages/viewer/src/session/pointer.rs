//! Where the mouse is: in the 3D view, or over a pixel of the picture.

use super::{Mode, Session};
use crate::project::Projection;
use crate::task::guarded;
use kit::{Camera, FilmSize, Vec2};
use raygen::generate_ray;
use scenes::placement::for_film;

impl Session {
    /// The pointer is at this position of the 3D view, in [0, 1]² from the bottom left.
    pub fn point_at_view(&mut self, position: Option<Vec2>) {
        self.pointer_in_view = position;
    }

    /// The pointer is over this pixel of the picture, counted from the bottom left.
    pub fn point_at_pixel(&mut self, pixel: Option<(u32, u32)>) {
        self.pointer_pixel = pixel;
    }

    /// The pixel of the picture under the pointer; in edit and BVH mode that of the picture that
    /// would be rendered.
    pub fn pixel_under_pointer(&self) -> Option<(u32, u32)> {
        if self.mode == Mode::Render {
            return self.pointer_pixel;
        }
        let film = self.settings?.film;
        let scene = self.scene.as_ref()?;
        let view = self.view.picture(scene)?.request.camera;
        pixel_at(&view, &self.orbit?.camera(), film, self.pointer_in_view?)
    }

    pub(super) fn inspect_under_pointer(&mut self) {
        match self.pixel_under_pointer() {
            Some((x, y)) => self.inspect(x, y),
            None => self.say("The mouse is not over the picture"),
        }
    }
}

/// The pixel of the picture of `camera` that appears at `position` in the picture of `view`, a
/// camera at the same place with other angles of view.
fn pixel_at(view: &Camera, camera: &Camera, film: FilmSize, position: Vec2) -> Option<(u32, u32)> {
    let camera = for_film(camera, film);
    let ray = guarded(|| generate_ray(view, position)).ok()?;
    let at = Projection::new(&camera).point(ray.o + ray.d)?;
    let pixel = (at * Vec2::new(f64::from(film.w), f64::from(film.h))).floor();
    let inside = pixel.x >= 0.0
        && pixel.y >= 0.0
        && pixel.x < f64::from(film.w)
        && pixel.y < f64::from(film.h);
    inside.then_some((pixel.x as u32, pixel.y as u32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{Mat3, Vec3};

    #[test]
    fn a_wider_view_shows_the_picture_in_its_middle() {
        let camera = Camera {
            pos: Vec3::ZERO,
            c2w: Mat3::IDENTITY,
            h_fov: 60.0,
            v_fov: 60.0,
            n_clip: 0.0,
            f_clip: 1e30,
        };
        let film = FilmSize { w: 100, h: 100 };
        let view = for_film(&camera, FilmSize { w: 200, h: 100 });
        let pixel = |x, y| pixel_at(&view, &camera, film, Vec2::new(x, y));
        assert_eq!(pixel(0.5, 0.501), Some((50, 50)));
        assert_eq!(pixel(0.2501, 0.001), Some((0, 0)));
        assert_eq!(pixel(0.2, 0.5), None);
    }
}
