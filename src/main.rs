//! The `ligne` program. Everything it does is in [`ligne::cli`].
#![deny(unsafe_code)]

// The library forbids unsafe code. The program has one small unsafe file, whose effect `docs/dev/speed.md`
// measures.
#[cfg(all(target_os = "linux", target_env = "gnu", target_pointer_width = "64"))]
#[allow(unsafe_code)]
mod heap;

fn main() -> std::process::ExitCode {
    #[cfg(all(target_os = "linux", target_env = "gnu", target_pointer_width = "64"))]
    heap::configure_allocator();
    ligne::cli::main()
}
