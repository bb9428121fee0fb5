//! `ligne man`: the manual page of the program, or of one of its commands.

use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use clap_mangen::roff::{Roff, bold, roman};

use super::defaults::VARIABLES;
use crate::error::Error;
use crate::style::fault::nearest;

/// What was typed.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne man > ligne.1                 the page of the program
  ligne man draw | man -l -           read the page of a command")]
pub(super) struct ManArgs {
    /// The command whose page is written; without it, the program's own
    command: Option<String>,
}

/// What a variable does, for those of [`VARIABLES`].
const VARIABLES_DO: [&str; 3] = [
    "The style, in place of --style.",
    "The number of threads, in place of --threads. The drawing is the same with any.",
    "The converter for STEP models, in place of --step-converter.",
];

/// Variables of STEP models without an option.
const STEP: [(&str, &str); 2] = [
    ("LIGNE_CACHE", "The folder for converted STEP models, in place of the user's cache folder."),
    (
        "LIGNE_STEP_SECONDS, LIGNE_STEP_MB",
        "Limits of a converter: seconds (default 300), and megabytes of memory on Linux (default 8192).",
    ),
];

/// Variables of job arrays, and what they do.
const ARRAYS: [(&str, &str); 2] = [
    (
        "SLURM_ARRAY_TASK_ID, SLURM_ARRAY_TASK_COUNT",
        "Which shard of several models ligne draw --out-dir draws, where --shard does not say it; --shard /N takes the first alone.",
    ),
    ("JOB_COMPLETION_INDEX, JOB_COMPLETIONS", "The same in an indexed job of Kubernetes."),
];

/// Commands that read `ligne.toml`.
const CONFIGURED: [&str; 4] = ["draw", "animate", "diff", "test"];

const FILES: [&str; 4] = [
    "What a project draws with unless told otherwise: looked for in the working folder and in each folder above it. \
     An option on the command line wins over an environment variable, a variable over this file, and the file \
     over what is built in. An option that excludes a configured one (--azimuth a view, --size a page) displaces it; \
     --set adds to configured changes. --no-config leaves the file aside.",
    "[draw] says how models are drawn, by ligne draw, ligne animate and ligne diff; its keys are the long names of options: style, set (a table of style keys, or a list of texts), \
     seed, camera, view, azimuth, elevation, fov, ortho, up, only, hide, section, uncut, explode, explode-part, step-converter, step-tolerance, animation, repeat, time, faces, frame, centre, unit, size, page, landscape, margin, scale, \
     background, precision, dpi, group, id-prefix, threads, quiet, strict.",
    "[diff] holds tolerance: within which distance lines and fills count as the same, as text or as a table. \
     ligne test takes it for cases that say nothing else, and takes nothing else of the file.",
    "Paths in it are relative to the file. Unknown keys and wrong values are refused with file and line.",
];

