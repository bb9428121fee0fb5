//! Command line of `ligne`: parsing, requests, and one module or folder for each command.
//!
//! A call runs in these steps:
//! 1. `shorthand` turns `ligne MODEL` into `ligne draw MODEL`.
//! 2. `config` adds options from environment variables and `ligne.toml`.
//! 3. clap parses the words into the argument structs of `options` (one file for each group of options).
//! 4. `request` checks them and makes a `DrawRequest`.
//! 5. The command draws, compares or lists. Files are staged in `output` and renamed at the end, all or none.
//!
//! Commands: `draw`, `animate`, `page`, `diff`, `test`, `fmt`, `info`, `styles`, `manual` (`man`,
//! `completions`); `lod` is in `models`, which opens models. `step` converts STEP files. `library_calls`
//! wraps the library calls that several commands share, and `json_files` reads and writes JSON.

mod animate;
mod config;
mod diff;
mod draw;
mod fmt;
mod info;
mod json_files;
mod library_calls;
mod manual;
mod models;
mod options;
mod output;
mod page;
mod request;
mod shorthand;
mod step;
mod styles;
mod test;
mod tolerances;

use std::io::Write;
use std::process::ExitCode;

use clap::{Args, Command as Program, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::error::Error;

/// Exit status if compared drawings differ.
const EXIT_DIFFERENCES: u8 = 1;

/// Exit status if the call or an input file is wrong.
const EXIT_WRONG: u8 = 2;

/// Exit status if the same call may succeed later, for example after a full disc. Source: EX_TEMPFAIL of
/// sysexits.h.
const EXIT_TRY_LATER: u8 = 75;

const EXAMPLES: &str = "Examples:
  ligne model.obj                                writes model.svg in the style ink
  ligne model.glb model.png --style toon         flat colours; `ligne styles` lists all styles
  ligne draw *.glb --out-dir drawings            draws many models
  ligne info model.stl                           lists contents and defects of a model

A model as the first word means `ligne draw`.";

/// Usage of the program.
const USAGE: &str = "ligne [OPTIONS] <COMMAND>
       ligne <MODEL> [OUT]... [OPTIONS]";

/// Help heading of the options that commands share with `ligne draw`.
const SHARED_HEADING: &str = "Options shared with ligne draw";

/// Commands that share options with `ligne draw`.
const SHARING_COMMANDS: [&str; 3] = ["animate", "diff", "styles"];

/// Arguments of the program.
#[derive(Debug, Parser)]
#[command(
    name = "ligne",
    version,
    about = "Turns a 3D model into a vector line drawing",
    arg_required_else_help = true,
    override_usage = USAGE,
    after_help = EXAMPLES
)]
struct Cli {
    #[command(subcommand)]
    command: Command,

    /// Ignore ligne.toml
    #[arg(long, global = true)]
    no_config: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Draw a model
    Draw(Box<options::draw_args::DrawArgs>),
    /// Draw an animation or a turntable as frames or a film
    Animate(Box<animate::AnimateArgs>),
    /// Compose drawings on pages: comic pages, technical sheets
    Page(Box<page::PageArgs>),
    /// Compare two drawings or models by geometry
    Diff(Box<diff::DiffArgs>),
    /// Draw the cases of a folder and compare them with approved drawings
    Test(test::TestArgs),
    /// Rewrite drawings in canonical form for version control
    Fmt(fmt::FmtArgs),
    /// List contents and defects of a model file
    Info(info::InfoArgs),
    /// Precompute the simplification of a model, for --faces
    Lod(models::lod::LodArgs),
    /// List or print built-in styles, or draw a model in all of them
    Styles(Box<styles::StylesArgs>),
    /// Print a completion script for a shell
    Completions(manual::completions::CompletionsArgs),
    /// Print a manual page
    Man(manual::man_page::ManArgs),
}

