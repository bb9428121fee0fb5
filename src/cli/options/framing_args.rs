//! Framing options, shared by all commands that draw a model.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use glam::DVec3;

use crate::cli::options::values::model_unit::ModelUnit;

/// Framing options.
#[derive(Debug, Clone, Args)]
pub(crate) struct FramingArgs {
    /// Parts to fit into the frame: visible, or all even when --only, --hide or --section removes some [default: visible]
    #[arg(long, value_name = "WHAT", help_heading = "View", value_enum, default_value_t = FramedParts::Visible,
        hide_default_value = true)]
    pub(crate) frame: FramedParts,

    /// Model point at the centre of the frame; needs --scale or an orthographic camera record
    #[arg(long, visible_alias = "center", value_name = "X,Y,Z", help_heading = "View", allow_hyphen_values = true,
        value_parser = point)]
    pub(crate) centre: Option<DVec3>,

    /// Unit of the model: mm, cm, m, in, ft [default: m in glTF, mm otherwise]
    #[arg(long, value_name = "UNIT", help_heading = "Page", value_enum, hide_possible_values = true)]
    pub(crate) unit: Option<ModelUnit>,
}

/// Parts that must fit into the frame. Plain comments keep the values on one line of help.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum FramedParts {
    // All parts of the model.
    All,
    // The parts that are drawn.
    Visible,
}

/// Option that saves the camera of a drawing.
#[derive(Debug, Clone, Args)]
pub(crate) struct SaveArgs {
    /// Write the camera as a record for --camera
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub(crate) save_camera: Option<PathBuf>,
}

fn point(text: &str) -> Result<DVec3, String> {
    let numbers: Vec<f64> = text.split(',').filter_map(|number| number.trim().parse().ok()).collect();
    match numbers.as_slice() {
        [x, y, z] if numbers.iter().all(|number| number.is_finite()) && text.split(',').count() == 3 => {
            Ok(DVec3::new(*x, *y, *z))
        }
        _ => Err("write a point as X,Y,Z, such as 0,12.5,-3".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn point_parses_three_coordinates() {
        assert_eq!(point("0, 12.5,-3"), Ok(DVec3::new(0.0, 12.5, -3.0)));
        for wrong in ["", "1", "1,2", "1,2,3,4", "a,2,3", "1,2,3,a", "nan,0,0", "1,,3"] {
            assert!(point(wrong).is_err(), "{wrong}");
        }
    }
}
