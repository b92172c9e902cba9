//! Ray/box tests: the interval of the ray between the last entry and the first exit of three slabs.

pub(crate) mod ize;
pub(crate) mod kay_kajiya;
mod nan_safe;
mod test;
pub(crate) mod williams;

pub(crate) use test::BoxTest;

use crate::kernel::Kernel;
use test::WithoutPrecomputation;

/// Returns all kernels, the textbook's first.
pub(crate) fn kernels() -> Vec<Kernel<kit::Aabb, kit::Interval>> {
    use ize::Ize;
    use kay_kajiya::KayKajiya;
    use nan_safe::NanSafe;
    use williams::Williams;
    vec![
        Kernel::new::<WithoutPrecomputation<KayKajiya>, f64>(),
        Kernel::new::<WithoutPrecomputation<KayKajiya>, f32>(),
        Kernel::new::<WithoutPrecomputation<NanSafe>, f64>(),
        Kernel::new::<WithoutPrecomputation<NanSafe>, f32>(),
        Kernel::new::<WithoutPrecomputation<Williams>, f64>(),
        Kernel::new::<WithoutPrecomputation<Williams>, f32>(),
        Kernel::new::<WithoutPrecomputation<Ize>, f64>(),
        Kernel::new::<WithoutPrecomputation<Ize>, f32>(),
    ]
}
