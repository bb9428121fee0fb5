//! [`Font`]: a bundled font or a font file, with its metrics and outlines.

use std::path::Path;
use std::sync::Arc;

use kurbo::{BezPath, Rect, Shape};
use skrifa::font::metrics::LineBox;
use skrifa::font::name::NameId;
use skrifa::font::{Font as Face, glyph::outline::PathSink};
use skrifa::{DrawMemory, GlyphId, ScalerFont};

use crate::drawing::FontFile;
use crate::error::bounded_read::read_up_to;
use crate::error::{Error, ErrorKind};

/// The bundled fonts, in the order of fallback.
const BUNDLED_FONTS: [(&str, &[u8]); 3] = [
    ("comic", include_bytes!("../../fonts/ComicNeue-Bold.otf")),
    ("technical", include_bytes!("../../fonts/RoutedGothic.ttf")),
    ("plain", include_bytes!("../../fonts/B612-Regular.otf")),
];

/// Maximum size of a font file, bytes.
const MAX_FILE_BYTES: u64 = 64 << 20;

/// A font; cheap to clone. Variable fonts are used with their default axes.
#[derive(Clone)]
pub struct Font {
    inner: Arc<FontData>,
}

struct FontData {
    /// Full name for messages.
    name: String,
    file: Arc<FontFile>,
    face: Face,
    scaler: ScalerFont,
    units_per_em: f64,
}

impl std::fmt::Debug for Font {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Font({})", self.inner.name)
    }
}

impl PartialEq for Font {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.inner, &other.inner) || self.inner.file == other.inner.file
    }
}

impl Font {
    /// The names of the bundled fonts.
    #[must_use]
    pub fn names() -> Vec<&'static str> {
        BUNDLED_FONTS.iter().map(|(name, _)| *name).collect()
    }

    /// A bundled font by name.
    ///
    /// # Errors
    /// Returns an error if there is no font of that name.
    pub fn named(name: &str) -> Result<Self, Error> {
        match BUNDLED_FONTS.iter().find(|(known, _)| *known == name) {
            Some((_, bytes)) => Self::from_bytes(bytes),
            None => Err(Error::new(format!("there is no font `{name}`"))
                .remedy(format!("choose {}, or name a TTF or OTF file", Self::names().join(", ")))),
        }
    }

    /// Reads a TTF or OTF file, or the first font of a collection.
    ///
    /// # Errors
    /// Returns an error that names the file if it cannot be read or is not a font.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let bytes = read_up_to(path, MAX_FILE_BYTES);
        let bytes = bytes.map_err(|error| Error::io("cannot be read", error).in_file(path))?;
        Self::from_bytes(&bytes.unwrap_or_default()).map_err(|error| error.in_file(path))
    }

    /// Reads the bytes of a TTF or OTF file, or the first font of a collection.
    ///
    /// # Errors
    /// Returns an error if the bytes are not a font, or a font without outlines.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let remedy = "give a TTF or OTF file with outlines";
        let refused = |what: &str| Error::new(what).of_kind(ErrorKind::Unsupported).remedy(remedy);
        let data: Arc<[u8]> = Arc::from(bytes);
        let held = Arc::clone(&data);
        let blob: Arc<dyn AsRef<[u8]> + Send + Sync> = Arc::new(held);
        let face = Face::new(skrifa::font::Blob::from(blob), 0).ok_or_else(|| refused("is not a font"))?;
        let scaler = ScalerFont::force_unhinted(face.clone(), None);
        if scaler.outline_source().is_none() || face.num_glyphs() == 0 {
            return Err(refused("is a font without outlines"));
        }
        let named = |id: NameId| -> Option<String> {
            let name = face.names().get(id)?.english_or_first()?.name().chars().collect::<String>();
            (!name.trim().is_empty()).then(|| name.trim().to_owned())
        };
        let name = named(NameId::FULL_NAME).or_else(|| named(NameId::FAMILY_NAME));
        let name = name.unwrap_or_else(|| "a font without a name".to_owned());
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '-';
        let postscript = named(NameId::POSTSCRIPT_NAME).unwrap_or_else(|| name.clone());
        let postscript: String = postscript.chars().filter(|c| plain(*c)).take(63).collect();
        let units_per_em = f64::from(face.units_per_em());
        let metrics = face.metrics();
        let line = metrics.h_line().unwrap_or_else(LineBox::default);
        let bounds = metrics.bounds;
        let bounds =
            [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(|x| x.to_f64() / units_per_em);
        let mut file = FontFile {
            embeddable: embeddable(&data),
            data,
            name: if postscript.is_empty() { "Font".to_owned() } else { postscript },
            bounds: Rect::new(bounds[0], bounds[1], bounds[2], bounds[3]),
            ascent: line.ascender.to_f64() / units_per_em,
            descent: line.descender.to_f64() / units_per_em,
            cap_height: 0.0,
            italic_deg: face.style_metrics().italic_angle.map_or(0.0, |angle| angle.to_f64()),
        };
        let told =
            metrics.cap_height.map(|height| height.to_f64() / units_per_em).filter(|height| *height > 0.0);
        let drawn = || {
            let glyph = face.charmap().map_unicode('H')?;
            let height = -outline(&scaler, glyph, units_per_em).bounding_box().y0;
            (height > 0.0).then_some(height)
        };
        file.cap_height = told.or_else(drawn).unwrap_or(0.7);
        let inner = FontData { name, file: Arc::new(file), face, scaler, units_per_em };
        Ok(Self { inner: Arc::new(inner) })
    }

    /// Full name, such as `Comic Neue Bold`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// The font file with its metrics, for embedding.
    #[must_use]
    pub fn file(&self) -> &Arc<FontFile> {
        &self.inner.file
    }

    /// The outline of a glyph in ems, y down, with its origin at (0, 0); empty for blanks.
    #[must_use]
    pub fn outline(&self, glyph: u16) -> BezPath {
        outline(&self.inner.scaler, GlyphId::from(glyph), self.inner.units_per_em)
    }

    /// The parsed font, for shaping.
    pub(crate) fn face(&self) -> &Face {
        &self.inner.face
    }

    /// Font units per em.
    pub(crate) fn units_per_em(&self) -> f64 {
        self.inner.units_per_em
    }
}

