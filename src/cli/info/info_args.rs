//! [`InfoArgs`]: the options of `ligne info`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::options::step_args::StepArgs;
use crate::cli::options::values::model_unit::ModelUnit;

/// Options of `ligne info`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne info bunny.obj
  ligne info bracket.stl --unit in
  ligne info drive.glb --all
  ligne info drive.glb --json | jq '.parts[].name'")]
pub(crate) struct InfoArgs {
    /// Model: .obj, .gltf, .glb, .stl, .ply or .step
    pub(crate) model: PathBuf,

    /// Unit of the model: mm, cm, m, in, ft [default: m in glTF, unknown otherwise]
    #[arg(long, value_name = "UNIT", value_enum, hide_possible_values = true)]
    pub(crate) unit: Option<ModelUnit>,

    /// List everything, with bounds and precision of each part [default: 20 entries per list]
    #[arg(long)]
    pub(crate) all: bool,

    /// Print JSON, always complete
    #[arg(long)]
    pub(crate) json: bool,

    #[command(flatten)]
    pub(crate) step: StepArgs,
}
