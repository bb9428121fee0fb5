//! Splits a file into JSON and binary chunk: GLB, or plain JSON without a chunk.

use crate::error::Error;
use crate::scene::Warnings;

const JSON_CHUNK: [u8; 4] = *b"JSON";
const BIN_CHUNK: [u8; 4] = *b"BIN\0";
const REEXPORT_REMEDY: &str = "export the model again as glTF 2.0";

/// The two parts of a glTF file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Container<'a> {
    /// The JSON text.
    pub json: &'a [u8],
    /// BIN chunk of a GLB file.
    pub bin: Option<&'a [u8]>,
}

/// Splits `bytes`; detects the form by the first bytes.
pub(crate) fn split<'a>(bytes: &'a [u8], warnings: &mut Warnings) -> Result<Container<'a>, Error> {
    if bytes.starts_with(b"glTF") {
        return glb(bytes, warnings);
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match text.trim_ascii_start().first() {
        Some(b'{') => Ok(Container { json: text, bin: None }),
        None => Err(Error::new("the file is empty: nothing to draw")),
        Some(_) => Err(unknown_file_error(bytes)),
    }
}

/// Error that describes a file that is not glTF.
fn unknown_file_error(bytes: &[u8]) -> Error {
    let text = bytes.trim_ascii_start();
    if text.starts_with(b"<") {
        return Error::new("this is an HTML or XML page, not a model")
            .remedy("download the file again; the link may lead to a web page");
    }
    if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"\x1f\x8b") {
        return Error::new("this is a compressed archive, not a model").remedy("unpack it first");
    }
    Error::new("neither GLB (no `glTF` at the start) nor JSON (no `{` at the start)")
        .at("byte 0")
        .remedy(REEXPORT_REMEDY)
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|b| u32::from_le_bytes(*b))
}

fn glb<'a>(bytes: &'a [u8], warnings: &mut Warnings) -> Result<Container<'a>, Error> {
    let truncated = || "the file may be cut off; download or export it again";
    let (Some(version), Some(total)) = (word(bytes, 4), word(bytes, 8)) else {
        return Err(Error::new(format!("a GLB header has 12 bytes, the file has {}", bytes.len()))
            .at("GLB header")
            .remedy(truncated()));
    };
    if version != 2 {
        return Err(Error::new(format!("GLB version {version}; only version 2 can be read"))
            .at("GLB header")
            .remedy(REEXPORT_REMEDY));
    }
    let total = total as usize;
    let Some(body) = bytes.get(..total) else {
        return Err(Error::new(format!(
            "the header promises {total} bytes, but the file has {}",
            bytes.len()
        ))
        .at("GLB header")
        .remedy(truncated()));
    };
    if total < bytes.len() {
        warnings.count("bytes after the end of the GLB data", (bytes.len() - total) as u64);
    }

    let mut container = Container { json: &[], bin: None };
    let mut at = 12;
    for number in 0.. {
        let place = || format!("chunk {number} at byte {at}");
        if number > 0 && at >= body.len() {
            break;
        }
        let (Some(length), Some(kind)) = (word(body, at), body.get(at + 4..).and_then(|b| b.first_chunk()))
        else {
            return Err(Error::new("the chunk header is incomplete").at(place()).remedy(truncated()));
        };
        let start = at + 8;
        let Some(data) = start.checked_add(length as usize).and_then(|end| body.get(start..end)) else {
            let left = body.len().saturating_sub(start);
            return Err(Error::new(format!("the chunk promises {length} bytes, but {left} are left"))
                .at(place())
                .remedy(truncated()));
        };
        match (number, *kind) {
            (0, JSON_CHUNK) => container.json = data,
            (0, _) => {
                return Err(Error::new("the first chunk must be JSON").at(place()).remedy(REEXPORT_REMEDY));
            }
            (_, BIN_CHUNK) if container.bin.is_none() => container.bin = Some(data),
            _ => {}
        }
        at = start + data.len();
    }
    Ok(container)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn split_error(bytes: &[u8]) -> String {
        split(bytes, &mut Warnings::default()).map(|_| ()).unwrap_err().to_string()
    }

    #[test]
    fn files_that_are_not_glb_are_named_in_the_error() {
        assert!(split_error(b"").contains("nothing to draw"));
        assert!(split_error(b" <!DOCTYPE html>").contains("HTML"));
        assert!(split_error(b"PK\x03\x04....").contains("archive"));
        assert!(split_error(b"\x89PNG").contains("neither GLB"));
    }

    #[test]
    fn glb_chunks_are_found_and_checked() {
        let mut glb = b"glTF\x02\0\0\0\x1e\0\0\0\x02\0\0\0JSON{}\0\0\0\0BIN\0".to_vec();
        let mut warnings = Warnings::default();
        let parts = split(&glb, &mut warnings).unwrap();
        assert_eq!((parts.json, parts.bin), (&b"{}"[..], Some(&b""[..])));
        assert!(warnings.is_empty());
        glb.push(0);
        assert!(split(&glb, &mut warnings).is_ok());
        assert_eq!(warnings.lines(), ["1 bytes after the end of the GLB data"]);
        assert!(split_error(&glb[..20]).contains("promises"));
        glb[4] = 1;
        assert!(split_error(&glb).contains("version 1"));
    }
}
