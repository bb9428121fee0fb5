//! Reference reader for PDF files: content streams, and everything else.

/// The inflated content streams of a PDF file, and the rest of the file with its XMP metadata.
pub(crate) fn split_pdf_streams(pdf: &[u8]) -> (String, String) {
    let find = |text: &[u8], word: &[u8]| text.windows(word.len()).position(|part| part == word);
    let (mut content, mut rest) = (String::new(), String::new());
    let mut left = pdf;
    while let Some(start) = find(left, b"\nstream\n") {
        rest.push_str(&String::from_utf8_lossy(&left[..start]));
        left = &left[start + 8..];
        let end = find(left, b"\nendstream").unwrap();
        match miniz_oxide::inflate::decompress_to_vec_zlib(&left[..end]) {
            Ok(inflated) => content.push_str(&String::from_utf8_lossy(&inflated)),
            // Uncompressed XMP metadata belongs to the rest; other uncompressed streams are content.
            Err(_) if left.starts_with(b"<?xpacket") => rest.push_str(&String::from_utf8_lossy(&left[..end])),
            Err(_) => content.push_str(&String::from_utf8_lossy(&left[..end])),
        }
        left = &left[end..];
    }
    rest.push_str(&String::from_utf8_lossy(left));
    (content, rest)
}
