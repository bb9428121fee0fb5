//! `ligne completions`: a completion script for a shell.

use clap::Args;
use clap_complete::{Shell, generate};

use crate::error::Error;

/// Options of `ligne completions`.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  ligne completions bash > ~/.local/share/bash-completion/completions/ligne"
)]
pub(super) struct CompletionsArgs {
    /// Shell
    shell: Shell,
}

/// Writes the script to standard output.
pub(super) fn run(args: &CompletionsArgs) -> Result<(), Error> {
    let mut script = Vec::new();
    generate(args.shell, &mut super::program(), "ligne", &mut script);
    super::print(&script)
}
