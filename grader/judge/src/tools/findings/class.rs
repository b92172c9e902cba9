//! How an answer is wrong.

use super::{Aspect, DirectionCounts};
use kit::Vec3;

/// The class of a wrong answer: the same mistake gives the same class, whatever formula contains
/// it. Signatures store the `Debug` text of a class.
///
/// ```
/// use judge::findings::Class;
/// assert_eq!(Class::of_number(-2.0, 2.0), Class::Negated);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Wrong in a way that no other class describes.
    Wrong,
    /// Off by about 2 to this power.
    Off(i8),
    /// A hit where there is none, a number that is not 0 where 0 is right.
    FalseHit,
    /// No hit where there is one, black where there is light.
    FalseMiss,
    /// NaN.
    NotANumber,
    /// The negated right number or direction.
    Negated,
    /// A number with the wrong sign and another magnitude.
    WrongSign,
    /// A negative number where 0 is right.
    Negative,
    /// A direction on the other side of the surface.
    OtherSide,
    /// A vector of chance that is not of unit length.
    WrongLength,
    /// The right direction, and shorter than 1.
    TooShort,
    /// The right direction, and longer than 1.
    TooLong,
    /// A number that is about 2 to this power times the right one.
    Ratio(i8),
    /// A number that is too small by less than a factor of the square root of 2.
    SlightlyLess,
    /// A number that is too large by less than a factor of the square root of 2.
    SlightlyMore,
    /// A colour whose channels are about 2 to the power of these numbers over `PER_OCTAVE` times
    /// the right ones; `BLACK_CHANNEL` for channels that are rightly black.
    Colour([i8; 3]),
    /// A wrong direction, or the mean of many positions, quantised along each axis.
    Towards([i8; 3]),
    /// Directions with a wrong distribution.
    Distribution(DirectionCounts),
    /// An infinite number.
    Infinite,
    /// 0 where the right number is not 0.
    Zero,
    /// Off by the rounding of single precision, or of a constant that is typed with few digits.
    Rounded,
    /// The right numbers, swapped.
    Swapped,
    /// A fault with a name of its own. A finding may have several of them.
    Named(&'static str),
}

impl Class {
    /// Whether answers of this class may differ: the class has the size of an error to a factor of
    /// 2, say, or only that there is one.
    pub fn is_rough(self, aspect: Aspect) -> bool {
        match self {
            Class::Wrong
            | Class::Off(_)
            | Class::WrongSign
            | Class::Negative
            | Class::OtherSide
            | Class::WrongLength
            | Class::TooShort
            | Class::TooLong
            | Class::Ratio(_)
            | Class::SlightlyLess
            | Class::SlightlyMore
            | Class::Colour(_)
            | Class::Towards(_)
            | Class::Distribution(_)
            | Class::Rounded => true,
            Class::FalseHit => !aspect.is_decision(),
            Class::FalseMiss
            | Class::NotANumber
            | Class::Negated
            | Class::Infinite
            | Class::Zero
            | Class::Swapped
            | Class::Named(_) => false,
        }
    }

    /// The class of a wrong number.
    pub fn of_number(answered: f64, right: f64) -> Class {
        let ratio = answered / right;
        if answered.is_nan() {
            Class::NotANumber
        } else if answered.is_infinite() {
            Class::Infinite
        } else if answered == 0.0 {
            Class::Zero
        } else if (ratio + 1.0).abs() < SAME {
            Class::Negated
        } else if (ratio - 1.0).abs() < ROUNDED {
            Class::Rounded
        } else if ratio.is_finite() && ratio > 0.0 {
            Class::Ratio(ratio.log2().round().clamp(-99.0, 99.0) as i8)
        } else {
            Class::Wrong
        }
    }

    /// As [`Class::of_number`], but too small and too large, a wrong sign, a positive and a
    /// negative number in the place of 0 have classes of their own: for densities, counts and sums,
    /// in which different mistakes cause them.
    pub fn of_signed_number(answered: f64, right: f64) -> Class {
        match Class::of_number(answered, right) {
            Class::Ratio(0) if answered.abs() < right.abs() => Class::SlightlyLess,
            Class::Ratio(0) => Class::SlightlyMore,
            Class::Wrong if right == 0.0 && answered > 0.0 => Class::FalseHit,
            Class::Wrong if right == 0.0 => Class::Negative,
            Class::Wrong if answered / right < 0.0 => Class::WrongSign,
            class => class,
        }
    }

