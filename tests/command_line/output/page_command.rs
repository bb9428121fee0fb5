//! `ligne page`: equal bytes for any thread count, errors with line and caret, and new page files that draw.

use crate::folder::Folder;

const PAGE: &str = "\
[page]
kind = 'comic'
size = [120, 90]
layout = '1 | 1'
style = 'ink'
[[page.panel]]
model = 'cubes.obj'
balloon = [{ text = 'Two cubes.', tail = 'knob' }]
[[page.panel]]
model = [{ file = 'cubes.obj', name = 'a' }, { file = 'cubes.obj', name = 'b', position = [4, 0, 0] }]
camera = { look_at = 'b/knob', zoom = 0.5 }
break = ['a/base']
sound = [{ text = 'Clack', size = 6 }]
";

/// A folder with the cubes and `page.toml`.
fn with_page(name: &str) -> Folder {
    let folder = Folder::with_cubes(name);
    folder.write("page.toml", PAGE);
    folder
}

#[test]
fn a_page_has_the_same_bytes_on_any_number_of_threads() {
    let folder = with_page("page-threads");
    let run = folder.ligne("page page.toml one.svg -o one.png --dpi 60 --threads 1");
    let said = &run.done().err;
    assert!(said.starts_with("one.svg: 1 page, 120 x 90 mm, ") && said.lines().count() == 2, "{said}");
    folder.ligne("page page.toml two.svg -o two.png --dpi 60 --threads 2 --quiet").done();
    assert_eq!(folder.read("one.svg"), folder.read("two.svg"));
    assert_eq!(folder.read("one.png"), folder.read("two.png"));
    let svg = folder.text("one.svg");
    for layer in ["panel-1", "panel-1-border", "panel-2-break", "panel-1-letters"] {
        assert!(svg.contains(&format!("<g id=\"{layer}\" inkscape:groupmode=\"layer\"")), "{layer}");
    }
    assert!(svg.contains("data-part=\"b/knob\""));
}

#[test]
fn what_is_wrong_is_shown_with_a_caret_and_nothing_is_written() {
    let folder = with_page("page-wrong");
    folder.write("page.svg", "as it was");
    for (from, to, told) in [
        (
            "size = [120, 90]",
            "siez = [120, 90]",
            "page.toml: line 3: unknown key `siez`; did you mean `size`?\n 3 | siez = [120, 90]\n   | ^^^^",
        ),
        ("'1 | 1'", "'1 | 1 / 1'", "page.toml: line 4: rows and columns are mixed here"),
        (
            "tail = 'knob'",
            "tail = 'knop'",
            "page.toml: line 8: there is no part `knop`; did you mean `knob`?",
        ),
        (
            "break = ['a/base']",
            "break = ['a/bass']",
            "line 12: there is no part `a/bass`; did you mean `a/base`?",
        ),
        ("model = 'cubes.obj'", "model = 'cube.obj'", "page.toml: line 7: there is no model `cube.obj`"),
        ("zoom = 0.5", "zooom = 0.5", "line 11: unknown key `zooom`; did you mean `zoom`?"),
    ] {
        folder.write("page.toml", &PAGE.replace(from, to));
        folder.ligne("page page.toml page.svg").refused(told);
        assert_eq!(folder.text("page.svg"), "as it was", "{to}");
    }
}

#[test]
fn several_pages_are_numbered() {
    let folder = with_page("page-numbers");
    folder.write("book.toml", "pages = ['page.toml', 'page.toml']\n");
    folder
        .ligne("page book.toml book.svg")
        .refused("one file of this format cannot hold 2 pages; number them");
    folder.ligne("page book.toml b-%02d.svg --quiet").done();
    assert_eq!(folder.read("b-01.svg"), folder.read("b-02.svg"));
    folder.ligne("page book.toml b.dxf").refused("page-%d.svg");
    folder.ligne("page page.toml b.dxf --quiet").done();
    assert!(folder.text("b.dxf").contains("AC1015"));
    folder.ligne("page page.toml page.toml").refused("ligne cannot write drawings as .toml");
}

#[test]
fn a_page_file_to_start_from_draws_at_once() {
    let folder = Folder::new("page-new");
    folder
        .ligne("page --new comic start.toml")
        .done()
        .says("example-goose.obj: `ligne page start.toml` draws it");
    folder.ligne("page --new comic start.toml").refused("the file exists already");
    let run = folder.ligne("page start.toml start.svg --strict");
    run.done();
    let svg = folder.text("start.svg");
    assert!(
        svg.contains("class=\"balloon shout\"")
            && svg.contains("panel-3-break")
            && svg.contains("class=\"motion\"")
    );
}

#[test]
fn pages_are_compared_panel_by_panel_and_kept_under_test() {
    let folder = with_page("page-diff");
    folder.write("cases/page.toml", "page-file = '../page.toml'\n");
    folder.ligne("test cases --bless").done();
    folder.ligne("test cases").done().says("passed   page");
    folder.ligne("page page.toml old.svg --quiet").done();
    assert_eq!(folder.read("old.svg"), folder.read("cases/page.svg"));
    folder.write("page.toml", &PAGE.replace("name = 'b', ", "name = 'b', hide = ['base'], "));
    folder.ligne("test cases").ends(1).says("part `b/base`: all its ");
    folder.ligne("page page.toml new.svg --quiet").done();
    let run = folder.ligne("diff old.svg new.svg --all");
    let told = &run.ends(1).says(" of `b/base` in `panel-2` ").out;
    // The other panel is unchanged.
    assert!(!told.contains("`panel-1`"), "{told}");
    folder.write("cases/page.toml", "page-file = '../page.toml'\nview = 'iso'\n");
    folder.ligne("test cases").ends(2).says("a page file already contains all other settings");
}

#[test]
fn page_files_name_their_inks_and_what_is_typed_counts() {
    let folder = with_page("page-inks");
    let sound = "sound = [{ text = 'Bang', fill = '#e4002b' }]\n";
    let inks = "ink = 'k'\nspot = { name = 'PANTONE 185 C', colour = '#e4002b' }\n";
    folder.write(
        "inks.toml",
        &format!("[page]\nkind = 'comic'\nbackground = '#334455'\n{inks}[[page.panel]]\n{sound}"),
    );
    folder.ligne("page inks.toml k.pdf --outlined --quiet").done();
    let bytes = |name: &str| String::from_utf8_lossy(&folder.read(name)).into_owned();
    assert!(bytes("k.pdf").contains("/Separation /PANTONE#20185#20C"));
    folder.ligne("page inks.toml typed.pdf --outlined --quiet --ink screen --spot #e4002b=Red").done();
    let typed = bytes("typed.pdf");
    assert!(typed.contains("/Separation /Red") && !typed.contains("PANTONE"));
    folder.ligne("page inks.toml cmyk.pdf --ink cmyk").refused("icc in a page file");
    folder.ligne("page inks.toml plain.svg --quiet").done();
    assert!(folder.text("plain.svg").contains("#e4002b"));
}
