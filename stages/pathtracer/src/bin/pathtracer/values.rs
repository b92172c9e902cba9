//! What values flags take, and what is said of others.

use std::str::FromStr;

fn within<T: FromStr + PartialOrd + std::fmt::Display>(
    value: &str,
    least: T,
    most: T,
) -> Result<T, String> {
    match value.parse::<T>() {
        Ok(v) if least <= v && v <= most => Ok(v),
        _ => Err(format!("give a whole number from {least} to {most}")),
    }
}

pub(crate) fn seed(value: &str) -> Result<u64, String> {
    within(value, 0, u64::MAX)
}

pub(crate) fn samples(value: &str) -> Result<u32, String> {
    within(value, 1, 1_048_576)
}

pub(crate) fn threads(value: &str) -> Result<usize, String> {
    within(value, 1, 1024)
}

pub(crate) fn depth(value: &str) -> Result<u32, String> {
    within(value, 0, 10_000)
}

pub(crate) fn positive(value: &str) -> Result<f64, String> {
    match value.parse::<f64>() {
        Ok(v) if v.is_finite() && v > 0.0 => Ok(v),
        _ => Err("give a finite number above 0".to_owned()),
    }
}

pub(crate) fn length(value: &str) -> Result<f64, String> {
    match value.parse::<f64>() {
        Ok(v) if v.is_finite() && v >= 0.0 => Ok(v),
        _ => {
            Err("give a finite length in scene units that is not negative, such as 0.05".to_owned())
        }
    }
}

pub(crate) fn positive_length(value: &str) -> Result<f64, String> {
    match value.parse::<f64>() {
        Ok(v) if v.is_finite() && v > 0.0 => Ok(v),
        _ => Err("give a finite length in scene units above 0, such as 3.5".to_owned()),
    }
}

pub(crate) fn edge(value: &str) -> Result<u32, String> {
    within(value, 1, 100_000)
}

pub(crate) fn pixels(value: &str) -> Result<u32, String> {
    within(value, 0, 100_000)
}
