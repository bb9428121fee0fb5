//! `ligne page`: draws the pages of a page file, and writes page files to start from.
//!
//! 1. Outputs are checked: one file for all pages, or numbered files.
//! 2. `crate::page` composes the pages. Each output is encoded, and all files are renamed at the end, all or
//!    none.
//! 3. `--watch` repeats this after each change of the page file or its inputs ([`page_watch`]).
//!
//! [`page_templates`] holds the page files of `--new`.

mod page_templates;
mod page_watch;

use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Args, ValueHint};

use super::output::number_text;
use super::step::open_other;
use super::{library_calls, print, say};
use crate::cli::options::step_args::StepArgs;
use crate::cli::output::numbered_files::NumberedFiles;
use crate::cli::output::output_files::{Format, Output, Staging, check_place, is_stdout};
use crate::cli::output::progress::Progress;
use crate::cli::request::draw_request::refuse_overwriting;
use crate::drawing::Composition;
use crate::error::Error;
use crate::export::encoding::gzip;
#[cfg(feature = "pdf")]
use crate::export::to_pdf;
use crate::export::{DxfOptions, DxfVersion, PngOptions, Resolution, SvgOptions};
use crate::page::{ComposedPage, PageFile, PrintInks};
use crate::pipeline::Stopwatch;

/// Options of `ligne page`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne page --new comic page.toml           writes a page file to start from
  ligne page page.toml page.pdf
  ligne page book.toml 'pages/%02d.svg'      one file per page
  ligne page page.toml print.pdf --ink k --marks
  ligne page page.toml page.png --watch      after each change of a file")]
pub(crate) struct PageArgs {
    /// Page file; with --new, the page file to write
    #[arg(value_hint = ValueHint::FilePath)]
    page: PathBuf,

    /// Output: .pdf, .svg, .svgz, .png or .dxf, with %d for page numbers; - for SVG on standard output [default: PAGE with .pdf]
    out: Option<PathBuf>,

    /// Further output; repeatable
    #[arg(short = 'o', long = "output", value_name = "OUT")]
    outputs: Vec<PathBuf>,

    /// Write a commented page file to start from
    #[arg(long, value_name = "KIND", value_parser = PossibleValuesParser::new(["comic", "sheet"]),
        conflicts_with_all = ["out", "outputs", "watch"])]
    new: Option<String>,

    /// Draw again after each change of the page file or its inputs
    #[arg(long)]
    watch: bool,

    /// DXF release: 2000, or r12 (read by every program; no letters, fills or line widths)
    #[arg(long, value_name = "RELEASE", default_value = "2000", ignore_case = true,
        value_parser = crate::cli::options::dxf_args::dxf_version())]
    dxf: DxfVersion,

    /// PNG resolution in pixels per inch [default: 300]
    #[arg(long, value_name = "N", value_parser = crate::cli::options::draw_args::dots_per_inch())]
    dpi: Option<f64>,

    /// Decimals of SVG coordinates [default: 3]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=9))]
    precision: Option<u8>,

    /// PDF inks: screen (RGB), k (black only) or cmyk (four inks, with --icc) [default: screen]
    #[cfg(feature = "pdf")]
    #[arg(long, value_name = "INKS", help_heading = "Print", ignore_case = true, hide_possible_values = true,
        value_parser = PossibleValuesParser::new(crate::cli::options::print_args::INKS))]
    ink: Option<String>,

    #[cfg(feature = "pdf")]
    #[command(flatten)]
    print: crate::cli::options::print_args::PrintArgs,

    #[command(flatten)]
    step: StepArgs,

    /// Number of threads; never changes the page [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Print errors only
    #[arg(short, long)]
    quiet: bool,

    /// Treat warnings as errors
    #[arg(long)]
    strict: bool,
}

/// Output of pages.
enum PageTarget {
    /// One file for all pages.
    One(Output),
    /// One file per page.
    Each(NumberedFiles),
}

