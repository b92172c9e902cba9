//! What a picture shows, and everything that rendering it needs.

use crate::args::Shade;
use crate::lit::{LightSettings, render_lit_tiles};
use crate::normals::render_normal_tiles;
use crate::packet::{Guide, PacketRenderer};
use crate::pixel_contents::PixelContents;
use crate::rendered::RenderedTile;
use crate::{Accel, AccelKind, Job, Textures};
use kit::film::Cell;
use kit::{Environment, LitScene, Scene};
use std::sync::atomic::AtomicBool;

/// What a picture shows.
#[derive(Clone, Debug)]
pub enum Picture {
    /// Surface normals.
    Normals(Scene),
    /// Light.
    Lit(LitScene),
}

impl Picture {
    /// Selects by the flag `--shade`.
    pub fn new(shade: Shade, scene: Scene, environment: Option<Environment>) -> Picture {
        match shade {
            Shade::Normals => Picture::Normals(scene),
            Shade::Lit => Picture::Lit(LitScene::new(scene, environment)),
            Shade::Auto => {
                let lit = LitScene::new(scene.clone(), environment);
                if lit.has_light() {
                    Picture::Lit(lit)
                } else {
                    Picture::Normals(scene)
                }
            }
        }
    }

    /// The geometry; of a lit picture with its area lights.
    pub fn scene(&self) -> &Scene {
        match self {
            Picture::Normals(scene) => scene,
            Picture::Lit(lit) => &lit.scene,
        }
    }

    /// What the pixels of `job` can show. Nothing is known, nor asked, of a picture of normals.
    pub fn pixel_contents(&self, job: &Job, settings: &LightSettings) -> PixelContents {
        match self {
            Picture::Normals(_) => PixelContents::default(),
            Picture::Lit(lit) => settings.pixel_contents(lit, job),
        }
    }

    /// Whether the picture shows light.
    pub fn is_lit(&self) -> bool {
        matches!(self, Picture::Lit(_))
    }
}

/// A picture's scene with its textures and its tree: everything that rendering needs.
#[derive(Clone, Debug)]
pub struct PreparedScene {
    /// What the picture shows.
    pub picture: Picture,
    /// The textures of the scene.
    pub textures: Textures,
    /// Built over the scene.
    pub accel: Accel,
    /// Where caustic rays are sent, if any are.
    pub guide: Guide,
}

impl PreparedScene {
    /// Builds the tree of `kind`.
    pub fn new(picture: Picture, textures: Textures, kind: AccelKind) -> PreparedScene {
        PreparedScene {
            accel: Accel::build(kind, picture.scene()),
            guide: Guide::default(),
            picture,
            textures,
        }
    }

    /// The geometry.
    pub fn scene(&self) -> &Scene {
        self.picture.scene()
    }

    /// Whether paths do what `settings` ask for and only paths in packets do, if there is light:
    /// whether they share what they find, and send caustic rays.
    pub fn has_packets_if_needed(&self, job: &Job, settings: &LightSettings) -> bool {
        match &self.picture {
            Picture::Lit(lit) if lit.has_light() && settings.need_packets() => {
                let (textures, contents) = (&self.textures, PixelContents::default());
                let (accel, guide) = (&self.accel, &self.guide);
                PacketRenderer::new(lit, textures, accel, job, settings, &contents, guide).is_some()
            }
            _ => true,
        }
    }

    /// Renders some tiles of the picture: those of [`render_lit`](crate::render_lit), or of
    /// normals. `finish` is called with each tile and returns what to keep of it. A tile that is in
    /// progress when `stop` is set has black pixels without samples. `contents` must be the
    /// [`Picture::pixel_contents`] of `job`.
    pub fn render_tiles<R: Send>(
        &self,
        job: &Job,
        settings: &LightSettings,
        contents: &PixelContents,
        tiles: &[Cell],
        stop: &AtomicBool,
        finish: &(dyn Fn(RenderedTile) -> R + Sync),
    ) -> Vec<R> {
        match &self.picture {
            Picture::Normals(scene) => {
                render_normal_tiles(scene, &self.accel, job, tiles, stop, finish)
            }
            Picture::Lit(lit) => render_lit_tiles(
                lit,
                &self.textures,
                &self.accel,
                job,
                settings,
                contents,
                &self.guide,
                tiles,
                stop,
                finish,
            ),
        }
    }
}
