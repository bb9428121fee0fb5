//! [`Converter`]: external programs that convert STEP to GLB, and how each is called.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use super::converter_process::{ProcessLimits, ProcessOutcome, run};
use crate::cli::options::step_args::StepArgs;
use crate::error::Error;
use crate::scene::UpAxis;

const CASCADIO: &str = include_str!("cascadio.py");
const OCCT: &str = include_str!("occt.js");
const FREECAD: &str = include_str!("freecad.py");

/// Exit status of a script whose package is not installed.
const NOT_INSTALLED: i32 = 91;

/// Advice to install a converter.
pub(crate) const INSTALL_REMEDY: &str =
    "install one with `pip install cascadio`, or name one with --step-converter";

/// Names of the interpreters and programs, in order of preference.
const PYTHONS: &[&str] = if cfg!(windows) { &["python", "py"] } else { &["python3", "python"] };
const NODES: &[&str] = &["node", "nodejs"];
const FREECADS: &[&str] = &[
    "freecadcmd",
    "FreeCADCmd",
    "freecad.cmd",
    "/Applications/FreeCAD.app/Contents/Resources/bin/freecadcmd",
];

/// Program that converts STEP to GLB.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Converter {
    kind: ConverterKind,
    program: PathBuf,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ConverterKind {
    /// Python with cascadio.
    Cascadio,
    /// Node.js with occt-import-js.
    Occt,
    Freecad,
    /// Program of the user.
    Own,
}

/// Result of a conversion without failure.
#[derive(Debug)]
pub(crate) enum ConversionResult {
    /// The file is written. Its up axis.
    Done(UpAxis),
    /// The package is not installed. Message of the interpreter.
    NotInstalled(String),
}

/// Converters to try, in order.
///
/// # Errors
/// If the named converter does not exist.
pub(crate) fn candidates(args: &StepArgs) -> Result<Vec<Converter>, Error> {
    let of = |kind: ConverterKind, names: &[&str]| -> Vec<Converter> {
        let programs = names.iter().filter_map(|name| find(name));
        programs.map(|program| Converter { kind, program }).collect()
    };
    let [cascadio, occt, freecad] = [
        of(ConverterKind::Cascadio, PYTHONS),
        of(ConverterKind::Occt, NODES),
        of(ConverterKind::Freecad, FREECADS),
    ];
    let Some(named) = &args.converter() else {
        return Ok([cascadio, occt, freecad].concat());
    };
    let missing = |needs: &str| {
        Error::new(format!("there is no program `{needs}`"))
            .at("--step-converter")
            .remedy("give its path, or leave the option out")
    };
    let of_package = |found: Vec<Converter>, needs: &str| {
        if found.is_empty() { Err(missing(needs)) } else { Ok(found) }
    };
    match named.as_str() {
        "cascadio" => of_package(cascadio, "python3"),
        "occt-import-js" => of_package(occt, "node"),
        "freecad" => of_package(freecad, "freecadcmd"),
        _ => {
            let program = find(named).ok_or_else(|| missing(named))?;
            Ok(vec![Converter { kind: ConverterKind::of(&program), program }])
        }
    }
}

impl ConverterKind {
    /// Kind by program name: `python3.12`, `node`, `freecadcmd`. Other names are programs of the user.
    fn of(program: &Path) -> Self {
        let name = program.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        let name = name.strip_suffix(".exe").unwrap_or(&name);
        let version = |rest: &str| rest.chars().all(|c| c.is_ascii_digit() || c == '.');
        match name {
            "py" | "pypy3" => Self::Cascadio,
            "node" | "nodejs" => Self::Occt,
            "freecadcmd" | "freecad.cmd" => Self::Freecad,
            _ if name.strip_prefix("python").is_some_and(version) => Self::Cascadio,
            _ => Self::Own,
        }
    }
}

/// Path of a program, from its path or its name in `PATH`.
fn find(name: &str) -> Option<PathBuf> {
    let path = Path::new(name);
    if path.components().count() > 1 {
        return path.is_file().then(|| std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf()));
    }
    let endings: &[&str] = if cfg!(windows) { &["", ".exe", ".cmd", ".bat"] } else { &[""] };
    let folders = std::env::var_os("PATH")?;
    // An empty entry means the working folder. A file there must not replace an installed program.
    let folders = std::env::split_paths(&folders).filter(|folder| !folder.as_os_str().is_empty());
    let mut places =
        folders.flat_map(|folder| endings.iter().map(move |ending| folder.join(format!("{name}{ending}"))));
    places.find(|place| place.is_file())
}

impl Converter {
    /// Name in messages.
    pub(crate) fn name(&self) -> String {
        let package = match self.kind {
            ConverterKind::Cascadio => "cascadio",
            ConverterKind::Occt => "occt-import-js",
            ConverterKind::Freecad => "FreeCAD",
            ConverterKind::Own => return self.program.display().to_string(),
        };
        format!("{package} ({})", self.program.display())
    }

    /// Bytes that identify the converter in cache keys: its path, and its script or program file.
    pub(crate) fn identity(&self) -> Vec<u8> {
        let mut identity = self.program.to_string_lossy().into_owned().into_bytes();
        identity.push(0);
        identity.extend(match self.kind {
            ConverterKind::Cascadio => CASCADIO.as_bytes().to_vec(),
            ConverterKind::Occt => OCCT.as_bytes().to_vec(),
            ConverterKind::Freecad => FREECAD.as_bytes().to_vec(),
            ConverterKind::Own => fs::read(&self.program).unwrap_or_default(),
        });
        identity
    }

