//! [`StyleSheetArgs`]: the options of `ligne styles --sheet`, which draws a model in several styles on one
//! sheet.
//!
//! They are the options of `ligne draw`, changed before they are added to the command: each requires
//! `--sheet`, `--style` is repeatable, and options without effect are hidden.

use std::path::PathBuf;

use clap::parser::ValueSource;
use clap::{ArgAction, ArgMatches, Args, Command, FromArgMatches};

use crate::cli::options::draw_args::HowArgs;

/// Parsed options of `ligne styles --sheet`.
#[derive(Debug)]
pub(crate) struct StyleSheetArgs {
    pub(crate) sheet: Option<PathBuf>,
    /// Names, globs and files of styles as typed; empty for all built-in styles.
    pub(crate) styles: Vec<String>,
    /// The other options of `ligne draw`.
    pub(crate) how: HowArgs,
}

#[derive(Debug, Args)]
struct SheetArg {
    /// Draw a model in all styles, or those of --style, on one sheet: .svg, .svgz, .png, .pdf or .dxf; - for standard output
    #[arg(long, value_name = "OUT", requires = "name")]
    sheet: Option<PathBuf>,
}

/// Options of `ligne draw` that have no effect on a sheet; they are hidden from the help.
const UNUSED_OPTIONS: [&str; 5] = ["page", "landscape", "margin", "scale", "group"];

impl Args for StyleSheetArgs {
    fn augment_args(command: Command) -> Command {
        let how = HowArgs::augment_args(Command::new("how"));
        let arguments = how.get_arguments().cloned().map(|argument| {
            let id = argument.get_id().to_string();
            let argument = argument.requires("sheet").hide(UNUSED_OPTIONS.contains(&&*id));
            if id == "style" {
                argument
                    .action(ArgAction::Append)
                    .value_name("NAME|GLOB|FILE.toml,...")
                    .help("Styles of --sheet: names, globs and files; repeatable [default: all built-in styles]")
                    .hide_default_value(true)
            } else {
                argument
            }
        });
        SheetArg::augment_args(command).args(arguments)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for StyleSheetArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let typed = matches.value_source("style") == Some(ValueSource::CommandLine);
        let styles = matches.get_many::<String>("style").filter(|_| typed);
        let styles = styles.map(|styles| styles.cloned().collect()).unwrap_or_default();
        Ok(Self {
            sheet: SheetArg::from_arg_matches(matches)?.sheet,
            styles,
            how: HowArgs::from_arg_matches(matches)?,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
