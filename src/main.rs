//! The `ligne` program: everything it does is in [`ligne::cli`].
#![deny(unsafe_code)]

// The library forbids unsafe code; the program has one small file of it, for what `docs/dev/speed.md` measures.
#[cfg(all(target_os = "linux", target_env = "gnu", target_pointer_width = "64"))]
#[allow(unsafe_code)]
mod heap;

fn main() -> std::process::ExitCode {
    #[cfg(all(target_os = "linux", target_env = "gnu", target_pointer_width = "64"))]
    heap::keep();
    ligne::cli::main()
}
