//! PDF for presses and archives: inks, separations, marks, PDF/X and PDF/A, and contradicting options.

use crate::folder::TestFolder;

/// A CMYK profile that comes with Ghostscript.
const CMYK_PROFILE: &str = "/usr/share/color/icc/ghostscript/default_cmyk.icc";

/// Whether the bytes of a file contain a text.
fn file_contains(folder: &TestFolder, name: &str, what: &str) -> bool {
    folder.read(name).windows(what.len()).any(|part| part == what.as_bytes())
}

#[test]
fn pdf_options_write_inks_marks_and_standards() {
    let folder = TestFolder::with_cubes("print");
    folder.ligne("draw cubes.obj plain.pdf --style toon").expect_success();
    folder.ligne("draw cubes.obj screen.pdf --style toon --ink screen").expect_success();
    assert_eq!(folder.read("plain.pdf"), folder.read("screen.pdf"), "the colours of screens are the default");
    folder.ligne("draw cubes.obj k.pdf --style toon --ink k --marks").expect_success();
    assert!(file_contains(&folder, "k.pdf", "/OPM 1") && file_contains(&folder, "k.pdf", "/Separation /All"));
    assert!(!file_contains(&folder, "k.pdf", "DeviceRGB"));
    folder.ligne("draw cubes.obj again.pdf --style toon --ink K --marks --threads 1").expect_success();
    assert_eq!(folder.read("k.pdf"), folder.read("again.pdf"));
    folder.ligne("draw cubes.obj a.pdf --pdf a2b").expect_success();
    assert!(file_contains(&folder, "a.pdf", "<pdfaid:part>2</pdfaid:part>"));
    folder
        .run(&["draw", "cubes.obj", "s.pdf", "--ink", "k", "--spot", "black=PANTONE Black 6 C"])
        .expect_success();
    assert!(file_contains(&folder, "s.pdf", "/PANTONE#20Black#206#20C"));
    if std::fs::exists(CMYK_PROFILE).unwrap_or(false) {
        let call = format!(
            "draw cubes.obj x.pdf --style toon --ink cmyk --icc {CMYK_PROFILE} --ink-limit 250 --pdf x4"
        );
        folder.ligne(&call).expect_success();
        assert!(file_contains(&folder, "x.pdf", "PDF/X-4</pdfxid:GTS_PDFXVersion>"));
    } else {
        eprintln!("skipped: {CMYK_PROFILE} is absent");
    }
}

#[test]
fn conflicting_pdf_options_are_refused() {
    let folder = TestFolder::with_cubes("print-refused");
    folder.write("no.icc", "no profile");
    for (options, what) in [
        ("a.pdf --ink cmyk", "--icc FILE"),
        ("a.pdf --ink cmyk --icc absent.icc", "absent.icc"),
        ("a.pdf --ink cmyk --icc no.icc", "not an ICC profile"),
        ("a.pdf --ink k --ink-limit 200", "--ink cmyk"),
        ("a.pdf --pdf x4", "PDF/X-4 needs a profile"),
        ("a.pdf --spot red", "COLOUR=INK"),
        ("a.pdf --spot red=All", "`All`"),
        ("a.svg --marks", "--marks"),
        ("a.svg --ink k", "--ink"),
        ("a.png --pdf a2b", "works with PDF only"),
    ] {
        folder.ligne(&format!("draw cubes.obj {options}")).expect_refusal(what);
        assert!(!folder.path("a.pdf").exists() && !folder.path("a.svg").exists(), "{options}");
    }
}
