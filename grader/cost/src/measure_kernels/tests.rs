//! Tests of what the times depend on.

use crate::rays::{Target, pairs};
use crate::report::RayFamily;
use kernels::{Instructions, Kernel, OperationCounts, RayAndShapes};

/// Returns rays that are aimed at edges and vertices, and ordinary ones. A rounding that differs
/// changes hits to misses.
fn hard_pairs<S: Target>() -> Vec<RayAndShapes<S>> {
    let families = [RayFamily::Ordinary, RayFamily::Edge, RayFamily::Vertex];
    let pairs = families
        .map(|family| pairs::<S>(family, 3, 1000))
        .into_iter()
        .flatten();
    pairs
        .map(|(shape, ray)| RayAndShapes {
            ray,
            shapes: vec![shape],
        })
        .collect()
}

/// Returns the name and the precision of the kernels that find other hits with AVX2 and FMA than
/// with the instructions of the build.
fn differing<S: Target, W: 'static>(kernels: &[Kernel<S, W>], fma: Instructions) -> Vec<String> {
    let pairs = hard_pairs();
    let order: Vec<u32> = (0..pairs.len() as u32).collect();
    let differs = |kernel: &&Kernel<S, W>| {
        let [build, with_fma] = [Instructions::BUILD, fma]
            .map(|instructions| kernel.pass(&pairs, instructions)(&order));
        assert!(build > 500, "{}: only {build} hits", kernel.info.name);
        build != with_fma
    };
    let differing = kernels.iter().filter(differs);
    differing
        .map(|kernel| format!("{} {:?}", kernel.info.name, kernel.precision))
        .collect()
}

#[test]
fn instructions_do_not_change_hits() {
    let Some(fma) = Instructions::with_fma() else {
        return;
    };
    assert_eq!(differing(&kernels::triangles(), fma), [""; 0]);
    assert_eq!(differing(&kernels::spheres(), fma), [""; 0]);
    assert_eq!(differing(&kernels::boxes(), fma), [""; 0]);
}

/// Returns the kernels that are marked as using fused multiply-adds but use none, or the reverse.
fn wrongly_marked<S: Target, W: 'static>(kernels: &[Kernel<S, W>]) -> Vec<&'static str> {
    let pairs = hard_pairs();
    let wrong = kernels.iter().filter(|kernel| {
        let mut counts = OperationCounts::default();
        for RayAndShapes { ray, shapes } in &pairs {
            counts += kernel.count(&shapes[0], ray);
        }
        kernel.info.uses_fma != (counts.fma > 0)
    });
    wrong.map(|kernel| kernel.info.name).collect()
}

#[test]
fn kernels_that_use_fused_multiply_adds_are_marked() {
    assert_eq!(wrongly_marked(&kernels::triangles()), [""; 0]);
    assert_eq!(wrongly_marked(&kernels::spheres()), [""; 0]);
    assert_eq!(wrongly_marked(&kernels::boxes()), [""; 0]);
    // BEGIN SOLUTION(part1.task3)
    let triangles = kernels::triangles();
    let marked = triangles.iter().filter(|kernel| kernel.info.uses_fma);
    assert_eq!(marked.count(), 3);
    // END SOLUTION(part1.task3)
}
