//! Transforms: the transform elements of a `<node>`, and the up axis of the file.

use super::document::{Document, Element, children, descendant, describe, tag, text, truncated};
use super::limits::in_world;
use super::numbers::{exactly, floats};
use crate::diagnostic::SceneError;
use kit::camera::PlaceError;
use kit::{Mat3, Vec3, math};

/// The affine map `p -> m·p + t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine {
    pub(crate) m: Mat3,
    pub(crate) t: Vec3,
}

impl Affine {
    pub(crate) const IDENTITY: Affine = Affine {
        m: Mat3::IDENTITY,
        t: Vec3::ZERO,
    };

    fn linear(m: Mat3) -> Affine {
        Affine { m, t: Vec3::ZERO }
    }

    /// The composition that applies `inner` first, then this.
    pub(crate) fn after(&self, inner: &Affine) -> Affine {
        Affine {
            m: self.m * inner.m,
            t: self.point(inner.t),
        }
    }

    pub(crate) fn point(&self, p: Vec3) -> Vec3 {
        self.m * p + self.t
    }

    pub(crate) fn direction(&self, d: Vec3) -> Vec3 {
        self.m * d
    }

    /// Whether the images of the unit vectors and of the origin are within the limits of world
    /// space.
    pub(crate) fn stays_in_world(&self) -> bool {
        [self.m.x_axis, self.m.y_axis, self.m.z_axis, self.t]
            .into_iter()
            .all(in_world)
    }

    /// The matrix of three rows of four numbers; those after them are not read.
    pub(super) fn of_rows(n: &[f64]) -> Affine {
        let row = |i: usize| Vec3::new(n[4 * i], n[4 * i + 1], n[4 * i + 2]);
        Affine {
            m: Mat3::from_cols(row(0), row(1), row(2)).transpose(),
            t: Vec3::new(n[3], n[7], n[11]),
        }
    }

    /// Whether the map changes the handedness.
    pub(super) fn mirrors(&self) -> bool {
        self.m.determinant() < 0.0
    }

    /// The matrix for normals, up to their length: the inverse transpose, computed as the cofactor
    /// matrix times the sign of the determinant, which also exists for singular maps.
    pub(crate) fn for_normals(&self) -> Mat3 {
        let Mat3 {
            x_axis,
            y_axis,
            z_axis,
        } = self.m;
        let cofactors = Mat3::from_cols(
            y_axis.cross(z_axis),
            z_axis.cross(x_axis),
            x_axis.cross(y_axis),
        );
        if self.mirrors() {
            cofactors * -1.0
        } else {
            cofactors
        }
    }
}

/// The transform from the axes of the file to world space, where +y is up.
///
/// Z_UP maps (x, y, z) to (-x, z, y), as the original course program does. This differs from the
/// standard by half a turn about y. X_UP maps to (-y, x, z), as in the standard. The default is
/// Y_UP.
pub(super) fn up_axis<'a>(doc: &Document<'a>, root: Element<'a>) -> Result<Affine, SceneError> {
    let Some(element) = descendant(root, &["asset", "up_axis"]) else {
        return Ok(Affine::IDENTITY);
    };
    let (x, y, z) = match text(element).as_str() {
        "Y_UP" => return Ok(Affine::IDENTITY),
        "Z_UP" => (Vec3::NEG_X, Vec3::Z, Vec3::Y),
        "X_UP" => (Vec3::Y, Vec3::NEG_X, Vec3::Z),
        "" => {
            doc.on(element, "<up_axis> is empty", "using Y_UP").warn();
            return Ok(Affine::IDENTITY);
        }
        other => {
            let title = format!("`{}` is not an axis", truncated(other));
            return Err(doc
                .on(element, title, "expected X_UP, Y_UP or Z_UP")
                .help("write the up axis that the modelling program uses")
                .into());
        }
    };
    Ok(Affine::linear(Mat3::from_cols(x, y, z)))
}

/// Whether a child of `<node>` with this tag is one of its transforms.
pub(super) fn is_transform(tag: &str) -> bool {
    matches!(
        tag,
        "matrix" | "translate" | "scale" | "rotate" | "lookat" | "skew"
    )
}

/// The transform of a `<node>` relative to its parent: the last transform element applies first.
pub(super) fn of_node<'a>(doc: &Document<'a>, node: Element<'a>) -> Result<Affine, SceneError> {
    let elements = children(node).filter(|element| is_transform(tag(*element)));
    elements
        .map(|element| read(doc, element))
        .try_fold(Affine::IDENTITY, |outer, inner| Ok(outer.after(&inner?)))
}

fn read<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Affine, SceneError> {
    match tag(element) {
        "matrix" => matrix(doc, element),
        "translate" => Ok(Affine {
            m: Mat3::IDENTITY,
            t: exactly::<3>(doc, element, "x y z")?.into(),
        }),
        "scale" => {
            let factors: Vec3 = exactly::<3>(doc, element, "x y z")?.into();
            Ok(Affine::linear(Mat3::from_diagonal(factors)))
        }
        "rotate" => rotate(doc, element),
        "lookat" => look_at(doc, element),
        _ => skew(doc, element),
    }
}

