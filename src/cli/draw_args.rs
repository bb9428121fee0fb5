//! What was typed after `ligne draw`.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum, ValueHint};

use super::contact_sheet::ViewSheetArgs;
use super::dxf_args::DxfArgs;
use super::framing_args::{FramingArgs, SaveArgs};
use super::many::args::ManyArgs;
use super::offered::Offered;
use super::paper::{self, Extent, Measure};
#[cfg(feature = "pdf")]
use super::print_args::PrintArgs;
use super::section_args::SectionArgs;
use super::step::StepArgs;
use super::style_keys;
use super::web_args::WebArgs;
use crate::math::colour::Colour;
use crate::render::Stage;
use crate::scene::{NamedView, UpAxis};
use crate::style::Style;

const EXAMPLES: &str = "Examples:
  ligne draw bunny.obj                                 writes bunny.svg
  ligne draw bunny.obj bunny.png --size 2000x1500 --azimuth -30
  ligne draw part.stl sheet.svg --style technical --view iso --page A4 --scale 1:2
  ligne draw drive.glb - --hide 'bolt*' --quiet | less
  ligne draw *.glb --out-dir drawings --format svg,png --view front,top,iso
  ligne draw bunny.obj --style mine.toml --watch";

const USAGE: &str = "ligne draw [OPTIONS] <MODEL> [OUT]
       ligne draw [OPTIONS] --out-dir <DIR> <MODEL>...";

/// What was typed after `ligne draw`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, override_usage = USAGE)]
pub(super) struct DrawArgs {
    /// The model: .obj, .gltf, .glb, .stl, .ply or .step, or - for standard input (say with --format what it is)
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) model: PathBuf,

    /// The drawing: .svg, .svgz, .png, .pdf or .dxf, or - for SVG on standard output [default: the model's name with
    /// .svg, in the current folder]
    pub(super) out: Option<PathBuf>,

    /// With --out-dir all are models
    #[arg(hide = true, requires = "out_dir")]
    pub(super) more: Vec<PathBuf>,

    /// A further drawing, may be given again
    #[arg(short = 'o', long = "output", value_name = "OUT")]
    pub(super) outputs: Vec<PathBuf>,

    #[command(flatten)]
    pub(super) how: HowArgs,

    #[command(flatten)]
    pub(super) contact: ViewSheetArgs,

    #[command(flatten)]
    pub(super) save: SaveArgs,

    #[command(flatten)]
    pub(super) many: ManyArgs,

    #[command(flatten)]
    pub(super) web: WebArgs,

    #[command(flatten)]
    pub(super) dxf: DxfArgs,

    #[cfg(feature = "pdf")]
    #[command(flatten)]
    pub(super) print: PrintArgs,

    /// Write what the drawing took and what it holds, as JSON; - for standard output
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub(super) report: Option<PathBuf>,

    /// Write the maps of the view that lines in the image are found in, into this folder: normal.png, depth.png (16 bits),
    /// edges.png and parts.png
    #[arg(long, value_name = "FOLDER", help_heading = "Output")]
    pub(super) maps: Option<PathBuf>,

    /// Draw what a stage of the pipeline made, each thing in its own colour: docs/stages.md
    #[arg(long, value_name = "NAME", help_heading = "Output",
        value_parser = PossibleValuesParser::new(Stage::ALL.map(Stage::name))
            .try_map(|name| Stage::parse(&name).ok_or("no such stage")))]
    pub(super) stage: Option<Stage>,
}