    /// Converts a model to GLB.
    ///
    /// # Errors
    /// If the converter fails, or exceeds its time or memory limit.
    pub(crate) fn convert(
        &self,
        model: &Path,
        glb: &Path,
        args: &StepArgs,
    ) -> Result<ConversionResult, Error> {
        let limits = ProcessLimits::of_process();
        let model = std::path::absolute(model).unwrap_or_else(|_| model.to_path_buf());
        let (tolerance, angle) = (args.tolerance_mm().to_string(), args.angle().to_string());
        let in_and_out = || [OsString::from(&model), OsString::from(glb)];
        let script = |flags: &[&str], text: &str| -> Vec<OsString> {
            let flags = flags.iter().map(OsString::from).chain([OsString::from(text)]);
            flags.chain(in_and_out()).chain([&tolerance, &angle].map(OsString::from)).collect()
        };
        let mut variables = Vec::new();
        let mut script_file = None;
        let words = match self.kind {
            ConverterKind::Cascadio => script(&["-c"], CASCADIO),
            ConverterKind::Occt => {
                let memory = format!("--max-old-space-size={}", limits.mb);
                script(&[&memory, "-e"], OCCT)
            }
            ConverterKind::Freecad => {
                let [source, target] = in_and_out();
                variables.extend([
                    ("LIGNE_STEP_IN", source),
                    ("LIGNE_STEP_OUT", target),
                    ("LIGNE_STEP_TOLERANCE", OsString::from(&tolerance)),
                    ("LIGNE_STEP_ANGLE", OsString::from(&angle)),
                ]);
                let place = glb.with_extension("py");
                fs::write(&place, FREECAD)
                    .map_err(|error| Error::io("cannot write a script", error).in_file(&place))?;
                vec![script_file.insert(place).clone().into_os_string()]
            }
            ConverterKind::Own => in_and_out().into_iter().chain([OsString::from(&tolerance)]).collect(),
        };
        // Node.js reserves more address space than it uses. Its own option and WebAssembly limit the memory.
        let bounds = (limits, self.kind != ConverterKind::Occt);
        let outcome = run(&self.program, &words, &variables, bounds, &glb.with_extension("log"));
        if let Some(script) = script_file {
            let _ = fs::remove_file(script);
        }
        self.interpret_outcome(outcome, limits, glb)
    }

    fn interpret_outcome(
        &self,
        outcome: ProcessOutcome,
        limits: ProcessLimits,
        glb: &Path,
    ) -> Result<ConversionResult, Error> {
        let name = self.name();
        let with = |said: String| if said.is_empty() { said } else { format!(": {said}") };
        match outcome {
            ProcessOutcome::Exited(0, said) if !glb.is_file() => {
                Err(Error::new(format!("{name} wrote no GLB{}", with(said))).remedy(FAILED_REMEDY))
            }
            ProcessOutcome::Exited(0, _) => Ok(ConversionResult::Done(match self.kind {
                // Cascadio keeps the axes of STEP.
                ConverterKind::Cascadio => UpAxis::Z,
                ConverterKind::Occt | ConverterKind::Freecad | ConverterKind::Own => UpAxis::Y,
            })),
            ProcessOutcome::Exited(NOT_INSTALLED, said)
                if matches!(self.kind, ConverterKind::Cascadio | ConverterKind::Occt) =>
            {
                Ok(ConversionResult::NotInstalled(said))
            }
            ProcessOutcome::Exited(code, said) => {
                let remedy = if lacks_memory(&said) { MEMORY_REMEDY } else { FAILED_REMEDY };
                let message = format!("{name} failed with exit status {code}{}", with(said));
                Err(Error::new(message).remedy(remedy))
            }
            ProcessOutcome::Killed(said) => {
                let bound = limits.mb;
                let message =
                    format!("{name} was stopped{}; it may have needed more than {bound} MB", with(said));
                Err(Error::new(message).remedy(MEMORY_REMEDY))
            }
            ProcessOutcome::TimedOut => {
                Err(Error::new(format!("{name} was stopped after {} s", limits.seconds))
                    .remedy("give a larger --step-tolerance, or more time with LIGNE_STEP_SECONDS"))
            }
            ProcessOutcome::NotRun(error) => {
                Err(Error::io(format!("cannot run {name}"), error).remedy("check --step-converter"))
            }
        }
    }
}

const FAILED_REMEDY: &str = "export the STEP file again (AP214 or AP242), or try another --step-converter";

const MEMORY_REMEDY: &str =
    "give a larger --step-tolerance, more memory with LIGNE_STEP_MB, or another --step-converter";

/// Whether the last line of a program's output reports a lack of memory.
fn lacks_memory(said: &str) -> bool {
    let said = said.to_ascii_lowercase();
    ["allocate", "bad_alloc", "memoryerror", "out of memory"].iter().any(|word| said.contains(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn converter_kind_is_recognized_by_program_name() {
        for (program, kind) in [
            ("/usr/bin/python3", ConverterKind::Cascadio),
            ("venv/bin/python3.12", ConverterKind::Cascadio),
            ("C/Python.EXE", ConverterKind::Cascadio),
            ("node", ConverterKind::Occt),
            ("FreeCADCmd", ConverterKind::Freecad),
            ("python-convert.sh", ConverterKind::Own),
            ("node.sh", ConverterKind::Own),
            ("step2glb", ConverterKind::Own),
        ] {
            assert_eq!(ConverterKind::of(Path::new(program)), kind, "{program}");
        }
    }
}
