//! Shaping: the glyphs of a text in one font and direction, with kerning, ligatures and marks.

use harfrust::{Buffer, Direction, Language, ShapeOptions, ShaperFont, shape};

use super::Font;
use crate::drawing::SetGlyph;
use crate::error::Error;

/// The glyphs of a text from left to right, in ems of the font, and whether the font has all of them. One
/// extra glyph marks the end.
pub(crate) fn shape_glyphs(
    font: &Font,
    text: &str,
    runs_left: bool,
    language: Option<&str>,
) -> Result<(Vec<SetGlyph>, bool), Error> {
    let mut buffer = Buffer::new();
    buffer.push_str(text);
    buffer.guess_segment_properties();
    buffer.set_direction(if runs_left { Direction::RightToLeft } else { Direction::LeftToRight });
    buffer.set_language(language.and_then(Language::new));
    shape(&ShaperFont::new(font.face()), &mut buffer, ShapeOptions::new()).map_err(|error| {
        Error::new(format!("`{text}` cannot be set in the font {}: {error:?}", font.name()))
            .remedy("choose another font")
    })?;
    let infos = buffer.glyph_infos();
    let mut starts: Vec<usize> = infos.iter().map(|info| info.cluster as usize).collect();
    starts.push(text.len());
    starts.sort_unstable();
    starts.dedup();
    let ems = |units: i32| f64::from(units) / font.units_per_em();
    let (mut x, mut y) = (0_i32, 0_i32);
    let mut is_complete = true;
    let mut glyphs = Vec::with_capacity(infos.len());
    let mut shown = None;
    for (info, glyph_position) in infos.iter().zip(buffer.glyph_positions()) {
        let start = info.cluster as usize;
        let end = starts.iter().copied().find(|end| *end > start).unwrap_or(text.len());
        let shows = if shown == Some(start) { start..start } else { start..end };
        shown = Some(start);
        let id = u16::try_from(info.glyph_id).unwrap_or(0);
        is_complete &= id != 0;
        let own = font.face().glyph_metrics().h_advance(harfrust::GlyphId::from(id));
        glyphs.push(SetGlyph {
            id,
            x: ems(x.saturating_add(glyph_position.x_offset)),
            y: ems(y.saturating_add(glyph_position.y_offset)),
            advance: f64::from(own) / font.units_per_em(),
            shows,
        });
        x = x.saturating_add(glyph_position.x_advance);
        y = y.saturating_add(glyph_position.y_advance);
    }
    // The position of the next glyph is the end of the text.
    glyphs.push(SetGlyph { id: 0, x: ems(x), y: 0.0, advance: 0.0, shows: text.len()..text.len() });
    Ok((glyphs, is_complete))
}