/// Draws the pages and prints a summary. With `--watch` it continues until it is stopped.
pub(crate) fn run(args: &PageArgs) -> Result<(), Error> {
    if let Some(kind) = &args.new {
        return page_templates::write(kind, &args.page, args.quiet);
    }
    let targets = targets(args)?;
    // Created first, so that changes during the first drawing are detected.
    let mut watch = page_watch::PageWatch::new(&args.page);
    let first = library_calls::in_threads(args.threads, || draw(args, &targets))?;
    if !args.watch {
        return first;
    }
    if let Err(error) = first {
        say(&format!("error: {error}"));
    }
    if !args.quiet {
        say(&format!("watching {}; Ctrl-C ends", args.page.display()));
    }
    loop {
        watch.changed();
        if let Err(error) = library_calls::in_threads(args.threads, || draw(args, &targets))? {
            say(&format!("error: {error}"));
        }
    }
}

fn targets(args: &PageArgs) -> Result<Vec<PageTarget>, Error> {
    let stem = || PathBuf::from(args.page.with_extension("pdf").file_name().unwrap_or_default());
    let mut paths: Vec<PathBuf> = args.out.iter().chain(&args.outputs).cloned().collect();
    if paths.is_empty() {
        paths.push(stem());
    }
    let targets: Vec<PageTarget> =
        paths.iter().map(|path| target(path, &args.page)).collect::<Result<_, _>>()?;
    #[cfg(feature = "pdf")]
    {
        let format = |target: &PageTarget| match target {
            PageTarget::One(output) => output.format,
            PageTarget::Each(numbered) => numbered.format,
        };
        let writes_pdf = targets.iter().any(|target| format(target) == Format::Pdf);
        args.print.refuse_without_pdf(args.ink.as_deref(), writes_pdf)?;
    }
    Ok(targets)
}

fn target(path: &Path, page: &Path) -> Result<PageTarget, Error> {
    let wrong = |message: String| {
        Error::new(message).in_file(path).remedy("write a name such as page-%d.svg for one file per page")
    };
    let target = match NumberedFiles::of(path, "a page", wrong)? {
        Some(numbered) => PageTarget::Each(numbered),
        None => PageTarget::One(Output::new(path.to_path_buf())?),
    };
    if let PageTarget::One(Output { path, format }) = &target
        && *format != Format::SvgToStdout
    {
        check_place(path)?;
        refuse_overwriting(path, "the page", page, "its page file")?;
    }
    Ok(target)
}

/// Draws all pages and writes them, all or none.
fn draw(args: &PageArgs, targets: &[PageTarget]) -> Result<(), Error> {
    let watch = Stopwatch::start();
    let progress = Progress::start(args.quiet, &args.page);
    progress.step("reading");
    let step = args.step.clone();
    let file = PageFile::open(&args.page)?.reading_models(move |path| open_other(path, &step));
    let several =
        |target: &&PageTarget| matches!(target, PageTarget::One(output) if needs_numbers(output.format));
    if let Some(PageTarget::One(output)) = targets.iter().find(several).filter(|_| file.len() > 1) {
        return Err(Error::new(format!("one file of this format cannot hold {}", pages(file.len())))
            .in_file(&output.path)
            .remedy("number them, such as page-%d.svg, or write .pdf"));
    }
    progress.step("drawing");
    let inks = file.print()?;
    let composed = file.compose()?;
    drop(progress);
    report_warnings(args, &composed)?;
    let compositions: Vec<Composition> = composed.into_iter().map(|page| page.composition).collect();
    let mut staging = Staging::default();
    let mut told = Vec::new();
    for target in targets {
        for (name, bytes, count) in encoded(target, &compositions, (args, &inks))? {
            match &name {
                Some(path) => {
                    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
                        staging.make_folder(folder)?;
                    }
                    staging.add(path, &bytes)?;
                }
                None => print(&bytes)?,
            }
            let name = name.map_or_else(|| "standard output".to_owned(), |path| path.display().to_string());
            told.push((name, bytes.len() as u64, count));
        }
    }
    staging.commit()?;
    if !args.quiet {
        for (name, bytes, count) in told {
            let size = compositions.first().map(|page| page.page);
            let size = size.map_or_else(String::new, |page| {
                format!("{} x {} mm", number_text::plain(page.width, 2), number_text::plain(page.height, 2))
            });
            let (pages, bytes, seconds) = (pages(count), number_text::bytes(bytes), watch.seconds());
            say(&format!("{name}: {pages}, {size}, {bytes}, {seconds:.2} s"));
        }
    }
    Ok(())
}

