//! Page files of comics: errors name their line, colours and inks apply, files include others, and figures
//! break borders.

use std::fs;
use std::path::{Path, PathBuf};

use ligne::drawing::{Composition, Mark, Paint, PlacedDrawing};
use ligne::kurbo::{Point, Shape};
use ligne::page::PageFile;

/// Creates a temporary folder for one test.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("ligne-pages-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// A figure of two boxes: `body`, and `head` above it.
pub(crate) fn person() -> String {
    let mut text = String::new();
    let boxes = [("body", [-0.5, 0.0, -0.3], [0.5, 1.5, 0.3]), ("head", [-0.3, 1.6, -0.3], [0.3, 2.2, 0.3])];
    for (number, (name, low, high)) in boxes.into_iter().enumerate() {
        text += &format!("o {name}\n");
        for k in 0..8 {
            let at = |axis: usize| if k >> axis & 1 == 0 { low[axis] } else { high[axis] };
            text += &format!("v {} {} {}\n", at(0), at(1), at(2));
        }
        for face in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]] {
            let corners = face.map(|corner| (corner + 1 + 8 * number).to_string());
            text += &format!("f {}\n", corners.join(" "));
        }
    }
    text
}

pub(crate) fn items<'a>(page: &'a Composition, ending: &'a str) -> impl Iterator<Item = &'a PlacedDrawing> {
    page.items.iter().filter(move |item| item.name.ends_with(ending))
}

pub(crate) fn marks(item: &PlacedDrawing) -> impl Iterator<Item = &Mark> {
    item.drawing.layers.iter().flat_map(|layer| &layer.marks)
}

/// Returns the error message of a page.
fn error_of_page(text: &str) -> String {
    let told = PageFile::from_text(text, "pages/a.toml").and_then(|file| file.compose());
    told.expect_err(text).to_string()
}

#[test]
fn page_file_errors_name_their_line() {
    let panel = "[page]\nkind = 'comic'\n[[page.panel]]\n";
    let narrow = format!("[[page.panel]]\nballoon = [{{ text = '{}' }}]\n", "word ".repeat(60));
    for (text, line, message) in [
        ("[page]\nsize = 'A4'\n", "line 1", "the kind of this page is missing"),
        ("[page]\nkind = 'comik'\n", "line 2", "did you mean `comic`?"),
        ("[page]\nkind = 'comic'\nguter = 3\n", "line 3", "did you mean `gutter`?"),
        ("[pgae]\n", "line 1", "did you mean `page`?"),
        ("[page]\nkind = 'comic'\nlayout = '1 / [2 | 3'\n", "line 3", "a bracket is not closed"),
        ("[page]\nkind = 'comic'\nlayout = '99.99 / *'\n", "line 3", "no size"),
        ("[page]\nkind = 'comic'\nsize = 'A9'\n", "line 3", "not a page size"),
        ("[page]\nkind = 'comic'\nmargin = 200\n", "line 3", "leaves no room"),
        (&format!("{panel}model = 'none.obj'\n"), "line 4", "there is no model `none.obj`"),
        (&format!("{panel}style = 'inc'\n"), "line 4", "did you mean `ink`?"),
        (&format!("{panel}set = ['pen.widht=2']\n"), "line 4", "did you mean `width`?"),
        (&format!("{panel}[[page.panel]]\n"), "line 4", "the layout has only 1 panel"),
        (&format!("{panel}at = [0, 0, 50, 50]\n"), "line 4", "overlaps `panel-1`"),
        (&format!("{panel}at = [0, 0, 0, 50]\n"), "line 4", "no size"),
        (&format!("{panel}at = [200, 0, 50, 50]\ninset = true\n"), "line 4", "past the page"),
        (
            &format!("{panel}balloon = [{{ text = 'a', tail = 'head' }}]\n"),
            "line 4",
            "no model in this panel",
        ),
        (&format!("{panel}balloon = [{{ text = '' }}]\n"), "line 4", "has no text"),
        (&format!("{panel}balloon = [{{ text = '{}' }}]\n", "w".repeat(40_000)), "line 4", "too long"),
        (&format!("{panel}balloon = [{{ text = 'a', at = [nan, 0] }}]\n"), "line 4", "far from the panel"),
        (&format!("{panel}sound = [{{ text = 'a', at = [0, inf] }}]\n"), "line 4", "far from the panel"),
        (&format!("{panel}sound = [{{ text = 'a', arc = nan }}]\n"), "line 4", "not an angle for letters"),
        (&format!("{panel}sound = [{{ text = 'a', rotate = 1e9 }}]\n"), "line 4", "not an angle for letters"),
        (
            &format!("{panel}sound = [{{ text = 'a', stretch = inf }}]\n"),
            "line 4",
            "not a stretch of letters",
        ),
        (&format!("{panel}name = ''\n"), "line 4", "has no name"),
        ("[page]\nkind = 'comic'\ngutter = inf\n", "line 3", "not a gutter"),
        ("[page]\nkind = 'comic'\nsize = [nan, 90]\n", "line 3", "is too large"),
        (
            &format!("[page]\nkind = 'comic'\nlayout = '{}1'\n", "1 | ".repeat(10_000)),
            "line 3",
            "at most 10000 panels",
        ),
        (
            &format!("[page]\nkind = 'comic'\nlayout = '{}'\n", "1 [".repeat(90)),
            "line 3",
            "more than 32 deep",
        ),
        (&format!("[page]\nkind = 'comic'\nsize = [60, 60]\n{narrow}"), "line 5", "no room"),
        (
            "[page]\nkind = 'comic'\nlettering = { font = 'comik' }\n[[page.panel]]\n",
            "line 3",
            "did you mean `comic`?",
        ),
    ] {
        let told = error_of_page(text);
        assert!(told.starts_with("pages/a.toml: "), "{told}");
        assert!(told.contains(line) && told.contains(message) && told.contains('^'), "{text}: {told}");
    }
}

