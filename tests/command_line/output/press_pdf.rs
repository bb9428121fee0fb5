//! PDF for presses and archives: inks, separations, marks, PDF/X and PDF/A, and contradicting options.

use crate::folder::Folder;

/// A CMYK profile that comes with Ghostscript.
const PRESS: &str = "/usr/share/color/icc/ghostscript/default_cmyk.icc";

/// Whether the bytes of a file contain a text.
fn holds(folder: &Folder, name: &str, what: &str) -> bool {
    folder.read(name).windows(what.len()).any(|part| part == what.as_bytes())
}

#[test]
fn inks_marks_and_standards_are_as_asked() {
    let folder = Folder::with_cubes("print");
    folder.ligne("draw cubes.obj plain.pdf --style toon").done();
    folder.ligne("draw cubes.obj screen.pdf --style toon --ink screen").done();
    assert_eq!(folder.read("plain.pdf"), folder.read("screen.pdf"), "the colours of screens are the default");
    folder.ligne("draw cubes.obj k.pdf --style toon --ink k --marks").done();
    assert!(holds(&folder, "k.pdf", "/OPM 1") && holds(&folder, "k.pdf", "/Separation /All"));
    assert!(!holds(&folder, "k.pdf", "DeviceRGB"));
    folder.ligne("draw cubes.obj again.pdf --style toon --ink K --marks --threads 1").done();
    assert_eq!(folder.read("k.pdf"), folder.read("again.pdf"));
    folder.ligne("draw cubes.obj a.pdf --pdf a2b").done();
    assert!(holds(&folder, "a.pdf", "<pdfaid:part>2</pdfaid:part>"));
    folder.run(&["draw", "cubes.obj", "s.pdf", "--ink", "k", "--spot", "black=PANTONE Black 6 C"]).done();
    assert!(holds(&folder, "s.pdf", "/PANTONE#20Black#206#20C"));
    if std::fs::exists(PRESS).unwrap_or(false) {
        let call =
            format!("draw cubes.obj x.pdf --style toon --ink cmyk --icc {PRESS} --ink-limit 250 --pdf x4");
        folder.ligne(&call).done();
        assert!(holds(&folder, "x.pdf", "PDF/X-4</pdfxid:GTS_PDFXVersion>"));
    } else {
        eprintln!("skipped: {PRESS} is absent");
    }
}

#[test]
fn what_cannot_be_printed_is_refused() {
    let folder = Folder::with_cubes("print-refused");
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
        folder.ligne(&format!("draw cubes.obj {options}")).refused(what);
        assert!(!folder.path("a.pdf").exists() && !folder.path("a.svg").exists(), "{options}");
    }
}
