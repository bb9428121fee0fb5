//! Options of contact sheets of views and of moments.

use clap::Args;

/// Options of `ligne draw --contact-sheet`.
#[derive(Debug, Clone, Default, Args)]
pub(in crate::cli) struct ViewSheetArgs {
    /// Draw 3 x 3 small views with their angles as captions: all around the model, or the neighbours of --azimuth and
    /// --elevation; --size is that of each view [default: 320x320]
    #[arg(long, help_heading = "View", conflicts_with_all = ["camera", "view", "page", "report", "maps", "save_camera",
        "out_dir", "resume", "watch"])]
    pub(in crate::cli) contact_sheet: bool,
}

/// Options of `ligne animate --contact-sheet`.
#[derive(Debug, Clone, Default, Args)]
pub(in crate::cli) struct MomentSheetArgs {
    /// Draw 3 x 3 moments of the animation with their times as captions, from --from to --to; --size is that of each
    /// [default: 320x320]
    #[arg(long, help_heading = "Frames", conflicts_with_all = ["turntable", "path", "budget", "levels", "shard", "resume",
        "hold", "fps", "faces", "page", "report"])]
    pub(in crate::cli) contact_sheet: bool,
}
