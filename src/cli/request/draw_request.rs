//! [`DrawRequest`]: checked options of one drawing.

use std::path::{Path, PathBuf};

use super::viewpoint::{Lens, SheetRequest, ViewRequest};
use crate::cli::options::draw_args::{DrawArgs, HowArgs};
use crate::cli::options::dxf_args::DxfArgs;
use crate::cli::options::web_args::WebArgs;
use crate::cli::output::output_files::{Format, Output, is_stdout};
use crate::colour::srgb::Colour;
use crate::drawing::Unit;
use crate::error::Error;
#[cfg(feature = "pdf")]
use crate::export::PdfOptions;
use crate::load::ModelFormat;
use crate::pipeline::{MapFiles, Stage};

/// One drawing in one or several formats.
#[derive(Debug)]
pub(crate) struct DrawRequest {
    pub(crate) model: PathBuf,
    /// The options as they were given. `sets`, `view` and `sheet` below are made from them.
    pub(crate) how: HowArgs,
    /// Format of the model on standard input; none if the model is a file.
    pub(crate) piped: Option<ModelFormat>,
    /// At least one output. No two share a path.
    pub(crate) outputs: Vec<Output>,
    pub(crate) report: Option<PathBuf>,
    /// Folder for the maps of the view.
    pub(crate) maps: Option<PathBuf>,
    pub(crate) sets: Vec<String>,
    /// Background that replaces the one of the style; the inner `None` is transparent.
    pub(crate) background: Option<Option<Colour>>,
    pub(crate) view: ViewRequest,
    pub(crate) sheet: SheetRequest,
    /// Path for the camera record of the drawing.
    pub(crate) save_camera: Option<PathBuf>,
    pub(crate) web: WebArgs,
    pub(crate) dxf: DxfArgs,
    /// Options of PDF output, if any are given.
    #[cfg(feature = "pdf")]
    pub(crate) print: Option<PdfOptions>,
    pub(crate) stage: Option<Stage>,
}

impl DrawRequest {
    /// Whether lengths of the drawing are model lengths: on a page with a scale, and in DXF.
    pub(crate) fn is_to_scale(&self) -> bool {
        self.sheet.scale.is_some() || self.outputs.iter().any(|output| output.format == Format::Dxf)
    }

