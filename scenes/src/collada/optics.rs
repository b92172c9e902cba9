//! `<camera>`: the angles of view and the clip distances.
//!
//! [`kit::Camera`] gets the frame of the file: `xfov` and `yfov` if both exist. Otherwise the
//! missing angle follows from `tan(xfov/2) = aspect_ratio · tan(yfov/2)`, where `aspect_ratio` is
//! 4:3 if it is missing. [`crate::placement::for_film`] fits the frame to a film of another aspect
//! ratio.

use super::document::{Document, Element, child, children, descendant, describe, tag, text};
use super::finding::Finding;
use super::numbers::exactly;
use super::transform::Affine;
use crate::diagnostic::SceneError;
use crate::placement::FAR_AWAY;
use kit::camera::scale_fov;
use kit::{Camera, Mat3, Vec3};
use std::f64::consts::PI;

/// Aspect ratio (width / height) without `aspect_ratio`: that of the assignment's images.
const DEFAULT_ASPECT: f64 = 4.0 / 3.0;

/// A camera in local space: angles in degrees, clip distances in the file's unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Optics {
    h_fov: f64,
    v_fov: f64,
    n_clip: f64,
    f_clip: f64,
}

/// Reads a camera. `None`, with a warning, if it is not perspective. An error if it has no valid
/// angle of view; other values that are not valid are ignored, with a warning.
pub(super) fn read<'a>(
    doc: &Document<'a>,
    camera: Element<'a>,
) -> Result<Option<Optics>, SceneError> {
    let common = descendant(camera, &["optics", "technique_common"]);
    let Some(perspective) = common.and_then(|common| child(common, "perspective")) else {
        let other = common.and_then(|common| children(common).next());
        let what = other.map_or("no optics".to_owned(), |other| format!("<{}>", tag(other)));
        let title = format!("{} has {what}", describe(camera));
        let expected = "expected <perspective>; without another camera, the scene is framed";
        doc.on(camera, title, expected).warn();
        return Ok(None);
    };
    let degrees = |name: &str| {
        let expected = "degrees from 0.001 to 179.999";
        let is_valid = |angle| (0.001..=179.999).contains(&angle);
        optional(doc, perspective, name, expected, is_valid)
    };
    let angles = (degrees("xfov"), degrees("yfov"));
    if let Some(damaged) = in_radians(doc, perspective, angles) {
        return Err(damaged.into());
    }
    // Outside of this range the missing angle would round to 0 or 180 degrees.
    let is_valid = |aspect| (0.001..=1000.0).contains(&aspect);
    let expected = "a number from 0.001 to 1000";
    let aspect =
        optional(doc, perspective, "aspect_ratio", expected, is_valid).unwrap_or(DEFAULT_ASPECT);
    let (h_fov, v_fov) = match angles {
        (Some(x), Some(y)) => (x, y),
        (Some(x), None) => (x, scale_fov(x, 1.0 / aspect)),
        (None, Some(y)) => (scale_fov(y, aspect), y),
        (None, None) => {
            let title = "<perspective> has no angle of view";
            let finding = doc.on(perspective, title, "expected <xfov> or <yfov>, in degrees");
            return Err(finding.into());
        }
    };
    let is_valid = |near| (0.0..FAR_AWAY).contains(&near);
    let near = optional(
        doc,
        perspective,
        "znear",
        "a number >= 0, below 1e30",
        is_valid,
    );
    let near = near.unwrap_or(0.0);
    let beyond = format!("more than znear, {near}");
    let far = optional(doc, perspective, "zfar", &beyond, |far| far > near);
    Ok(Some(Optics {
        h_fov,
        v_fov,
        n_clip: near,
        f_clip: far.unwrap_or(FAR_AWAY),
    }))
}

/// The error for a camera that a converter has damaged: assimp 5 writes angles in radians, beside
/// an `aspect_ratio` of 0.
fn in_radians<'r, 'a>(
    doc: &'r Document<'a>,
    perspective: Element<'a>,
    angles: (Option<f64>, Option<f64>),
) -> Option<Finding<'r, 'a>> {
    let aspect = child(perspective, "aspect_ratio").map(text)?;
    let (name, angle) = match angles {
        (Some(x), None) => ("xfov", x),
        (None, Some(y)) => ("yfov", y),
        _ => return None,
    };
    if aspect.parse() != Ok(0.0) || angle >= PI {
        return None;
    }
    let title = format!("{name} is {angle} degrees, which looks like radians");
    let expected =
        "expected degrees; aspect_ratio is 0, too, as a converter writes for every camera";
    Some(doc.on(child(perspective, name)?, title, expected))
}

/// The number in the child `name`, if there is one. `None`, with a warning, if it is not valid.
fn optional<'a>(
    doc: &Document<'a>,
    parent: Element<'a>,
    name: &str,
    expected: &str,
    is_valid: impl Fn(f64) -> bool,
) -> Option<f64> {
    let element = child(parent, name)?;
    let ignored = format!("<{name}> is ignored");
    match exactly(doc, element, name) {
        Ok([number]) if is_valid(number) => Some(number),
        Ok([number]) => {
            let title = format!("{name} is {number}");
            doc.on(element, title, format!("expected {expected}"))
                .help(ignored)
                .warn();
            None
        }
        Err(error) => {
            doc.warn_of(error, &ignored);
            None
        }
    }
}

impl Optics {
    /// The camera in world space, with orthonormal axes. `None` if it has no direction after the
    /// transform. Scale and mirroring of the transform are ignored.
    pub(super) fn place(&self, to_world: &Affine) -> Option<Camera> {
        let backward = to_world.direction(Vec3::Z).try_normalize()?;
        let up = to_world.direction(Vec3::Y).try_normalize()?;
        let c2w: Mat3 = Camera::look_at(backward, Vec3::ZERO, up).ok()?;
        Some(Camera {
            pos: to_world.t,
            c2w,
            h_fov: self.h_fov,
            v_fov: self.v_fov,
            n_clip: self.n_clip,
            f_clip: self.f_clip,
        })
    }
}
