//! All tests of the page of costs.

mod accuracy_table;
mod cost;
mod cost_page;
