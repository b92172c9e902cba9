//! Parsers of flag values, and their error messages.

use std::str::FromStr;

fn in_range<T: FromStr + PartialOrd + std::fmt::Display>(
    value: &str,
    min: T,
    max: T,
) -> Result<T, String> {
    match value.parse::<T>() {
        Ok(v) if min <= v && v <= max => Ok(v),
        _ => Err(format!("expected a whole number from {min} to {max}")),
    }
}

pub(crate) fn seed(value: &str) -> Result<u64, String> {
    in_range(value, 0, u64::MAX)
}

pub(crate) fn samples(value: &str) -> Result<u32, String> {
    in_range(value, 1, 1_048_576)
}

/// With the most samples of a run, sample numbers still have 30 bits.
pub(crate) fn first_sample(value: &str) -> Result<u32, String> {
    in_range(value, 0, (1 << 30) - 1_048_576)
}

pub(crate) fn threads(value: &str) -> Result<usize, String> {
    in_range(value, 1, 1024)
}

pub(crate) fn depth(value: &str) -> Result<u32, String> {
    in_range(value, 0, 10_000)
}

pub(crate) fn positive(value: &str) -> Result<f64, String> {
    match value.parse::<f64>() {
        Ok(v) if v.is_finite() && v > 0.0 => Ok(v),
        _ => Err("expected a finite number above 0".to_owned()),
    }
}

/// Exposure in stops. The limit keeps every radiance of a picture finite.
pub fn stops(value: &str) -> Result<f64, String> {
    match value.parse::<f64>() {
        Ok(v) if v.abs() <= 64.0 => Ok(v),
        _ => Err("expected a number of stops from -64 to 64, such as 1.5".to_owned()),
    }
}

pub(crate) fn length(value: &str) -> Result<f64, String> {
    match value.parse::<f64>() {
        Ok(v) if v.is_finite() && v >= 0.0 => Ok(v),
        _ => Err("expected a finite length of at least 0 in scene units, such as 0.05".to_owned()),
    }
}

pub(crate) fn positive_length(value: &str) -> Result<f64, String> {
    match value.parse::<f64>() {
        Ok(v) if v.is_finite() && v > 0.0 => Ok(v),
        _ => Err("expected a finite length above 0 in scene units, such as 3.5".to_owned()),
    }
}

pub(crate) fn edge(value: &str) -> Result<u32, String> {
    in_range(value, 1, 100_000)
}

pub(crate) fn pixels(value: &str) -> Result<u32, String> {
    in_range(value, 0, 100_000)
}
