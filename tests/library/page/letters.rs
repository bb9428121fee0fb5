//! Text blocks: optimal line breaks by brute force, ink within bounds, fallback fonts, hyphenation, shaping
//! and rejected input.

use kurbo::{Point, Rect, Shape};
use ligne::colour::srgb::Colour;
use ligne::kurbo;
use ligne::text::{Align, Font, Setting, TextBlock};

const LONG_SENTENCE: &str =
    "Those who would give up essential liberty, to purchase a little temporary safety, deserve neither!";

fn comic() -> Setting {
    Setting::new(Font::named("comic").unwrap()).with_em(4.0)
}

/// Breaks words into lines at the blanks given by `bits`. Returns the number of lines and the width of the
/// widest.
fn break_lines(words: &[&str], bits: u32, setting: &Setting) -> (usize, f64) {
    let mut text = String::new();
    for (number, word) in words.iter().enumerate() {
        text += word;
        text += if bits >> number & 1 == 1 { "\n" } else { " " };
    }
    let block = TextBlock::unbroken(&text, setting).unwrap();
    (block.lines.len(), block.width)
}

#[test]
fn balanced_line_breaks_are_optimal() {
    let setting = comic();
    for (text, width) in
        [("It was a bright cold day in April, and", 30.0), ("Wait, that is not mine at all!", 22.0)]
    {
        let words: Vec<&str> = text.split(' ').collect();
        let block = TextBlock::balanced(text, &setting, width).unwrap();
        let ways = (0..1 << (words.len() - 1)).map(|bits| break_lines(&words, bits, &setting));
        let fitting: Vec<(usize, f64)> = ways.filter(|(_, widest)| *widest <= width).collect();
        let fewest = fitting.iter().map(|way| way.0).min().unwrap();
        let narrowest =
            fitting.iter().filter(|way| way.0 == fewest).map(|way| way.1).fold(f64::MAX, f64::min);
        assert_eq!(block.lines.len(), fewest, "{}", block.words());
        assert!(
            (block.width - narrowest).abs() < 1e-9,
            "{} is not {narrowest}: {}",
            block.width,
            block.words()
        );
    }
}

#[test]
fn line_breaks_fit_the_smallest_ellipse() {
    let setting = comic().upper_case();
    let text = "It was a bright cold day in April, and";
    let words: Vec<&str> = text.split(' ').collect();
    for aspect in [0.5, 0.8, 1.3] {
        let (block, radii) = TextBlock::in_ellipse(text, &setting, aspect).unwrap();
        let radius = |block: &TextBlock| {
            let middle = block.bounds().center();
            let corners = block.lines.iter().flat_map(|line| {
                let bounds = line.bounds();
                [
                    (bounds.x0, bounds.y0),
                    (bounds.x1, bounds.y0),
                    (bounds.x0, bounds.y1),
                    (bounds.x1, bounds.y1),
                ]
            });
            let out =
                corners.map(|(x, y)| ((x - middle.x).powi(2) + ((y - middle.y) / aspect).powi(2)).sqrt());
            out.fold(0.0, f64::max)
        };
        assert!((radius(&block) - radii.x).abs() < 1e-9 && (radii.y - radii.x * aspect).abs() < 1e-9);
        for bits in 0..1_u32 << (words.len() - 1) {
            let lines = words.iter().enumerate().fold(String::new(), |text, (number, word)| {
                text + word + if bits >> number & 1 == 1 { "\n" } else { " " }
            });
            let other = radius(&TextBlock::unbroken(&lines, &setting).unwrap());
            assert!(other >= radii.x - 1e-9, "{lines} fits {other}, less than {}", radii.x);
        }
    }
}

/// Returns the bounding box of the ink.
fn ink(block: &TextBlock, corner: Point) -> Rect {
    let marks = block.marks(corner, Colour::BLACK);
    marks.iter().map(|mark| mark.path.bounding_box()).reduce(|a, b| a.union(b)).unwrap()
}

