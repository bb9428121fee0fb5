//! `ligne info`: contents and defects of a model file.
//!
//! 1. [`model_contents`] collects everything into one structure, with a file for each kind of entry:
//!    [`parts`] with their [`precision`], [`degenerate_elements`], [`materials`], [`joints`] and
//!    [`lights_cameras_clips`].
//! 2. [`text_summary`] prints it as text, in the lists of [`text_lists`]. `--json` prints the whole
//!    structure.
//!
//! [`info_args`] defines the options.

mod degenerate_elements;
mod info_args;
mod joints;
mod lights_cameras_clips;
mod materials;
mod model_contents;
mod parts;
mod precision;
#[cfg(test)]
mod tests;
mod text_lists;
mod text_summary;

pub(crate) use self::info_args::InfoArgs;
use self::model_contents::ModelInfo;
use super::step::open_rigged;
use super::{json_files, print};
use crate::error::Error;

/// Reads the model and prints its contents.
pub(crate) fn run(args: &InfoArgs) -> Result<(), Error> {
    let rigged = open_rigged(&args.model, &args.step)?;
    let info = ModelInfo::of(&rigged.posed(&[])?, &rigged.rig, args);
    if args.json { print(json_files::text(&info).as_bytes()) } else { print(info.text(args.all).as_bytes()) }
}
