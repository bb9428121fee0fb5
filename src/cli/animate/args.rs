//! What was typed after `ligne animate`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::contact_sheet::MomentSheetArgs;
use crate::cli::draw_args::HowArgs;
use crate::cli::shard::Share;

const EXAMPLES: &str = "Examples:
  ligne animate crane.glb crane.svg                    one SVG that moves
  ligne animate crane.glb 'frames/%04d.svg' --fps 24 --hold 2
  ligne animate fox.glb fox.gif --animation Run --style toon --size 400
  ligne animate fox.glb fox.svg --animation Walk:1..0,Run:0..1 --repeat --to 4
  ligne animate drive.glb turn.webp --turntable 36
  ligne animate crane.glb 'frames/%04d.png' --shard 1/4 --resume";

/// What was typed after `ligne animate`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(in crate::cli) struct AnimateArgs {
    /// The model: .obj, .gltf, .glb, .stl, .ply or .step
    pub(super) model: PathBuf,

    /// One file of all frames: .svg, .gif, .png, .webp, .mp4 or .webm; or a file for each, its number in the
    /// place of %04d: 'frames/%04d.svg' (.png, .pdf)
    pub(super) out: PathBuf,

    #[command(flatten)]
    pub(super) how: HowArgs,

    #[command(flatten)]
    pub(super) contact: MomentSheetArgs,

    /// Frames a second
    #[arg(long, value_name = "N", default_value_t = 12.0, help_heading = "Frames")]
    pub(super) fps: f64,

    /// The time of the first frame [default: when the animation begins]
    #[arg(long, value_name = "SECONDS", help_heading = "Frames", allow_hyphen_values = true)]
    pub(super) from: Option<f64>,

    /// The time at which the last frame is over [default: when the animation ends]
    #[arg(long, value_name = "SECONDS", help_heading = "Frames", allow_hyphen_values = true,
        conflicts_with_all = ["turntable", "path"])]
    pub(super) to: Option<f64>,

    /// Show every drawing for so many frames: 2 draws on twos
    #[arg(long, value_name = "N", default_value_t = 1, help_heading = "Frames",
        value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) hold: u16,

    /// Go round the model in so many frames
    #[arg(long, value_name = "N", help_heading = "Frames", conflicts_with = "path",
        value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(super) turntable: Option<u32>,

    /// See each frame by a camera of its own: a list of camera records
    #[arg(long, value_name = "FILE.json", help_heading = "Frames",
        conflicts_with_all = ["camera", "view", "azimuth", "elevation", "fov", "ortho", "scale"])]
    pub(super) path: Option<PathBuf>,

    /// Hold every frame within this time, with as few faces as that needs: docs/detail.md
    #[arg(long, value_name = "TIME", help_heading = "Frames", value_parser = super::detail::budget,
        conflicts_with_all = ["faces", "shard", "resume"])]
    pub(super) budget: Option<f64>,

    /// The numbers of faces of all drawings: written with --budget, read without
    #[arg(long, value_name = "FILE", help_heading = "Frames", conflicts_with = "faces")]
    pub(super) levels: Option<PathBuf>,

    /// Draw the Kth of every N frames only, so that N computers share the work; /N: the K of a job array (docs/many.md)
    #[arg(long, value_name = "K/N", help_heading = "Frames", value_parser = Share::parse)]
    pub(super) shard: Option<Share>,

    /// Leave frames as they are that have been written already
    #[arg(long, help_heading = "Frames")]
    pub(super) resume: bool,

    /// Write what the frames took and what they hold, as JSON; - for standard output
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub(super) report: Option<PathBuf>,
}
