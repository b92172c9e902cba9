//! Colours: linear red, green and blue.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

/// Radiance, reflectance or another quantity per colour channel: linear sRGB, without upper limit.
///
/// ```
/// use kit::Spectrum;
/// let red = Spectrum::new(1.0, 0.0, 0.0);
/// let sum = red + 0.5 * Spectrum::WHITE;
/// assert_eq!(sum, Spectrum::new(1.5, 0.5, 0.5));
/// assert_eq!(red.luminance(), 0.2126);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spectrum {
    /// Red.
    pub r: f64,
    /// Green.
    pub g: f64,
    /// Blue.
    pub b: f64,
}

impl Spectrum {
    /// 0 in every channel.
    pub const BLACK: Spectrum = Spectrum::grey(0.0);
    /// 1 in every channel.
    pub const WHITE: Spectrum = Spectrum::grey(1.0);

    /// A spectrum with the given channels.
    #[inline]
    pub const fn new(r: f64, g: f64, b: f64) -> Spectrum {
        Spectrum { r, g, b }
    }

    /// The value `v` in every channel.
    #[inline]
    pub const fn grey(v: f64) -> Spectrum {
        Spectrum { r: v, g: v, b: v }
    }

    /// Relative luminance of linear sRGB (ITU-R BT.709).
    #[inline]
    pub fn luminance(self) -> f64 {
        0.2126 * self.r + 0.7152 * self.g + 0.0722 * self.b
    }

    /// Whether all channels are exactly 0.
    #[inline]
    pub fn is_black(self) -> bool {
        self == Spectrum::BLACK
    }

    /// Whether all channels are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.r.is_finite() && self.g.is_finite() && self.b.is_finite()
    }

    /// The largest channel.
    #[inline]
    pub fn max_channel(self) -> f64 {
        self.r.max(self.g).max(self.b)
    }

    /// The channels as `[r, g, b]`.
    pub const fn to_array(self) -> [f64; 3] {
        [self.r, self.g, self.b]
    }

    #[inline]
    fn zip(self, other: Spectrum, f: impl Fn(f64, f64) -> f64) -> Spectrum {
        Spectrum::new(f(self.r, other.r), f(self.g, other.g), f(self.b, other.b))
    }
}

impl From<[f64; 3]> for Spectrum {
    #[inline]
    fn from([r, g, b]: [f64; 3]) -> Spectrum {
        Spectrum { r, g, b }
    }
}

impl Add for Spectrum {
    type Output = Spectrum;
    #[inline]
    fn add(self, other: Spectrum) -> Spectrum {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Spectrum {
    type Output = Spectrum;
    #[inline]
    fn sub(self, other: Spectrum) -> Spectrum {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for Spectrum {
    type Output = Spectrum;
    #[inline]
    fn mul(self, other: Spectrum) -> Spectrum {
        self.zip(other, |a, b| a * b)
    }
}

impl Mul<f64> for Spectrum {
    type Output = Spectrum;
    #[inline]
    fn mul(self, s: f64) -> Spectrum {
        self * Spectrum::grey(s)
    }
}

impl Mul<Spectrum> for f64 {
    type Output = Spectrum;
    #[inline]
    fn mul(self, s: Spectrum) -> Spectrum {
        s * self
    }
}

impl Div<f64> for Spectrum {
    type Output = Spectrum;
    #[inline]
    fn div(self, s: f64) -> Spectrum {
        self.zip(Spectrum::grey(s), |a, b| a / b)
    }
}

impl AddAssign for Spectrum {
    #[inline]
    fn add_assign(&mut self, other: Spectrum) {
        *self = *self + other;
    }
}

impl MulAssign for Spectrum {
    #[inline]
    fn mul_assign(&mut self, other: Spectrum) {
        *self = *self * other;
    }
}

impl Sum for Spectrum {
    #[inline]
    fn sum<I: Iterator<Item = Spectrum>>(spectra: I) -> Spectrum {
        spectra.fold(Spectrum::BLACK, Add::add)
    }
}
