//! Merges parts of a picture: cells and ranges of samples that several machines rendered.

use crate::exact_sum::PixelSum;
use crate::sums_file::{SumsFile, SumsHead};
use kit::film::Cell;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The picture that the parts in `paths` have together, with the bits of one run: each sample once,
/// added exactly.
///
/// The parts have to be of one picture, their cells have to fill a rectangle, and all pixels need
/// the same range of samples, without gaps or overlaps. The error is a sentence that names the
/// file, or the flags of what is missing.
pub fn merge(paths: &[PathBuf]) -> Result<SumsFile, String> {
    let named = |path: &Path, why: String| format!("{} {why}", path.display());
    let mut parts = Vec::new();
    for path in paths {
        let head = SumsHead::read(path).map_err(|why| named(path, why))?;
        parts.push((path.as_path(), head));
    }
    let head = merged_head(&parts)?;
    let (w, area) = (head.cell.x1 - head.cell.x0, head.cell.area());
    let mut pixels = vec![PixelSum::default(); area as usize];
    // By their first sample, so that pixels without exact sums do not depend on the order of the
    // arguments either.
    parts.sort_by_key(|(_, part)| part.first_sample);
    for (path, part) in parts {
        let file = SumsFile::read(path).map_err(|why| named(path, why))?;
        if file.head != part {
            return Err(named(path, "was changed while it was read".to_owned()));
        }
        for ((x, y), sum) in part.cell.pixels().zip(&file.pixels) {
            let i = (y - head.cell.y0) as usize * w as usize + (x - head.cell.x0) as usize;
            pixels[i].merge(sum);
        }
    }
    Ok(SumsFile { head, pixels })
}

/// The head of all parts together, if they fit.
fn merged_head(parts: &[(&Path, SumsHead)]) -> Result<SumsHead, String> {
    let Some(&(first_path, first)) = parts.first() else {
        return Err("there are no files to merge".to_owned());
    };
    for (path, part) in parts {
        let same = |a: &SumsHead| (a.picture, a.film, a.adaptive);
        if same(part) != same(&first) {
            return Err(format!(
                "{} and {} are not parts of one picture: render all with the same scene, camera, textures and flags, \
                 apart from -p, --first-sample, -s and -t. Parts of -s 1 have their samples at the centres of pixels, and \
                 merge only with each other",
                first_path.display(),
                path.display()
            ));
        }
    }
    let heads = || parts.iter().map(|(_, part)| part);
    let mut head = first;
    for part in heads() {
        let (a, b) = (&mut head.cell, part.cell);
        (a.x0, a.y0) = (a.x0.min(b.x0), a.y0.min(b.y0));
        (a.x1, a.y1) = (a.x1.max(b.x1), a.y1.max(b.y1));
        head.first_sample = head.first_sample.min(part.first_sample);
    }
    let end = heads().map(end_of).max().unwrap_or(0);
    head.samples = end - head.first_sample;
    check_coverage(parts, &head)?;
    Ok(head)
}

/// One past the last sample.
fn end_of(part: &SumsHead) -> u32 {
    part.first_sample + part.samples
}

/// Checks that each pixel of `whole` has each of its samples exactly once.
fn check_coverage(parts: &[(&Path, SumsHead)], whole: &SumsHead) -> Result<(), String> {
    let edges = |of: fn(&Cell) -> [u32; 2]| -> Vec<u32> {
        let edges: BTreeSet<u32> = parts.iter().flat_map(|(_, p)| of(&p.cell)).collect();
        edges.into_iter().collect()
    };
    let (columns, rows) = (edges(|c| [c.x0, c.x1]), edges(|c| [c.y0, c.y1]));
    // No edge of a part is inside such a rectangle, so all its pixels have the same parts.
    for y in rows.windows(2) {
        for x in columns.windows(2) {
            let cell = Cell {
                x0: x[0],
                y0: y[0],
                x1: x[1],
                y1: y[1],
            };
            let contains =
                |c: Cell| c.x0 <= cell.x0 && cell.x1 <= c.x1 && c.y0 <= cell.y0 && cell.y1 <= c.y1;
            let mut here: Vec<&(&Path, SumsHead)> = parts
                .iter()
                .filter(|(_, part)| contains(part.cell))
                .collect();
            here.sort_by_key(|(_, part)| part.first_sample);
            let mut next = whole.first_sample;
            let mut last: Option<&Path> = None;
            for (path, part) in here {
                if part.first_sample > next {
                    return Err(missing(whole, cell, next, part.first_sample));
                }
                if let Some(last) = last.filter(|_| part.first_sample < next) {
                    return Err(format!(
                        "{} and {} have the same samples of the same pixels: give each part once",
                        last.display(),
                        path.display()
                    ));
                }
                next = end_of(part);
                last = Some(path);
            }
            if next < end_of(whole) {
                return Err(missing(whole, cell, next, end_of(whole)));
            }
        }
    }
    Ok(())
}

