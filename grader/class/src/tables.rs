//! Writes all that a class gets to see: `gradebook.csv`, `class.html`, `lecture.html` and the
//! students' pages. They are a function of the plan, of the units in `OUT` and of the options: the
//! same bytes, whichever machines graded.

use crate::collect::{Class, Options};
use crate::out::{Out, read_regular};
use crate::plan::Plan;
use crate::{entries, gradebook, pages};
use base::{GraderError, write_whole};
use grader::report::HintLevel;
use std::path::Path;

/// Writes the tables of `plan`. The students' pages reveal as much as `hint` says.
pub fn write(
    out: &Out,
    plan: Plan,
    hint: HintLevel,
    options: &Options,
) -> Result<Class, GraderError> {
    let names = plan.submissions.iter().map(|planned| planned.name.raw());
    let page_names = entries::page_names(&names.collect::<Vec<_>>());
    let students = out.join("students");
    std::fs::create_dir_all(&students).map_err(|e| GraderError::file("create", &students, e))?;
    let class = Class::read(out, plan, options, |plan, i, row, details| {
        let pictures = |name: &str| read_regular(&out.picture(name)).ok();
        let page = pages::student::page(plan, row, details, hint, &pictures);
        let path = students.join(format!("{}.html", page_names[i]));
        write_whole(&path, page.as_bytes())
    })?;
    remove_other_pages(&students, &page_names)?;
    let page = pages::class::page(&class, &page_names);
    write_whole(&out.join("class.html"), page.as_bytes())?;
    write_whole(&out.join("lecture.html"), pages::lecture(&class).as_bytes())?;
    // Last: where it is, everything is.
    write_whole(
        &out.join("gradebook.csv"),
        gradebook::write(&class)?.as_bytes(),
    )?;
    Ok(class)
}

/// Removes the pages of students who are no longer in the class.
fn remove_other_pages(students: &Path, names: &[String]) -> Result<(), GraderError> {
    let failed = |e| GraderError::file("read", students, e);
    for entry in std::fs::read_dir(students).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let is_page = path
            .extension()
            .is_some_and(|extension| extension == "html");
        let is_known = |stem: &std::ffi::OsStr| names.iter().any(|name| stem == name.as_str());
        if is_page && !path.file_stem().is_some_and(is_known) {
            std::fs::remove_file(&path).map_err(|e| GraderError::file("remove", &path, e))?;
        }
    }
    Ok(())
}
