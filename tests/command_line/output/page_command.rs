//! `ligne page`: equal bytes for any thread count, errors with line and caret, and new page files that draw.

use crate::folder::TestFolder;

const PAGE_TOML: &str = "\
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
fn folder_with_page(name: &str) -> TestFolder {
    let folder = TestFolder::with_cubes(name);
    folder.write("page.toml", PAGE_TOML);
    folder
}

#[test]
fn pages_are_identical_for_any_thread_count() {
    let folder = folder_with_page("page-threads");
    let run = folder.ligne("page page.toml one.svg -o one.png --dpi 60 --threads 1");
    let said = &run.expect_success().err;
    assert!(said.starts_with("one.svg: 1 page, 120 x 90 mm, ") && said.lines().count() == 2, "{said}");
    folder.ligne("page page.toml two.svg -o two.png --dpi 60 --threads 2 --quiet").expect_success();
    assert_eq!(folder.read("one.svg"), folder.read("two.svg"));
    assert_eq!(folder.read("one.png"), folder.read("two.png"));
    let svg = folder.text("one.svg");
    for layer in ["panel-1", "panel-1-border", "panel-2-break", "panel-1-letters"] {
        assert!(svg.contains(&format!("<g id=\"{layer}\" inkscape:groupmode=\"layer\"")), "{layer}");
    }
    assert!(svg.contains("data-part=\"b/knob\""));
}

#[test]
fn page_file_errors_show_a_caret_and_write_nothing() {
    let folder = folder_with_page("page-wrong");
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
        folder.write("page.toml", &PAGE_TOML.replace(from, to));
        folder.ligne("page page.toml page.svg").expect_refusal(told);
        assert_eq!(folder.text("page.svg"), "as it was", "{to}");
    }
}

#[test]
fn several_pages_need_a_number_pattern() {
    let folder = folder_with_page("page-numbers");
    folder.write("book.toml", "pages = ['page.toml', 'page.toml']\n");
    folder
        .ligne("page book.toml book.svg")
        .expect_refusal("one file of this format cannot hold 2 pages; number them");
    folder.ligne("page book.toml b-%02d.svg --quiet").expect_success();
    assert_eq!(folder.read("b-01.svg"), folder.read("b-02.svg"));
    folder.ligne("page book.toml b.dxf").expect_refusal("page-%d.svg");
    folder.ligne("page page.toml b.dxf --quiet").expect_success();
    assert!(folder.text("b.dxf").contains("AC1015"));
    folder.ligne("page page.toml page.toml").expect_refusal("ligne cannot write drawings as .toml");
}

#[test]
fn page_new_comic_writes_a_page_file_that_draws() {
    let folder = TestFolder::new("page-new");
    folder
        .ligne("page --new comic start.toml")
        .expect_success()
        .expect_output("example-goose.obj: `ligne page start.toml` draws it");
    folder.ligne("page --new comic start.toml").expect_refusal("the file exists already");
    let run = folder.ligne("page start.toml start.svg --strict");
    run.expect_success();
    let svg = folder.text("start.svg");
    assert!(
        svg.contains("class=\"balloon shout\"")
            && svg.contains("panel-3-break")
            && svg.contains("class=\"motion\"")
    );
}

#[test]
fn diff_and_test_compare_pages_panel_by_panel() {
    let folder = folder_with_page("page-diff");
    folder.write("cases/page.toml", "page-file = '../page.toml'\n");
    folder.ligne("test cases --bless").expect_success();
    folder.ligne("test cases").expect_success().expect_output("passed   page");
    folder.ligne("page page.toml old.svg --quiet").expect_success();
    assert_eq!(folder.read("old.svg"), folder.read("cases/page.svg"));
    folder.write("page.toml", &PAGE_TOML.replace("name = 'b', ", "name = 'b', hide = ['base'], "));
    folder.ligne("test cases").expect_status(1).expect_output("part `b/base`: all its ");
    folder.ligne("page page.toml new.svg --quiet").expect_success();
    let run = folder.ligne("diff old.svg new.svg --all");
    let told = &run.expect_status(1).expect_output(" of `b/base` in `panel-2` ").out;
    // The other panel is unchanged.
    assert!(!told.contains("`panel-1`"), "{told}");
    folder.write("cases/page.toml", "page-file = '../page.toml'\nview = 'iso'\n");
    folder
        .ligne("test cases")
        .expect_status(2)
        .expect_output("a page file already contains all other settings");
}

#[test]
fn page_file_inks_apply_unless_options_replace_them() {
    let folder = folder_with_page("page-inks");
    let sound = "sound = [{ text = 'Bang', fill = '#e4002b' }]\n";
    let inks = "ink = 'k'\nspot = { name = 'PANTONE 185 C', colour = '#e4002b' }\n";
    folder.write(
        "inks.toml",
        &format!("[page]\nkind = 'comic'\nbackground = '#334455'\n{inks}[[page.panel]]\n{sound}"),
    );
    folder.ligne("page inks.toml k.pdf --outlined --quiet").expect_success();
    let bytes = |name: &str| String::from_utf8_lossy(&folder.read(name)).into_owned();
    assert!(bytes("k.pdf").contains("/Separation /PANTONE#20185#20C"));
    folder
        .ligne("page inks.toml typed.pdf --outlined --quiet --ink screen --spot #e4002b=Red")
        .expect_success();
    let typed = bytes("typed.pdf");
    assert!(typed.contains("/Separation /Red") && !typed.contains("PANTONE"));
    folder.ligne("page inks.toml cmyk.pdf --ink cmyk").expect_refusal("icc in a page file");
    folder.ligne("page inks.toml plain.svg --quiet").expect_success();
    assert!(folder.text("plain.svg").contains("#e4002b"));
}
