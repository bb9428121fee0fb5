//! Printing plates: the inks that print each colour of a drawing.
//!
//! Source: ISO 32000-1, sections 8.6.6.4 (separations) and 8.6.7 (overprint).

use std::sync::Arc;

use moxcms::{
    ColorProfile, DataColorSpace, Layout, RenderingIntent, Transform8BitExecutor, TransformOptions,
};

use super::pdf_options::{Inks, PdfOptions, Spot, Standard};
use crate::colour::srgb::Colour;
use crate::error::{Error, ErrorKind};

/// Ink of a colour; all amounts are 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PressInk {
    /// RGB for screens.
    Rgb([f64; 3]),
    Cmyk([f64; 4]),
    /// The spot ink with this number.
    Spot(usize),
}

/// Conversion of colours to inks.
pub(crate) struct Plates {
    inks: Inks,
    pub spots: Vec<Spot>,
    limit: Option<f64>,
    solid_black: f64,
    /// Whether viewers may interpolate pictures, which PDF/A forbids.
    pub smooths: bool,
    transform: Option<Arc<Transform8BitExecutor>>,
    /// ICC profile of the press or screen: bytes, number of channels, name.
    pub profile: Option<(Arc<[u8]>, usize, String)>,
}

impl Plates {
    /// Prepares the conversion for the given options.
    ///
    /// # Errors
    /// If options contradict each other, or a profile is invalid or of the wrong kind.
    pub(crate) fn new(options: &PdfOptions) -> Result<Self, Error> {
        let source = match &options.inks {
            Inks::Cmyk(profile) => Some(profile),
            Inks::Screen | Inks::K => options.profile.as_ref(),
        };
        let colour_model = match options.inks {
            Inks::Screen => (DataColorSpace::Rgb, 3, "RGB"),
            Inks::K | Inks::Cmyk(_) => (DataColorSpace::Cmyk, 4, "CMYK"),
        };
        let mut plates = Self {
            inks: options.inks.clone(),
            spots: options.spots.clone(),
            limit: None,
            solid_black: options.solid_black,
            smooths: options.standard != Some(Standard::A2b),
            transform: None,
            profile: None,
        };
        if let Some(limit) = options.ink_limit {
            if !(limit.is_finite() && (100.0..=400.0).contains(&limit)) {
                let message = format!("an ink limit of {limit} % is not possible");
                return Err(Error::new(message).remedy("give 100 to 400 percent"));
            }
            plates.limit = Some(limit / 100.0);
        }
        for (number, spot) in options.spots.iter().enumerate() {
            let is_reserved =
                ["", "All", "None", "Cyan", "Magenta", "Yellow", "Black"].contains(&spot.name.as_str());
            if is_reserved || spot.name.len() > 127 {
                return Err(Error::new(format!("`{}` cannot be the name of an ink", spot.name))
                    .remedy("give the name of the ink, such as \"PANTONE 185 C\""));
            }
            if options.spots.iter().take(number).any(|earlier_spot| same(earlier_spot.colour, spot.colour)) {
                return Err(Error::new(format!("the colour {} has two inks", spot.colour.hex()))
                    .remedy("name it once"));
            }
        }
        let Some(bytes) = source else { return Ok(plates) };
        let refused = |what: &str| {
            Error::new(what).of_kind(ErrorKind::Unsupported).remedy(format!(
                "give the ICC profile of a {}, with {} channels",
                if colour_model.1 == 3 { "screen" } else { "press" },
                colour_model.2
            ))
        };
        let profile =
            ColorProfile::new_from_slice(bytes).map_err(|_| refused("the file is not an ICC profile"))?;
        if profile.color_space != colour_model.0 {
            return Err(refused(&format!("the profile is not for {}", colour_model.2)));
        }
        if matches!(options.inks, Inks::Cmyk(_)) {
            let intent = RenderingIntent::RelativeColorimetric;
            let how = TransformOptions {
                rendering_intent: intent,
                prefer_fixed_point: false,
                ..Default::default()
            };
            let screen = ColorProfile::new_srgb();
            let transform = screen.create_transform_8bit(Layout::Rgb, &profile, Layout::Rgba, how);
            plates.transform =
                Some(transform.map_err(|_| refused("the profile cannot convert colours to inks"))?);
        }
        let name =
            profile.description.as_ref().and_then(named).unwrap_or_else(|| "a profile without a name".into());
        plates.profile = Some((Arc::clone(bytes), colour_model.1, name));
        Ok(plates)
    }

