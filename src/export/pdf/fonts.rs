//! Embedded fonts of a PDF, reduced to the glyphs used.
//!
//! Source: ISO 32000-1, sections 9.7 (composite fonts) and 9.10.3 (ToUnicode).

use std::collections::BTreeMap;
use std::sync::Arc;

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, Str};
use subsetter::GlyphRemapper;

use crate::drawing::{FontFile, TextRun};
use crate::export::encoding::decimals::Decimals;

/// Decimals of glyph positions in thousandths of an em.
const THOUSANDTH_DECIMALS: u8 = 3;

/// A slower level than for page content.
const DEFLATE_LEVEL: u8 = 8;

/// PDF objects per font.
pub(crate) const OBJECTS_PER_FONT: usize = 5;

/// Character collection of fonts and glyphs.
const CID_SYSTEM: SystemInfo =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// A font and its used glyphs.
pub(crate) struct UsedFont {
    file: Arc<FontFile>,
    /// Advance in ems and the first text shown, by glyph number.
    glyphs: BTreeMap<u16, (f64, String)>,
    numbers: GlyphRemapper,
    /// The subset of the font once it is made. Fonts that cannot be subset are not embedded.
    part: Vec<u8>,
}

/// Fonts of a document in order of first use.
#[derive(Default)]
pub(crate) struct Fonts {
    pub list: Vec<UsedFont>,
}

impl Fonts {
    /// Records the glyphs of a text run.
    pub(crate) fn note(&mut self, run: &TextRun) {
        if !run.font.embeddable {
            return;
        }
        let place = self.position(&run.font).unwrap_or_else(|| {
            let file = Arc::clone(&run.font);
            let (glyphs, numbers, part) = (BTreeMap::new(), GlyphRemapper::new(), Vec::new());
            self.list.push(UsedFont { file, glyphs, numbers, part });
            self.list.len() - 1
        });
        let Some(font) = self.list.get_mut(place) else { return };
        for glyph in run.glyphs.iter() {
            let shows = run.words.get(glyph.shows.clone()).unwrap_or_default();
            let (_, known) = font.glyphs.entry(glyph.id).or_insert_with(|| (glyph.advance, String::new()));
            if known.is_empty() {
                shows.clone_into(known);
            }
        }
    }

    /// Subsets the fonts, and drops those for which this fails.
    pub(crate) fn cut(&mut self) {
        for font in &mut self.list {
            for id in font.glyphs.keys() {
                font.numbers.remap(*id);
            }
            let cut = subsetter::subset(&font.file.data, 0, &font.numbers);
            font.part = cut
                .ok()
                .map(|part| table(&part, *b"CFF ").map_or_else(|| part.clone(), <[u8]>::to_vec))
                .unwrap_or_default();
        }
        self.list.retain(|font| !font.part.is_empty());
    }

    /// Number of a font.
    pub(crate) fn position(&self, file: &Arc<FontFile>) -> Option<usize> {
        self.list.iter().position(|font| Arc::ptr_eq(&font.file, file) || font.file == *file)
    }

    /// Writes a run in its font with the current fill. Returns whether it did.
    pub(crate) fn set(&self, out: &mut Vec<u8>, run: &TextRun, decimals: Decimals) -> bool {
        let Some(number) = self.position(&run.font) else { return false };
        let Some(font) = self.list.get(number) else { return false };
        let fine = Decimals::new(THOUSANDTH_DECIMALS);
        out.extend_from_slice(format!("BT\n/{} 1 Tf\n", font_name(number)).as_bytes());
        let mut line: Option<f64> = None;
        // Pen position in thousandths of an em, as a viewer computes it.
        let mut pen = 0.0;
        for glyph in run.glyphs.iter() {
            let Some(id) = font.numbers.get(glyph.id) else { continue };
            let (x, y) = (glyph.x * 1000.0, glyph.y);
            if line != Some(y) {
                if line.is_some() {
                    out.extend_from_slice(b"] TJ\n");
                }
                let place = run.place * kurbo::Affine::translate((glyph.x, y));
                let [a, b, c, d, e, f] = place.as_coeffs();
                for part in [a, b, c, d] {
                    Decimals::new(6).write_operand(out, part);
                }
                for part in [e, f] {
                    decimals.write_operand(out, part);
                }
                out.extend_from_slice(b"Tm\n[");
                (line, pen) = (Some(y), x);
            }
            let back = fine.round(pen - x);
            if back != 0 {
                fine.write(out, back);
                pen -= back as f64 / 1000.0;
            }
            out.extend_from_slice(format!("<{id:04x}>").as_bytes());
            pen += thousandths(glyph.advance);
        }
        if line.is_some() {
            out.extend_from_slice(b"] TJ\n");
        }
        out.extend_from_slice(b"ET\n");
        true
    }

