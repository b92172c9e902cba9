//! A picture of a closed mesh, with leaks in magenta: see [`leak_view`](crate::leak_view).

use super::kernel_name::name;
use crate::leak_view::{MeshView, NEAR, SIZE, TRIANGLES};
use crate::report::{KernelFamily, KernelRow};
use judge::plural;
use pages::html::{escape, png_data_uri};
use plots::columns::Columns;
use plots::figure::Figure;
use plots::numbers::percent;
use std::fmt::Write;

/// Draws the pictures: with a kernel that leaks (the textbook's if it leaks, else the worst), with
/// the fastest kernel that does not, and with the student's. `None` if no known kernel leaks.
pub(crate) fn figure(family: &KernelFamily) -> Option<Figure> {
    let known = kernels::triangles();
    let leaks = |row: &KernelRow| row.leaks_per_million.unwrap_or(0.0);
    let kernel_of = |row: &KernelRow| {
        let mut known = known.iter().filter(|kernel| !kernel.info.culls);
        known
            .find(|kernel| {
                let precision = crate::measure_kernels::precision(kernel.precision);
                kernel.info.name == row.name && precision == row.precision
            })
            .copied()
    };
    let rows = || {
        family
            .rows
            .iter()
            .filter_map(|row| Some((row, kernel_of(row)?)))
    };
    let leaking = rows()
        .filter(|(row, _)| leaks(row) > 0.0)
        .max_by(|(a, _), (b, _)| {
            let textbook = a.textbook.cmp(&b.textbook);
            textbook.then(leaks(a).total_cmp(&leaks(b)))
        });
    let tight = rows()
        .filter(|(row, _)| row.leaks_per_million == Some(0.0))
        .min_by(|a, b| {
            let [a, b] = [a, b].map(|(row, _)| row.ranked_time().ratio.median);
            a.total_cmp(&b)
        });
    let (leaking, view) = (leaking?, MeshView::traced()?);
    let mut pictures: Vec<(String, Vec<u32>)> = [Some(leaking), tight]
        .into_iter()
        .flatten()
        .map(|(row, kernel)| (name(row), view.leaks(&kernel)))
        .collect();
    if let Some(leaks) = &family.student_leaks {
        pictures.push(("★ your code".into(), leaks.clone()));
    }
    let share = |leaks: &[u32]| percent(leaks.len() as f64 / view.at_edges().max(1) as f64);
    let mut drawing = String::from("<div class=\"pair\">");
    let mut notes = format!(
        "A closed mesh of {TRIANGLES} triangles. {} pixels are within {NEAR} pixels of an edge; their rays are aimed at the edge. ",
        view.at_edges()
    );
    for (name, leaks) in &pictures {
        let [w, h] = SIZE;
        let _ = write!(
            drawing,
            "<figure><img src=\"{}\" width=\"{w}\" height=\"{h}\" alt=\"a closed mesh, {} leaks in magenta\">\
             <figcaption>{}: {}</figcaption></figure>",
            png_data_uri(&view.picture(leaks)),
            leaks.len(),
            escape(name),
            match leaks.len() {
                0 => "no leaks".into(),
                n => plural(n, "leak", "leaks"),
            }
        );
        notes += &match leaks.len() {
            0 => format!("{name} has no leaks. "),
            n => format!("{name} has {n} leaks ({}). ", share(leaks)),
        };
    }
    drawing += "</div>";
    let finding = match pictures.as_slice() {
        [(leaking, leaks), (tight, none), ..] if none.is_empty() => format!(
            "{leaking} lets {} of the rays at edges through, {tight} none",
            share(leaks)
        ),
        [(leaking, leaks), ..] => {
            format!(
                "{leaking} lets {} of the rays at edges through",
                share(leaks)
            )
        }
        [] => return None,
    };
    let columns = Columns::new("test", |(name, _): &(String, Vec<u32>)| name.clone())
        .and("leaks", |(_, leaks)| leaks.len().to_string())
        .and("share of the rays", |(_, leaks)| share(leaks));
    let figure = Figure {
        finding,
        drawing,
        caption: "A closed mesh seen from outside, with a ray aimed at an edge in each pixel near one: in magenta pixels it passes through."
            .into(),
        notes,
        ..Figure::default()
    };
    Some(columns.table(&pictures, figure))
}
