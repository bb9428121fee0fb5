//! Tests of numbers, lines and encodings of texts.

use super::*;

fn parsed_number(text: &str) -> Option<f64> {
    let mut cursor = Cursor::new(text.as_bytes());
    let value = cursor.number();
    assert!(value.is_none() || cursor.at_word_end(), "{text} read to {}", cursor.at);
    value
}

#[test]
fn parsed_numbers_match_the_standard_library() {
    for text in [
        "0",
        "-0",
        "1",
        "-1",
        "1.",
        ".5",
        "-.5",
        "0.1",
        "123456789.123456789",
        "1e5",
        "1e-5",
        "-1.5E+3",
        "1e22",
        "1e23",
        "9007199254740993",
        "9007199254740991e22",
        "12345678901234567890123",
        "1e400",
        "-1e400",
        "1e-400",
        "0.000000000000000000000000001",
        "4.9406564584124654e-324",
        "1.7976931348623157e308",
        "inf",
        "-inf",
        "0.30000000000000004",
        "123456.7e-20",
        "8.5e00000",
    ] {
        assert_eq!(
            parsed_number(text).map(f64::to_bits),
            Some(text.parse::<f64>().unwrap().to_bits()),
            "{text}"
        );
    }
    assert!(parsed_number("nan").unwrap().is_nan());
    assert_eq!(parsed_number("+2.5"), Some(2.5));
    assert_eq!(parsed_number("+-2.5"), None);
    assert_eq!(parsed_number("--2.5"), None);
}

#[test]
fn random_numbers_are_parsed_exactly() {
    let mut state = 1_u64;
    for i in 0..20_000 {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let value = (state >> 11) as f64 / (1_u64 << (i % 60)) as f64;
        for text in [format!("{value}"), format!("{value:.6}"), format!("{value:e}"), format!("{value:.4e}")]
        {
            assert_eq!(parsed_number(&text), Some(text.parse().unwrap()), "{text}");
        }
    }
}

#[test]
fn number_rejects_words_without_moving_the_cursor() {
    for text in ["", "a", "-", ".", "#", "/", "e5", "-e", "\\"] {
        let mut cursor = Cursor::new(text.as_bytes());
        assert_eq!((cursor.number(), cursor.at), (None, 0), "{text}");
    }
}

#[test]
fn integers_saturate_at_the_limits_of_i64() {
    for (text, wanted) in [("12", 12), ("-3", -3), ("99999999999999999999", i64::MAX), ("+7", 7)] {
        assert_eq!(Cursor::new(text.as_bytes()).integer(), Some(wanted));
    }
    assert_eq!(Cursor::new(b"x").integer(), None);
}

#[test]
fn line_numbers_count_lf_crlf_and_cr() {
    for text in ["a\nb\nc", "a\r\nb\r\nc", "a\rb\rc"] {
        let cursor = Cursor { bytes: text.as_bytes(), at: text.len() - 1 };
        assert_eq!(cursor.line(), 3);
    }
}

#[test]
fn utf16_is_recognized_by_its_byte_order_mark() {
    let units: Vec<u16> = "é 🦆".encode_utf16().collect();
    let little: Vec<u8> = units.iter().flat_map(|u| u.to_le_bytes()).collect();
    let big: Vec<u8> = units.iter().flat_map(|u| u.to_be_bytes()).collect();
    assert_eq!(&*utf8(&[&[0xff, 0xfe], &little[..]].concat()), "é 🦆".as_bytes());
    assert_eq!(&*utf8(&[&[0xfe, 0xff], &big[..]].concat()), "é 🦆".as_bytes());
    assert_eq!(&*utf8(b"\xff\xfea\0\x00\xd8b\0c"), "a\u{fffd}b".as_bytes());
    for other in [&b""[..], b"\xff", b"\xef\xbb\xbfv", b"caf\xe9"] {
        assert!(matches!(utf8(other), Cow::Borrowed(same) if same == other));
    }
    assert!(utf8(b"\xff\xfe").is_empty());
}

#[test]
fn decode_reads_utf8_or_latin1() {
    assert_eq!(decode("é".as_bytes()), "é");
    assert_eq!(decode(b"caf\xe9"), "café");
}
