//! Options of contact sheets: views and moments.

use clap::Args;

/// Options of `ligne draw --contact-sheet`.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct ViewSheetArgs {
    /// Draw 3 x 3 views with their angles, around the model or around --azimuth and --elevation; --size is of each
    #[arg(long, help_heading = "View", conflicts_with_all = ["camera", "view", "page", "report", "maps", "save_camera",
        "out_dir", "resume", "watch"])]
    pub(crate) contact_sheet: bool,
}

/// Options of `ligne animate --contact-sheet`.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct MomentSheetArgs {
    /// Draw 3 x 3 moments from --from to --to with their times; --size is of each
    #[arg(long, help_heading = "Frames", conflicts_with_all = ["turntable", "path", "budget", "levels", "shard", "resume",
        "hold", "fps", "faces", "page", "report"])]
    pub(crate) contact_sheet: bool,
}
