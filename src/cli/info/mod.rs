//! `ligne info`: contents and defects of a model file.
//!
//! `contents` collects what a scene holds, with a file for each kind of entry: `parts` with their `precision`, `left_out`,
//! `materials`, `joints`, and `staging` for lights, cameras and animations. `summary` writes it for people, in the lists of `lists`. JSON, for
//! programs, has all of it.

mod args;
mod contents;
mod joints;
mod left_out;
mod lists;
mod materials;
mod parts;
mod precision;
mod staging;
mod summary;
#[cfg(test)]
mod tests;

pub(super) use self::args::InfoArgs;
use self::contents::Info;
use super::print;
use super::step::open_rigged;
use crate::error::Error;

/// Reads the model and prints its contents.
pub(super) fn run(args: &InfoArgs) -> Result<(), Error> {
    let rigged = open_rigged(&args.model, &args.step)?;
    let info = Info::of(&rigged.posed(&[])?, &rigged.rig, args);
    if args.json {
        let json = serde_json::to_string_pretty(&info).unwrap_or_default();
        print(format!("{json}\n").as_bytes())
    } else {
        print(info.text(args.all).as_bytes())
    }
}
