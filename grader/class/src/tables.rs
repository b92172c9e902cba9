//! Writes all that a class gets to see: `gradebook.csv`, `class.html`, `lecture.html` and the
//! students' pages. They are a function of the plan, of the units in `OUT` and of the options: the
//! same bytes, whichever machines graded. A student of a team to whom something is given by hand alone
//! has a page besides the team's, which the others need not see.

use crate::collect::{Class, Options, Row};
use crate::out::{Out, read_regular};
use crate::pages::OwnPage;
use crate::plan::Plan;
use crate::{by_hand, entries, gradebook, pages};
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
    let members = || options.by_hand.members.values();
    // No file is called so.
    let of_members =
        members().map(|member| format!("{}\0{}", member.submission.raw(), member.key.raw()));
    let of_members: Vec<String> = of_members.collect();
    let submissions = plan.submissions.iter().map(|planned| planned.name.raw());
    let names: Vec<&str> = submissions
        .chain(of_members.iter().map(String::as_str))
        .collect();
    let page_names = entries::page_names(&names);
    let own_pages: Vec<OwnPage> = members()
        .zip(&page_names[plan.submissions.len()..])
        .map(|(member, page)| OwnPage { member, page })
        .collect();
    let students = out.join("students");
    std::fs::create_dir_all(&students).map_err(|e| GraderError::file("create", &students, e))?;
    let class = Class::read(out, plan, options, |plan, i, row, details| {
        let pictures = |name: &str| read_regular(&out.picture(name)).ok();
        let write = |name: &str, row: &Row| {
            let page = pages::student::page(plan, row, details, hint, &pictures);
            write_whole(&students.join(format!("{name}.html")), page.as_bytes())
        };
        write(&page_names[i], row)?;
        for OwnPage { member, page } in own_pages.iter().filter(|own| own.is_of(row)) {
            let mut own = Row {
                owner: Some(member.name.clone()),
                ..row.clone()
            };
            by_hand::apply(&member.marks, &mut own);
            write(page, &own)?;
        }
        Ok(())
    })?;
    remove_other_pages(&students, &page_names)?;
    let page = pages::class::page(&class, &page_names, &own_pages);
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