/// The outline of a glyph in ems, y down.
fn outline(scaler: &ScalerFont, glyph: GlyphId, units_per_em: f64) -> BezPath {
    let mut sink = OutlineSink { path: BezPath::new(), units_per_em };
    if let Some(outline) = scaler.outline(glyph)
        && outline.draw(DrawMemory::Scratch, &mut sink).is_err()
    {
        return BezPath::new();
    }
    sink.path
}

/// A sink that converts an outline from font units to ems, y down.
struct OutlineSink {
    path: BezPath,
    units_per_em: f64,
}

impl OutlineSink {
    fn at(&self, x: f32, y: f32) -> (f64, f64) {
        (f64::from(x) / self.units_per_em, -f64::from(y) / self.units_per_em)
    }
}

impl PathSink for OutlineSink {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.at(x, y));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.at(x, y));
    }

    fn quad_to(&mut self, cx0: f32, cy0: f32, x: f32, y: f32) {
        self.path.quad_to(self.at(cx0, cy0), self.at(x, y));
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        self.path.curve_to(self.at(cx0, cy0), self.at(cx1, cy1), self.at(x, y));
    }

    fn close(&mut self) {
        self.path.close_path();
    }
}

/// Whether the font may be embedded as a subset: `fsType` bits of the OS/2 table (OpenType 1.9).
fn embeddable(bytes: &[u8]) -> bool {
    let flags = || -> Option<u16> {
        let face = skrifa::FontRef::from_index(bytes, 0).ok()?;
        let table = face.table_data(skrifa::Tag::new(b"OS/2"))?;
        table.read_at::<u16>(8).ok()
    };
    let flags = flags().unwrap_or(0);
    let (usage, no_parts, pixels_only) = (flags & 0xf, flags & 0x100 != 0, flags & 0x200 != 0);
    usage != 2 && !no_parts && !pixels_only
}
