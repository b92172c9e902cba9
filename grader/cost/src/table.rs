//! The results as text tables.

use super::cells::{count, figures, nanoseconds, narrow, ratio};
use super::picture;
use super::report::{
    Accuracy, CostReport, GridCounts, KernelFamily, KernelRow, RayFamily, Timing, correct_bits,
    whole_bits,
};
use super::trees;
use super::world;
use comfy_table::Table;
use plots::columns::Columns;
use std::fmt::Write;

/// Formats all results as text.
pub fn show(report: &CostReport) -> String {
    let mut printed = Printed::default();
    printed.rest_of(report) + &printed.end_of(report)
}

/// What is printed of a report that grows part by part.
#[derive(Debug, Default)]
pub struct Printed {
    head: bool,
    families: usize,
    legend: bool,
    trees: bool,
    pictures: bool,
    world: bool,
}

impl Printed {
    /// What is not printed yet, as text.
    pub fn rest_of(&mut self, report: &CostReport) -> String {
        let mut text = String::new();
        if !std::mem::replace(&mut self.head, true) {
            text += &head(report);
        }
        for family in &report.families[self.families..] {
            text += &family_text(family);
        }
        self.families = report.families.len();
        if let Some(trees) = report.bvh.as_ref().filter(|_| !self.trees) {
            self.trees = true;
            text += self.legend(report);
            text += &trees::table::show(trees);
        }
        if let Some(rows) = report.world.as_ref().filter(|_| !self.world) {
            self.world = true;
            text += self.legend(report);
            text += &world::table::show(rows);
        }
        if let Some(pictures) = report.pictures.as_ref().filter(|_| !self.pictures) {
            self.pictures = true;
            text += self.legend(report);
            text += &picture::table::show(pictures);
        }
        text
    }

    /// What follows the last part, as text.
    pub fn end_of(&mut self, report: &CostReport) -> String {
        self.rest_of(report) + self.legend(report)
    }

    /// The legend of the kernels' tables, once after the last of them.
    fn legend(&mut self, report: &CostReport) -> &'static str {
        let has_rows = report.families.iter().any(|family| !family.rows.is_empty());
        match has_rows && !std::mem::replace(&mut self.legend, true) {
            true => LEGEND,
            false => "",
        }
    }
}

/// The machine and the settings.
fn head(report: &CostReport) -> String {
    let machine = &report.machine;
    format!(
        "{}, {} threads (one is used), {}, built for {}\nseed {}{}\n",
        machine.cpu,
        machine.cores,
        machine.rustc,
        machine.target_features.join(" "),
        report.seed,
        if report.quick {
            "; --quick: few rays, times are rough"
        } else {
            ""
        },
    )
}

/// The tables of the kernels of one shape.
fn family_text(family: &KernelFamily) -> String {
    let mut text = String::new();
    // A handout before this task has no kernels to compare with, because they would be a
    // solution.
    if family.rows.is_empty() {
        let missing = family
            .student_missing
            .as_deref()
            .unwrap_or("there is nothing to measure");
        let _ = writeln!(text, "\n{}: no rows: {missing}.", family.shape.name());
        return text;
    }
    let _ = writeln!(text, "\n{}", times(family));
    let _ = writeln!(text, "{}", errors(family));
    let _ = writeln!(text, "{}", decisions(family));
    let _ = writeln!(text, "{}", bits(family));
    if let Some(missing) = &family.student_missing {
        let _ = writeln!(text, "Your code is not measured: {missing}.");
    }
    for column in &family.columns {
        let _ = writeln!(text, "  {}: {}", column.family.name(), column.about);
    }
    text
}

/// Explains the columns.
const LEGEND: &str = "\n\
Time: ns for hit or miss, t and hit point: the median of interleaved rounds, each pass after an untimed one; ± reaches the\n\
farther quartile; ~ marks a tie with the textbook. With AVX2 and FMA all kernels use these instructions, the textbook's too.\n\
Wrong: false hits + false misses per million rays that are decidable for a robust f64 kernel. Kernels in f32 are\n\
judged on rounded inputs. Leaks: rays per million that leave a closed mesh without a hit, aimed at its edges from inside.\n\
Grid: the same exactly at vertices, edges and diagonals of an integer terrain; miscounted: not one triangle is hit, but several\n\
or none, so a count by triangles, as parity needs it, is wrong.\n\
Bits: leading bits of t that are correct for 50 % and for 99.9 % of the rays; mean: of 50 %, over all families of rays, as in\n\
the plot of --html. * marks your own code.\n";