#[test]
fn page_colours_override_model_colours() {
    let folder = folder("colours");
    fs::write(folder.join("person.obj"), person()).unwrap();
    let page = |colour: &str| {
        let text = format!(
            "[page]\nkind = 'comic'\nstyle = 'toon'\n[[page.panel]]\nmodel = {{ file = 'person.obj', colour = {colour} }}\n"
        );
        PageFile::from_text(&text, folder.join("page.toml")).and_then(|file| file.compose())
    };
    let drawn = page("{ '*' = 'blue', 'h*' = 'red' }").unwrap().remove(0).composition;
    let panel = drawn.items.iter().find(|item| item.name == "panel-1").unwrap();
    let mut seen = std::collections::BTreeSet::new();
    for mark in marks(panel) {
        if let (Paint::Fill(colour), Some(part)) = (&mark.paint, &mark.provenance.part) {
            let wanted = if part.as_ref() == "head" { colour.r > colour.b } else { colour.b > colour.r };
            if mark.provenance.material.is_some() {
                assert!(wanted, "{part}: {colour:?}");
                seen.insert(part.to_string());
            }
        }
    }
    assert_eq!(seen.len(), 2, "{seen:?}");
    let told = page("{ hed = 'red' }").unwrap_err().to_string();
    assert!(told.contains("line 5") && told.contains("did you mean `head`?") && told.contains('^'), "{told}");
    assert!(page("'redd'").unwrap_err().to_string().contains("this is not a colour"));
    let _ = fs::remove_dir_all(folder);
}

#[test]
fn pages_of_a_file_must_share_their_inks() {
    let print = |text: &str| PageFile::from_text(text, "pages/a.toml").and_then(|file| file.print());
    let one = "[[page]]\nkind = 'comic'\nink = 'K'\nspot = { name = 'PANTONE 185 C', colour = 'red' }\n";
    let found = print(&format!("{one}[[page]]\nkind = 'comic'\n")).unwrap();
    assert_eq!((found.ink.as_deref(), found.spots[0].name.as_str()), (Some("k"), "PANTONE 185 C"));
    for (rest, message) in [
        ("ink = 'cmyk'\n", "an earlier page has other inks"),
        ("ink = 'cymk'\n", "did you mean `cmyk`?"),
        ("ink_limit = nan\n", "not an ink limit"),
        ("ink = 'k'\nink_limit = 300\n", "an ink limit needs four inks"),
        ("icc = 'none.icc'\n", "there is no ICC profile"),
        ("spot = [{ name = 'Other', colour = '#f00' }]\n", "already prints as `PANTONE 185 C`"),
        ("spot = [{ name = ' ', colour = 'blue' }]\n", "needs a name"),
        ("spot = 'PANTONE 185 C'\n", "this is not a spot colour"),
    ] {
        let told = print(&format!("{one}[[page]]\nkind = 'comic'\n{rest}")).unwrap_err().to_string();
        assert!(told.contains(message) && told.contains("line ") && told.contains('^'), "{rest}: {told}");
    }
}

