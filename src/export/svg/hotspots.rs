//! Hot-spots: the topmost layer of an SVG, with invisible areas of parts that answer the pointer. If the
//! drawing has a title for screen readers, they are buttons in the tab order with the names of their parts.

use crate::drawing::Hotspot;
use crate::export::encoding::decimals::Decimals;
use crate::export::encoding::xml::escape;
use crate::export::paths::canonical_path::{CanonicalWriter, PathForm};

/// Id and label of the layer.
pub(crate) const HOTSPOT_LAYER: &str = "hotspots";

/// Writes the areas, and completes the start and end tags of the layer. The class of the layer is its name
/// without an id prefix.
pub(crate) fn write(out: &mut Vec<u8>, spots: &[Hotspot], decimals: Decimals, read_aloud: bool) {
    out.extend_from_slice(
        format!(" class=\"{HOTSPOT_LAYER}\" fill=\"none\" pointer-events=\"all\">\n").as_bytes(),
    );
    let mut canonical = CanonicalWriter::new(decimals);
    // Areas do not overlap, so they are sorted by part.
    let mut spots: Vec<&Hotspot> = spots.iter().collect();
    spots.sort_by(|a, b| a.part.cmp(&b.part));
    for Hotspot { part, outline } in spots {
        out.extend_from_slice(b"<path data-part=\"");
        escape(out, part);
        if read_aloud {
            out.extend_from_slice(b"\" role=\"button\" tabindex=\"0\" aria-label=\"");
            escape(out, part);
        }
        out.extend_from_slice(b"\" d=\"");
        canonical.write(out, outline, PathForm::Filled);
        out.extend_from_slice(b"\"><title>");
        escape(out, part);
        out.extend_from_slice(b"</title></path>\n");
    }
    out.extend_from_slice(b"</g>\n");
}
