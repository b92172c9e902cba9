//! The picture of the 3D view: ray-traced, at the resolution that the time allows.

use crate::cut::Cut;
use crate::project::Projection;
use crate::scene_data::SceneData;
use crate::tree_walk;
use kit::camera::half_tan;
use kit::{Camera, Hit, PrimId, Primitive, Spectrum, Vec2, Vec3};
use pathtracer::{Accel, Counters, layers, tone};
use raygen::generate_ray;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// What the surfaces of the view look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewStyle {
    /// The colours of the materials, lit from the camera.
    Materials,
    /// The primitives below a node of the tree: one colour for each child.
    Node(u32),
}

/// What to trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewRequest {
    /// The camera, with the angles of the view.
    pub camera: Camera,
    /// Width and height of the view in pixels.
    pub size: (u32, u32),
    /// The look of surfaces.
    pub style: ViewStyle,
    /// Whether the edges of triangles are drawn.
    pub edges: bool,
    /// The plane that cuts it open.
    pub cut: Option<Cut>,
}

/// What one ray of the view hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewHit {
    /// Distance from the camera; infinite for a miss.
    pub t: f32,
    /// The primitive.
    pub prim: u32,
    /// Barycentric weights of the second and the third vertex.
    pub uv: [f32; 2],
}

/// A traced view.
#[derive(Clone, Debug)]
pub struct ViewPicture {
    /// What was asked for.
    pub request: ViewRequest,
    /// Width and height in traced pixels: at most those of the request.
    pub size: (u32, u32),
    /// Red, green, blue and opacity (0 for a miss), row by row from the top left.
    pub pixels: Vec<[u8; 4]>,
    /// The hits, in the same order.
    pub hits: Vec<ViewHit>,
}

impl ViewPicture {
    /// The hit at a position of the film, in [0, 1]² from the bottom left; `None` for a miss.
    pub fn hit_at(&self, film: Vec2) -> Option<ViewHit> {
        let (w, h) = (f64::from(self.size.0), f64::from(self.size.1));
        let (x, y) = ((film.x * w).floor(), ((1.0 - film.y) * h).floor());
        let inside = (0.0..w).contains(&x) && (0.0..h).contains(&y);
        let hit = inside.then(|| self.hits[y as usize * self.size.0 as usize + x as usize])?;
        hit.t.is_finite().then_some(hit)
    }

    /// Where a primitive is visible: runs of pixels, as the row from the top and the columns from
    /// the first one to the one behind the last.
    pub fn runs_of(&self, prim: u32) -> impl Iterator<Item = (usize, std::ops::Range<usize>)> {
        let rows = self.hits.chunks(self.size.0.max(1) as usize).enumerate();
        rows.flat_map(move |(row, hits)| {
            let mut at = 0;
            let runs = hits.chunk_by(|a, b| a.prim == b.prim);
            runs.filter_map(move |run| {
                let columns = at..at + run.len();
                at = columns.end;
                (run[0].prim == prim).then_some((row, columns))
            })
        })
    }

    /// Whether a point at this position and distance is hidden by a surface.
    pub fn hides(&self, film: Vec2, distance: f64) -> bool {
        self.hit_at(film)
            .is_some_and(|hit| f64::from(hit.t) < distance * (1.0 - HIDING_MARGIN))
    }
}

/// How much nearer a surface has to be to hide a line: lines on a surface are visible.
const HIDING_MARGIN: f64 = 2e-3;

/// Traces the request with `size` pixels on rayon's current thread pool. Once `stop` is set, the
/// remaining rows stay empty.
pub fn trace(
    data: &SceneData,
    request: &ViewRequest,
    size: (u32, u32),
    stop: &AtomicBool,
) -> ViewPicture {
    let surfaces = Surfaces::new(data, request, size);
    let (w, h) = size;
    let rows: Vec<Vec<([u8; 4], ViewHit)>> = (0..h)
        .into_par_iter()
        .map(|row| {
            if stop.load(Ordering::Relaxed) {
                return vec![MISS; w as usize];
            }
            let y = (f64::from(h - row) - 0.5) / f64::from(h);
            (0..w)
                .map(|x| surfaces.pixel(Vec2::new((f64::from(x) + 0.5) / f64::from(w), y)))
                .collect()
        })
        .collect();
    let (pixels, hits) = rows.into_iter().flatten().unzip();
    ViewPicture {
        request: *request,
        size,
        pixels,
        hits,
    }
}

const MISS: ([u8; 4], ViewHit) = (
    [0; 4],
    ViewHit {
        t: f32::INFINITY,
        prim: u32::MAX,
        uv: [0.0; 2],
    },
);

/// The scene in the style of a request.
struct Surfaces<'a> {
    data: &'a SceneData,
    camera: Camera,
    /// The tree that rays traverse; that of the scene, or of a node.
    node: Option<NodeColors>,
    edges: bool,
    cut: Option<Cut>,
    projection: Projection,
    /// Width and height in pixels.
    size: Vec2,
    /// The height of a pixel at a distance of 1.
    pixel_at_one: f64,
}

/// The tree below a node, and the colours of its primitives.
struct NodeColors {
    tree: Accel,
    color_of: Vec<Spectrum>,
}

