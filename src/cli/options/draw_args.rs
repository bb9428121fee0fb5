//! Options of `ligne draw`.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum, ValueHint};

use super::batch_args::BatchArgs;
use super::contact_sheet_args::ViewSheetArgs;
use super::dxf_args::DxfArgs;
use super::framing_args::{FramingArgs, SaveArgs};
#[cfg(feature = "pdf")]
use super::print_args::PrintArgs;
use super::section_and_explode_args::SectionArgs;
use super::step_args::StepArgs;
use super::style_keys;
use super::values::paper_size;
use super::web_args::WebArgs;
use crate::cli::options::values::completion_values::CompletionValues;
use crate::cli::options::values::paper_size::{PageLength, PaperSize};
use crate::colour::srgb::Colour;
use crate::pipeline::Stage;
use crate::scene::{NamedView, UpAxis};
use crate::style::Style;

const EXAMPLES: &str = "Examples:
  ligne draw bunny.obj                              writes bunny.svg
  ligne bunny.obj                                   the same
  ligne draw bunny.obj bunny.svg bunny.png --size 2000x1500 --azimuth -30
  ligne draw part.stl sheet.svg --style technical --view iso --page A4 --scale 1:2
  ligne draw drive.glb - --hide 'bolt*' --quiet | less
  ligne draw *.glb --out-dir drawings --format svg,png --view front,top,iso
  ligne draw bunny.obj --style mine.toml --watch";

const USAGE: &str = "ligne draw [OPTIONS] <MODEL> [OUT]...
       ligne draw [OPTIONS] --out-dir <DIR> <MODEL>...";

/// Options of `ligne draw`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, override_usage = USAGE)]
pub(crate) struct DrawArgs {
    /// Model: .obj, .gltf, .glb, .stl, .ply or .step; - for standard input, with --input-format
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) model: PathBuf,

    /// Drawings: .svg, .svgz, .png, .pdf or .dxf; - for SVG on standard output [default: MODEL's name with .svg]
    pub(crate) out: Option<PathBuf>,

    /// Further drawings; with --out-dir further models
    #[arg(hide = true)]
    pub(crate) more: Vec<PathBuf>,

    /// Further drawing; repeatable
    #[arg(short = 'o', long = "output", value_name = "OUT")]
    pub(crate) outputs: Vec<PathBuf>,

    #[command(flatten)]
    pub(crate) how: HowArgs,

    #[command(flatten)]
    pub(crate) contact: ViewSheetArgs,

    #[command(flatten)]
    pub(crate) save: SaveArgs,

    #[command(flatten)]
    pub(crate) many: BatchArgs,

    #[command(flatten)]
    pub(crate) web: WebArgs,

    #[command(flatten)]
    pub(crate) dxf: DxfArgs,

    #[cfg(feature = "pdf")]
    #[command(flatten)]
    pub(crate) print: PrintArgs,

    /// Write times, counts and warnings as JSON; - for standard output
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub(crate) report: Option<PathBuf>,

    /// Write the view's maps for image lines: normal.png, depth.png, edges.png and parts.png
    #[arg(long, value_name = "FOLDER", help_heading = "Output")]
    pub(crate) maps: Option<PathBuf>,

    /// Draw the result of one pipeline stage, colour-coded (docs/dev/stages.md)
    #[arg(long, value_name = "NAME", help_heading = "Output",
        value_parser = PossibleValuesParser::new(Stage::ALL.map(Stage::name))
            .try_map(|name| Stage::parse(&name).ok_or("no such stage")))]
    pub(crate) stage: Option<Stage>,
}

