//! Clip planes for Mitsuba.
//!
//! Here a camera ray is clipped at lengths along the ray, in Mitsuba at planes: at a depth `z`
//! along the camera's axis. The two agree on what is seen of a surface if the surface is as a whole
//! inside or outside of both. So each surface is cut to what the camera can see, and its depths and
//! distances are compared with the clip distances.

use crate::Job;
use kit::camera::half_tan;
use kit::{Camera, Primitive, Scene, Vec3};

/// Depths along the camera's axis between which Mitsuba sees surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ClipPlanes {
    pub(super) near: f64,
    pub(super) far: f64,
}

/// The smallest depth of what is seen of a surface, and the largest distance.
#[derive(Clone, Copy, Debug)]
struct Seen {
    depth: f64,
    distance: f64,
}

/// The near plane if a surface touches the camera, relative to the largest distance.
const NEAREST: f64 = 1e-6;

impl ClipPlanes {
    /// Clip planes that show what the camera of `job` shows: those of the camera where they hide a
    /// surface, else planes before and behind all surfaces. A problem for each of the camera's clip
    /// distances that cuts a surface.
    pub(super) fn of(scene: &Scene, job: &Job, problems: &mut Vec<String>) -> ClipPlanes {
        let Camera { n_clip, f_clip, .. } = job.camera;
        let (mut nearest, mut farthest) = (f64::INFINITY, 0.0_f64);
        let (mut hides_near, mut hides_far) = (false, false);
        let (mut cut_near, mut cut_far) = (None, None);
        for (i, primitive) in scene.primitives().enumerate() {
            let Some(seen) = seen(&job.camera, &primitive) else {
                continue;
            };
            nearest = nearest.min(seen.depth);
            farthest = farthest.max(seen.distance);
            if seen.distance < n_clip {
                hides_near = true;
            } else if seen.depth < n_clip {
                cut_near.get_or_insert(i);
            }
            if seen.depth > f_clip {
                hides_far = true;
            } else if seen.distance > f_clip {
                cut_far.get_or_insert(i);
            }
        }
        let mut check = |cut: Option<usize>, name: &str, distance: f64| {
            if let Some(i) = cut {
                let object = &scene.objects[scene.object_of[i] as usize];
                problems.push(format!(
                    "the camera: {name} {distance} cuts {}, and Mitsuba cuts at a plane: choose another \
                     camera",
                    object.name
                ));
            }
        };
        check(cut_near, "znear", n_clip);
        check(cut_far, "zfar", f_clip);
        if farthest == 0.0 {
            // Nothing is seen.
            return ClipPlanes {
                near: 1.0,
                far: 2.0,
            };
        }
        ClipPlanes {
            near: if hides_near {
                n_clip
            } else {
                (0.5 * nearest).max(NEAREST * farthest)
            },
            far: if hides_far { f_clip } else { 2.0 * farthest },
        }
    }
}

/// What the camera can see of a surface; `None` if it is out of the picture. Of a sphere, all of it
/// if it can see a part.
fn seen(camera: &Camera, primitive: &Primitive<'_>) -> Option<Seen> {
    let local = |p: Vec3| camera.c2w.transpose() * (p - camera.pos);
    let (x, y) = (half_tan(camera.h_fov), half_tan(camera.v_fov));
    // Planes through the camera, with the picture on the side of their normals. It looks along -z.
    let planes = [
        Vec3::new(1.0, 0.0, -x),
        Vec3::new(-1.0, 0.0, -x),
        Vec3::new(0.0, 1.0, -y),
        Vec3::new(0.0, -1.0, -y),
        Vec3::NEG_Z,
    ];
    match primitive {
        Primitive::Triangle(t) => {
            let mut polygon: Vec<Vec3> = [t.p0, t.p1, t.p2].map(local).to_vec();
            for plane in planes {
                polygon = cut(&polygon, plane);
            }
            let depths = polygon.iter().map(|p| -p.z);
            let distances = polygon.iter().map(|p| p.length());
            (!polygon.is_empty()).then(|| Seen {
                depth: depths.fold(f64::INFINITY, f64::min).max(0.0),
                distance: distances.fold(0.0, f64::max),
            })
        }
        Primitive::Sphere(s) => {
            let center = local(s.center);
            let is_seen = |plane: &Vec3| center.dot(*plane) >= -s.radius * plane.length();
            planes.iter().all(is_seen).then(|| Seen {
                depth: (-center.z - s.radius).max(0.0),
                distance: center.length() + s.radius,
            })
        }
    }
}

/// The part of a polygon on the side of a plane through the origin that `normal` points to
/// (Sutherland and Hodgman, "Reentrant polygon clipping", 1974).
fn cut(polygon: &[Vec3], normal: Vec3) -> Vec<Vec3> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &p) in polygon.iter().enumerate() {
        let next = polygon[(i + 1) % polygon.len()];
        let (here, there) = (p.dot(normal), next.dot(normal));
        if here >= 0.0 {
            kept.push(p);
        }
        if (here >= 0.0) != (there >= 0.0) {
            kept.push(p + (next - p) * (here / (here - there)));
        }
    }
    kept
}
