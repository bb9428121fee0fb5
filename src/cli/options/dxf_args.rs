//! Options of DXF output.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::drawing::Drawing;
use crate::error::Error;
use crate::export::{DxfLength, DxfOptions, DxfVersion};
use crate::scene::Camera;
use crate::scene::Projection;

/// Options of DXF output.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct DxfArgs {
    /// DXF release: r12 (read by every program) or 2000 (with fills, line widths and units)
    #[arg(long, value_name = "RELEASE", help_heading = "Output", default_value = "r12", ignore_case = true,
        value_parser = dxf_version())]
    dxf: DxfVersion,

    /// DXF lengths: page (mm, 1 px = 1/96 inch) or model (model units; needs an orthographic view)
    #[arg(long, value_name = "WHOSE", help_heading = "Output", default_value = "page",
        value_parser = PossibleValuesParser::new(["page", "model"])
            .map(|name| if name == "model" { DxfLengthSource::Model } else { DxfLengthSource::Page }))]
    dxf_length: DxfLengthSource,
}

/// Parser of a DXF release.
pub(crate) fn dxf_version() -> impl TypedValueParser<Value = DxfVersion> {
    PossibleValuesParser::new(["r12", "2000"])
        .map(|name| if name == "2000" { DxfVersion::R2000 } else { DxfVersion::R12 })
}

/// Source of the lengths in a DXF file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DxfLengthSource {
    Page,
    Model,
}

impl Default for DxfArgs {
    fn default() -> Self {
        Self { dxf: DxfVersion::default(), dxf_length: DxfLengthSource::Page }
    }
}

/// Encodes a drawing as DXF, and returns a warning about elements that DXF cannot hold.
///
/// # Errors
/// If model lengths are requested for a perspective view.
pub(crate) fn encode(
    drawing: &Drawing,
    camera: &Camera,
    args: &DxfArgs,
) -> Result<(Vec<u8>, Option<String>), Error> {
    let mut options = DxfOptions::default().with_version(args.dxf);
    match (args.dxf_length, camera.projection) {
        (DxfLengthSource::Page, _) => {}
        (DxfLengthSource::Model, Projection::Orthographic { height }) => {
            let per_unit = camera.height / height;
            // The frame is centred on the page, and the camera looks at its centre.
            let [right, up, _] = camera.axes();
            let at = [
                drawing.page.width / 2.0 - camera.eye.dot(right) * per_unit,
                drawing.page.height / 2.0 + camera.eye.dot(up) * per_unit,
            ];
            options = options.with_length(DxfLength::Model(per_unit)).with_origin(at);
        }
        (DxfLengthSource::Model, Projection::Perspective { .. }) => {
            return Err(Error::new("a perspective view has no uniform scale")
                .at("--dxf-length")
                .remedy("give --ortho or a named view, or leave --dxf-length out"));
        }
    }
    let told = match (drawing.left_out_of_dxf(&options), args.dxf) {
        (0, _) => None,
        (left, DxfVersion::R12) => Some(format!(
            "DXF R12 cannot hold fills or pictures: {left} are left out (--dxf 2000 keeps fills)"
        )),
        (left, DxfVersion::R2000) => Some(format!("DXF cannot hold pictures: {left} are left out")),
    };
    Ok((drawing.to_dxf(&options), told))
}
