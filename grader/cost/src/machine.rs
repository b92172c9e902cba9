//! Describes the machine that the times are measured on.

use super::report::Machine;
use std::process::Command;

/// Target features beyond the baseline of the architecture that affect the speed of kernels.
macro_rules! assumed {
    ($($feature:literal),+) => {
        [$(($feature, cfg!(target_feature = $feature))),+]
    };
}

/// Describes this machine.
pub(crate) fn describe() -> Machine {
    let assumed = assumed!("sse2", "sse4.2", "avx", "avx2", "fma", "avx512f", "neon");
    Machine {
        cpu: cpu().unwrap_or_else(|| format!("an unnamed {}", std::env::consts::ARCH)),
        cores: std::thread::available_parallelism().map_or(1, usize::from),
        rustc: rustc().unwrap_or_else(|| "unknown".into()),
        target_features: assumed
            .iter()
            .filter(|(_, is_assumed)| *is_assumed)
            .map(|(feature, _)| feature.to_string())
            .collect(),
        has_fma: has_fma(),
    }
}

/// Returns the system's name of the processor.
fn cpu() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_string())
}

fn rustc() -> Option<String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc).arg("--version").output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    Some(text.trim().to_string())
}

#[cfg(target_arch = "x86_64")]
fn has_fma() -> bool {
    std::arch::is_x86_feature_detected!("fma")
}

#[cfg(not(target_arch = "x86_64"))]
fn has_fma() -> bool {
    cfg!(target_arch = "aarch64")
}
