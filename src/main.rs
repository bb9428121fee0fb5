//! The `ligne` program: everything it does is in [`ligne::cli`].
#![forbid(unsafe_code)]

fn main() -> std::process::ExitCode {
    ligne::cli::main()
}
