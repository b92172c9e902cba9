//! What rays do at triangles and spheres.
//!
//! [`triangle`] and [`sphere`] hold the plain cases. The other files go where textbook formulas fail,
//! each test with a line on how; [`truth`] is the slow and exact computation that they are held
//! against.

mod sphere;
mod sphere_grazed;
mod sphere_properties;
mod sphere_roots;
mod triangle;
mod triangle_degenerate;
mod triangle_edges;
mod triangle_meshes;
mod triangle_properties;
mod triangle_range;
mod triangle_scales;
mod truth;

// BEGIN SOLUTION(part1.task3)
/// Property tests try the same `cases` inputs on every run, so that a run can be repeated;
/// `PROPTEST_RNG_SEED=7 cargo test` tries others.
fn cases(cases: u32) -> proptest::test_runner::Config {
    use proptest::test_runner::{Config, RngSeed};
    let config = Config::with_cases(cases);
    match config.rng_seed {
        RngSeed::Random => Config {
            rng_seed: RngSeed::Fixed(1),
            ..config
        },
        RngSeed::Fixed(_) => config,
    }
}
// END SOLUTION(part1.task3)
