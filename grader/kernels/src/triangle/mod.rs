//! Ray/triangle tests. Edges, vertices and both ends of the ray's range count; both faces are hit.
//!
//! With the vertices relative to the ray's origin, `A = p0 - o` and so on, the ray's line passes
//! through the triangle if `d·(B×C)`, `d·(C×A)` and `d·(A×B)` do not differ in sign. All of these
//! kernels are based on this test. They differ in the values that they round on the way, and in the
//! values that they do not compute.

mod baldwin_weber;
mod filtered;
pub(crate) mod moller_trumbore;
mod plane;
pub(crate) mod plucker;
mod test;
pub(crate) mod woop;
mod woop_fused;

pub(crate) use test::TriangleTest;

use crate::kernel::{HitF64, Kernel};
use test::{PointFromWeights, PointOnRay};

/// Returns all kernels, the textbook's first.
pub(crate) fn kernels() -> Vec<Kernel<kit::Triangle, HitF64>> {
    use baldwin_weber::BaldwinWeber;
    use filtered::Filtered;
    use moller_trumbore::{Culling, MollerTrumbore, UsualEpsilon};
    use plane::PlaneThenSides;
    use plucker::Plucker;
    use woop::Woop;
    use woop_fused::{Fused, FusedAtZero};
    vec![
        Kernel::new::<PointOnRay<MollerTrumbore>, f64>(),
        Kernel::new::<PointOnRay<MollerTrumbore>, f32>(),
        Kernel::new::<PointOnRay<UsualEpsilon>, f64>(),
        Kernel::new::<PointOnRay<UsualEpsilon>, f32>(),
        Kernel::new::<PointOnRay<Culling>, f64>(),
        Kernel::new::<PointOnRay<Culling>, f32>(),
        Kernel::new::<PointOnRay<PlaneThenSides>, f64>(),
        Kernel::new::<PointOnRay<PlaneThenSides>, f32>(),
        Kernel::new::<BaldwinWeber, f64>(),
        Kernel::new::<BaldwinWeber, f32>(),
        Kernel::new::<PointOnRay<Plucker>, f64>(),
        Kernel::new::<PointOnRay<Plucker>, f32>(),
        Kernel::new::<PointFromWeights<Woop>, f64>(),
        Kernel::new::<PointFromWeights<Woop>, f32>(),
        Kernel::new_f32_in_f64::<PointFromWeights<Woop>>(),
        Kernel::new::<PointFromWeights<FusedAtZero>, f64>(),
        Kernel::new::<PointFromWeights<Fused>, f64>(),
        Kernel::new::<PointFromWeights<Filtered>, f64>(),
    ]
}
