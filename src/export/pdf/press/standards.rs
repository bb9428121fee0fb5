//! Metadata required by standards: creator, dates, output intent, XMP and file ids.
//!
//! Source: ISO 15930-7 (PDF/X-4), ISO 19005-2 (PDF/A-2), ISO 16684-1 (XMP).

use pdf_writer::types::{OutputIntentSubtype, TrappingStatus};
use pdf_writer::writers::{Catalog, DocumentInfo};
use pdf_writer::{Date, Ref, TextStr};

use super::pdf_options::{PdfOptions, Standard};
use crate::export::encoding::xml::escape;

/// Name of the creating program.
pub(crate) const CREATOR: &str = concat!("ligne ", env!("CARGO_PKG_VERSION"));

/// Creation date of the file.
fn date([year, month, day, hour, minute, second]: [u16; 6]) -> Date {
    let small = |value: u16| value.min(255) as u8;
    let date = Date::new(year).month(small(month)).day(small(day)).hour(small(hour)).minute(small(minute));
    date.second(small(second)).utc_offset_hour(0).utc_offset_minute(0)
}

/// Writes the document information.
pub(crate) fn write_info(info: &mut DocumentInfo, title: &str, options: &PdfOptions) {
    if !title.is_empty() {
        info.title(TextStr(title));
    }
    info.creator(TextStr(CREATOR));
    if options.standard.is_some() {
        info.producer(TextStr(CREATOR)).creation_date(date(options.date)).modified_date(date(options.date));
    }
    if options.standard == Some(Standard::X4) {
        info.trapped(TrappingStatus::NotTrapped);
    }
}

/// Writes the output intent: the press or the screen for which the file is made.
pub(crate) fn write_intent(catalog: &mut Catalog, standard: Standard, name: &str, profile: Ref) {
    let mut intents = catalog.output_intents();
    let mut intent = intents.push();
    intent.subtype(match standard {
        Standard::X4 => OutputIntentSubtype::PDFX,
        Standard::A2b => OutputIntentSubtype::PDFA,
    });
    intent.output_condition_identifier(TextStr("Custom")).output_condition(TextStr(name)).info(TextStr(name));
    intent.dest_output_profile(profile);
}

/// File id as a hash of the contents: FNV-1a with two offset bases.
pub(crate) fn id<'a>(contents: impl Iterator<Item = &'a [u8]>) -> [u8; 16] {
    let mut hashes = [0xcbf2_9ce4_8422_2325_u64, 0x6c62_272e_07bb_0142];
    for content in contents {
        for byte in content {
            for (turn, hash) in hashes.iter_mut().enumerate() {
                *hash = (*hash ^ u64::from(*byte).rotate_left(turn as u32 * 7))
                    .wrapping_mul(0x0000_0100_0000_01b3);
            }
        }
    }
    let mut id = [0; 16];
    for (half, hash) in id.chunks_exact_mut(8).zip(hashes) {
        half.copy_from_slice(&hash.to_be_bytes());
    }
    id
}

/// Document information and the standard as XMP.
pub(crate) fn xmp(title: &str, options: &PdfOptions, standard: Standard, id: [u8; 16]) -> Vec<u8> {
    let escaped = |text: &str| {
        let mut out = Vec::new();
        escape(&mut out, text);
        String::from_utf8_lossy(&out).into_owned()
    };
    let [year, month, day, hour, minute, second] = options.date;
    let date = format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}+00:00");
    let hex: String = id.iter().map(|byte| format!("{byte:02x}")).collect();
    let uuid = format!("uuid:{}-{}-{}-{}-{}", &hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..]);
    let title = if title.is_empty() { "untitled".to_owned() } else { escaped(title) };
    let own = match standard {
        Standard::X4 => {
            "<rdf:Description rdf:about=\"\" xmlns:pdfxid=\"http://www.npes.org/pdfx/ns/id/\">\n\
             <pdfxid:GTS_PDFXVersion>PDF/X-4</pdfxid:GTS_PDFXVersion>\n</rdf:Description>\n"
        }
        Standard::A2b => {
            "<rdf:Description rdf:about=\"\" xmlns:pdfaid=\"http://www.aiim.org/pdfa/ns/id/\">\n\
             <pdfaid:part>2</pdfaid:part>\n<pdfaid:conformance>B</pdfaid:conformance>\n</rdf:Description>\n"
        }
    };
    let trapped = if standard == Standard::X4 { "<pdf:Trapped>False</pdf:Trapped>\n" } else { "" };
    format!(
        "<?xpacket begin=\"\u{feff}\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n\
         <x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n\
         <rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n\
         <rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\">\n\
         <dc:format>application/pdf</dc:format>\n\
         <dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">{title}</rdf:li></rdf:Alt></dc:title>\n\
         </rdf:Description>\n\
         <rdf:Description rdf:about=\"\" xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\">\n\
         <xmp:CreatorTool>{CREATOR}</xmp:CreatorTool>\n\
         <xmp:CreateDate>{date}</xmp:CreateDate>\n<xmp:ModifyDate>{date}</xmp:ModifyDate>\n\
         <xmp:MetadataDate>{date}</xmp:MetadataDate>\n\
         </rdf:Description>\n\
         <rdf:Description rdf:about=\"\" xmlns:pdf=\"http://ns.adobe.com/pdf/1.3/\">\n\
         <pdf:Producer>{CREATOR}</pdf:Producer>\n{trapped}\
         </rdf:Description>\n\
         <rdf:Description rdf:about=\"\" xmlns:xmpMM=\"http://ns.adobe.com/xap/1.0/mm/\">\n\
         <xmpMM:DocumentID>{uuid}</xmpMM:DocumentID>\n<xmpMM:VersionID>1</xmpMM:VersionID>\n\
         <xmpMM:RenditionClass>default</xmpMM:RenditionClass>\n\
         </rdf:Description>\n\
         {own}</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"r\"?>"
    )
    .into_bytes()
}
