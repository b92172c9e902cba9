//! The book of the course.
//!
//! The text is Markdown in `src`, one chapter for each part and each task. It reads well as it is;
//! this crate makes its figures, checks it, and renders it as a site, which is read without a
//! server:
//!
//! - [`drawing`]: a figure as SVG. [`figures`]: the figures, drawn by code that calls `kit`.
//! - [`chapter`]: a chapter's sections, formulas, links and code blocks, as the tests read them.
//! - [`symbols`]: the index of symbols in the glossary.
//! - [`page`]: a chapter as HTML, with formulas by [`maths`]. [`site`]: all pages, and what they
//!   need.
//!
//! The tests in `tests` compare the text with the course: titles, points, signatures, mistakes,
//! numbers, links. The code blocks of the chapters are compiled as documentation tests.

pub mod chapter;
pub mod drawing;
pub mod figures;
mod highlight;
pub mod maths;
pub mod page;
pub mod paths;
mod predictions;
pub mod site;
pub mod symbols;

/// The folder of this crate, which contains `src`.
pub fn folder() -> &'static std::path::Path {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Compiles and runs the Rust code of the chapters.
#[cfg(doctest)]
mod code_of_chapters {
    macro_rules! chapters {
        ($($name:ident $file:literal)*) => { $(
            #[doc = include_str!(concat!("../src/", $file))]
            pub struct $name;
        )* };
    }
    chapters! {
        Part1Task1 "part1/task1.md"
        Part1Task2 "part1/task2.md"
        Part1Task3 "part1/task3.md"
        Part1Task4 "part1/task4.md"
        Part2Task1 "part2/task1.md"
        Part2Task2 "part2/task2.md"
        Part2Task3 "part2/task3.md"
        Part3Task1 "part3/task1.md"
        Part3Task2 "part3/task2.md"
        Part3Task3 "part3/task3.md"
        Part4Task1 "part4/task1.md"
        Part4Task2 "part4/task2.md"
        Part4Task3 "part4/task3.md"
        Part5Task1 "part5/task1.md"
        Part5Task2 "part5/task2.md"
        Part1 "part1/README.md"
        Part2 "part2/README.md"
        Part3 "part3/README.md"
        Part4 "part4/README.md"
        Part5 "part5/README.md"
        Part6 "part6/README.md"
        Part6Task1 "part6/task1.md"
        Part6Task2 "part6/task2.md"
        GettingStarted "getting-started.md"
        Debugging "debugging.md"
        Rust "rust.md"
        Chance "chance.md"
        Light "light.md"
    }
}
