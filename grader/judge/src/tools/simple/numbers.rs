//! The numbers of a question that may be replaced by others: for [`super::variations`].

use wire::work::{Probe, Ray, Xyz};

/// What a number of a question is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Number {
    /// A coordinate of a point, or a radius.
    Length,
    /// A component of a ray's direction.
    Direction,
    /// An end of a ray's range, in multiples of the direction.
    T,
    /// A component of a normal.
    Normal,
}

/// Calls `change` with the coordinates of a point.
pub(crate) fn point(p: &mut Xyz, kind: Number, change: &mut dyn FnMut(Number, &mut f64)) {
    p.iter_mut().for_each(|x| change(kind, x));
}

/// Calls `change` with the numbers of the rays.
pub(crate) fn rays(probes: &mut [Probe], change: &mut dyn FnMut(Number, &mut f64)) {
    for Probe { ray, .. } in probes {
        let Ray { o, d, min_t, max_t } = ray;
        point(o, Number::Length, change);
        point(d, Number::Direction, change);
        change(Number::T, min_t);
        change(Number::T, max_t);
    }
}