    /// Whether the inks are those of a press.
    pub(crate) fn is_press(&self) -> bool {
        self.inks != Inks::Screen
    }

    /// Ink of a colour.
    pub(crate) fn ink(&self, colour: Colour) -> PressInk {
        match self.spots.iter().position(|spot| same(spot.colour, colour)) {
            Some(number) => PressInk::Spot(number),
            None => self.process(colour),
        }
    }

    /// Ink of a colour without spot inks.
    pub(crate) fn process(&self, colour: Colour) -> PressInk {
        let black = |light: f64| if light <= self.solid_black { 1.0 } else { 1.0 - light };
        match (&self.inks, &self.transform) {
            (Inks::Screen, _) => PressInk::Rgb(colour.channels()),
            (Inks::Cmyk(_), Some(transform)) if !(colour.r == colour.g && colour.g == colour.b) => {
                let mut out = [0_u8; 4];
                // Both slices hold one pixel, so the conversion cannot fail.
                let done = transform.transform(&[colour.r, colour.g, colour.b], &mut out).is_ok();
                let inks = out.map(|ink| f64::from(ink) / 255.0);
                PressInk::Cmyk(if done { self.limited(inks) } else { [0.0, 0.0, 0.0, black(colour.luma())] })
            }
            _ => PressInk::Cmyk([0.0, 0.0, 0.0, black(colour.luma())]),
        }
    }

    /// Process inks that approximate a colour on a press without its spot ink.
    pub(crate) fn process_equivalent(&self, colour: Colour) -> [f64; 4] {
        match self.process(colour) {
            PressInk::Cmyk(inks) if self.transform.is_some() => inks,
            // A rough conversion without a profile.
            _ => {
                let [r, g, b] = colour.channels();
                let light = r.max(g).max(b);
                let part = |channel: f64| if light > 0.0 { (light - channel) / light } else { 0.0 };
                [part(r), part(g), part(b), 1.0 - light]
            }
        }
    }

    /// Whether marks of a colour overprint what is below: solid black does.
    pub(crate) fn overprints(&self, colour: Colour) -> bool {
        self.ink(colour) == PressInk::Cmyk([0.0, 0.0, 0.0, 1.0])
    }

    /// Reduces inks to the ink limit: first the grey component is moved to black, then the colours are scaled
    /// down.
    fn limited(&self, [c, m, y, k]: [f64; 4]) -> [f64; 4] {
        let Some(limit) = self.limit else { return [c, m, y, k] };
        let over = c + m + y + k - limit;
        if over <= 0.0 {
            return [c, m, y, k];
        }
        // Each part of grey replaces three inks by one.
        let grey = (over / 2.0).min(c.min(m).min(y)).min(1.0 - k);
        let [c, m, y, k] = [c - grey, m - grey, y - grey, k + grey];
        let rest = c + m + y;
        let thinner = if rest + k > limit { ((limit - k) / rest).max(0.0) } else { 1.0 };
        [c * thinner, m * thinner, y * thinner, k]
    }
}

/// The start of the year 2000 in the format of ICC profiles.
const PROFILE_DATE: [u8; 12] = [7, 208, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0];

/// Whether two colours are equal except for their opacity.
fn same(a: Colour, b: Colour) -> bool {
    (a.r, a.g, a.b) == (b.r, b.g, b.b)
}