/// Colour of primitives in the left child: the assignment's program's.
pub const LEFT_COLOR: Spectrum = Spectrum::new(0.6, 0.6, 1.0);
/// Colour of primitives in the right child: the assignment's program's.
pub const RIGHT_COLOR: Spectrum = Spectrum::new(0.8, 0.8, 1.0);

impl<'a> Surfaces<'a> {
    fn new(data: &'a SceneData, request: &ViewRequest, size: (u32, u32)) -> Surfaces<'a> {
        let node = match request.style {
            ViewStyle::Materials => None,
            ViewStyle::Node(node) => data.bvh().map(|tree| {
                let mut color_of = vec![LEFT_COLOR; data.scene().len()];
                for prim in tree_walk::right_primitives(tree, node) {
                    color_of[prim.0 as usize] = RIGHT_COLOR;
                }
                NodeColors {
                    tree: Accel::Bvh(tree_walk::below(tree, node)),
                    color_of,
                }
            }),
        };
        Surfaces {
            data,
            camera: request.camera,
            node,
            edges: request.edges,
            cut: request.cut,
            projection: Projection::new(&request.camera),
            size: Vec2::new(f64::from(size.0), f64::from(size.1)),
            pixel_at_one: 2.0 * half_tan(request.camera.v_fov) / f64::from(size.1),
        }
    }

    fn pixel(&self, sensor: Vec2) -> ([u8; 4], ViewHit) {
        let whole = generate_ray(&self.camera, sensor);
        let limited = self.cut.map_or(Some(whole), |cut| cut.limit(&whole));
        let Some(mut ray) = limited else {
            return MISS;
        };
        let scene = self.data.scene();
        let accel = match &self.node {
            Some(node) => &node.tree,
            None => &self.data.prepared.accel,
        };
        let d = ray.d;
        let Some(hit) = accel.closest(scene, &mut ray, None, &mut Counters::default()) else {
            return MISS;
        };
        let facing = AMBIENT + (1.0 - AMBIENT) * hit.n.dot(d).abs();
        let mut color = self.color(&hit) * facing;
        if self.edges {
            color = color * (1.0 - EDGE_OPACITY * self.edge_strength(sensor, hit.prim, hit.t));
        }
        let [r, g, b] = tone::to_bytes(color * std::f64::consts::FRAC_1_SQRT_2);
        let hit = ViewHit {
            t: hit.t as f32,
            prim: hit.prim.0,
            uv: [hit.uv.x as f32, hit.uv.y as f32],
        };
        ([r, g, b, 255], hit)
    }

    fn color(&self, hit: &Hit) -> Spectrum {
        if let Some(node) = &self.node {
            return node.color_of[hit.prim.0 as usize];
        }
        let scene = self.data.scene();
        let material = scene.material_of(hit.prim);
        let color = self
            .data
            .prepared
            .textures
            .at(scene, hit)
            .unwrap_or(Spectrum::WHITE)
            * layers::albedo(material);
        match color.is_black() && matches!(material, kit::Material::Emission { .. }) {
            true => Spectrum::WHITE,
            // Nothing is so dark that its edges disappear.
            false => color * (1.0 - DARKEST) + Spectrum::grey(DARKEST),
        }
    }

    /// How strongly the edges of a triangle show at a position on the film, from 0 to 1: fully
    /// within half a pixel of an edge, and not at all for triangles of a few pixels, which would be
    /// all edge.
    fn edge_strength(&self, sensor: Vec2, prim: PrimId, t: f64) -> f64 {
        let Primitive::Triangle(triangle) = self.data.scene().primitive(prim) else {
            return 0.0;
        };
        let p = [triangle.p0, triangle.p1, triangle.p2];
        // A triangle that is smaller than that is not projected at all.
        let longest = (p[1] - p[0])
            .length_squared()
            .max((p[2] - p[0]).length_squared());
        if longest < (MIN_HEIGHT * self.pixel_at_one * t).powi(2) {
            return 0.0;
        }
        let pixel = |p: Vec3| Some(self.projection.point(p)? * self.size);
        let at = sensor * self.size;
        let (mut nearest, mut smallest) = (f64::INFINITY, f64::INFINITY);
        for i in 0..3 {
            let (a, b) = (p[(i + 1) % 3], p[(i + 2) % 3]);
            let visible = self.projection.segment(a, b);
            let Some((a, b)) = visible.and_then(|(a, b)| Some((pixel(a)?, pixel(b)?))) else {
                continue;
            };
            let along = (b - a).normalize_or_zero();
            let distance = |p: Vec2| along.perp_dot(p - a).abs();
            nearest = nearest.min(distance(at));
            if let Some(opposite) = pixel(p[i]) {
                smallest = smallest.min(distance(opposite));
            }
        }
        let fade = ((smallest - MIN_HEIGHT) / MIN_HEIGHT).clamp(0.0, 1.0);
        fade * (EDGE_WIDTH + 0.5 - nearest).clamp(0.0, 1.0)
    }
}

/// The brightness of surfaces that are seen edge-on.
const AMBIENT: f64 = 0.35;
/// The smallest brightness of a colour.
const DARKEST: f64 = 0.04;
/// The opacity of edges.
const EDGE_OPACITY: f64 = 0.55;
/// Half of the width of an edge in pixels.
const EDGE_WIDTH: f64 = 0.5;
/// The height of a triangle in pixels below which its edges are not drawn.
const MIN_HEIGHT: f64 = 3.0;
