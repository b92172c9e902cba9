//! Transforms: the transform elements of a `<node>`, and the up axis of the file.

use super::document::{Document, Element, child, describe, tag, truncated};
use super::limits::in_world;
use super::numbers::{exactly, floats};
use crate::diagnostic::SceneError;
use kit::{Mat3, Vec3, math};

/// The affine map `p -> m·p + t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub(super) m: Mat3,
    pub(super) t: Vec3,
}

impl Affine {
    pub(super) const IDENTITY: Affine = Affine {
        m: Mat3::IDENTITY,
        t: Vec3::ZERO,
    };

    fn linear(m: Mat3) -> Affine {
        Affine { m, t: Vec3::ZERO }
    }

    /// The composition that applies `inner` first, then this.
    pub(super) fn after(&self, inner: &Affine) -> Affine {
        Affine {
            m: self.m * inner.m,
            t: self.point(inner.t),
        }
    }

    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        self.m * p + self.t
    }

    pub(super) fn direction(&self, d: Vec3) -> Vec3 {
        self.m * d
    }

    /// Whether the images of the unit vectors and of the origin are within the limits of world
    /// space.
    pub(super) fn stays_in_world(&self) -> bool {
        [self.m.x_axis, self.m.y_axis, self.m.z_axis, self.t]
            .into_iter()
            .all(in_world)
    }

    /// Whether the map changes the handedness.
    pub(super) fn mirrors(&self) -> bool {
        self.m.determinant() < 0.0
    }

    /// The matrix for normals, up to their length: the inverse transpose, computed as the cofactor
    /// matrix times the sign of the determinant, which also exists for singular maps.
    pub(super) fn for_normals(&self) -> Mat3 {
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
    let Some(element) = child(root, "asset").and_then(|asset| child(asset, "up_axis")) else {
        return Ok(Affine::IDENTITY);
    };
    let text = element.text().unwrap_or_default().trim();
    match text {
        "Y_UP" => Ok(Affine::IDENTITY),
        "Z_UP" => Ok(Affine::linear(Mat3::from_cols(
            Vec3::NEG_X,
            Vec3::Z,
            Vec3::Y,
        ))),
        "X_UP" => Ok(Affine::linear(Mat3::from_cols(
            Vec3::Y,
            Vec3::NEG_X,
            Vec3::Z,
        ))),
        other => Err(doc
            .on(
                element,
                format!("`{}` is not an axis", truncated(other)),
                "expected X_UP, Y_UP or Z_UP",
            )
            .help("write the up axis that the modelling program uses")
            .into()),
    }
}

/// The transform of a child element of `<node>`; `None` if it is not a transform element.
pub(super) fn read<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
) -> Result<Option<Affine>, SceneError> {
    let affine = match tag(element) {
        "matrix" => matrix(doc, element)?,
        "translate" => Affine {
            m: Mat3::IDENTITY,
            t: exactly::<3>(doc, element, "x y z")?.into(),
        },
        "scale" => {
            let factors: Vec3 = exactly::<3>(doc, element, "x y z")?.into();
            Affine::linear(Mat3::from_diagonal(factors))
        }
        "rotate" => rotate(doc, element)?,
        "lookat" => look_at(doc, element)?,
        "skew" => {
            let title = "<skew> is not supported";
            return Err(doc
                .on(
                    element,
                    title,
                    "expected matrix, translate, rotate, scale or lookat",
                )
                .help("write the same transform as a <matrix>")
                .into());
        }
        _ => return Ok(None),
    };
    Ok(Some(affine))
}

/// Sixteen numbers in row-major order. The last row must be 0 0 0 1; missing numbers of it are
/// filled in, with a warning.
fn matrix<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Affine, SceneError> {
    const LAST_ROW: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
    let mut numbers = floats(doc, element)?;
    let found = numbers.len();
    let diagnostic = |title: String| {
        let expected = "expected 16 numbers, row by row, the last row 0 0 0 1";
        doc.on(element, title, expected)
    };
    if !(12..=16).contains(&found) {
        let help = "write four rows of four numbers";
        return Err(diagnostic(format!("<matrix> has {found} numbers"))
            .help(help)
            .into());
    }
    numbers.extend(&LAST_ROW[found - 12..]);
    if numbers[12..] != LAST_ROW {
        return Err(diagnostic("the last row of <matrix> is not 0 0 0 1".into())
            .help("only affine transforms are supported; a column-major matrix must be transposed")
            .into());
    }
    if found < 16 {
        doc.warn(|| {
            diagnostic(format!("<matrix> has {found} numbers"))
                .relabel("missing numbers are filled in from the last row 0 0 0 1")
        });
    }
    let row = |i: usize| Vec3::new(numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2]);
    Ok(Affine {
        m: Mat3::from_cols(row(0), row(1), row(2)).transpose(),
        t: Vec3::new(numbers[3], numbers[7], numbers[11]),
    })
}

/// An axis and an angle in degrees.
fn rotate<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Affine, SceneError> {
    let [x, y, z, degrees] = exactly::<4>(doc, element, "an axis x y z and an angle in degrees")?;
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

/// Eye, point of interest and up: the transform of a camera that looks along its -z from the eye to
/// the point of interest.
fn look_at<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Affine, SceneError> {
    let n = exactly::<9>(doc, element, "eye x y z, point of interest x y z, up x y z")?;
    let [eye, interest, up] = [0, 3, 6].map(|i| Vec3::new(n[i], n[i + 1], n[i + 2]));
    let m = kit::Camera::look_at(eye, interest, up).map_err(|error| {
        doc.on(
            element,
            format!("<lookat> has no valid direction: {error}"),
            "expected eye, point of interest, up",
        )
        .help("correct the nine numbers")
    })?;
    Ok(Affine { m, t: eye })
}