/// How a model is drawn: what `ligne draw`, `ligne diff` and cases of `ligne test` have in common.
#[derive(Debug, Clone, Args)]
pub(super) struct HowArgs {
    /// Name of a built-in style, or a style sheet [env: LIGNE_STYLE]
    #[arg(long, value_name = "NAME|FILE.toml", default_value = "ink", hide_possible_values = true,
        value_parser = Offered::new(Style::names(), |name| Ok(name.to_owned())))]
    pub(super) style: String,

    /// Change one key of the style; may be given again: --set lines.crease_deg=30 (ligne styles --keys lists all keys)
    #[arg(long = "set", value_name = "KEY=VALUE", hide_possible_values = true,
        value_parser = Offered::late(style_keys::settings, setting))]
    pub(super) sets: Vec<String>,

    /// The hand: another number draws the same with another one [default: the style's]
    #[arg(long, value_name = "N")]
    pub(super) seed: Option<u32>,

    /// A camera record (.json), or the name of a camera of the model
    #[arg(long, value_name = "FILE.json|NAME", help_heading = "View",
        conflicts_with_all = ["view", "azimuth", "elevation", "fov", "ortho"])]
    pub(super) camera: Option<String>,

    /// A named view, orthographic unless --fov is given; ligne draw takes several: front,top,iso
    #[arg(long, help_heading = "View", value_delimiter = ',', conflicts_with_all = ["azimuth", "elevation"], ignore_case = true,
        value_parser = PossibleValuesParser::new(NamedView::ALL.map(view_value))
            .try_map(|name| NamedView::parse(&name).ok_or("no such view")))]
    pub(super) view: Vec<NamedView>,

    /// Degrees to the right of the front: 0 = front, 90 = right [default: 35]
    #[arg(long, value_name = "DEGREES", help_heading = "View", allow_negative_numbers = true,
        value_parser = degrees)]
    pub(super) azimuth: Option<f64>,

    /// Degrees above the horizon, -90 to 90 [default: 22]
    #[arg(long, value_name = "DEGREES", help_heading = "View", allow_negative_numbers = true,
        value_parser = elevation)]
    pub(super) elevation: Option<f64>,

    /// Perspective with this vertical field of view [default: 35]
    #[arg(long, value_name = "DEGREES", help_heading = "View", conflicts_with = "ortho",
        value_parser = field_of_view)]
    pub(super) fov: Option<f64>,

    /// Parallel lines of sight
    #[arg(long, help_heading = "View")]
    pub(super) ortho: bool,

    /// Which axis of the model points up [default: as the format has it]
    #[arg(long, help_heading = "View", value_parser = PossibleValuesParser::new(["y", "z"])
        .map(|name| if name == "z" { UpAxis::Z } else { UpAxis::Y }))]
    pub(super) up: Option<UpAxis>,

    /// Draw only the parts whose name matches, may be given again
    #[arg(long, value_name = "GLOB", help_heading = "View")]
    pub(super) only: Vec<String>,

    /// Leave out the parts whose name matches, may be given again
    #[arg(long, value_name = "GLOB", help_heading = "View")]
    pub(super) hide: Vec<String>,

    /// Draw a moment of this animation of the model; several play together, with equal shares or with weights:
    /// Walk,Run or Walk:0.7,Run:0.3; weights may change in time: Walk:1..0,Run:0..1 or Walk:1@0.5..0@2,Run
    #[arg(long, value_name = "NAME[:WEIGHT],...", help_heading = "View")]
    pub(super) animation: Vec<String>,

    /// Let each animation begin again when it is over
    #[arg(long, help_heading = "View")]
    pub(super) repeat: bool,

    /// The moment in seconds; where the model has one animation, its name may be left out [default: 0]
    #[arg(long, value_name = "SECONDS", help_heading = "View", value_parser = seconds,
        allow_hyphen_values = true)]
    pub(super) time: Option<f64>,

    /// Draw with no more than so many faces: those go first whose loss changes the shape least (docs/detail.md)
    #[arg(long, value_name = "N", help_heading = "View", value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) faces: Option<u64>,

    #[command(flatten)]
    pub(super) framing: FramingArgs,

    #[command(flatten)]
    pub(super) section: SectionArgs,

    #[command(flatten)]
    pub(super) step: StepArgs,

    /// Size of the drawing in px: 1000x800, or 1000 for a square [default: 1000x1000]
    #[arg(long, value_name = "WIDTHxHEIGHT", help_heading = "Page", conflicts_with = "page",
        value_parser = paper::size_px)]
    pub(super) size: Option<Extent>,

    /// Page in mm: A0 to A6, Letter, Legal, Tabloid, or such as 210x297mm
    #[arg(long, value_name = "NAME|WIDTHxHEIGHT", help_heading = "Page", hide_possible_values = true,
        value_parser = Offered::new(paper::sheet_names(), paper::page_mm))]
    pub(super) page: Option<Extent>,

    /// Lay the page on its longer side
    #[arg(long, help_heading = "Page", requires = "page")]
    pub(super) landscape: bool,

    /// Free border round the picture, such as 10mm [default: 10mm on a page, 0 otherwise]
    #[arg(long, value_name = "LENGTH", help_heading = "Page", value_parser = paper::margin)]
    pub(super) margin: Option<Measure>,

    /// Draw to scale, orthographic: 1:2 is half size. A unit of the model is a mm, in glTF a m, unless --unit tells
    #[arg(long, value_name = "PAPER:MODEL", help_heading = "Page", requires = "page", conflicts_with = "fov",
        value_parser = paper::scale)]
    pub(super) scale: Option<f64>,

    /// Colour of the paper, #rrggbb, a name such as ivory, or none [default: the style's]
    #[arg(long, value_name = "COLOUR|none", help_heading = "Page", value_parser = background)]
    pub(super) background: Option<Background>,

    /// Decimals of coordinates in SVG
    #[arg(long, value_name = "N", help_heading = "Output", value_parser = clap::value_parser!(u8).range(0..=9))]
    pub(super) precision: Option<u8>,

    /// Pixels to the inch in PNG [default: 96, where a px is a pixel; 300 on a page]
    #[arg(long, value_name = "N", help_heading = "Output", value_parser = dots_per_inch)]
    pub(super) dpi: Option<f64>,

    /// What the groups in SVG stand for
    #[arg(long, help_heading = "Output", value_enum, default_value_t = GroupBy::Layer)]
    pub(super) group: GroupBy,

    /// Put before every id in SVG, so that several drawings fit in one page
    #[arg(long, value_name = "PREFIX", help_heading = "Output", value_parser = id_prefix)]
    pub(super) id_prefix: Option<String>,

    /// Number of threads; the drawing is the same with any [env: LIGNE_THREADS] [default:
    /// one a core]
    #[arg(long, value_name = "N", help_heading = "Output",
        value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,

    /// Say nothing but errors
    #[arg(short, long, help_heading = "Output")]
    pub(super) quiet: bool,

    /// Take warnings for errors
    #[arg(long, help_heading = "Output")]
    pub(super) strict: bool,
}