/// Options for drawing a model, shared by `ligne draw`, `ligne animate`, `ligne diff` and cases of `ligne test`.
#[derive(Debug, Clone, Args)]
pub(crate) struct HowArgs {
    /// Built-in style, or style sheet [env: LIGNE_STYLE]
    #[arg(long, value_name = "NAME|FILE.toml", default_value = "ink", hide_possible_values = true,
        value_parser = CompletionValues::new(Style::names(), |name| Ok(name.to_owned())))]
    pub(crate) style: String,

    /// Change one style key, such as lines.crease_deg=30; repeatable; ligne styles --keys lists the keys
    #[arg(long = "set", value_name = "KEY=VALUE", hide_possible_values = true,
        value_parser = CompletionValues::late(style_keys::settings, setting))]
    pub(crate) sets: Vec<String>,

    /// Random seed for hand-drawn effects [default: the style's]
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u32>,

    /// Camera record, or the name of a camera in the model
    #[arg(long, value_name = "FILE.json|NAME", help_heading = "View",
        conflicts_with_all = ["view", "azimuth", "elevation", "fov", "ortho"])]
    pub(crate) camera: Option<String>,

    /// Named view, orthographic without --fov; a list such as front,top,iso draws each
    #[arg(long, help_heading = "View", value_delimiter = ',', conflicts_with_all = ["azimuth", "elevation"], ignore_case = true,
        value_parser = PossibleValuesParser::new(NamedView::ALL.map(view_value))
            .try_map(|name| NamedView::parse(&name).ok_or("no such view")))]
    pub(crate) view: Vec<NamedView>,

    /// Camera angle to the right of the front: 0 front, 90 right [default: 35]
    #[arg(long, value_name = "DEGREES", help_heading = "View", allow_negative_numbers = true,
        value_parser = number("write a number of degrees", |d| d.is_finite()))]
    pub(crate) azimuth: Option<f64>,

    /// Camera angle above the horizon, -90 to 90 [default: 22]
    #[arg(long, value_name = "DEGREES", help_heading = "View", allow_negative_numbers = true,
        value_parser = number("write degrees from -90 to 90", |d| d.abs() <= 90.0))]
    pub(crate) elevation: Option<f64>,

    /// Perspective with this vertical field of view [default: 35]
    #[arg(long, value_name = "DEGREES", help_heading = "View", conflicts_with = "ortho",
        value_parser = number("write degrees between 0 and 180", |d| *d > 0.0 && *d < 180.0))]
    pub(crate) fov: Option<f64>,

    /// Parallel projection
    #[arg(long, help_heading = "View")]
    pub(crate) ortho: bool,

    /// Up axis of the model [default: from the format]
    #[arg(long, help_heading = "View", value_parser = PossibleValuesParser::new(["y", "z"])
        .map(|name| if name == "z" { UpAxis::Z } else { UpAxis::Y }))]
    pub(crate) up: Option<UpAxis>,

    /// Draw only parts with a matching name; repeatable
    #[arg(long, value_name = "GLOB", help_heading = "View")]
    pub(crate) only: Vec<String>,

    /// Leave out parts with a matching name; repeatable
    #[arg(long, value_name = "GLOB", help_heading = "View")]
    pub(crate) hide: Vec<String>,

    /// Clips to play, by name or pattern: Walk, 'Walk*', Walk:0.7,Run:0.3, Walk:1..0,Run:0..1 [default: first clip]
    #[arg(long, value_name = "NAME[:WEIGHT],...", help_heading = "View")]
    pub(crate) animation: Vec<String>,

    /// Loop each clip
    #[arg(long, help_heading = "View")]
    pub(crate) repeat: bool,

    /// Time within the animation [default: 0]
    #[arg(long, value_name = "SECONDS", help_heading = "View", allow_hyphen_values = true,
        value_parser = number("write a number of seconds", |time| time.is_finite()))]
    pub(crate) time: Option<f64>,

    /// Simplify the model to at most N faces
    #[arg(long, value_name = "N", help_heading = "View", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) faces: Option<u64>,

    #[command(flatten)]
    pub(crate) framing: FramingArgs,

    #[command(flatten)]
    pub(crate) section: SectionArgs,

    #[command(flatten)]
    pub(crate) step: StepArgs,

    /// Size of the drawing in px, such as 1000x800 or 1000 [default: 1000x1000]
    #[arg(long, value_name = "WIDTHxHEIGHT", help_heading = "Page", conflicts_with = "page",
        value_parser = paper_size::size_px)]
    pub(crate) size: Option<PaperSize>,

    /// Page in mm: A0 to A6, Letter, Legal, Tabloid, or such as 210x297mm
    #[arg(long, value_name = "NAME|WIDTHxHEIGHT", help_heading = "Page", hide_possible_values = true,
        value_parser = CompletionValues::new(paper_size::SHEET_NAMES, paper_size::page_mm))]
    pub(crate) page: Option<PaperSize>,

    /// Turn the page to landscape
    #[arg(long, help_heading = "Page", requires = "page")]
    pub(crate) landscape: bool,

    /// Free border, such as 10mm [default: 10mm on a page, 0 otherwise]
    #[arg(long, value_name = "LENGTH", help_heading = "Page", value_parser = paper_size::margin)]
    pub(crate) margin: Option<PageLength>,

    /// Orthographic scale, such as 1:2 for half size; see --unit
    #[arg(long, value_name = "PAPER:MODEL", help_heading = "Page", requires = "page", conflicts_with = "fov",
        value_parser = paper_size::scale)]
    pub(crate) scale: Option<f64>,

    /// Paper colour: #rrggbb, a CSS name, or none [default: the style's]
    #[arg(long, value_name = "COLOUR|none", help_heading = "Page", value_parser = background)]
    pub(crate) background: Option<Background>,

    /// Decimals of SVG coordinates [default: 2 in px, 3 in mm]
    #[arg(long, value_name = "N", help_heading = "Output", value_parser = clap::value_parser!(u8).range(0..=9))]
    pub(crate) precision: Option<u8>,

    /// PNG resolution in pixels per inch [default: 96 in px, 300 on a page]
    #[arg(long, value_name = "N", help_heading = "Output", value_parser = dots_per_inch())]
    pub(crate) dpi: Option<f64>,

    /// SVG groups by layer of the drawing or by part of the model [default: layer]
    #[arg(long, help_heading = "Output", value_enum, default_value_t = GroupBy::Layer, hide_default_value = true)]
    pub(crate) group: GroupBy,

    /// Prefix for all ids in SVG, for several drawings in one page
    #[arg(long, value_name = "PREFIX", help_heading = "Output", value_parser = id_prefix)]
    pub(crate) id_prefix: Option<String>,

    /// Number of threads; never changes the drawing [env: LIGNE_THREADS] [default: one per core]
    #[arg(long, value_name = "N", help_heading = "Output",
        value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

    /// Print errors only
    #[arg(short, long, help_heading = "Output")]
    pub(crate) quiet: bool,

    /// Treat warnings as errors
    #[arg(long, help_heading = "Output")]
    pub(crate) strict: bool,
}

