//! Camera files: the format of the flag `-c` and of the key `D` of the original program.
//!
//! A file has twenty-eight numbers, separated by white space:
//!
//! ```text
//! hFov vFov aspect nClip fClip                   angles of view in degrees
//! pos.x pos.y pos.z target.x target.y target.z   world space
//! phi theta r minR maxR                          the same position about the target, in radians
//! c2w, row by row                                columns: right, up, backward
//! screenW screenH screenDist                     in pixels
//! ```
//!
//! Numbers are written with 17 significant digits, so reading a written file gives identical
//! values. `aspect`, `phi`, `theta`, `r` and `screenDist` follow from the other numbers: they are
//! written, but ignored when read.

use crate::collada::limits::MAX_COORDINATE;
use crate::diagnostic::{Diagnostic, SceneError};
use crate::placement::View;
use crate::text_file;
use kit::camera::half_tan;
use kit::{Camera, FilmSize, Mat3, Vec3, math};
use std::fmt;
use std::ops::Range;
use std::path::Path;

/// The content of a camera file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraFile {
    /// The camera and its target.
    pub view: View,
    /// The film that the camera was set up for.
    pub film: FilmSize,
    /// Smallest distance of an interactive camera from the target.
    pub min_r: f64,
    /// Largest distance of an interactive camera from the target.
    pub max_r: f64,
}

/// The names of the numbers, in the order of the file.
const NAMES: [&str; 28] = [
    "hFov",
    "vFov",
    "aspect",
    "nClip",
    "fClip", // line 1
    "pos.x",
    "pos.y",
    "pos.z",
    "target.x",
    "target.y",
    "target.z", // line 2
    "phi",
    "theta",
    "r",
    "minR",
    "maxR", // line 3
    "c2w[0][0]",
    "c2w[0][1]",
    "c2w[0][2]", // line 4
    "c2w[1][0]",
    "c2w[1][1]",
    "c2w[1][2]", //
    "c2w[2][0]",
    "c2w[2][1]",
    "c2w[2][2]", //
    "screenW",
    "screenH",
    "screenDist", // line 5
];

/// Tolerance for `c2w` to be a rotation: allows for rounding and for files with 7 digits.
const ROTATION_TOLERANCE: f64 = 1e-5;

/// `min_r` of a new file, relative to the distance from the target. The original's number.
const MIN_R_FACTOR: f64 = 0.05;
/// `max_r` of a new file, relative to the distance from the target. The original's number.
const MAX_R_FACTOR: f64 = 10.0;

/// Largest coordinate of a position or target. A camera that frames the largest valid scene is
/// outside of it.
const MAX_POSITION: f64 = 100.0 * MAX_COORDINATE;

/// Largest valid width or height.
const MAX_SCREEN: f64 = 1_000_000.0;

impl CameraFile {
    /// The camera file of a view on a film.
    pub fn new(view: View, film: FilmSize) -> CameraFile {
        let r = (view.camera.pos - view.target).length();
        CameraFile {
            view,
            film,
            min_r: MIN_R_FACTOR * r,
            max_r: MAX_R_FACTOR * r,
        }
    }

    /// Reads a camera file.
    pub fn load(path: impl AsRef<Path>) -> Result<CameraFile, SceneError> {
        let path = path.as_ref();
        let name = path.display().to_string();
        CameraFile::parse(&name, &text_file::read(path, &name)?.text)
    }

    /// Parses the text of a camera file. `name` is the file name for error messages.
    pub fn parse(name: &str, text: &str) -> Result<CameraFile, SceneError> {
        let numbers = Numbers::read(name, text)?;
        let n = &numbers.values;
        numbers.check(&[0, 1], "from 1e-9 to less than 180", |angle| {
            (1e-9..180.0).contains(&angle)
        })?;
        numbers.check(&[3], "a number >= 0", |near| near >= 0.0)?;
        numbers.check(&[4], "more than nClip", |far| far > n[3])?;
        let positions = [5, 6, 7, 8, 9, 10];
        numbers.check(&positions, &format!("at most {MAX_POSITION:e}"), |x| {
            x.abs() <= MAX_POSITION
        })?;
        numbers.check(&[25, 26], "an integer >= 1", |size| {
            (1.0..=MAX_SCREEN).contains(&size) && size.fract() == 0.0
        })?;
        let row = |i: usize| Vec3::new(n[i], n[i + 1], n[i + 2]);
        let c2w = Mat3::from_cols(row(16), row(19), row(22)).transpose();
        if !is_rotation(&c2w) {
            let diagnostic = numbers.diagnostic(
                16,
                "c2w is not a rotation",
                "expected a rotation matrix from here on",
            );
            let help = "its columns must be orthogonal unit vectors: right, up, backward";
            return Err(diagnostic.help(help).into());
        }
        let camera = Camera {
            pos: row(5),
            c2w,
            h_fov: n[0],
            v_fov: n[1],
            n_clip: n[3],
            f_clip: n[4],
        };
        Ok(CameraFile {
            view: View {
                camera,
                target: row(8),
            },
            film: FilmSize {
                w: n[25] as u32,
                h: n[26] as u32,
            },
            min_r: n[14],
            max_r: n[15],
        })
    }
}