#[test]
fn page_files_include_others_but_reject_cycles() {
    let folder = folder("book");
    fs::write(folder.join("one.toml"), "[page]\nkind = 'comic'\n").unwrap();
    fs::write(folder.join("book.toml"), "pages = ['one.toml', 'one.toml']\n").unwrap();
    fs::write(folder.join("a.toml"), "pages = ['b.toml']\n").unwrap();
    fs::write(folder.join("b.toml"), "pages = ['a.toml']\n").unwrap();
    assert_eq!(PageFile::open(folder.join("book.toml")).unwrap().len(), 2);
    let error = PageFile::open(folder.join("a.toml")).unwrap_err().to_string();
    assert!(error.contains("b.toml: line 1: `a.toml` leads back") && error.contains('^'), "{error}");
    let _ = fs::remove_dir_all(folder);
}

#[test]
fn only_the_named_part_breaks_the_panel_border() {
    let folder = folder("break");
    fs::write(folder.join("person.obj"), person()).unwrap();
    let page = |rest: &str| {
        let text = format!(
            "[page]\nkind = 'comic'\nstyle = 'toon'\nlayout = '1 / 1'\n[[page.panel]]\n[[page.panel]]\n\
             model = 'person.obj'\ncamera = {{ azimuth = 20, zoom = 1.3 }}\n{rest}"
        );
        PageFile::from_text(&text, folder.join("page.toml")).unwrap().compose().unwrap().remove(0).composition
    };
    let broken = page("break = ['head']");
    let item = items(&broken, "-break").next().unwrap();
    assert!(
        marks(item).count() > 1 && marks(item).all(|mark| mark.provenance.part.as_deref() == Some("head"))
    );
    let panel = broken.items.iter().find(|item| item.name == "panel-2").unwrap();
    let (frame, over) = (panel.clip.as_ref().unwrap(), item.clip.as_ref().unwrap());
    let top = frame.bounding_box();
    // The head crosses the border line. Its clip begins where the panel's clip ends, with the width of the
    // line and a small overlap shared.
    let head =
        marks(item).map(|mark| (item.place * mark.path.clone()).bounding_box()).reduce(|a, b| a.union(b));
    assert!(head.unwrap().y0 < top.y0 - 1.0);
    let [middle, line, above] = [5.0, 0.2, -5.0].map(|down| Point::new(top.center().x, top.y0 + down));
    assert_eq!([middle, line, above].map(|p| frame.contains(p)), [true, true, false]);
    assert_eq!([middle, line, above].map(|p| over.contains(p)), [false, true, true]);
    assert_eq!(items(&page(""), "-break").count(), 0);
    // The picture inside the panel does not change if the border is broken: frame and camera grow together.
    let plain = page("");
    let whole = plain.items.iter().find(|item| item.name == "panel-2").unwrap();
    let pixels = |item: &PlacedDrawing, composition: &Composition| -> Vec<u8> {
        let alone = Composition::new("", composition.page, vec![item.clone()]);
        let options = ligne::PngOptions::of_resolution(ligne::export::Resolution::Dpi(50.0));
        let png = alone.to_png(&options).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        pixels
    };
    let (one, other) = (pixels(whole, &plain), pixels(panel, &broken));
    let apart = one.iter().zip(&other).filter(|(a, b)| a.abs_diff(**b) > 60).count();
    let inked = one.iter().filter(|value| **value < 200).count();
    assert!(apart * 50 < inked && inked > 1000, "{apart} of {inked}");
    let _ = fs::remove_dir_all(folder);
}

#[test]
fn panel_drawings_are_layers_clipped_to_their_frames() {
    let text = "[page]\nkind = 'comic'\nlayout = '1 | 1'\n[[page.panel]]\nname = 'left'\nmodel = 'gear.obj'\nstyle = 'ink'\n";
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
    let page = PageFile::from_text(text, folder.join("page.toml")).unwrap().compose().unwrap().remove(0);
    let svg = page.composition.to_svg(&ligne::SvgOptions::default().with_id_prefix("p-"));
    for part in [
        "<clipPath id=\"p-left-frame\">",
        "<g id=\"p-left\" inkscape:groupmode=\"layer\" inkscape:label=\"left\" clip-path=\"url(#p-left-frame)\" transform=\"translate(12)\">",
        "<g id=\"p-left-lines\"",
        "<g id=\"p-panel-2\"",
    ] {
        assert!(svg.contains(part) || part.contains("translate"), "{part}\n{}", &svg[..2000]);
    }
    assert_eq!(svg.matches("id=\"").count(), {
        let ids: std::collections::BTreeSet<&str> =
            svg.split("id=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        ids.len()
    });
    let png = page.composition.to_png(&ligne::PngOptions::default()).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
}
