//! `ligne man`: prints the manual page of the program or of a command, or the reference of all commands.

use clap::{Args, Command};
use clap_mangen::Man;
use clap_mangen::roff::{Roff, bold, roman};

use super::command_reference;
use super::conventions::{EXIT_STATUS, FILES, environment};
use crate::error::Error;
use crate::error::nearest::{nearest, suggestion};

/// Options of `ligne man`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne man > ligne.1                 the page of the program
  ligne man draw | man -l -           read the page of a command")]
pub(crate) struct ManArgs {
    /// Command to describe [default: the program]
    command: Option<String>,

    /// Print the reference of all commands as Markdown
    #[arg(long, hide = true, conflicts_with = "command")]
    markdown: bool,
}

/// Commands that read `ligne.toml`.
const CONFIGURED: [&str; 4] = ["draw", "animate", "diff", "test"];

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
ligne test drawings --html changes.html
ligne info drive.glb
ligne styles ink > mine.toml";

/// Writes the page to standard output.
pub(crate) fn run(args: &ManArgs) -> Result<(), Error> {
    let mut program = crate::cli::program();
    program.build();
    if args.markdown {
        return crate::cli::print(command_reference::markdown(&program).as_bytes());
    }
    let command = match args.command.as_deref() {
        None => &program,
        Some(name) => program.find_subcommand(name).ok_or_else(|| {
            let names: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
            let remedy =
                suggestion(nearest(name, &names), || format!("the commands are {}", names.join(", ")));
            Error::new(format!("there is no command `{name}`")).remedy(remedy)
        })?,
    };
    let page = page(&program, command).map_err(|error| Error::io("cannot write the page", error))?;
    crate::cli::print(&page)
}

/// The manual page as roff.
fn page(program: &Command, command: &Command) -> Result<Vec<u8>, std::io::Error> {
    let is_program = command.get_name() == program.get_name();
    // Examples have a separate section.
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
    environment_section(&mut roff, command, is_program);
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
    // Each section repeats the definition of the apostrophe. Only one is kept.
    let preamble = Roff::default().render();
    Ok((preamble.clone() + &String::from_utf8_lossy(&out).replace(&preamble, "")).into_bytes())
}

fn environment_section(roff: &mut Roff, command: &Command, is_program: bool) {
    let has = |option: &str| command.get_arguments().any(|known| known.get_long() == Some(option));
    let entries = environment(|option| is_program || has(option));
    if entries.is_empty() {
        return;
    }
    roff.control("SH", ["ENVIRONMENT"]);
    for (name, effect) in entries {
        entry(roff, name, effect);
    }
    roff.control("PP", []);
    roff.text([roman("An empty variable counts as unset.")]);
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
    for (status, meaning) in EXIT_STATUS {
        entry(roff, status, meaning);
    }
    roff.control("PP", []);
    roff.text([roman("After an error nothing is written, and existing files stay unchanged.")]);
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
    let subcommands = program.get_subcommands().filter(|subcommand| subcommand.get_name() != "help");
    let pages: Vec<String> = if is_program {
        subcommands.map(|subcommand| format!("ligne-{}(1)", subcommand.get_name())).collect()
    } else {
        let related = subcommands.filter(|subcommand| {
            CONFIGURED.contains(&subcommand.get_name()) && subcommand.get_name() != command.get_name()
        });
        std::iter::once("ligne(1)".to_owned())
            .chain(related.map(|subcommand| format!("ligne-{}(1)", subcommand.get_name())))
            .collect()
    };
    roff.control("SH", ["SEE ALSO"]);
    roff.text([roman(pages.join(", "))]);
}

/// A term with its meaning.
fn entry(roff: &mut Roff, term: &str, meaning: &str) {
    roff.control("TP", []);
    roff.text([bold(term)]);
    roff.text([roman(meaning)]);
}

/// Lines without filling.
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
    use crate::cli::options::draw_args::HowArgs;

    fn page_text(command: Option<&str>) -> String {
        let mut program = crate::cli::program();
        program.build();
        let command = command.and_then(|name| program.find_subcommand(name)).unwrap_or(&program);
        String::from_utf8(page(&program, command).unwrap_or_default()).unwrap_or_default()
    }

    #[test]
    fn every_command_has_a_man_page() {
        let mut program = crate::cli::program();
        program.build();
        for command in program.get_subcommands().filter(|c| c.get_name() != "help") {
            let page = page_text(Some(command.get_name()));
            let title = format!(".TH LIGNE-{} 1", command.get_name().to_uppercase());
            assert!(page.contains(&title), "{title} in {page}");
            for section in ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "\"EXIT STATUS\"", "EXAMPLES"] {
                assert!(page.contains(&format!(".SH {section}\n")), "{section} in {page}");
            }
        }
    }

    #[test]
    fn man_page_names_every_key_of_the_configuration_file() {
        let page = page_text(None).replace('\\', "");
        let draw = HowArgs::augment_args(Command::new("draw"));
        for option in draw.get_arguments().filter_map(|option| option.get_long()) {
            let named = page.contains(&format!(" {option},"))
                || page.contains(&format!(" {option}."))
                || page.contains(&format!(" {option} ("));
            assert!(named, "{option}");
        }
    }
}
