//! The instruction sets that code in lanes is tested with.

use fearless_simd::Level;

/// Instruction sets of this machine, the best one first: results have to be the same with all of
/// them.
pub fn instruction_sets() -> Vec<Level> {
    let mut levels = vec![Level::new(), Level::baseline()];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(Level::new().as_avx2().map(Level::Avx2));
        levels.extend(Level::new().as_sse4_2().map(Level::Sse4_2));
    }
    levels
}