    /// Writes the fonts, five objects for each.
    pub(crate) fn write(&self, pdf: &mut Pdf, ids: &[Ref]) {
        for (number, (font, ids)) in self.list.iter().zip(ids.chunks(OBJECTS_PER_FONT)).enumerate() {
            if let [font_id, cid, descriptor, data, unicode] = *ids {
                font.write(pdf, number, [font_id, cid, descriptor, data, unicode]);
            }
        }
    }
}

impl UsedFont {
    fn write(&self, pdf: &mut Pdf, number: usize, [id, cid, descriptor, data, unicode]: [Ref; 5]) {
        // Font subsets have a unique prefix of six letters before the name of the font.
        let tag: String = (0..6).rev().map(|place| letter(number / 26_usize.pow(place))).collect();
        let name = format!("{tag}+{}", self.file.name);
        let is_cff = table(&self.part, *b"glyf").is_none();
        let full = if is_cff { format!("{name}-Identity-H") } else { name.clone() };
        let mut font = pdf.type0_font(id);
        font.base_font(Name(full.as_bytes())).encoding_predefined(Name(b"Identity-H"));
        font.descendant_font(cid).to_unicode(unicode);
        font.finish();

        let mut letters = pdf.cid_font(cid);
        letters.subtype(if is_cff { CidFontType::Type0 } else { CidFontType::Type2 });
        letters
            .base_font(Name(name.as_bytes()))
            .system_info(CID_SYSTEM)
            .font_descriptor(descriptor)
            .default_width(0.0);
        if !is_cff {
            letters.cid_to_gid_map_predefined(Name(b"Identity"));
        }
        let mut widths = letters.widths();
        let advance =
            |old: u16| self.glyphs.get(&old).map_or(0.0, |(advance, _)| thousandths(*advance) as f32);
        widths.consecutive(0, self.numbers.remapped_gids().map(advance));
        widths.finish();
        letters.finish();

        let mut about = pdf.font_descriptor(descriptor);
        let em = |x: f64| (x * 1000.0).round() as f32;
        let bounds = self.file.bounds;
        about.name(Name(name.as_bytes())).flags(FontFlags::SYMBOLIC);
        about.bbox(Rect::new(em(bounds.x0), em(bounds.y0), em(bounds.x1), em(bounds.y1)));
        about
            .italic_angle(self.file.italic_deg as f32)
            .ascent(em(self.file.ascent))
            .descent(em(self.file.descent));
        // The true stem width is unknown, and viewers do not use it for embedded fonts.
        about.cap_height(em(self.file.cap_height)).stem_v(95.0);
        if is_cff {
            about.font_file3(data);
        } else {
            about.font_file2(data);
        }
        about.finish();

        let packed = compress_to_vec_zlib(&self.part, DEFLATE_LEVEL);
        let mut stream = pdf.stream(data, &packed);
        stream.filter(Filter::FlateDecode);
        if is_cff {
            stream.pair(Name(b"Subtype"), Name(b"CIDFontType0C"));
        } else {
            stream.pair(Name(b"Length1"), self.part.len() as i32);
        }
        stream.finish();

        let mut map = UnicodeCmap::new(Name(b"ligne"), CID_SYSTEM);
        for (old, (_, shows)) in &self.glyphs {
            if let Some(new) = self.numbers.get(*old)
                && !shows.is_empty()
            {
                map.pair_with_multiple(new, shows.chars());
            }
        }
        let map = map.finish();
        pdf.cmap(unicode, &map);
    }
}

/// Name of a font in the resources of pages.
pub(crate) fn font_name(number: usize) -> String {
    format!("F{number}")
}

fn letter(number: usize) -> char {
    char::from(b'A' + (number % 26) as u8)
}

/// Advance of a glyph in thousandths of an em, as written.
fn thousandths(ems: f64) -> f64 {
    (ems * 1e6).round() / 1e3
}

/// A table of an OpenType file.
fn table(file: &[u8], tag: [u8; 4]) -> Option<&[u8]> {
    let count = u16::from_be_bytes(file.get(4..6)?.try_into().ok()?);
    let entries = file.get(12..12 + usize::from(count) * 16)?;
    let entry = entries.chunks_exact(16).find(|entry| entry.starts_with(&tag))?;
    let number = |at: usize| Some(u32::from_be_bytes(entry.get(at..at + 4)?.try_into().ok()?) as usize);
    let (start, length) = (number(8)?, number(12)?);
    file.get(start..start.checked_add(length)?)
}
