//! All tests of the page of costs.

mod cost;
mod cost_page;
