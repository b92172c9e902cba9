//! What crosses between the grader and the worker: [`Case`]s in, [`Record`]s out.
//!
//! Plain data that knows nothing of the course's types. Numbers keep their bits: files are
//! [postcard](https://docs.rs/postcard), so NaN, infinities and -0 arrive as they were sent.
//!
//! [`work`] says what the worker is asked to do, [`answer`] what it says of it, [`mod@file`] how both
//! stand in a file that is still readable after the worker was killed. [`light`] is what lit worlds are made of; [`direct`],
//! [`global`] and [`adaptive`] are questions and answers of Parts 3 to 5.

pub mod adaptive;
pub mod answer;
pub mod direct;
pub mod file;
pub mod global;
pub mod light;
pub mod work;

pub use answer::{Answer, Frame, Outcome, Record};
pub use work::{Case, Work};