fn is_rotation(m: &Mat3) -> bool {
    let square = m.transpose() * *m;
    let off = (0..3)
        .any(|i| (square.col(i) - Mat3::IDENTITY.col(i)).abs().max_element() > ROTATION_TOLERANCE);
    !off && m.determinant() > 0.0
}

/// The numbers of a file and their byte ranges.
struct Numbers<'a> {
    name: &'a str,
    text: &'a str,
    values: Vec<f64>,
    ranges: Vec<Range<usize>>,
}

impl<'a> Numbers<'a> {
    fn read(name: &'a str, text: &'a str) -> Result<Numbers<'a>, SceneError> {
        let mut numbers = Numbers {
            name,
            text,
            values: Vec::new(),
            ranges: Vec::new(),
        };
        for token in text.split_ascii_whitespace() {
            let start = token.as_ptr() as usize - text.as_ptr() as usize;
            let range = start..start + token.len();
            let index = numbers.values.len();
            numbers.ranges.push(range);
            let Some(what) = NAMES.get(index) else {
                let title = format!("the file has more than {} numbers", NAMES.len());
                let help = "check that it is a camera file; the key D in the viewer writes one";
                return Err(numbers
                    .diagnostic(index, title, "expected the end of the file")
                    .help(help)
                    .into());
            };
            match token.parse::<f64>() {
                Ok(value) if value.is_finite() => numbers.values.push(value),
                _ => {
                    let title = format!("{what} is not a finite number");
                    let help = "write numbers like -1.5 or 2e-3, with spaces between them";
                    return Err(numbers
                        .diagnostic(index, title, "expected a number")
                        .help(help)
                        .into());
                }
            }
        }
        if let Some(next) = NAMES.get(numbers.values.len()) {
            let title = format!(
                "the file has {} numbers, {next} is missing",
                numbers.values.len()
            );
            let diagnostic = Diagnostic::about_file(name, title);
            let help = format!(
                "a camera file has {}: angles, position, c2w and screen",
                NAMES.len()
            );
            return Err(diagnostic
                .at(text, text.len()..text.len(), format!("expected {next}"))
                .help(help)
                .into());
        }
        Ok(numbers)
    }

    fn diagnostic(&self, index: usize, title: impl Into<String>, expected: &str) -> Diagnostic {
        Diagnostic::about_file(self.name, title).at(self.text, self.ranges[index].clone(), expected)
    }

    fn check(
        &self,
        indices: &[usize],
        expected: &str,
        valid: impl Fn(f64) -> bool,
    ) -> Result<(), SceneError> {
        match indices.iter().find(|i| !valid(self.values[**i])) {
            None => Ok(()),
            Some(i) => {
                let title = format!("{} is {}", NAMES[*i], &self.text[self.ranges[*i].clone()]);
                let help = format!("correct {}", NAMES[*i]);
                Err(self
                    .diagnostic(*i, title, &format!("expected {expected}"))
                    .help(help)
                    .into())
            }
        }
    }
}

/// Formats the text of the file.
impl fmt::Display for CameraFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Camera {
            pos,
            c2w,
            h_fov,
            v_fov,
            n_clip,
            f_clip,
        } = self.view.camera;
        let target = self.view.target;
        let backward = pos - target;
        let r = backward.length();
        let phi = math::acos((backward.y / r).clamp(-1.0, 1.0));
        let theta = math::atan2(backward.x, backward.z);
        let aspect = half_tan(h_fov) / half_tan(v_fov);
        let (w, h) = (f64::from(self.film.w), f64::from(self.film.h));
        let screen_dist = h / (2.0 * half_tan(v_fov));
        let rows = c2w.transpose();
        let lines: [&[f64]; 5] = [
            &[h_fov, v_fov, aspect, n_clip, f_clip],
            &[pos.x, pos.y, pos.z, target.x, target.y, target.z],
            &[
                if phi.is_nan() { 0.0 } else { phi },
                theta,
                r,
                self.min_r,
                self.max_r,
            ],
            &[rows.x_axis, rows.y_axis, rows.z_axis]
                .map(|row| row.to_array())
                .concat(),
            &[w, h, screen_dist],
        ];
        for line in lines {
            let words: Vec<String> = line.iter().map(|number| digits(*number)).collect();
            writeln!(f, "{}", words.join(" "))?;
        }
        Ok(())
    }
}