/// Rounding of the last row of a matrix that was computed with `float`.
const LAST_ROW_TOLERANCE: f64 = 1e-6;

/// Sixteen numbers in row-major order. The last row must be 0 0 0 1, apart from rounding; if it is
/// cut off, the missing numbers are filled in, with a warning.
pub(super) fn matrix<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Affine, SceneError> {
    const LAST_ROW: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
    let mut numbers = floats(doc, element)?;
    let found = numbers.len();
    let finding = |title: String| {
        let expected = "expected 16 numbers, row by row, the last row 0 0 0 1";
        doc.on(element, title, expected)
    };
    let is_rounded = |(number, exact): (&f64, f64)| (number - exact).abs() <= LAST_ROW_TOLERANCE;
    let is_cut_off = (12..16).contains(&found) && LAST_ROW.starts_with(&numbers[12..]);
    if is_cut_off {
        numbers.extend(&LAST_ROW[found - 12..]);
        finding(format!("<matrix> has {found} numbers"))
            .relabel("missing numbers are filled in from the last row 0 0 0 1")
            .warn();
    } else if found != 16 {
        return Err(finding(format!("<matrix> has {found} numbers"))
            .help("write four rows of four numbers")
            .into());
    } else if !numbers[12..].iter().zip(LAST_ROW).all(is_rounded) {
        return Err(finding("the last row of <matrix> is not 0 0 0 1".into())
            .help("only affine transforms are supported; a column-major matrix must be transposed")
            .into());
    }
    Ok(Affine::of_rows(&numbers))
}

/// An axis and an angle in degrees. An angle of 0 needs no axis.
fn rotate<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Affine, SceneError> {
    let [x, y, z, degrees] = exactly::<4>(doc, element, "an axis x y z and an angle in degrees")?;
    if degrees == 0.0 {
        return Ok(Affine::IDENTITY);
    }
    let axis = Vec3::new(x, y, z).try_normalize().ok_or_else(|| {
        let title = format!("{} has a rotation axis of length 0", describe(element));
        doc.on(element, title, "expected an axis that is not 0 0 0")
            .help("write the axis first, then the angle, such as 0 0 1 90")
    })?;
    let radians = degrees.to_radians();
    let (sin, cos) = (math::sin(radians), math::cos(radians));
    // Rodrigues' formula, v cos + (axis x v) sin + axis (axis.v)(1 - cos), for the three unit
    // vectors.
    let rotated = |v: Vec3| v * cos + axis.cross(v) * sin + axis * axis.dot(v) * (1.0 - cos);
    Ok(Affine::linear(Mat3::from_cols(
        rotated(Vec3::X),
        rotated(Vec3::Y),
        rotated(Vec3::Z),
    )))
}

/// An angle in degrees and two axes: moves each point along the first axis, by the tangent of the
/// angle times its coordinate along the second.
///
/// The text of the standard can be read in two ways. This is how Maya's exporter writes a shear,
/// and what the pictures of Khronos' conformance tests show.
fn skew<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Affine, SceneError> {
    let n = exactly::<7>(doc, element, "an angle in degrees and two axes x y z")?;
    let [first, second] = [1, 4].map(|i| Vec3::new(n[i], n[i + 1], n[i + 2]).try_normalize());
    let slope = math::tan(n[0].to_radians());
    match (first, second) {
        (Some(along), Some(across)) if n[0].abs() < 90.0 => {
            let column = |v: Vec3| v + along * (slope * across.dot(v));
            Ok(Affine::linear(Mat3::from_cols(
                column(Vec3::X),
                column(Vec3::Y),
                column(Vec3::Z),
            )))
        }
        _ => {
            let title = "<skew> has no valid axes or angle";
            let expected = "expected an angle between -90 and 90, and axes that are not 0 0 0";
            Err(doc
                .on(element, title, expected)
                .help("write the same transform as a <matrix>")
                .into())
        }
    }
}

/// Eye, point of interest and up: the transform of a camera that looks along its -z from the eye to
/// the point of interest.
fn look_at<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Affine, SceneError> {
    let n = exactly::<9>(doc, element, "eye x y z, point of interest x y z, up x y z")?;
    let [eye, interest, up] = [0, 3, 6].map(|i| Vec3::new(n[i], n[i + 1], n[i + 2]));
    let expected = "expected eye, point of interest, up";
    let m = match kit::Camera::look_at(eye, interest, up) {
        Err(PlaceError::UpAlongView) => {
            let title = "<lookat> has no valid up direction";
            doc.on(element, title, expected)
                .help("using a direction perpendicular to the view")
                .warn();
            let up = (interest - eye)
                .normalize_or_zero()
                .any_orthonormal_vector();
            kit::Camera::look_at(eye, interest, up)
        }
        m => m,
    };
    let m = m.map_err(|error| {
        let title = format!("<lookat> has no valid direction: {error}");
        doc.on(element, title, expected)
            .help("correct the nine numbers")
    })?;
    Ok(Affine { m, t: eye })
}