/// Commands and options of the program, for the parser, help, manual pages and completions.
fn program() -> Program {
    let of_drawing = options::draw_args::HowArgs::augment_args(Program::new("draw"));
    let shared: Vec<_> = of_drawing.get_arguments().map(|option| option.get_id().clone()).collect();
    let mut program = Cli::command();
    // `Command::mut_subcommand` would move the command to the end of the list.
    for command in
        program.get_subcommands_mut().filter(|command| SHARING_COMMANDS.contains(&command.get_name()))
    {
        *command = std::mem::take(command).mut_args(|option| {
            if shared.contains(option.get_id()) { option.help_heading(SHARED_HEADING) } else { option }
        });
    }
    program
}

/// Runs the program with the arguments of the process.
#[must_use]
pub fn main() -> ExitCode {
    let surroundings = config::call_defaults::CallEnvironment::of_process();
    let program = program();
    let typed = shorthand::expanded(std::env::args_os().collect(), &program);
    let words = match config::call_defaults::complete(typed, &program, &surroundings) {
        Ok(words) => words,
        Err(error) => {
            say(&format!("error: {error}"));
            return ExitCode::from(EXIT_WRONG);
        }
    };
    let parsed = program.clone().try_get_matches_from(&words);
    let cli = match parsed.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) => {
            let error = options::style_keys::with_tip(error, &words, &program);
            // There is no other place to report a failure of standard error.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(EXIT_WRONG));
        }
    };
    let success = |()| ExitCode::SUCCESS;
    let done = match cli.command {
        Command::Draw(args) if args.contact.contact_sheet => {
            draw::contact_sheet::of_views(*args).map(success)
        }
        Command::Draw(args) if draw::batch::is_batch(&args) => draw::batch::run(*args),
        Command::Draw(args) => request::draw_request::DrawRequest::new(*args)
            .and_then(|request| draw::model_drawing::run(&request))
            .map(success),
        Command::Animate(args) => animate::run(*args).map(success),
        Command::Page(args) => page::run(&args).map(success),
        Command::Diff(args) => diff::run(&args),
        Command::Test(args) => test::run(&args, cli.no_config, &surroundings),
        Command::Fmt(args) => fmt::run(&args),
        Command::Info(args) => info::run(&args).map(success),
        Command::Lod(args) => models::lod::run(&args).map(success),
        Command::Styles(args) => styles::run(&args).map(success),
        Command::Completions(args) => manual::completions::run(&args).map(success),
        Command::Man(args) => manual::man_page::run(&args).map(success),
    };
    match done {
        Ok(status) => status,
        Err(error) => {
            say(&format!("error: {error}"));
            ExitCode::from(output::exit_status::of_error(&error))
        }
    }
}

/// Prints a line on standard error. A closed pipe is not an error.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Writes to standard output. A closed pipe is not an error.
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
    /// Maximum length of a help text that fits on one line next to its option on a wide terminal.
    const MAX_HELP_CHARS: usize = 125;

    #[test]
    fn every_option_has_one_line_of_help() {
        let mut program = super::program();
        program.build();
        for command in program.get_subcommands().filter(|command| command.get_name() != "help") {
            for option in command.get_arguments() {
                let help = option.get_help().map(ToString::to_string).unwrap_or_default();
                let place = format!("{} {option}: {help}", command.get_name());
                assert!(!help.is_empty() && help.chars().count() <= MAX_HELP_CHARS, "{place}");
                assert!(option.get_long_help().is_none() && !help.ends_with('.'), "{place}");
            }
        }
    }

    use crate::error::spelling::british;

    #[test]
    fn options_in_british_spelling_have_american_aliases() {
        let program = super::program();
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
    fn commands_are_valid_and_their_help_shows_an_example() {
        let mut command = super::program();
        command.build();
        command.clone().debug_assert();
        for subcommand in command.get_subcommands_mut().filter(|c| c.get_name() != "help") {
            let help = subcommand.render_long_help().to_string();
            assert!(help.contains("Example"), "{help}");
        }
    }
}