/// The meaning of groups in SVG. Plain comments keep the values on one line of help.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum GroupBy {
    // A group per layer of the drawing.
    Layer,
    // A group per part of the model.
    Part,
}

/// Paper colour; none for a transparent background.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Background(pub(crate) Option<Colour>);

fn background(text: &str) -> Result<Background, String> {
    if text.eq_ignore_ascii_case("none") {
        return Ok(Background(None));
    }
    let colour = Colour::parse(text).ok_or("write a colour as #rrggbb or by its name in CSS, or none")?;
    Ok(Background(Some(colour)))
}

/// Name and aliases of a named view.
fn view_value(view: NamedView) -> PossibleValue {
    PossibleValue::new(view.name()).aliases(view.other_name())
}

fn setting(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((key, _)) if !key.trim().is_empty() => Ok(text.to_owned()),
        _ => Err("write KEY=VALUE, such as lines.crease_deg=30".to_owned()),
    }
}

/// Parser of a number that is right, or of a message.
pub(crate) fn number(
    message: &'static str,
    is_right: fn(&f64) -> bool,
) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| text.parse().ok().filter(is_right).ok_or_else(|| message.to_owned())
}

/// Parser of a resolution.
pub(crate) fn dots_per_inch() -> impl Fn(&str) -> Result<f64, String> + Clone {
    number("write a number from 1 to 9600", |dpi| (1.0..=9600.0).contains(dpi))
}

fn id_prefix(text: &str) -> Result<String, String> {
    let starts = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    let goes_on = text.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.'));
    if starts && goes_on {
        Ok(text.to_owned())
    } else {
        Err("begin with a letter or _, and go on with letters, digits, _, - and .".to_owned())
    }
}