fn pages(count: usize) -> String {
    number_text::counted(count as u64, "page")
}

fn needs_numbers(format: Format) -> bool {
    matches!(format, Format::Svg | Format::Svgz | Format::Png | Format::Dxf | Format::SvgToStdout)
}

/// Prints warnings. Under `--strict` they are an error.
fn report_warnings(args: &PageArgs, composed: &[ComposedPage]) -> Result<(), Error> {
    let warnings: Vec<&String> = composed.iter().flat_map(|page| &page.warnings).collect();
    if args.strict && !warnings.is_empty() {
        let all: Vec<&str> = warnings.iter().map(|warning| warning.as_str()).collect();
        return Err(Error::new(all.join("; "))
            .in_file(&args.page)
            .remedy("repair the models, or draw without --strict"));
    }
    if !args.quiet {
        warnings.iter().for_each(|warning| say(&format!("warning: {}: {warning}", args.page.display())));
    }
    Ok(())
}

/// A file: its path (none for standard output), its bytes, and its number of pages.
type EncodedFile = (Option<PathBuf>, Vec<u8>, usize);

/// Encodes the files of one output.
fn encoded(
    target: &PageTarget,
    pages: &[Composition],
    args: (&PageArgs, &PrintInks),
) -> Result<Vec<EncodedFile>, Error> {
    match target {
        PageTarget::One(Output { path, format }) => {
            let bytes = encode(pages, *format, args).map_err(|error| error.or_in_file(path))?;
            let name = (!is_stdout(path)).then(|| path.clone());
            Ok(vec![(name, bytes, pages.len())])
        }
        PageTarget::Each(numbered) => {
            let page = |(number, page): (usize, &Composition)| {
                let path = numbered.path(number + 1);
                let bytes = encode(std::slice::from_ref(page), numbered.format, args);
                bytes.map_err(|error| error.or_in_file(&path)).map(|bytes| (Some(path), bytes, 1))
            };
            pages.iter().enumerate().map(page).collect()
        }
    }
}

fn encode(
    pages: &[Composition],
    format: Format,
    (args, file): (&PageArgs, &PrintInks),
) -> Result<Vec<u8>, Error> {
    #[cfg(not(feature = "pdf"))]
    let _ = file;
    let Some(page) = pages.first() else { return Ok(Vec::new()) };
    let svg = || page.to_svg(&SvgOptions { precision: args.precision, ..SvgOptions::default() });
    match format {
        Format::Svg | Format::SvgToStdout => Ok(svg().into_bytes()),
        Format::Svgz => Ok(gzip::packed(svg().as_bytes())),
        Format::Png => {
            page.to_png(&PngOptions { resolution: args.dpi.map_or(Resolution::Natural, Resolution::Dpi) })
        }
        #[cfg(feature = "pdf")]
        Format::Pdf => {
            let (print, ink) = args.print.merged_with(args.ink.as_deref(), file);
            to_pdf(pages, &print.options(ink.as_deref())?.unwrap_or_default())
        }
        Format::Dxf => Ok(page.flattened().to_dxf(&DxfOptions::default().with_version(args.dxf))),
    }
}
