//! The command line: what was typed, what is meant, one file a command.

mod animate;
mod blend;
mod completions;
mod config;
mod contact_sheet;
mod defaults;
mod diff;
mod draw;
mod draw_args;
mod dxf_args;
mod fmt;
mod framing_args;
mod info;
mod keys;
mod lod;
mod man;
mod many;
mod model_unit;
mod moment;
mod number;
mod numbered;
mod offered;
mod output;
mod page;
mod paper;
mod pipeline;
#[cfg(feature = "pdf")]
mod print_args;
mod progress;
mod request;
mod section_args;
mod shard;
mod status;
mod step;
mod style_keys;
mod styles;
mod test;
mod viewpoint;
mod web;
mod web_args;
mod wonder;

use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use crate::error::Error;

/// Exit status where drawings that were compared differ.
const DIFFERENCES: u8 = 1;

/// Exit status where the call or an input file is wrong.
const WRONG: u8 = 2;

/// Exit status where the same call may well do later: a full disc, a network that is away. EX_TEMPFAIL of sysexits.h.
const LATER: u8 = 75;

const EXAMPLES: &str = "Examples:
  ligne draw model.obj                              writes model.svg, in ink
  ligne draw model.glb model.png --style toon       in flat colours; `ligne styles` lists all
  ligne info model.stl                              says what is in a model, and what is wrong with it";

/// What was typed.
#[derive(Debug, Parser)]
#[command(
    name = "ligne",
    version,
    about = "Turns a 3D model into a vector line drawing",
    arg_required_else_help = true,
    after_help = EXAMPLES
)]
struct Cli {
    #[command(subcommand)]
    command: Command,

    /// Leave ligne.toml aside
    #[arg(long, global = true)]
    no_config: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Draw a model
    Draw(Box<draw_args::DrawArgs>),
    /// Draw the frames of an animation, or of a turn round a model
    Animate(Box<animate::AnimateArgs>),
    /// Compose drawings on pages: comic panels, technical sheets
    Page(Box<page::PageArgs>),
    /// Compare two drawings by geometry
    Diff(Box<diff::DiffArgs>),
    /// Draw every case of a folder and compare it with the approved drawing
    Test(test::TestArgs),
    /// Rewrite drawings in the form that makes small textual differences
    Fmt(fmt::FmtArgs),
    /// Say what is in a model file, and what is wrong with it
    Info(info::InfoArgs),
    /// Write beside a model in which order it loses its faces
    Lod(lod::LodArgs),
    /// List the built-in styles, show one, or draw a model in all of them
    Styles(Box<styles::StylesArgs>),
    /// Write a completion script for a shell
    Completions(completions::CompletionsArgs),
    /// Write the manual page
    Man(man::ManArgs),
}

/// Runs the program with the arguments of the process.
#[must_use]
pub fn main() -> ExitCode {
    let surroundings = defaults::Surroundings::of_process();
    let words = defaults::complete(std::env::args_os().collect(), &Cli::command(), &surroundings);
    let words = match words {
        Ok(words) => words,
        Err(error) => {
            say(&format!("error: {error}"));
            return ExitCode::from(WRONG);
        }
    };
    let cli = match Cli::try_parse_from(&words) {
        Ok(cli) => cli,
        Err(error) => {
            let error = style_keys::with_tip(error, &words, &Cli::command());
            // Nobody is left to tell where this fails.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(WRONG));
        }
    };
    let all_well = |()| ExitCode::SUCCESS;
    let done = match cli.command {
        Command::Draw(args) if args.contact.contact_sheet => contact_sheet::of_views(*args).map(all_well),
        Command::Draw(args) if many::is_asked(&args) => many::run(*args),
        Command::Draw(args) => {
            request::DrawRequest::new(*args).and_then(|request| draw::run(&request)).map(all_well)
        }
        Command::Animate(args) => animate::run(*args).map(all_well),
        Command::Page(args) => page::run(&args).map(all_well),
        Command::Diff(args) => diff::run(&args),
        Command::Test(args) => test::run(&args, cli.no_config, &surroundings),
        Command::Fmt(args) => fmt::run(&args),
        Command::Info(args) => info::run(&args).map(all_well),
        Command::Lod(args) => lod::run(&args).map(all_well),
        Command::Styles(args) => styles::run(&args).map(all_well),
        Command::Completions(args) => completions::run(&args).map(all_well),
        Command::Man(args) => man::run(&args).map(all_well),
    };
    match done {
        Ok(status) => status,
        Err(error) => {
            say(&format!("error: {error}"));
            ExitCode::from(status::of_error(&error))
        }
    }
}

/// A line on standard error; one that nobody reads is no error.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Writes to standard output; a reader that has seen enough and closed the pipe is no error.
fn print(bytes: &[u8]) -> Result<(), Error> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Error::io("cannot write to standard output", error))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use crate::error::spelling::british;

    #[test]
    fn options_in_british_spelling_have_american_aliases() {
        let program = super::Cli::command();
        let mut tried = 0;
        for option in program.get_subcommands().flat_map(clap::Command::get_arguments) {
            let Some(name) = option.get_long() else { continue };
            let american = name.replace("colour", "color").replace("centre", "center");
            assert_eq!(british(name), name, "options are named in British spelling");
            if american != name {
                let aliases = option.get_all_aliases().unwrap_or_default();
                assert!(aliases.contains(&&*american), "--{name} has no alias --{american}");
                tried += 1;
            }
        }
        assert!(tried > 0);
    }

    #[test]
    fn the_commands_are_sound_and_show_an_example() {
        let mut command = super::Cli::command();
        command.build();
        command.clone().debug_assert();
        for subcommand in command.get_subcommands_mut().filter(|c| c.get_name() != "help") {
            let help = subcommand.render_long_help().to_string();
            assert!(help.contains("Example"), "{help}");
        }
    }
}
