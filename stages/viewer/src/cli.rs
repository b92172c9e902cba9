//! The flags of the program: those of `pathtracer`, and those of the window.

use crate::snapshot::Shot;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser};
use pathtracer::args::{Args, with_advice};
use std::ffi::OsString;
use std::path::PathBuf;

/// Shows a scene, the tree over it, its picture, and the rays of each pixel.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "viewer",
    version,
    max_term_width = 100,
    allow_negative_numbers = true
)]
pub struct ViewerArgs {
    /// The flags of the program `pathtracer`.
    #[command(flatten)]
    pub render: Args,

    /// Show the failing cases of a report of the grader: the report.json that it writes
    #[arg(long, value_name = "REPORT.json")]
    pub report: Option<PathBuf>,

    /// Write a picture of the window instead of opening it; needs no display
    #[arg(long, num_args = 2, value_names = ["MODE", "OUT.png"])]
    pub snapshot: Option<Vec<String>>,

    /// Width and height of the window; without it those of the last time, at first 1400 x 900
    #[arg(long, num_args = 2, value_names = ["W", "H"], value_parser = clap::value_parser!(u16).range(320..))]
    pub window: Vec<u16>,

    /// Compare two pictures, or one with the picture that is rendered
    #[arg(long, num_args = 1..=2, value_names = ["A.png", "B.png"])]
    pub compare: Vec<PathBuf>,

    /// Start with a light window
    #[arg(long)]
    pub light: bool,
}

/// The path that stands for no scene.
const NO_SCENE: &str = "-";

impl ViewerArgs {
    /// Parses the command line. The scene may be missing; its path is then empty.
    pub fn parse_from(
        arguments: impl IntoIterator<Item = OsString>,
    ) -> Result<ViewerArgs, clap::Error> {
        // clap accepts no empty path.
        let command = ViewerArgs::command().mut_arg("scene", |scene| {
            scene.required(false).default_value(NO_SCENE)
        });
        let matches: ArgMatches = command
            .try_get_matches_from(arguments)
            .map_err(with_advice::<ViewerArgs>)?;
        let mut args = ViewerArgs::from_arg_matches(&matches)?;
        if args.render.scene.as_os_str() == NO_SCENE {
            args.render.scene = PathBuf::new();
        }
        Ok(args)
    }

    /// The mode and the file of `--snapshot`. The error is a sentence.
    pub fn shot(&self) -> Result<Option<(Shot, PathBuf)>, String> {
        let Some([mode, path]) = self.snapshot.as_deref() else {
            return Ok(None);
        };
        let shot = <Shot as clap::ValueEnum>::from_str(mode, true).map_err(|_| {
            let names = <Shot as clap::ValueEnum>::value_variants().iter();
            let names = names.filter_map(|shot| {
                Some(
                    clap::ValueEnum::to_possible_value(shot)?
                        .get_name()
                        .to_owned(),
                )
            });
            format!(
                "--snapshot {mode}: choose one of {}",
                names.collect::<Vec<_>>().join(", ")
            )
        })?;
        Ok(Some((shot, PathBuf::from(path))))
    }

    /// Width and height of the window, if it is opened for the first time or the flag is given.
    pub fn window_size(&self) -> [usize; 2] {
        match self.window[..] {
            [w, h] => [w, h].map(usize::from),
            _ => [1400, 900],
        }
    }
}
