//! Numbers that count operations, and numbers without rounding errors.

mod counting;
mod exact;
