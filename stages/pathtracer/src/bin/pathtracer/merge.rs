//! `pathtracer merge`: one picture of parts that several runs rendered.

use crate::failure::Failure;
use crate::outputs::{self, PictureFile};
use base::{errln, outln};
use clap::Parser;
use pathtracer::args::{RateScaleName, ToneName, stops};
use pathtracer::{Output, OutputError, Tone, merge, rate_picture};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Merges parts of one picture that were rendered with -f NAME.sums: cells (-p) and ranges of
/// samples (--first-sample). The result has the bits of one run.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "pathtracer merge",
    bin_name = "pathtracer merge",
    max_term_width = 100,
    allow_negative_numbers = true
)]
pub(crate) struct MergeArgs {
    /// The parts, in any order
    #[arg(value_name = "PART.sums", required = true)]
    parts: Vec<PathBuf>,

    /// The file to write: .png, .exr or .hdr, or .sums to merge it further
    #[arg(short = 'f', long = "file", value_name = "FILENAME")]
    file: PathBuf,

    /// Exposure of a .png in stops: 1 is twice as bright
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, value_parser = stops)]
    exposure: f64,

    /// Tone curve of a .png
    #[arg(long, value_enum, default_value_t = ToneName::Assignment)]
    tone: ToneName,

    /// Colours of the sample counts, if the parts were rendered with -a
    #[arg(long, value_enum, default_value_t = RateScaleName::Viridis)]
    rate_scale: RateScaleName,
}

/// Merges the parts of `args`.
pub(crate) fn run(args: &MergeArgs) -> Result<ExitCode, Failure> {
    let taken: Vec<(&str, &Path)> = args
        .parts
        .iter()
        .map(|part| ("a part", part.as_path()))
        .collect();
    outputs::refuse_taken("-f", &args.file, &taken)?;
    let tone = Tone {
        exposure: args.exposure,
        curve: args.tone.into(),
    };
    let file = PictureFile::create(&args.file, tone)?;
    let merged = merge(&args.parts)?;
    let head = merged.head;
    let rate = match &file {
        PictureFile::Picture(_) if head.adaptive => {
            let path = outputs::rate_path(&args.file);
            outputs::refuse_taken("the sample counts of -a", &path, &taken)?;
            Some((Output::create(&path)?, path))
        }
        _ => None,
    };
    let cell = head.cell;
    outln!(
        "Merged      {} parts: {} x {} pixels, samples {} to {}",
        args.parts.len(),
        cell.x1 - cell.x0,
        cell.y1 - cell.y0,
        head.first_sample,
        head.first_sample + head.samples - 1,
    );
    if cell != head.film.whole() || head.first_sample > 0 {
        errln!(
            "note: this is a part of a picture of {} x {} pixels: from column {}, row {}, sample {} on",
            head.film.w,
            head.film.h,
            cell.x0,
            cell.y0,
            head.first_sample
        );
    }
    let film = merged.film();
    match file {
        PictureFile::Picture(file) => file.write(&film, cell)?,
        PictureFile::Sums(file) => merged
            .write(&file)
            .map_err(|why| OutputError::NotWritable(args.file.clone(), why))?,
    }
    outln!("Wrote       {}", args.file.display());
    if let Some((rate, path)) = rate {
        let picture = rate_picture(&film, cell, head.samples, args.rate_scale.into());
        rate.write_bytes(&picture)?;
        outln!("Wrote       {}", path.display());
    }
    Ok(ExitCode::SUCCESS)
}