/// The table of times and operations.
fn times(family: &KernelFamily) -> Table {
    let with_fma =
        |of: fn(&Timing) -> String| move |row: &KernelRow| row.time_with_fma.as_ref().map(of);
    let columns = Columns::new(family.shape.name(), name)
        .and("ns", |row| nanoseconds(&row.time))
        .and("vs. textbook", |row| ratio(&row.time))
        .and_some("ns with\nAVX2, FMA", with_fma(nanoseconds))
        .and_some("vs. textbook\nwith AVX2, FMA", with_fma(ratio))
        .and("operations", |row| {
            let total = row.operations.map(|operations| operations.total());
            total.map_or(String::new(), figures)
        });
    narrow(&columns, &family.rows)
}

/// The table of leaks, and of errors on ordinary rays.
fn errors(family: &KernelFamily) -> Table {
    let on_grid = |of: fn(&GridCounts) -> f64| {
        move |row: &KernelRow| row.grid.as_ref().map(|grid| count(of(grid)))
    };
    let columns = Columns::new(family.shape.name(), name)
        .and_some("leaks", |row| row.leaks_per_million.map(count))
        .and_some("lost on\na grid", on_grid(|grid| grid.lost_per_million))
        .and_some(
            "miscounted\non a grid",
            on_grid(|grid| grid.miscounted_per_million),
        )
        .and("error of t, ulp:\n50 %, 99.9 %, max", |row| {
            let t = row.by_ray_family.first().and_then(|accuracy| accuracy.t);
            t.map_or(String::new(), |t| {
                let [p50, p999, max] = [t.ulp.p50, t.ulp.p999, t.ulp.max].map(figures);
                format!("{p50} {p999:>6} {max:>6}")
            })
        })
        .and_some("off surface,\nulp, 99.9 %", |row| {
            ordinary_off(row).map(figures)
        });
    narrow(&columns, &family.rows)
}

/// Returns the distance of hit points of ordinary rays from the surface, in ulp.
fn ordinary_off(row: &KernelRow) -> Option<f64> {
    let ordinary = row.by_ray_family.first()?;
    Some(ordinary.off_surface?.ulp.p999)
}

/// The table of wrong decisions, one column per family of rays.
fn decisions(family: &KernelFamily) -> Table {
    let wrong = |accuracy: &Accuracy| count(accuracy.wrong_per_million());
    narrow(
        &by_family(family, "wrong per million", &wrong),
        &family.rows,
    )
}

/// The table of correct bits, one column per family of rays, and their mean.
fn bits(family: &KernelFamily) -> Table {
    let bits = |accuracy: &Accuracy| {
        accuracy.t.map_or(String::new(), |t| {
            let [p50, p999] = [t.relative.p50, t.relative.p999].map(correct_bits);
            format!("{} {:2}", whole_bits(p50), whole_bits(p999))
        })
    };
    let columns = by_family(family, "correct bits of t", &bits).and("mean", |row| {
        whole_bits(row.mean_correct_bits()).to_string()
    });
    narrow(&columns, &family.rows)
}

fn by_family<'a>(
    family: &KernelFamily,
    what: &str,
    cell: &'a dyn Fn(&Accuracy) -> String,
) -> Columns<'a, KernelRow> {
    let corner = format!("{}: {what}", family.shape.name());
    let families = family.columns.iter().enumerate();
    families.fold(Columns::new(&corner, name), |columns, (i, column)| {
        columns.and(heading(column.family), move |row| {
            row.by_ray_family.get(i).map_or(String::new(), cell)
        })
    })
}

/// Returns the heading of a column, on two lines if it has two words.
fn heading(family: RayFamily) -> &'static str {
    match family {
        RayFamily::Ordinary => "ordi-\nnary",
        RayFamily::FarOffset => "far\noffset",
        RayFamily::TinyScale => "tiny\nscale",
        RayFamily::HugeScale => "huge\nscale",
        RayFamily::OnTheSurface => "on the\nsurface",
        RayFamily::Grazing => "graz-\ning",
        other => other.name(),
    }
}

fn name(row: &KernelRow) -> String {
    let star = if row.student { "* " } else { "" };
    format!("{star}{} {}", row.name, row.precision.name())
}
