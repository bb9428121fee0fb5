//! `ligne completions`: a completion script for a shell.

use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

use crate::error::Error;

/// What was typed.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  ligne completions bash > ~/.local/share/bash-completion/completions/ligne"
)]
pub(super) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

/// Writes the script to standard output.
pub(super) fn run(args: &CompletionsArgs) -> Result<(), Error> {
    let mut script = Vec::new();
    generate(args.shell, &mut super::Cli::command(), "ligne", &mut script);
    super::print(&script)
}
