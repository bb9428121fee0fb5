//! Support for the command-line tests: running the program in a temporary folder.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A cube of side 2 and a cube of side 1 above it, as two parts.
pub const CUBES: &str = "\
o base
v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8
o knob
v -.5 1.5 -.5\nv .5 1.5 -.5\nv .5 2.5 -.5\nv -.5 2.5 -.5\nv -.5 1.5 .5\nv .5 1.5 .5\nv .5 2.5 .5\nv -.5 2.5 .5
f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 11 12 16 15\nf 10 11 15 14\nf 12 9 13 16
";

/// A temporary folder, removed when it is dropped.
pub struct TestFolder(PathBuf);

impl TestFolder {
    /// An empty folder with a unique path that contains `name`.
    pub fn new(name: &str) -> Self {
        static FOLDERS: AtomicUsize = AtomicUsize::new(0);
        let number = FOLDERS.fetch_add(1, Ordering::Relaxed);
        let folder = std::env::temp_dir().join(format!("ligne-test-{name}-{}-{number}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder for the test");
        Self(folder)
    }

    /// An empty folder with the cubes in `cubes.obj`.
    pub fn with_cubes(name: &str) -> Self {
        let folder = Self::new(name);
        folder.write("cubes.obj", CUBES);
        folder
    }

    pub fn write(&self, name: &str, text: &str) {
        let path = self.0.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder of the test");
        fs::write(path, text).expect("a file of the test");
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).expect("text")
    }

    /// Names of the files in the folder, sorted.
    pub fn names(&self) -> Vec<String> {
        self.names_in("")
    }

    /// Names of the files in a subfolder, sorted.
    pub fn names_in(&self, inner: &str) -> Vec<String> {
        let entries = fs::read_dir(self.0.join(inner)).expect("the folder of the test");
        let mut names: Vec<String> =
            entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Runs `ligne` in the folder, with arguments separated by spaces.
    pub fn ligne(&self, line: &str) -> RunResult {
        self.run(&line.split_whitespace().collect::<Vec<_>>())
    }

    /// Runs `ligne` in the folder with these arguments.
    pub fn run(&self, args: &[&str]) -> RunResult {
        let output = self.command(args).output().expect("the program runs");
        RunResult::new(output)
    }

    /// Runs `ligne` in the folder with additional environment variables.
    pub fn run_with(&self, variables: &[(&str, &str)], line: &str) -> RunResult {
        let mut command = self.command(&line.split_whitespace().collect::<Vec<_>>());
        RunResult::new(command.envs(variables.iter().copied()).output().expect("the program runs"))
    }

    /// The path of a file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// A command that runs `ligne` in the folder.
    pub fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ligne"));
        command.args(args).current_dir(&self.0);
        // Settings of the machine must not affect the tests.
        for variable in ["LIGNE_STYLE", "LIGNE_THREADS", "CI", "SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"]
            .iter()
            .chain(&["LIGNE_STEP_CONVERTER", "LIGNE_STEP_SECONDS", "LIGNE_STEP_MB"])
        {
            command.env_remove(variable);
        }
        command
    }
}

impl Drop for TestFolder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Exit status and output of a run.
#[derive(Debug)]
pub struct RunResult {
    pub status: Option<i32>,
    pub out: String,
    pub err: String,
}

impl RunResult {
    pub fn new(output: Output) -> Self {
        Self {
            status: output.status.code(),
            out: String::from_utf8_lossy(&output.stdout).into_owned(),
            err: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }

    /// Checks exit status 2, no standard output, and `what` in standard error.
    pub fn expect_refusal(&self, what: &str) {
        assert_eq!(self.status, Some(2), "{self:?}");
        assert!(self.err.contains(what), "no `{what}` in {self:?}");
        assert!(self.out.is_empty() && !self.err.contains("panicked"), "{self:?}");
    }

    /// Checks the exit status, and that there was no panic.
    pub fn expect_status(&self, status: i32) -> &Self {
        assert!(self.status == Some(status) && !self.err.contains("panicked"), "{self:?}");
        self
    }

    /// Checks that standard output or standard error contains `what`.
    pub fn expect_output(&self, what: &str) -> &Self {
        assert!(self.out.contains(what) || self.err.contains(what), "no `{what}` in {self:?}");
        self
    }

    /// Checks exit status 0.
    pub fn expect_success(&self) -> &Self {
        assert_eq!(self.status, Some(0), "{self:?}");
        self
    }
}
