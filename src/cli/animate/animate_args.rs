//! Options of `ligne animate`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::options::contact_sheet_args::MomentSheetArgs;
use crate::cli::options::draw_args::HowArgs;
use crate::cli::options::values::shard::ShardSpec;

const EXAMPLES: &str = "Examples:
  ligne animate crane.glb crane.svg                    one animated SVG
  ligne animate crane.glb 'frames/%04d.svg' --fps 24 --hold 2
  ligne animate fox.glb fox.gif --animation Run --style toon --size 400
  ligne animate fox.glb fox.svg --animation Walk:1..0,Run:0..1 --repeat --to 4
  ligne animate drive.glb turn.webp --turntable 36
  ligne animate crane.glb 'frames/%04d.png' --shard 1/4 --resume";

/// Options of `ligne animate`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct AnimateArgs {
    /// Model: .obj, .gltf, .glb, .stl, .ply or .step
    pub(crate) model: PathBuf,

    /// One film (.svg, .gif, .png, .webp, .mp4, .webm), or numbered frames such as 'frames/%04d.svg'
    pub(crate) out: PathBuf,

    #[command(flatten)]
    pub(crate) contact: MomentSheetArgs,

    /// Frames per second
    #[arg(long, value_name = "N", default_value_t = 12.0, help_heading = "Frames")]
    pub(crate) fps: f64,

    /// Time of the first frame [default: start of the clip]
    #[arg(long, value_name = "SECONDS", help_heading = "Frames", allow_hyphen_values = true)]
    pub(crate) from: Option<f64>,

    /// End of the last frame [default: end of the clip]
    #[arg(long, value_name = "SECONDS", help_heading = "Frames", allow_hyphen_values = true,
        conflicts_with_all = ["turntable", "path"])]
    pub(crate) to: Option<f64>,

    /// Frames per drawing, 2 for animation on twos
    #[arg(long, value_name = "N", default_value_t = 1, help_heading = "Frames",
        value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) hold: u16,

    /// Turn once around the model in N frames
    #[arg(long, value_name = "N", help_heading = "Frames", conflicts_with = "path",
        value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) turntable: Option<u32>,

    /// One camera per frame, as a list of camera records
    #[arg(long, value_name = "FILE.json", help_heading = "Frames",
        conflicts_with_all = ["camera", "view", "azimuth", "elevation", "fov", "ortho", "scale"])]
    pub(crate) path: Option<PathBuf>,

    /// Time limit per frame, such as 33ms, met by simplifying the model
    #[arg(long, value_name = "TIME", help_heading = "Frames", value_parser = super::face_limit::budget,
        conflicts_with_all = ["faces", "shard", "resume"])]
    pub(crate) budget: Option<f64>,

    /// Read the face count of each drawing from this file
    #[arg(long, value_name = "FILE", help_heading = "Frames", conflicts_with = "faces")]
    pub(crate) levels: Option<PathBuf>,

    /// Write the face counts found with --budget to this file, for --levels
    #[arg(long, value_name = "FILE", help_heading = "Frames", requires = "budget")]
    pub(crate) save_levels: Option<PathBuf>,

    /// Draw share K of N of the frames, or share K of a job array with /N
    #[arg(long, value_name = "K/N", help_heading = "Frames", value_parser = ShardSpec::parse)]
    pub(crate) shard: Option<ShardSpec>,

    /// Skip frames that exist
    #[arg(long, help_heading = "Frames")]
    pub(crate) resume: bool,

    /// Write times, counts and warnings as JSON; - for standard output
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub(crate) report: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) how: HowArgs,
}
