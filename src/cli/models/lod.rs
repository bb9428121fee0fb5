//! `ligne lod`: stores the simplification order of a model. Also limits the number of faces of models.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::options::step_args::StepArgs;
use crate::cli::output::number_text::{bytes as size, counted, grouped};
use crate::cli::output::output_files::{check_place, write_file};
use crate::cli::request::draw_request::refuse_overwriting;
use crate::cli::say;
use crate::cli::step::open_scene;
use crate::edit::simplify::Detail;
use crate::error::Error;
use crate::pipeline::Stopwatch;
use crate::scene::Scene;

/// Options of `ligne lod`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne lod bunny.obj                        writes bunny.ligne-lod next to the model
  ligne lod bunny.obj levels/bunny.ligne-lod
  ligne draw bunny.obj --faces 5000          reads bunny.ligne-lod

The file makes --faces faster. It does not change the drawing.")]
pub(crate) struct LodArgs {
    /// Model: .obj, .gltf, .glb, .stl, .ply or .step
    model: PathBuf,

    /// Output [default: MODEL's name with .ligne-lod, in its folder]
    #[arg(value_name = "OUT.ligne-lod")]
    out: Option<PathBuf>,

    #[command(flatten)]
    step: StepArgs,

    /// Print errors only
    #[arg(short, long)]
    quiet: bool,
}

/// Computes all edge collapses of the model and writes them.
pub(crate) fn run(args: &LodArgs) -> Result<(), Error> {
    let out = args.out.clone().unwrap_or_else(|| Detail::beside(&args.model));
    check_place(&out)?;
    refuse_overwriting(&out, "the output", &args.model, "the model")?;
    let scene = open_scene(&args.model, &args.step)?;
    let mut watch = Stopwatch::start();
    let detail = Detail::of(&scene);
    let took = watch.lap_ms();
    let bytes = detail.to_bytes(&scene);
    write_file(&out, &bytes)?;
    if !args.quiet {
        let mut levels = detail.levels();
        let fewest = levels.seek(&scene, 0)?;
        say(&format!(
            "{}: {} down to {}, {}, {}, {took:.0} ms",
            out.display(),
            counted(scene.triangle_count() as u64, "face"),
            grouped(fewest),
            counted(levels.deepest() as u64, "level"),
            size(bytes.len() as u64),
        ));
    }
    Ok(())
}

/// Levels of detail of a model, from the file next to it, or computed down to `faces` faces. If the file
/// cannot be used, the scene gets a note.
pub(crate) fn detail(model: &Path, scene: &mut Scene, faces: u64) -> Detail {
    let beside = Detail::beside(model);
    if let Ok(bytes) = std::fs::read(&beside) {
        match Detail::read(&bytes, scene) {
            Ok(detail) => return detail,
            Err(error) => scene.warnings.note(format!("{} is ignored: {}", beside.display(), error.message)),
        }
    }
    Detail::down_to(scene, faces)
}

/// Reduces a pose of the scene to at most `faces` faces, or to the fewest possible.
pub(crate) fn reduced(scene: &Scene, detail: &Detail, faces: u64) -> Result<Scene, Error> {
    let mut levels = detail.levels();
    let fewest = levels.seek(scene, faces)?;
    let mut scene = levels.scene(scene)?;
    if fewest > faces {
        let fewest = counted(fewest, "face");
        scene
            .warnings
            .note(format!("the model keeps {fewest}, because its pieces cannot be simplified further"));
    }
    Ok(scene)
}