    /// Whether the model is drawn in its stored pose.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.how.animation.is_empty() && self.how.time.is_none()
    }

    /// Checks the arguments of `ligne draw`.
    ///
    /// # Errors
    /// If an output has no known format, if two outputs are the same file, or if an output would overwrite
    /// the model.
    pub(crate) fn new(args: DrawArgs) -> Result<Self, Error> {
        let typed = args.out.into_iter().chain(args.more).chain(args.outputs).collect();
        let paths = args.many.paths(&args.model, typed)?;
        let outputs = paths.into_iter().map(Output::new).collect::<Result<Vec<_>, _>>()?;
        let save_camera = args.save.save_camera;
        let besides: Vec<&Path> = args.report.iter().chain(&save_camera).map(PathBuf::as_path).collect();
        check_apart(&args.model, &outputs, &besides, args.maps.as_deref())?;
        let piped = args.many.piped([&args.model])?;
        let request = Self::of_model(args.model, args.how)?.reading(piped);
        #[cfg(feature = "pdf")]
        let print = args.print.of_outputs(args.web.pdf_inks(), &outputs)?;
        Ok(Self {
            #[cfg(feature = "pdf")]
            print,
            outputs,
            report: args.report,
            maps: args.maps,
            stage: args.stage,
            save_camera,
            web: args.web,
            dxf: args.dxf,
            ..request
        })
    }

    /// Reads the model from standard input if its path is `-`.
    pub(crate) fn reading(mut self, piped: Option<ModelFormat>) -> Self {
        self.piped = piped.filter(|_| is_stdout(&self.model));
        if self.piped.is_some() {
            self.model = PathBuf::from("standard input");
        }
        self
    }

    /// Request for a model with drawing options, and SVG on standard output.
    ///
    /// # Errors
    /// If options contradict each other.
    pub(crate) fn of_model(model: PathBuf, args: HowArgs) -> Result<Self, Error> {
        // clap does not check a required option if it conflicts with another given option.
        let alone = [("--scale", args.scale.is_some()), ("--landscape", args.landscape)];
        if let Some((option, _)) = alone.into_iter().find(|(_, given)| *given && args.page.is_none()) {
            return Err(Error::new("this option needs a page in mm")
                .at(option)
                .remedy("give --page, such as --page A4"));
        }
        let lens = match (args.fov, args.ortho || args.scale.is_some()) {
            (Some(fov_y_deg), _) => Some(Lens::Perspective { fov_y_deg }),
            (None, true) => Some(Lens::Parallel),
            (None, false) => None,
        };
        if args.view.len() > 1 {
            return Err(Error::new("one drawing cannot show several views")
                .at("--view")
                .remedy("give one view"));
        }
        let view = match (&args.camera, args.view.first().copied()) {
            (Some(camera), _) => ViewRequest::Recorded(camera.clone()),
            (None, Some(view)) => ViewRequest::Named(view, lens),
            (None, None) => {
                ViewRequest::Angles { azimuth_deg: args.azimuth, elevation_deg: args.elevation, lens }
            }
        };
        let page = args.page.map(|page| if args.landscape { page.landscape() } else { page });
        Ok(Self {
            model,
            piped: None,
            outputs: vec![Output { path: PathBuf::from("-"), format: Format::SvgToStdout }],
            report: None,
            maps: None,
            sets: args.sets.iter().cloned().chain(args.seed.map(|seed| format!("seed={seed}"))).collect(),
            background: args.background.map(|background| background.0),
            view,
            sheet: SheetRequest {
                extent: page.map(|mm| (mm, Unit::Mm)).or(args.size.map(|px| (px, Unit::Px))),
                margin: args.margin,
                scale: args.scale,
                centre: args.framing.centre,
                unit: args.framing.unit,
            },
            save_camera: None,
            web: WebArgs::default(),
            dxf: DxfArgs::default(),
            #[cfg(feature = "pdf")]
            print: None,
            stage: None,
            how: args,
        })
    }
}

/// Refuses outputs that share a path or would overwrite the model.
pub(crate) fn check_apart(
    model: &Path,
    outputs: &[Output],
    besides: &[&Path],
    maps: Option<&Path>,
) -> Result<(), Error> {
    let mut taken: Vec<PathBuf> = Vec::new();
    let files = outputs.iter().filter(|output| output.format != Format::SvgToStdout);
    let besides_files = besides.iter().copied().filter(|path| !is_stdout(path));
    let in_folder: Vec<PathBuf> =
        maps.into_iter().flat_map(|folder| MapFiles::NAMES.map(|name| folder.join(name))).collect();
    let paths = files.map(|output| output.path.as_path()).chain(besides_files);
    for path in paths.chain(in_folder.iter().map(PathBuf::as_path)) {
        refuse_overwriting(path, "the drawing", model, "the model")?;
        if taken.iter().any(|other| same_file(path, other)) {
            return Err(Error::new("this output is named twice").in_file(path).remedy("leave one out"));
        }
        taken.push(path.to_path_buf());
    }
    let printed = outputs.iter().filter(|output| output.format == Format::SvgToStdout).count();
    if printed + besides.iter().filter(|path| is_stdout(path)).count() > 1 {
        return Err(Error::new("standard output is named twice").remedy("leave one `-` out"));
    }
    Ok(())
}

/// Refuses an output that would overwrite an input; both are named in the error.
pub(crate) fn refuse_overwriting(output: &Path, what: &str, input: &Path, of: &str) -> Result<(), Error> {
    if !same_file(output, input) {
        return Ok(());
    }
    let error = Error::new(format!("{what} would overwrite {of}")).in_file(output);
    Err(error.remedy(format!("give {what} another name")))
}

