//! `ligne fmt`: rewrites drawings in canonical form.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use super::{EXIT_DIFFERENCES, print};
use crate::cli::output::output_files::{Staging, check_place, is_stdout};
use crate::diff::canonical_svg;
use crate::error::Error;
use crate::export::encoding::gzip;

/// Maximum size of an unpacked drawing, bytes.
const MAX_UNPACKED_BYTES: usize = 1 << 30;

/// Options of `ligne fmt`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne fmt drawing.svg               rewrite a drawing in canonical form
  ligne fmt --check docs/*.svg        list the drawings that are not in canonical form
  ligne fmt drawing.svg -o -          write to standard output

The picture stays the same. Marks that do not overlap are sorted, paths start at their upper end, and numbers are rounded.
Version control then shows small differences. Drawings of ligne draw are already in canonical form.")]
pub(crate) struct FmtArgs {
    /// SVG files
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    /// Write nothing; list files that are not in canonical form, and exit with 1 if there are any
    #[arg(long, conflicts_with = "output")]
    check: bool,

    /// Decimals of coordinates [default: from the file]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=8))]
    precision: Option<u8>,

    /// Output for a single FILE; - for standard output
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
}

/// Rewrites the files, all or none.
pub(crate) fn run(args: &FmtArgs) -> Result<ExitCode, Error> {
    if args.files.len() > 1 && args.output.is_some() {
        return Err(Error::new("one output cannot hold several files")
            .at("--output")
            .remedy("leave out --output to rewrite the files in place"));
    }
    if let Some(output) = args.output.as_deref().filter(|output| !is_stdout(output)) {
        check_place(output)?;
    }
    let mut staging = Staging::default();
    let mut strays = String::new();
    for file in &args.files {
        let text = read(file)?;
        let form = canonical_svg(&text, args.precision).map_err(|error| error.in_file(file))?;
        let encoded = |path: &Path| match path.extension() {
            Some(ending) if ending.eq_ignore_ascii_case("svgz") => Cow::Owned(gzip::packed(form.as_bytes())),
            _ => Cow::Borrowed(form.as_bytes()),
        };
        match &args.output {
            _ if args.check && form == text => {}
            _ if args.check => {
                strays.push_str(&file.display().to_string());
                strays.push('\n');
            }
            Some(output) if is_stdout(output) => return print(form.as_bytes()).map(|()| ExitCode::SUCCESS),
            Some(output) => staging.add(output, &encoded(output))?,
            None if form != text => staging.add(file, &encoded(file))?,
            None => {}
        }
    }
    staging.commit()?;
    print(strays.as_bytes())?;
    Ok(if strays.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(EXIT_DIFFERENCES) })
}

fn read(file: &Path) -> Result<String, Error> {
    let bytes = std::fs::read(file)
        .map_err(|error| Error::io("cannot be read", error).in_file(file).remedy("check the path"))?;
    let bytes = gzip::plain(bytes, MAX_UNPACKED_BYTES).map_err(|error| error.in_file(file))?;
    String::from_utf8(bytes)
        .map_err(|_| Error::new("the file is not UTF-8 text").in_file(file).remedy("save it as SVG in UTF-8"))
}
