//! `ligne diff`: differences between two drawings, two models, or two folders of them.
//!
//! 1. [`input_pairs`] pairs the files: two files, or the files of two folders by name ([`folder_files`]).
//! 2. Models are drawn first, the second from the view of the first. `crate::diff` compares the drawings.
//! 3. [`comparison`] holds the result for each pair. [`report`] prints it as text, JSON or Markdown.
//! 4. [`difference_pictures`] draws the differences if `--image` is given.

mod comparison;
mod difference_pictures;
mod folder_files;
mod input_pairs;
mod report;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use self::comparison::FileComparison;
use self::difference_pictures::PictureTarget;
use self::input_pairs::InputPairs;
use super::{EXIT_DIFFERENCES, library_calls, print};
use crate::cli::options::draw_args::HowArgs;
use crate::cli::output::output_files::Staging;
use crate::diff::{self, DiffOptions, Ignore, Tolerances, View};
use crate::error::Error;

const EXAMPLES: &str = "Examples:
  ligne diff old.svg new.svg                           one line per difference
  ligne diff old.svg new.svg --tolerance lines=0.05mm,fills=0.2mm --image changes.svg
  ligne diff v1/drive.glb v2/drive.glb --view iso      two models from the same view
  ligne diff approved/ drawn/ --markdown > summary.md  two folders, paired by file name

Exit status: 0 no difference, 1 differences, 2 error.";

/// Options of `ligne diff`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct DiffArgs {
    /// Old drawing (.svg), model (.obj, .gltf, .glb, .stl, .ply, .step) or folder
    before: PathBuf,

    /// New drawing, model or folder
    after: PathBuf,

    /// Distance within which ink counts as equal: 0.1px, or lines=0.05mm,fills=0.2mm [default: twice the written precision]
    #[arg(long, value_name = "LENGTH", help_heading = "Comparison", value_parser = tolerances)]
    tolerance: Option<Tolerances>,

    /// Ignore labels, colours, widths or text; a list, or repeatable
    #[arg(long, value_name = "WHAT", help_heading = "Comparison", value_parser = ignore)]
    ignore: Vec<Ignore>,

    /// Compare pixels as well
    #[arg(long, help_heading = "Comparison")]
    pixels: bool,

    /// List each mark on its own line
    #[arg(long, help_heading = "Comparison", conflicts_with_all = ["json", "markdown"])]
    all: bool,

    /// Print JSON
    #[arg(long, help_heading = "Comparison", conflicts_with = "markdown")]
    json: bool,

    /// Print Markdown, for a pull request
    #[arg(long, help_heading = "Comparison")]
    markdown: bool,

    /// Draw the differences: removed in red, added in green; for folders, a folder
    #[arg(long, value_name = "OUT.svg|png", help_heading = "Comparison")]
    image: Option<PathBuf>,

    /// Draw both versions side by side instead of overlaid
    #[arg(long, help_heading = "Comparison", requires = "image")]
    side_by_side: bool,

    #[command(flatten)]
    how: HowArgs,
}

fn tolerances(text: &str) -> Result<Tolerances, String> {
    Tolerances::parse(text).map_err(|error| error.to_string())
}

fn ignore(text: &str) -> Result<Ignore, String> {
    Ignore::parse(text).map_err(|error| error.to_string())
}

/// Compares the inputs, prints the differences, and draws them if requested.
pub(crate) fn run(args: &DiffArgs) -> Result<ExitCode, Error> {
    let pairing = InputPairs::new(&args.before, &args.after)?;
    let images = args.image.as_deref().map(|path| PictureTarget::new(path, &pairing)).transpose()?;
    let options = DiffOptions {
        tolerances: args.tolerance.clone().unwrap_or_default(),
        pixels: args.pixels,
        ignore: args.ignore.iter().fold(Ignore::default(), |all, more| all.and(*more)),
        brief: !(args.all || args.json || args.markdown || args.image.is_some()),
    };
    let told = library_calls::in_threads(args.how.threads, || compare_pairs(args, &pairing, &options))??;
    if let Some(images) = images {
        let view = if args.side_by_side { View::SideBySide } else { View::Over };
        let mut staging = Staging::default();
        images.add(&told, view, &mut staging)?;
        staging.commit()?;
    }
    let text = match (&pairing, args.json, args.markdown) {
        (_, true, _) => report::json(&told, &pairing),
        (_, _, true) => report::markdown(&told, args),
        _ if args.how.quiet => String::new(),
        _ => report::text(&told, &pairing, args.all),
    };
    print(text.as_bytes())?;
    Ok(match told.iter().all(|(_, told)| told.is_same()) {
        true => ExitCode::SUCCESS,
        false => ExitCode::from(EXIT_DIFFERENCES),
    })
}

/// Compares all pairs. Returns the results by name.
fn compare_pairs(
    args: &DiffArgs,
    pairing: &InputPairs,
    options: &DiffOptions,
) -> Result<Vec<(String, FileComparison)>, Error> {
    let mut told = Vec::new();
    for (name, sides) in &pairing.names {
        told.push((
            name.clone(),
            match sides {
                [Some(before), Some(after)] => {
                    let [before, after] = input_pairs::pictures(before, after, &args.how)?;
                    FileComparison::Both(Box::new(diff::compare(&before, &after, options)))
                }
                [Some(_), None] => FileComparison::Only(0),
                _ => FileComparison::Only(1),
            },
        ));
    }
    Ok(told)
}