/// Whether two paths lead to the same file. Files that do not exist are compared by path.
pub(crate) fn same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b && a.is_file(),
        _ => a == b,
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::cli::options::values::paper_size::PaperSize;

    #[derive(Parser)]
    struct DrawCommand {
        #[command(flatten)]
        args: DrawArgs,
    }

    fn request(line: &str) -> Result<DrawRequest, String> {
        let words = std::iter::once("draw").chain(line.split_whitespace());
        let typed = DrawCommand::try_parse_from(words).map_err(|error| error.to_string())?;
        DrawRequest::new(typed.args).map_err(|error| error.to_string())
    }

    #[test]
    fn draw_request_names_the_output_after_the_model() -> Result<(), String> {
        let request = request("some/folder/bunny.v2.obj")?;
        let paths: Vec<_> = request.outputs.iter().map(|output| output.path.clone()).collect();
        assert_eq!(paths, [PathBuf::from("bunny.v2.svg")]);
        assert_eq!(request.view, ViewRequest::Angles { azimuth_deg: None, elevation_deg: None, lens: None });
        assert!(request.sheet.extent.is_none() && request.background.is_none());
        Ok(())
    }

    #[test]
    fn draw_request_holds_the_values_of_its_options() -> Result<(), String> {
        let printed =
            request("m.stl a.svg -o b.PNG -o - --page a4 --landscape --scale 1:2 --background none")?;
        let formats: Vec<_> = printed.outputs.iter().map(|output| output.format).collect();
        assert_eq!(formats, [Format::Svg, Format::Png, Format::SvgToStdout]);
        assert_eq!(printed.sheet.extent, Some((PaperSize { width: 297.0, height: 210.0 }, Unit::Mm)));
        assert_eq!(printed.background, Some(None));
        assert_eq!(printed.sheet.scale, Some(0.5));
        let lens = Some(Lens::Parallel);
        assert_eq!(printed.view, ViewRequest::Angles { azimuth_deg: None, elevation_deg: None, lens });
        let turned = request("m.stl --azimuth -35 --elevation -10.5 --fov 20")?;
        let lens = Some(Lens::Perspective { fov_y_deg: 20.0 });
        assert_eq!(
            turned.view,
            ViewRequest::Angles { azimuth_deg: Some(-35.0), elevation_deg: Some(-10.5), lens }
        );
        Ok(())
    }

    #[test]
    fn draw_request_rejects_contradictory_and_invalid_options() {
        let wrong = [
            "",
            "m.stl a.gif",
            "m.stl a.eps",
            "m.stl a",
            "m.stl a.svg -o a.svg",
            "m.stl - -o -",
            "m.stl a.svg --report a.svg",
            "m.stl - --report -",
            "m.stl maps/depth.png --maps maps",
            "m.svg m.svg",
            "m.stl --view iso --azimuth 3",
            "m.stl --view sideways",
            "m.stl --fov 30 --ortho",
            "m.stl --fov 180",
            "m.stl --elevation 91",
            "m.stl --azimuth nan",
            "m.stl --camera c.json --view top",
            "m.stl --scale 1:2",
            "m.stl --scale 1:2 --page A4 --fov 30",
            "m.stl --scale 1:2 --size 9",
            "m.stl --landscape",
            "m.stl --landscape --size 9",
            "m.stl --size 10x10 --page A4",
            "m.stl --threads 0",
            "m.stl --precision 10",
            "m.stl --set seed",
            "m.stl --background bluish",
            "m.stl --id-prefix 9",
            "m.stl --stage cells",
            "m.stl --dpi 0",
            "m.stl --up x",
            "m.stl --centre 1,2",
            "m.stl --unit furlong",
            "m.stl a.svg --save-camera a.svg",
            "m.stl --save-camera m.stl",
            "m.stl - --save-camera -",
            "m.stl --faces 0",
            "m.stl --faces many",
        ];
        for line in wrong {
            assert!(request(line).is_err(), "{line}");
        }
    }
}
