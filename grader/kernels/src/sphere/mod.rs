//! Ray/sphere tests: the smallest root of `a t² + 2 b t + c` in the ray's range, with
//! `f = o - center`, `a = d·d`, `b = f·d`, `c = f·f - r²`. Tangents count.

mod haines;
mod q_form;
mod quadratic;
mod test;

use crate::kernel::{HitF64, Kernel};
use test::{PointOnRay, ReprojectedPoint};

/// Returns all kernels, the textbook's first.
pub(crate) fn kernels() -> Vec<Kernel<kit::Sphere, HitF64>> {
    use haines::Haines;
    use q_form::QForm;
    use quadratic::Quadratic;
    vec![
        Kernel::new::<PointOnRay<Quadratic>, f64>(),
        Kernel::new::<PointOnRay<Quadratic>, f32>(),
        Kernel::new::<ReprojectedPoint<Quadratic>, f64>(),
        Kernel::new::<ReprojectedPoint<Quadratic>, f32>(),
        Kernel::new::<PointOnRay<QForm>, f64>(),
        Kernel::new::<PointOnRay<QForm>, f32>(),
        Kernel::new::<ReprojectedPoint<QForm>, f64>(),
        Kernel::new::<ReprojectedPoint<QForm>, f32>(),
        Kernel::new::<PointOnRay<Haines>, f64>(),
        Kernel::new::<PointOnRay<Haines>, f32>(),
        Kernel::new::<ReprojectedPoint<Haines>, f64>(),
        Kernel::new::<ReprojectedPoint<Haines>, f32>(),
    ]
}