    /// The class of a wrong colour where neither it nor the right one is black.
    pub fn of_colour(answered: [f64; 3], right: [f64; 3]) -> Class {
        let is_rounded = |(a, r): (f64, f64)| a == r || (a / r - 1.0).abs() < ROUNDED;
        if answered.into_iter().zip(right).all(is_rounded) {
            return Class::Rounded;
        }
        let mut ratios = [0; 3];
        for ((ratio, a), r) in ratios.iter_mut().zip(answered).zip(right) {
            if a == 0.0 && r == 0.0 {
                *ratio = BLACK_CHANNEL;
            } else if (a / r).is_finite() && a / r > 0.0 {
                let steps = PER_OCTAVE * (a / r).log2();
                *ratio = steps.round().clamp(-99.0, 99.0) as i8;
            } else {
                return Class::of_number(a, r);
            }
        }
        Class::Colour(ratios)
    }

    /// The class of an answer that is off by `size`, in any unit.
    pub fn of_size(size: f64) -> Class {
        if size.is_nan() {
            Class::NotANumber
        } else if size == f64::INFINITY {
            Class::Infinite
        } else {
            Class::Off(size.log2().round().clamp(-99.0, 99.0) as i8)
        }
    }

    /// The class of a ray's origin that is off by `off`, and `from_surface` away from the point
    /// that it leaves: that point itself and a fixed offset have names.
    pub fn of_offset(off: f64, from_surface: f64) -> Class {
        if from_surface < AT_THE_POINT {
            return Class::Named("at the surface itself");
        }
        match off {
            MIN_FIXED_OFFSET..=MAX_FIXED_OFFSET => Class::Named("an epsilon away"),
            _ => Class::of_size(off),
        }
    }

    /// The class of a wrong unit vector.
    pub fn of_direction(answered: Vec3, right: Vec3) -> Class {
        if answered.is_nan() {
            Class::NotANumber
        } else if (answered + right).length() < SAME {
            Class::Negated
        } else if (answered.normalize_or_zero() - right).length() < SAME
            && (answered.length() - 1.0).abs() > SAME
        {
            // Different mistakes: a normal as long as the radius, or divided by its square.
            match answered.length() < 1.0 {
                true => Class::TooShort,
                false => Class::TooLong,
            }
        } else if (answered - right).length() < ROUNDED {
            Class::Rounded
        } else {
            Class::of_size((answered - right).length())
        }
    }

    /// The class of a wrong unit vector that does not depend on random numbers: a direction that is
    /// wrong in another way than sign or length is itself part of the class.
    pub fn of_certain_direction(answered: Vec3, right: Vec3) -> Class {
        match Class::of_direction(answered, right) {
            Class::Off(_) => {
                let way = 16.0 * answered.normalize_or_zero();
                Class::Towards(way.to_array().map(|along| along.round() as i8))
            }
            class => class,
        }
    }
}

/// Answers that match the right one to this bound after a change of sign, length or order have the
/// class of that change.
pub(crate) const SAME: f64 = 1e-6;

/// A smaller relative error comes from rounding: f32 has a precision of 6e-8, and a few operations
/// multiply it; 3.14159 for π is off by 8e-7.
const ROUNDED: f64 = 1e-5;

/// An origin that is nearer to its point is that point: `Surface::leave` moves it 1e-12 or more.
const AT_THE_POINT: f64 = 1e-14;

/// The smallest error of an origin that counts as a fixed offset. Rounding errors are smaller.
const MIN_FIXED_OFFSET: f64 = 1e-9;

/// The largest error of an origin that counts as a fixed offset from the surface.
const MAX_FIXED_OFFSET: f64 = 0.1;

/// Number of classes of colour ratios in a factor of 2.
const PER_OCTAVE: f64 = 4.0;

/// The ratio of a black channel to a right one that is also black.
pub const BLACK_CHANNEL: i8 = i8::MAX;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_origin_at_the_surface_itself_is_told_from_one_that_is_moved_too_far() {
        let moved = 2e-12;
        assert_eq!(
            Class::of_offset(moved, 0.0),
            Class::Named("at the surface itself")
        );
        assert_eq!(Class::of_offset(moved, 2.0 * moved), Class::Off(-39));
        assert_eq!(
            Class::of_offset(1e-4, 1e-4),
            Class::Named("an epsilon away")
        );
    }

    #[test]
    fn negative_numbers_and_numbers_on_the_wrong_side_have_classes_of_their_own() {
        let class = Class::of_signed_number;
        assert_eq!(class(0.25, 0.0), Class::FalseHit);
        assert_eq!(class(-0.25, 0.0), Class::Negative);
        assert_eq!(class(-0.25, 0.25), Class::Negated);
        assert_eq!(class(-0.5, 0.25), Class::WrongSign);
        assert_eq!(class(0.0, 0.25), Class::Zero);
    }
}