const EXAMPLE_FILE: &str = "\
# ligne.toml
[draw]
style = \"technical\"
set = { \"lines.crease_deg\" = 30 }
page = \"A4\"
view = \"iso\"

[diff]
tolerance = { default = \"0.1px\", lines = \"0.05mm\" }";

/// Examples on the page of the program.
const EXAMPLES: &str = "\
ligne draw bunny.obj
ligne draw part.stl sheet.pdf --style technical --view iso --page A4 --scale 1:2
ligne test drawings --report changes.html
ligne info drive.glb
ligne styles ink > mine.toml";

/// Writes the page to standard output.
pub(super) fn run(args: &ManArgs) -> Result<(), Error> {
    let mut program = super::Cli::command();
    program.build();
    let command = match args.command.as_deref() {
        None => &program,
        Some(name) => program.find_subcommand(name).ok_or_else(|| {
            let names: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
            let remedy = match nearest(name, &names) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the commands are {}", names.join(", ")),
            };
            Error::new(format!("there is no command `{name}`")).remedy(remedy)
        })?,
    };
    let page = page(&program, command).map_err(|error| Error::io("cannot write the page", error))?;
    super::print(&page)
}

/// The page as roff.
fn page(program: &Command, command: &Command) -> Result<Vec<u8>, std::io::Error> {
    let is_program = command.get_name() == program.get_name();
    // Examples have a section of their own.
    let shown = command.clone().after_help("");
    let name = shown.get_display_name().unwrap_or(shown.get_name()).to_owned();
    let source = format!("ligne {}", program.get_version().unwrap_or_default());
    let man = Man::new(shown).title(name.to_uppercase()).source(source).manual("ligne");
    let mut out = Vec::new();
    man.render_title(&mut out)?;
    man.render_name_section(&mut out)?;
    man.render_synopsis_section(&mut out)?;
    man.render_description_section(&mut out)?;
    man.render_options_section(&mut out)?;
    if is_program {
        man.render_subcommands_section(&mut out)?;
    }
    let mut roff = Roff::default();
    environment(&mut roff, command, is_program);
    if is_program || CONFIGURED.contains(&command.get_name()) {
        files(&mut roff);
    }
    exit_status(&mut roff);
    let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    examples(
        &mut roff,
        if is_program { EXAMPLES } else { after.split_once('\n').map_or("", |(_, rest)| rest) },
    );
    see_also(&mut roff, program, command, is_program);
    roff.to_writer(&mut out)?;
    // Each section brings the definition of the apostrophe; once is enough.
    let preamble = Roff::default().render();
    Ok((preamble.clone() + &String::from_utf8_lossy(&out).replace(&preamble, "")).into_bytes())
}

fn environment(roff: &mut Roff, command: &Command, is_program: bool) {
    let has = |option: &str| command.get_arguments().any(|known| known.get_long() == Some(option));
    let mut entries: Vec<(&str, &str)> = Vec::new();
    for ((name, option), does) in VARIABLES.iter().zip(VARIABLES_DO) {
        // A sheet of styles shows all of them, not the one that a project prefers.
        let is_ignored = command.get_name() == "styles" && *option != "step-converter";
        if is_program || has(option) && !is_ignored {
            entries.push((name, does));
        }
    }
    if is_program || has("bless") {
        entries.push(("CI", "Where it is set, ligne test refuses --bless: drawings are approved by people."));
    }
    if is_program || has("out-dir") {
        entries.extend(ARRAYS);
    }
    if is_program || has("step-converter") {
        entries.extend(STEP);
    }
    if entries.is_empty() {
        return;
    }
    roff.control("SH", ["ENVIRONMENT"]);
    for (name, does) in entries {
        entry(roff, name, does);
    }
    roff.control("PP", []);
    roff.text([roman("An empty variable counts as none.")]);
}

fn files(roff: &mut Roff) {
    roff.control("SH", ["FILES"]);
    let [first, others @ ..] = FILES;
    entry(roff, "ligne.toml", first);
    for paragraph in others {
        roff.control("IP", []);
        roff.text([roman(paragraph)]);
    }
    roff.control("IP", []);
    verbatim(roff, EXAMPLE_FILE);
}

fn exit_status(roff: &mut Roff) {
    roff.control("SH", ["EXIT STATUS"]);
    entry(roff, "0", "Done; drawings that were compared are the same.");
    entry(
        roff,
        "1",
        "ligne diff or ligne test found differences, or a drawing that nobody has approved; ligne fmt --check one not in canonical form.",
    );
    entry(
        roff,
        "2",
        "The call or an input file is wrong. The message says which, what is wrong with it and what to do; \
         existing files stay as they were. Where ligne draw has many models, the others are drawn.",
    );
    entry(
        roff,
        "75",
        "A file could not be read or written for a reason that may pass, such as a full disc: the same call may do later, \
         ligne draw with --resume.",
    );
}

fn examples(roff: &mut Roff, text: &str) {
    if text.trim().is_empty() {
        return;
    }
    roff.control("SH", ["EXAMPLES"]);
    let lines: Vec<&str> = text.lines().map(|line| line.strip_prefix("  ").unwrap_or(line)).collect();
    verbatim(roff, &lines.join("\n"));
}

fn see_also(roff: &mut Roff, program: &Command, command: &Command, is_program: bool) {
    let others = program.get_subcommands().filter(|other| other.get_name() != "help");
    let pages: Vec<String> = if is_program {
        others.map(|other| format!("ligne-{}(1)", other.get_name())).collect()
    } else {
        let related = others
            .filter(|other| CONFIGURED.contains(&other.get_name()) && other.get_name() != command.get_name());
        std::iter::once("ligne(1)".to_owned())
            .chain(related.map(|other| format!("ligne-{}(1)", other.get_name())))
            .collect()
    };
    roff.control("SH", ["SEE ALSO"]);
    roff.text([roman(pages.join(", "))]);
}

/// A term with what it means.
fn entry(roff: &mut Roff, term: &str, meaning: &str) {
    roff.control("TP", []);
    roff.text([bold(term)]);
    roff.text([roman(meaning)]);
}

/// Lines that are not filled.
fn verbatim(roff: &mut Roff, text: &str) {
    roff.control("nf", []);
    for line in text.lines() {
        roff.text([roman(line)]);
    }
    roff.control("fi", []);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::draw_args::HowArgs;

    fn text(command: Option<&str>) -> String {
        let mut program = crate::cli::Cli::command();
        program.build();
        let command = command.and_then(|name| program.find_subcommand(name)).unwrap_or(&program);
        String::from_utf8(page(&program, command).unwrap_or_default()).unwrap_or_default()
    }

    #[test]
    fn every_command_has_a_page() {
        let mut program = crate::cli::Cli::command();
        program.build();
        for command in program.get_subcommands().filter(|c| c.get_name() != "help") {
            let page = text(Some(command.get_name()));
            let title = format!(".TH LIGNE-{} 1", command.get_name().to_uppercase());
            assert!(page.contains(&title), "{title} in {page}");
            for section in ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "\"EXIT STATUS\"", "EXAMPLES"] {
                assert!(page.contains(&format!(".SH {section}\n")), "{section} in {page}");
            }
        }
    }

    #[test]
    fn the_page_names_every_key_of_the_file() {
        let page = text(None).replace('\\', "");
        let draw = HowArgs::augment_args(Command::new("draw"));
        for option in draw.get_arguments().filter_map(|option| option.get_long()) {
            let named = page.contains(&format!(" {option},"))
                || page.contains(&format!(" {option}."))
                || page.contains(&format!(" {option} ("));
            assert!(named, "{option}");
        }
    }
}
