//! The command line: what was typed, what is meant, one file a command.

/// Runs the program.
pub fn main() -> std::process::ExitCode {
    std::process::ExitCode::from(2)
}