/// What the groups in SVG stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum GroupBy {
    /// The layers of the drawing
    Layer,
    /// The parts of the model
    Part,
}

/// A colour of the paper, or none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Background(pub(super) Option<Colour>);

fn background(text: &str) -> Result<Background, String> {
    if text.eq_ignore_ascii_case("none") {
        return Ok(Background(None));
    }
    let colour = Colour::parse(text).ok_or("write a colour as #rrggbb or by its name in CSS, or none")?;
    Ok(Background(Some(colour)))
}

/// The names of a view.
fn view_value(view: NamedView) -> PossibleValue {
    PossibleValue::new(view.name()).aliases(view.other_name())
}

fn setting(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((key, _)) if !key.trim().is_empty() => Ok(text.to_owned()),
        _ => Err("write KEY=VALUE, such as lines.crease_deg=30".to_owned()),
    }
}

fn degrees(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|d: &f64| d.is_finite()).ok_or_else(|| "write a number of degrees".to_owned())
}

fn elevation(text: &str) -> Result<f64, String> {
    degrees(text).ok().filter(|d| d.abs() <= 90.0).ok_or_else(|| "write degrees from -90 to 90".to_owned())
}

fn field_of_view(text: &str) -> Result<f64, String> {
    degrees(text)
        .ok()
        .filter(|d| *d > 0.0 && *d < 180.0)
        .ok_or_else(|| "write degrees between 0 and 180".to_owned())
}

fn seconds(text: &str) -> Result<f64, String> {
    let time = text.parse().ok().filter(|time: &f64| time.is_finite());
    time.ok_or_else(|| "write a number of seconds".to_owned())
}

pub(super) fn dots_per_inch(text: &str) -> Result<f64, String> {
    let dpi = text.parse().ok().filter(|dpi: &f64| (1.0..=9600.0).contains(dpi));
    dpi.ok_or_else(|| "write a number from 1 to 9600".to_owned())
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
