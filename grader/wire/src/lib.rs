//! Cases in, records out.