/// Says which part to render.
fn missing(whole: &SumsHead, cell: Cell, first: u32, end: u32) -> String {
    let Cell { x0, y0, x1, y1 } = cell;
    let cell = if cell == whole.film.whole() {
        String::new()
    } else {
        format!("-p {x0} {y0} {} {} ", x1 - x0, y1 - y0)
    };
    let samples = end - first;
    if samples == 1 && whole.samples > 1 {
        return format!(
            "a part is missing: of {cell}sample {first} alone. A part has at least two, because the only sample of a \
             picture is at the centre of its pixel: render this one together with a neighbouring part"
        );
    }
    let range = match first {
        0 => format!("-s {samples}"),
        _ => format!("--first-sample {first} -s {samples}"),
    };
    format!("a part is missing: render it with {cell}{range}, and the other flags as before")
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::FilmSize;

    fn part(cell: [u32; 4], first_sample: u32, samples: u32) -> SumsHead {
        let [x0, y0, x1, y1] = cell;
        SumsHead {
            picture: 7,
            film: FilmSize { w: 8, h: 4 },
            cell: Cell { x0, y0, x1, y1 },
            first_sample,
            samples,
            adaptive: false,
        }
    }

    fn merged(parts: &[SumsHead]) -> Result<SumsHead, String> {
        let names: Vec<PathBuf> = (0..parts.len())
            .map(|i| format!("{i}.sums").into())
            .collect();
        let parts: Vec<(&Path, SumsHead)> = names
            .iter()
            .map(PathBuf::as_path)
            .zip(parts.iter().copied())
            .collect();
        merged_head(&parts)
    }

    #[test]
    fn cells_and_ranges_fill_a_rectangle() {
        let whole = [0, 0, 8, 4];
        assert_eq!(merged(&[part(whole, 0, 16)]), Ok(part(whole, 0, 16)));
        let ranges = [part(whole, 16, 16), part(whole, 0, 16), part(whole, 32, 2)];
        assert_eq!(merged(&ranges), Ok(part(whole, 0, 34)));
        let cells = [
            part([0, 0, 3, 4], 0, 8),
            part([3, 0, 8, 1], 0, 8),
            part([3, 1, 8, 4], 0, 4),
            part([3, 1, 8, 4], 4, 4),
        ];
        assert_eq!(merged(&cells), Ok(part(whole, 0, 8)));
        let corner = [part([2, 1, 4, 2], 8, 8), part([4, 1, 5, 2], 8, 8)];
        assert_eq!(merged(&corner), Ok(part([2, 1, 5, 2], 8, 8)));
    }

    #[test]
    fn what_is_missing_is_named_with_its_flags() {
        let whole = [0, 0, 8, 4];
        let gap = merged(&[part(whole, 0, 16), part(whole, 24, 8)]);
        assert!(
            gap.unwrap_err()
                .contains("with --first-sample 16 -s 8, and")
        );
        let hole = merged(&[
            part([0, 0, 3, 4], 0, 8),
            part([3, 0, 8, 1], 0, 8),
            part([3, 2, 8, 4], 0, 8),
        ]);
        assert!(hole.unwrap_err().contains("with -p 3 1 5 1 -s 8, and"));
        let one = merged(&[part(whole, 0, 8), part(whole, 9, 3)]);
        assert!(one.unwrap_err().contains("of sample 8 alone. A part has"));
        let short = merged(&[part([0, 0, 3, 4], 0, 8), part([3, 0, 8, 4], 0, 6)]);
        assert!(
            short
                .unwrap_err()
                .contains("-p 3 0 5 4 --first-sample 6 -s 2,")
        );
    }

    #[test]
    fn overlaps_and_other_pictures_are_refused() {
        let whole = [0, 0, 8, 4];
        let twice = merged(&[part(whole, 0, 16), part(whole, 0, 16)]);
        assert!(
            twice
                .unwrap_err()
                .contains("0.sums and 1.sums have the same samples")
        );
        let overlap = merged(&[part(whole, 0, 16), part([1, 1, 2, 2], 15, 4)]);
        assert!(overlap.is_err());
        let other = SumsHead {
            picture: 8,
            ..part(whole, 16, 16)
        };
        let mixed = merged(&[part(whole, 0, 16), other]);
        assert!(mixed.unwrap_err().contains("not parts of one picture"));
        assert!(merged(&[]).is_err());
    }
}
