//! `ligne completions`: a completion script for a shell.

use clap::Args;
use clap_complete::{Shell, generate};

use crate::error::Error;

/// Options of `ligne completions`.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  ligne completions bash > ~/.local/share/bash-completion/completions/ligne"
)]
pub(crate) struct CompletionsArgs {
    /// Shell
    shell: Shell,
}

/// Writes the completion script to standard output.
pub(crate) fn run(args: &CompletionsArgs) -> Result<(), Error> {
    let mut script = Vec::new();
    generate(args.shell, &mut crate::cli::program(), "ligne", &mut script);
    if args.shell == Shell::Bash {
        script = without_space_after_keys(script);
    }
    crate::cli::print(&script)
}

/// Completion script for bash without a space between a key of `--set` and its value.
fn without_space_after_keys(script: Vec<u8>) -> Vec<u8> {
    let case = "--set)\n";
    let text = String::from_utf8_lossy(&script);
    text.replace(case, &format!("{case}                    compopt -o nospace 2>/dev/null\n")).into_bytes()
}