#[test]
fn text_ink_stays_inside_the_block_bounds() {
    let texts = [LONG_SENTENCE, "ÅÉ jgy", "fj", "2 Ω, α", "a\u{301} e\u{302}", "f-\nj"];
    for font in Font::names() {
        for align in [Align::Left, Align::Centre, Align::Right] {
            let setting = Setting::new(Font::named(font).unwrap()).with_em(3.0).aligned(align);
            for text in texts {
                for setting in [setting.clone(), setting.clone().upper_case()] {
                    let corner = Point::new(17.0, -5.0);
                    for block in [
                        TextBlock::unbroken(text, &setting).unwrap(),
                        TextBlock::in_width(text, &setting, 24.0).unwrap(),
                        TextBlock::balanced(text, &setting, 24.0).unwrap(),
                        TextBlock::in_ellipse(text, &setting, 0.7).unwrap().0,
                    ] {
                        let bounds = (block.bounds() + corner.to_vec2()).inflate(1e-9, 1e-9);
                        let ink = ink(&block, corner);
                        assert_eq!(bounds.union(ink), bounds, "{font}, {text}: {ink:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn capitals_have_the_requested_height() {
    for font in Font::names() {
        let setting = Setting::new(Font::named(font).unwrap()).with_capitals(3.5);
        let height = ink(&TextBlock::unbroken("H", &setting).unwrap(), Point::ZERO).height();
        // Routed Gothic has a round pen, and its capital height is that of the centre line.
        assert!((height - 3.5).abs() < 0.6, "{font}: {height}");
    }
}

#[test]
fn missing_letters_use_fallback_fonts_and_are_reported() {
    let block = TextBlock::unbroken("10 Ω, ⌀5", &comic()).unwrap();
    let told: Vec<String> = block.fallbacks.iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        [
            "the font Comic Neue Bold has no `Ω` (U+03A9); B612 Regular is used",
            "the font Comic Neue Bold has no `⌀` (U+2300); Routed Gothic is used"
        ]
    );
    let fonts: Vec<String> = block
        .marks(Point::ZERO, Colour::BLACK)
        .iter()
        .map(|mark| mark.provenance.text.as_ref().unwrap().font.name.clone())
        .collect();
    assert_eq!(fonts, ["ComicNeue-Bold", "B612-Regular", "ComicNeue-Bold", "RoutedGothic", "ComicNeue-Bold"]);
    let error = TextBlock::unbroken("a 漢", &comic()).unwrap_err().to_string();
    assert!(error.contains("`漢` (U+6F22)") && error.contains("Comic Neue Bold, Routed Gothic"), "{error}");
    assert!(TextBlock::unbroken("Plain.", &comic()).unwrap().fallbacks.is_empty());
}

#[test]
fn words_are_hyphenated_by_language() {
    let long = "Donaudampfschifffahrtsgesellschaft";
    let error = TextBlock::in_width(long, &comic(), 30.0).unwrap_err().to_string();
    assert!(error.contains(long) && error.contains("30.00"), "{error}");
    let block = TextBlock::in_width(long, &comic().in_language("de"), 30.0).unwrap();
    assert_eq!(block.words(), "Donaudampf-\nschifffahrtsge-\nsellschaft");
    assert!(block.lines.iter().all(|line| line.width <= 30.0));
    let balanced = TextBlock::balanced(long, &comic().in_language("de"), 30.0).unwrap();
    assert!(
        balanced.lines.len() == 3
            && balanced.width <= block.lines.iter().map(|l| l.width).fold(0.0, f64::max)
    );
    // Words that fit are not hyphenated.
    let whole = TextBlock::balanced("Hyphenation everywhere", &comic().in_language("en"), 30.0).unwrap();
    assert_eq!(whole.words(), "Hyphenation\neverywhere");
    assert!(
        TextBlock::unbroken("a", &comic().in_language("klingon"))
            .unwrap_err()
            .to_string()
            .contains("klingon")
    );
}

#[test]
fn upper_case_kerning_and_combining_marks_are_shaped() {
    let width = |text: &str| TextBlock::unbroken(text, &comic()).unwrap().width;
    assert!(width("AVAVAV") < width("AAA") + width("VVV") - 0.1, "no kerning");
    assert!((width("e\u{301}") - width("é")).abs() < 1e-9, "a mark is put on its letter");
    assert_eq!(TextBlock::unbroken("straße i", &comic().upper_case()).unwrap().words(), "STRASSE I");
    assert_eq!(TextBlock::unbroken("i", &comic().upper_case().in_language("tr")).unwrap().words(), "İ");
}

#[test]
fn glyphs_map_to_the_bytes_of_their_text() {
    let block = TextBlock::unbroken("Größe fi é", &comic()).unwrap();
    let marks = block.marks(Point::new(3.0, 4.0), Colour::BLACK);
    for mark in &marks {
        let run = mark.provenance.text.as_ref().unwrap();
        let said: String = run.glyphs.iter().map(|glyph| &run.words[glyph.shows.clone()]).collect();
        assert_eq!(said, run.words.as_ref());
        // The outline of the mark has the bounding box of its glyphs.
        let font = Font::named("comic").unwrap();
        let mut around: Option<Rect> = None;
        for glyph in run.glyphs.iter() {
            let place = run.place * kurbo::Affine::new([1.0, 0.0, 0.0, -1.0, glyph.x, glyph.y]);
            let outline = place * font.outline(glyph.id);
            if !outline.elements().is_empty() {
                let own = outline.bounding_box();
                around = Some(around.map_or(own, |all| all.union(own)));
            }
        }
        let (around, own) = (around.unwrap(), mark.path.bounding_box());
        assert!((around.x0 - own.x0).abs() + (around.y1 - own.y1).abs() + (around.x1 - own.x1).abs() < 1e-9);
    }
}

#[test]
fn right_to_left_glyphs_are_in_visual_order() {
    let file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    let Ok(font) = Font::open(file) else {
        eprintln!("skipped: {file} is absent");
        return;
    };
    let setting = Setting::new(font).with_em(10.0);
    let block = TextBlock::unbroken("שלום", &setting).unwrap();
    let marks = block.marks(Point::ZERO, Colour::BLACK);
    let run = marks[0].provenance.text.as_ref().unwrap();
    let said: Vec<&str> = run.glyphs.iter().map(|glyph| &run.words[glyph.shows.clone()]).collect();
    assert_eq!(said, ["ם", "ו", "ל", "ש"]);
    assert!(run.glyphs.windows(2).all(|pair| pair[0].x < pair[1].x));
}

#[test]
fn mixed_direction_text_is_in_visual_order() {
    let file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    let Ok(font) = Font::open(file) else {
        eprintln!("skipped: {file} is absent");
        return;
    };
    let setting = Setting::new(font).with_em(10.0);
    let visual_text = |text: &str| {
        let marks = TextBlock::unbroken(text, &setting).unwrap().marks(Point::ZERO, Colour::BLACK);
        let runs = marks.iter().filter_map(|mark| mark.provenance.text.as_ref());
        let letters =
            runs.flat_map(|run| run.glyphs.iter().map(|glyph| run.words[glyph.shows.clone()].to_owned()));
        letters.collect::<String>()
    };
    assert_eq!(visual_text("abc 12, d"), "abc 12, d");
    assert_eq!(visual_text("abc אבג דה. d"), "abc הד גבא. d");
    assert_eq!(visual_text("אב 12 גד ab"), "ab דג 12 בא");
    assert_eq!(visual_text("אב (abc)"), ")abc( בא", "brackets are mirrored where letters are shaped");
    assert_eq!(visual_text("אב 12.5 גד"), "דג 12.5 בא");
}

#[test]
fn the_same_text_gives_the_same_marks() {
    let setting = comic().in_language("en");
    let marks =
        || TextBlock::in_ellipse(LONG_SENTENCE, &setting, 0.7).unwrap().0.marks(Point::ZERO, Colour::BLACK);
    assert_eq!(marks(), marks());
}

#[test]
fn invalid_texts_and_fonts_are_rejected() {
    let message =
        |text: &str, setting: &Setting| TextBlock::balanced(text, setting, 10.0).unwrap_err().to_string();
    assert!(message(" \n ", &comic()).contains("has no letters"));
    assert!(message(&"long ".repeat(20_000), &comic()).contains("too long"));
    assert!(message("a", &comic().with_em(f64::NAN)).contains("not above 0"));
    assert!(TextBlock::in_ellipse("a", &comic(), -1.0).is_err());
    assert!(Font::named("gothic").unwrap_err().to_string().contains("comic, technical, plain"));
    assert!(Font::from_bytes(b"not a font").unwrap_err().to_string().contains("is not a font"));
    let absent = Font::open("absent.ttf").unwrap_err();
    assert!(absent.to_string().starts_with("absent.ttf: cannot be read"), "{absent}");
    // Damaged fonts are rejected or set something, without a crash.
    let whole = std::fs::read("fonts/ComicNeue-Bold.otf").unwrap();
    for cut in [12, 100, 1000, 5000, 20_000] {
        if let Ok(font) = Font::from_bytes(&whole[..cut]) {
            let _ = TextBlock::unbroken("abc", &Setting::new(font));
        }
        let mut torn = whole.clone();
        torn[cut..cut + 40].fill(0xff);
        if let Ok(font) = Font::from_bytes(&torn) {
            let _ = TextBlock::unbroken("abc", &Setting::new(font));
        }
    }
}
