//! [`InfoArgs`]: the options of `ligne info`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::model_unit::ModelUnit;
use crate::cli::step::StepArgs;

/// Options of `ligne info`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne info bunny.obj
  ligne info bracket.stl --unit in
  ligne info drive.glb --all
  ligne info drive.glb --json | jq '.parts[].name'")]
pub(in crate::cli) struct InfoArgs {
    /// The model: .obj, .gltf, .glb, .stl, .ply or .step
    pub(super) model: PathBuf,

    /// The unit of the model: mm, cm, m, in, ft [default: m in glTF, which demands it; the other formats do not say]
    #[arg(long, value_name = "UNIT", value_enum, hide_possible_values = true)]
    pub(super) unit: Option<ModelUnit>,

    /// List everything in full, with the step of each part's coordinates and the rounding that follows from it [default: 20 entries a list]
    #[arg(long)]
    pub(super) all: bool,

    /// Write JSON, for programs; always in full
    #[arg(long)]
    pub(super) json: bool,

    #[command(flatten)]
    pub(super) step: StepArgs,
}