/// Name of a profile.
fn named(text: &moxcms::ProfileText) -> Option<String> {
    let name = match text {
        moxcms::ProfileText::PlainString(name) => name.clone(),
        moxcms::ProfileText::Localizable(names) => names.first()?.value.clone(),
        moxcms::ProfileText::Description(name) => name.ascii_string.clone(),
    };
    let name: String = name.chars().filter(|c| !c.is_control()).collect();
    (!name.trim().is_empty()).then(|| name.trim().to_owned())
}

/// ICC profile of sRGB.
pub(crate) fn srgb_profile() -> Option<Vec<u8>> {
    let mut bytes = ColorProfile::new_srgb().encode().ok()?;
    // Replace the creation time, which would come from the clock.
    bytes.get_mut(24..36)?.copy_from_slice(&PROFILE_DATE);
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_ink_plates_use_black_only() {
        let plates = Plates::new(&PdfOptions::default().with_inks(Inks::K)).unwrap();
        let k = |colour: Colour| match plates.ink(colour) {
            PressInk::Cmyk([0.0, 0.0, 0.0, k]) => k,
            other => panic!("{other:?}"),
        };
        assert_eq!(k(Colour::BLACK), 1.0);
        assert_eq!(k(Colour::rgb(26, 26, 26)), 1.0);
        assert_eq!(k(Colour::WHITE), 0.0);
        assert!((k(Colour::rgb(128, 128, 128)) - 0.498).abs() < 0.001);
        assert!(k(Colour::rgb(255, 255, 0)) < k(Colour::rgb(0, 0, 255)));
        assert!(plates.overprints(Colour::rgb(26, 26, 26)) && !plates.overprints(Colour::rgb(60, 60, 60)));
    }

    #[test]
    fn limited_inks_stay_within_the_ink_limit() {
        let mut plates = Plates::new(&PdfOptions::default().with_inks(Inks::K)).unwrap();
        plates.limit = Some(2.4);
        for inks in [[1.0, 1.0, 1.0, 1.0], [0.9, 0.8, 0.7, 0.6], [1.0, 1.0, 0.0, 0.9], [0.5, 0.5, 0.5, 0.5]] {
            let within = plates.limited(inks);
            assert!(within.iter().sum::<f64>() <= 2.4 + 1e-9, "{within:?}");
            assert!(within.iter().all(|ink| (0.0..=1.0).contains(ink)) && within[3] >= inks[3], "{within:?}");
        }
        assert_eq!(plates.limited([0.5, 0.5, 0.5, 0.5]), [0.5; 4]);
    }

    #[test]
    fn srgb_profile_has_a_fixed_date_and_no_id() {
        let bytes = srgb_profile().unwrap();
        assert_eq!(bytes[24..36], PROFILE_DATE);
        assert_eq!(bytes[84..100], [0; 16], "an id would be another one with each date");
    }

    #[test]
    fn plates_reject_unprintable_options() {
        let message = |options: PdfOptions| Plates::new(&options).err().unwrap().to_string();
        assert!(message(PdfOptions::default().with_ink_limit(50.0)).contains("50 %"));
        assert!(message(PdfOptions::default().with_spot(Colour::BLACK, "All")).contains("`All`"));
        let twice = PdfOptions::default().with_spot(Colour::BLACK, "A").with_spot(Colour::BLACK, "B");
        assert!(message(twice).contains("two inks"));
        let none: Arc<[u8]> = Arc::from(&b"no profile"[..]);
        assert!(message(PdfOptions::default().with_inks(Inks::Cmyk(none))).contains("not an ICC profile"));
        let screen = srgb_profile().unwrap();
        let wrong = message(PdfOptions::default().with_inks(Inks::Cmyk(screen.into())));
        assert!(wrong.contains("not for CMYK") && wrong.contains("press"), "{wrong}");
    }
}
