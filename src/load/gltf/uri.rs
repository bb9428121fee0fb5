//! URIs of buffers and images: data URIs, and relative paths inside the model's folder.

use std::borrow::Cow;

use base64::Engine as _;
use base64::engine::general_purpose::GeneralPurpose;
use base64::engine::{DecodePaddingMode, GeneralPurposeConfig};

const LENIENT_BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// Bytes of a `data:` URI; `None` for other URIs. The error describes what is wrong.
pub(crate) fn data(uri: &str) -> Option<Result<Vec<u8>, String>> {
    let rest = uri.get(..5).filter(|head| head.eq_ignore_ascii_case("data:")).and(uri.get(5..))?;
    let Some((head, body)) = rest.split_once(',') else {
        return Some(Err("the data URI has no comma".to_owned()));
    };
    let body = percent_decoded(body);
    if !head.ends_with(";base64") {
        return Some(Ok(body.into_owned()));
    }
    let decoded = LENIENT_BASE64.decode(&body).or_else(|error| {
        // Hand-made files often have line breaks inside.
        let packed: Vec<u8> = body.iter().copied().filter(|b| !b.is_ascii_whitespace()).collect();
        if packed.len() < body.len() { LENIENT_BASE64.decode(packed) } else { Err(error) }
    });
    Some(decoded.map_err(|error| format!("the data URI is not valid base64 ({error})")))
}

/// Path of a relative URI, with `/` as separator and without `.` and `..`. Returns an error if it leads out
/// of the model's folder.
pub(crate) fn inside_folder(uri: &str) -> Result<String, String> {
    let decoded = percent_decoded(uri);
    let Ok(path) = std::str::from_utf8(&decoded) else {
        return Err(format!("`{}` is not UTF-8", shortened(uri)));
    };
    if path.contains("://") || path.starts_with(['/', '\\']) || path.as_bytes().get(1) == Some(&b':') {
        return Err(format!("`{}` is not a path relative to the model", shortened(uri)));
    }
    let mut parts = Vec::new();
    for part in path.split(['/', '\\']) {
        match part {
            "" | "." => {}
            ".." => {
                if parts.pop().is_none() {
                    return Err(format!("`{}` leads out of the model's folder", shortened(uri)));
                }
            }
            _ => parts.push(part),
        }
    }
    if parts.is_empty() {
        return Err(format!("`{}` names no file", shortened(uri)));
    }
    Ok(parts.join("/"))
}

/// Text of a URI with escapes decoded.
pub(crate) fn decoded(uri: &str) -> String {
    String::from_utf8_lossy(&percent_decoded(uri)).into_owned()
}

/// A URI shortened for messages.
pub(crate) fn shortened(uri: &str) -> Cow<'_, str> {
    match uri.char_indices().nth(80) {
        Some((end, _)) => Cow::Owned(format!("{}...", uri.get(..end).unwrap_or_default())),
        None => Cow::Borrowed(uri),
    }
}

fn percent_decoded(text: &str) -> Cow<'_, [u8]> {
    if !text.contains('%') {
        return Cow::Borrowed(text.as_bytes());
    }
    let mut decoded = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&byte, tail)) = rest.split_first() {
        let pair = tail.get(..2).filter(|pair| pair.iter().all(u8::is_ascii_hexdigit));
        let pair = pair.and_then(|pair| std::str::from_utf8(pair).ok());
        match pair.and_then(|pair| u8::from_str_radix(pair, 16).ok()).filter(|_| byte == b'%') {
            Some(value) => {
                decoded.push(value);
                rest = tail.get(2..).unwrap_or_default();
            }
            None => {
                decoded.push(byte);
                rest = tail;
            }
        }
    }
    Cow::Owned(decoded)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn data_uris_are_decoded() {
        assert_eq!(data("data:application/octet-stream;base64,AAEC"), Some(Ok(vec![0, 1, 2])));
        assert_eq!(data("DATA:;base64,AA"), Some(Ok(vec![0])));
        assert_eq!(data("data:;base64,AA\nEC"), Some(Ok(vec![0, 1, 2])));
        assert_eq!(data("data:text/plain,a%20b"), Some(Ok(b"a b".to_vec())));
        assert!(data("data:;base64,@@@@").unwrap().unwrap_err().contains("base64"));
        assert!(data("data:").unwrap().is_err());
        assert_eq!(data("model.bin"), None);
    }

    #[test]
    fn inside_folder_refuses_paths_outside_the_folder() {
        assert_eq!(inside_folder("a%20b.bin"), Ok("a b.bin".to_owned()));
        assert_eq!(inside_folder("./tex\\..//x.png"), Ok("x.png".to_owned()));
        assert_eq!(inside_folder("100%.bin"), Ok("100%.bin".to_owned()));
        for bad in ["../x", "a/../../x", "%2e%2e/x", "/etc/passwd", "C:/x", "http://x/y", "\\\\host\\x", ""] {
            assert!(inside_folder(bad).is_err(), "{bad}");
        }
    }
}