/// A number with 17 significant digits, in the format of C's `%.17g`: enough to read back the same
/// float.
fn digits(number: f64) -> String {
    let scientific = format!("{number:.16e}");
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trim = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    if (-4..17).contains(&exponent) {
        trim(&format!("{number:.*}", (16 - exponent) as usize))
    } else {
        let sign = if exponent < 0 { '-' } else { '+' };
        format!("{}e{sign}{:02}", trim(mantissa), exponent.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const EXAMPLE: &str = "50 38.5 1.3333333333333333 0.1 100\n1 2 3 1 2 -1\n1.57 0 4 0.2 40\n\
                           1 0 0 0 1 0 0 0 1\n480 360 515.3\n";

    fn parse_error(text: &str) -> SceneError {
        CameraFile::parse("a.cam", text).expect_err("the file is invalid")
    }

    #[test]
    fn numbers_are_assigned_in_order() {
        let file = CameraFile::parse("a.cam", EXAMPLE).unwrap();
        assert_eq!(file.view.camera.pos, Vec3::new(1.0, 2.0, 3.0));
        assert_eq!(file.view.target, Vec3::new(1.0, 2.0, -1.0));
        assert_eq!(
            (file.view.camera.h_fov, file.view.camera.v_fov),
            (50.0, 38.5)
        );
        assert_eq!(
            (file.view.camera.n_clip, file.view.camera.f_clip),
            (0.1, 100.0)
        );
        assert_eq!(file.film, FilmSize { w: 480, h: 360 });
        assert_eq!((file.min_r, file.max_r), (0.2, 40.0));
    }

    #[test]
    fn c2w_is_read_row_by_row() {
        let rotated = EXAMPLE.replace("1 0 0 0 1 0 0 0 1", "0 0 1 0 1 0 -1 0 0");
        let camera = CameraFile::parse("a.cam", &rotated).unwrap().view.camera;
        assert_eq!(camera.c2w * Vec3::X, Vec3::NEG_Z);
    }

    #[test]
    fn errors_name_the_number_and_its_line() {
        let cut = parse_error("50 38.5 1.33");
        assert_eq!(cut.0.title(), "the file has 3 numbers, nClip is missing");
        let wide = parse_error(&EXAMPLE.replace("38.5", "180"));
        assert_eq!(wide.0.title(), "vFov is 180");
        assert_eq!(wide.0.line_and_column(), Some((1, 4)));
        let text = parse_error(&EXAMPLE.replace("2 3 1", "2 three 1"));
        assert_eq!(text.0.title(), "pos.z is not a finite number");
        assert_eq!(text.0.line_and_column(), Some((2, 5)));
        assert_eq!(
            parse_error(&EXAMPLE.replace("0.1 100", "nan 100"))
                .0
                .title(),
            "nClip is not a finite number"
        );
        assert_eq!(
            parse_error(&EXAMPLE.replace("0.1 100", "0.1 0.1"))
                .0
                .title(),
            "fClip is 0.1"
        );
        assert_eq!(
            parse_error(&EXAMPLE.replace("1 2 3", "1 2 1e200"))
                .0
                .title(),
            "pos.z is 1e200"
        );
        assert_eq!(
            parse_error(&EXAMPLE.replace("480", "480.5")).0.title(),
            "screenW is 480.5"
        );
        assert_eq!(
            parse_error(&EXAMPLE.replace("1 0 0 0 1", "1 0 0 0 2"))
                .0
                .title(),
            "c2w is not a rotation"
        );
        assert_eq!(
            parse_error(&EXAMPLE.replace("1 0 0 0 1", "-1 0 0 0 1"))
                .0
                .title(),
            "c2w is not a rotation"
        );
        assert_eq!(
            parse_error(&format!("{EXAMPLE} 7")).0.title(),
            "the file has more than 28 numbers"
        );
        assert_eq!(
            parse_error("").0.title(),
            "the file has 0 numbers, hFov is missing"
        );
    }

    #[test]
    fn digits_are_written_as_the_original_does() {
        assert_eq!(digits(2.0_f64.sqrt()), "1.4142135623730951");
        assert_eq!(digits(f64::from(0.1_f32)), "0.10000000149011612");
        assert_eq!(digits(-7.498798913309288e-33), "-7.498798913309288e-33");
        assert_eq!(digits(100.0), "100");
        assert_eq!(digits(-0.0), "-0");
        assert_eq!(digits(1e30), "1e+30");
    }

    proptest! {
        #[test]
        fn written_files_are_read_back_exactly(
            fov in (1e-3..179.9_f64, 1e-3..179.9_f64),
            pos in prop::array::uniform3(-1e6..1e6_f64),
            turn in (-3.1..3.1_f64, -1.5..1.5_f64),
            distance in 1e-3..1e3_f64,
            size in (1..9999_u32, 1..9999_u32),
        ) {
            let backward = Vec3::new(
                math::sin(turn.0) * math::cos(turn.1),
                math::sin(turn.1),
                math::cos(turn.0) * math::cos(turn.1),
            );
            let pos = Vec3::from(pos);
            let camera = Camera {
                pos,
                c2w: Camera::look_at(backward, Vec3::ZERO, Vec3::Y).unwrap(),
                h_fov: fov.0,
                v_fov: fov.1,
                n_clip: 0.1 * distance,
                f_clip: 1e30,
            };
            let view = View { camera, target: pos - distance * backward };
            let file = CameraFile::new(view, FilmSize { w: size.0, h: size.1 });
            prop_assert_eq!(CameraFile::parse("a.cam", &file.to_string()).unwrap(), file);
        }
    }
}
