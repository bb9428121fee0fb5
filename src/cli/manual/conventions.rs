//! Texts on environment variables, files and exit status, for manual pages and the reference.

use crate::cli::config::call_defaults::VARIABLES;

/// Effects of [`VARIABLES`].
const VARIABLE_EFFECTS: [&str; 3] =
    ["Default of --style.", "Default of --threads.", "Default of --step-converter."];

/// Variables for STEP models that have no option, with their effects.
const STEP_VARIABLES: [(&str, &str); 2] = [
    ("LIGNE_CACHE", "Folder for converted STEP models [default: the cache folder of the user]."),
    (
        "LIGNE_STEP_SECONDS, LIGNE_STEP_MB",
        "Limits of a converter: seconds [default: 300], and megabytes of memory on Linux [default: 8192].",
    ),
];

/// Variables of job arrays, with their effects.
const JOB_ARRAY_VARIABLES: [(&str, &str); 2] = [
    (
        "SLURM_ARRAY_TASK_ID, SLURM_ARRAY_TASK_COUNT",
        "Default of --shard for ligne draw --out-dir with several models. --shard /N takes K from the first variable.",
    ),
    ("JOB_COMPLETION_INDEX, JOB_COMPLETIONS", "The same for an indexed job of Kubernetes."),
];

/// Meaning of each exit status.
pub(crate) const EXIT_STATUS: [(&str, &str); 4] = [
    ("0", "Success. Compared drawings are the same."),
    (
        "1",
        "ligne diff or ligne test found differences or a new drawing, or ligne fmt --check found a file that is not in canonical form.",
    ),
    ("2", "The call or an input file is wrong. With several models, ligne draw still draws the others."),
    (
        "75",
        "A file could not be read or written for a temporary reason, such as a full disc. Repeat the call later, ligne draw with --resume.",
    ),
];

/// Description of `ligne.toml`, one entry per paragraph.
pub(crate) const FILES: [&str; 4] = [
    "ligne.toml holds defaults for a project. ligne looks for it in the working folder, then in each folder above. \
     An option wins over an environment variable, a variable over the file, and the file over built-in defaults. An option also \
     replaces a configured one that excludes it: --azimuth replaces a view, --size replaces a page. --set adds to configured changes. \
     --no-config ignores the file.",
    "The table [draw] applies to ligne draw, animate and diff. Its keys are long names of options. \
     Style: style, set (a table of style keys, or a list of texts), seed. \
     View: camera, view, azimuth, elevation, fov, ortho, up, only, hide, section, uncut, explode, explode-part, step-converter, step-tolerance, animation, repeat, \
     time, faces, frame, centre. \
     Page: unit, size, page, landscape, margin, scale, background. \
     Output: precision, dpi, group, id-prefix, threads, quiet, strict.",
    "The table [diff] holds tolerance, as text or as a table. ligne diff uses it, and so does ligne test for cases without a tolerance. \
     ligne test uses nothing else of the file.",
    "Paths are relative to the file. An unknown key or a wrong value is an error that names file and line.",
];

/// Variables that a command reads, with their effects. `has` returns whether the command has an option.
pub(crate) fn environment(has: impl Fn(&str) -> bool) -> Vec<(&'static str, &'static str)> {
    let mut entries: Vec<(&str, &str)> = Vec::new();
    for ((name, option), effect) in VARIABLES.iter().zip(VARIABLE_EFFECTS) {
        if has(option) {
            entries.push((name, effect));
        }
    }
    if has("bless") {
        entries.push(("CI", "If set, ligne test refuses --bless."));
    }
    if has("folders") {
        entries.extend(JOB_ARRAY_VARIABLES);
    }
    if has("step-converter") {
        entries.extend(STEP_VARIABLES);
    }
    entries
}
