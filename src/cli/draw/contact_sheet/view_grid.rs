//! `ligne draw --contact-sheet`: one model drawn from nine sides.

use super::{COLUMN_COUNT, ContactSheet, PICTURE_COUNT, check_outputs, picture_request};
use crate::cli::draw::model_drawing;
use crate::cli::library_calls;
use crate::cli::options::draw_args::DrawArgs;
use crate::cli::output::number_text;
use crate::cli::output::progress::Progress;
use crate::cli::request::draw_request::DrawRequest;
use crate::error::Error;
use crate::pipeline::Stopwatch;
use crate::scene::cameras::named_views::{THREE_QUARTER_AZIMUTH_DEG, THREE_QUARTER_ELEVATION_DEG};

/// Angle between the views around the model, and elevation of the view from above, degrees.
const VIEW_SPACING_DEG: f64 = 45.0;
const TOP_ELEVATION_DEG: f64 = 70.0;

/// Angles between neighbouring views, degrees.
const AZIMUTH_STEP_DEG: f64 = 20.0;
const ELEVATION_STEP_DEG: f64 = 15.0;

/// Draws the model from all sides, or from angles around the given view.
pub(crate) fn run(args: DrawArgs) -> Result<(), Error> {
    let how = args.how.clone();
    let whole = DrawRequest::new(args)?;
    check_outputs(&whole.outputs)?;
    let angles = angles(how.azimuth, how.elevation);
    let request = |[azimuth, elevation]: [f64; 2]| {
        let mut how = how.clone();
        (how.azimuth, how.elevation) = (Some(azimuth), Some(elevation));
        let request = DrawRequest::of_model(whole.model.clone(), how)?;
        Ok(DrawRequest { piped: whole.piped, stage: whole.stage, ..picture_request(request) })
    };
    let requests: Vec<DrawRequest> = angles.into_iter().map(request).collect::<Result<_, Error>>()?;
    let all: Vec<&DrawRequest> = requests.iter().collect();
    let mut sheet = ContactSheet::default();
    let mut captions = angles.into_iter().map(caption);
    library_calls::in_threads(whole.how.threads, || {
        let progress = Progress::start(whole.how.quiet, &whole.model);
        model_drawing::draw_model(None, &all, &mut Stopwatch::start(), &progress, |_, drawn| {
            let caption = captions.next().unwrap_or_default();
            let key = caption.replace("--", "").replace(' ', "-");
            sheet.add(drawn, caption, key);
            Ok(())
        })
    })??;
    sheet.finish(&whole, &whole.outputs, COLUMN_COUNT, "view")
}

/// Caption: the options that repeat the view.
fn caption([azimuth, elevation]: [f64; 2]) -> String {
    format!("--azimuth {} --elevation {}", number_text::plain(azimuth, 2), number_text::plain(elevation, 2))
}

/// Azimuth and elevation of each view, degrees. Without given angles the views go around the model, with the
/// default view in the middle and a view from above last. Otherwise they surround the given view.
fn angles(azimuth: Option<f64>, elevation: Option<f64>) -> [[f64; 2]; PICTURE_COUNT] {
    let centre =
        [azimuth.unwrap_or(THREE_QUARTER_AZIMUTH_DEG), elevation.unwrap_or(THREE_QUARTER_ELEVATION_DEG)];
    let middle = PICTURE_COUNT / 2;
    if azimuth.is_none() && elevation.is_none() {
        return std::array::from_fn(|place| match place {
            8 => [centre[0], TOP_ELEVATION_DEG],
            _ => [turned(centre[0] + (place as f64 - middle as f64) * VIEW_SPACING_DEG), centre[1]],
        });
    }
    // Near a pole all rows lie on one side of it.
    let up = if centre[1] + ELEVATION_STEP_DEG > 90.0 {
        0.0
    } else if centre[1] - ELEVATION_STEP_DEG < -90.0 {
        2.0
    } else {
        1.0
    };
    std::array::from_fn(|place| {
        let (column, row) = ((place % COLUMN_COUNT) as f64, (place / COLUMN_COUNT) as f64);
        [turned(centre[0] + (column - 1.0) * AZIMUTH_STEP_DEG), centre[1] + (up - row) * ELEVATION_STEP_DEG]
    })
}

/// Normalises an azimuth to the range from -180 to 180 degrees.
fn turned(azimuth: f64) -> f64 {
    let turned = azimuth.rem_euclid(360.0);
    if turned > 180.0 { turned - 360.0 } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_surround_the_model_or_the_given_view() {
        let all = angles(None, None);
        assert_eq!(all[4], [35.0, 22.0]);
        assert_eq!(all[8], [35.0, 70.0]);
        assert_eq!(
            all[..8].iter().map(|own| own[0]).collect::<Vec<_>>(),
            [-145.0, -100.0, -55.0, -10.0, 35.0, 80.0, 125.0, 170.0]
        );
        assert_eq!(caption(all[0]), "--azimuth -145 --elevation 22");
        let near = angles(Some(170.0), Some(10.5));
        assert_eq!((near[0], near[4], near[8]), ([150.0, 25.5], [170.0, 10.5], [-170.0, -4.5]));
        for elevation in [-90.0, -80.0, 0.0, 80.0, 90.0] {
            let near = angles(None, Some(elevation));
            assert!(near.iter().all(|own| own[1].abs() <= 90.0), "{near:?}");
            assert!(near.contains(&[35.0, elevation]), "{near:?}");
        }
    }
}
