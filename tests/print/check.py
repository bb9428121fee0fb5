#!/usr/bin/env python3
"""Pages for presses read back by other programs: what they are made of, their boxes, plates, fonts and standards.

    cargo run --example print -- FOLDER PROFILE.icc
    tests/print/check.py FOLDER

needs qpdf, pdfinfo and pdffonts (poppler-utils), gs (Ghostscript), and pikepdf and Pillow of Python; verapdf and Inkscape are asked where
they are there. What is missing is said, and makes the check fail; these two alone may be missing.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PLATES = ["Cyan", "Magenta", "Yellow", "Black"]
MM = 72 / 25.4
faults = []


def fault(text):
    faults.append(text)
    print("FAULT:", text)


def said(*call):
    run = subprocess.run(call, capture_output=True, text=True)
    return run.returncode, run.stdout + run.stderr


def near(found, wanted, what):
    if any(abs(a - b) > 0.02 for a, b in zip(found, wanted, strict=True)):
        fault(f"{what}: {found}, not {wanted}")


def check_syntax(file):
    status, text = said("qpdf", "--check", str(file))
    if status:
        fault(f"{file.name}: qpdf says {text}")


def check_boxes(file):
    """The example's page is 120 x 80 mm with 3 mm of bleed; marks reach 8 mm out and have 1 mm around them."""
    _, text = said("pdfinfo", "-box", str(file))
    boxes = {}
    for line in text.splitlines():
        name, _, rest = line.partition(":")
        if name.endswith("Box"):
            boxes[name] = [float(number) for number in rest.split()]
    edge = 9 if "screen" not in file.name and "archive" not in file.name else 3
    for name, inset, outset in [("MediaBox", 0, edge), ("BleedBox", edge - 3, 3), ("TrimBox", edge, 0)]:
        low = inset * MM
        wanted = [low, low, low + (120 + 2 * outset) * MM, low + (80 + 2 * outset) * MM]
        near(boxes[name], wanted, f"{file.name} {name}")


def check_fonts(file):
    _, text = said("pdffonts", str(file))
    lines = text.splitlines()[2:]
    if "outlined" in file.name:
        if lines:
            fault(f"{file.name}: has fonts: {lines}")
        return
    if len(lines) != 2:
        fault(f"{file.name}: {len(lines)} fonts, not two")
    for line in lines:
        if line.split()[-5:-2] != ["yes", "yes", "yes"]:
            fault(f"{file.name}: not embedded, or no part, or without words: {line}")
    _, words = said("pdftotext", str(file), "-")
    if "ENGINEER." not in words or "CRACK! \u03a9" not in words:
        fault(f"{file.name}: its words read {words!r}")


def plates(file, resolution=900):
    """The plates of the first page within the trimmed page: which share of each is inked, 0 to 1."""
    from PIL import Image

    shares = {}
    with tempfile.TemporaryDirectory() as folder:
        status, text = said(
            "gs", "-q", "-dNOPAUSE", "-dBATCH", "-dSAFER", "-sDEVICE=tiffsep", f"-r{resolution}", "-dLastPage=1",
            f"-sOutputFile={folder}/p%d.tif", str(file),
        )
        if status or "rror" in text:
            fault(f"{file.name}: Ghostscript says {text}")
        for path in sorted(Path(folder).glob("p1(*).tif")):
            image = Image.open(path).convert("L")
            edge = 9 / 25.4 * resolution + 4
            image = image.crop((edge, edge, image.width - edge, image.height - edge))
            inked = sum(count * (255 - value) for value, count in enumerate(image.histogram()))
            shares[path.name[3:-5]] = inked / 255 / (image.width * image.height)
    return shares


def check_plates(file):
    shares = plates(file)
    print(f"  {file.name}:", ", ".join(f"{name} {100 * share:.2f} %" for name, share in shares.items()))
    black_alone = file.name in ("k.pdf", "x4-k.pdf", "outlined.pdf", "spot.pdf", "dots.pdf")
    for name in PLATES[:3]:
        if black_alone and shares[name]:
            fault(f"{file.name}: ink on the plate {name}")
        if not black_alone and not shares[name]:
            fault(f"{file.name}: no ink on the plate {name}")
    if not shares["Black"]:
        fault(f"{file.name}: no ink on the plate Black")
    wants_spot = file.name in ("spot.pdf", "x4.pdf")
    if wants_spot != ("PANTONE 185 C" in shares) or wants_spot and not shares["PANTONE 185 C"]:
        fault(f"{file.name}: plates {list(shares)}")
    return shares


def check_structure(file):
    import pikepdf

    pdf = pikepdf.open(file)
    layers = pdf.Root.OCProperties.D.Order
    names = [str(entry.Name) for entry in pdf.Root.OCProperties.OCGs]
    if "panel-1" not in names or "balloon" not in names or "lines" not in names or len(layers) != 2:
        fault(f"{file.name}: layers {names}")
    states = pdf.pages[0].Resources.ExtGState
    overprinting = [state for state in states.values() if state.get("/OP")]
    if ("screen" in file.name or "archive" in file.name) == bool(overprinting):
        fault(f"{file.name}: states {dict(states)}")
    if any(state.op is not True or state.OPM != 1 for state in overprinting):
        fault(f"{file.name}: overprint by halves")
    if "archive" in file.name:
        xmp = bytes(pdf.Root.Metadata.read_bytes()).decode()
        intent = pdf.Root.OutputIntents[0]
        if "<pdfaid:part>2<" not in xmp or intent.S != "/GTS_PDFA1" or intent.DestOutputProfile.N != 3:
            fault(f"{file.name}: not told as PDF/A-2b")
        for key in ("Title", "Creator", "Producer"):
            if str(pdf.docinfo["/" + key]) not in xmp:
                fault(f"{file.name}: {key} is not in XMP")
        if not pdf.trailer.get("/ID") or pdf.is_encrypted:
            fault(f"{file.name}: ID or encryption")
        for entry in pdf.objects:
            if isinstance(entry, pikepdf.Stream) and entry.get("/Interpolate"):
                fault(f"{file.name}: a smoothed picture")
    if "x4" in file.name:
        xmp = bytes(pdf.Root.Metadata.read_bytes()).decode()
        intents = pdf.Root.OutputIntents
        if "<pdfxid:GTS_PDFXVersion>PDF/X-4<" not in xmp or len(intents) != 1 or intents[0].S != "/GTS_PDFX":
            fault(f"{file.name}: not told as PDF/X-4")
        if intents[0].DestOutputProfile.N != 4 or pdf.docinfo.Trapped != "/False" or not pdf.trailer.get("/ID"):
            fault(f"{file.name}: profile, Trapped or ID")
        if str(pdf.docinfo.Title) != "A page" or "A page" not in xmp or "CreationDate" not in str(pdf.docinfo):
            fault(f"{file.name}: title or dates")
        if pdf.is_encrypted or pdf.pdf_version != "1.6":
            fault(f"{file.name}: version {pdf.pdf_version}")
        for entry in pdf.objects:
            if isinstance(entry, pikepdf.Stream) and "LZW" in str(entry.get("/Filter", "")):
                fault(f"{file.name}: LZW")


def limit_of(file):
    """The most ink that any colour of a file asks for."""
    import pikepdf

    most = 0
    pdf = pikepdf.open(file)
    for page in pdf.pages:
        for operands, operator in pikepdf.parse_content_stream(page):
            if str(operator) in ("k", "K"):
                most = max(most, sum(float(ink) for ink in operands))
    return 100 * most


def check_comic(folder):
    """The comic page: a page of 168.28 x 260.35 mm with 3 mm of bleed; marks reach 8 mm out and have 1 mm around them."""
    import pikepdf

    shares = {}
    for name in ("comic-archive.pdf", "comic-k.pdf", "comic-x4.pdf", "comic-dots.pdf"):
        file = folder / name
        check_syntax(file)
        edge = 3 if "archive" in name else 9
        _, text = said("pdfinfo", "-box", str(file))
        trim = next(line for line in text.splitlines() if line.startswith("TrimBox"))
        low = edge * MM
        wanted = [low, low, low + 168.28 * MM, low + 260.35 * MM]
        near([float(number) for number in trim.split()[1:]], wanted, f"{name} TrimBox")
        _, text = said("pdffonts", str(file))
        for line in text.splitlines()[2:]:
            if line.split()[-5:-2] != ["yes", "yes", "yes"]:
                fault(f"{name}: not embedded, or no part, or without words: {line}")
        _, words = said("pdftotext", str(file), "-")
        if "BREAKFAST." not in words:
            fault(f"{name}: its words read {words!r}")
        pdf = pikepdf.open(file)
        layers = [str(entry.Name) for entry in pdf.Root.OCProperties.OCGs]
        missing = {f"panel-{k}" for k in range(1, 7)} | {"panel-5-break", "panel-6-letters"}
        if missing - set(layers):
            fault(f"{name}: no layers {sorted(missing - set(layers))}")
        megabytes = file.stat().st_size / 1e6
        print(f"  {name}: {megabytes:.2f} MB")
        if megabytes > 10:
            fault(f"{name}: more than 10 MB")
        if "archive" not in name:
            shares[name] = plates(file, 300)
            inks = (f"{plate} {100 * share:.2f} %" for plate, share in shares[name].items())
            print(f"  {name}:", ", ".join(inks))
    if any(shares["comic-k.pdf"][plate] for plate in PLATES[:3]) or not shares["comic-k.pdf"]["Black"]:
        fault(f"comic-k.pdf: {shares['comic-k.pdf']}")
    if not shares["comic-x4.pdf"].get("PANTONE 185 C"):
        fault(f"comic-x4.pdf: no ink of its own: {shares['comic-x4.pdf']}")
    most = limit_of(folder / "comic-x4.pdf")
    if most > 240.01:
        fault(f"comic-x4.pdf: {most} % ink, more than 240 %")


def check_inkscape(folder):
    """The comic page as Inkscape sees it: its layers by name, and the same picture."""
    from xml.etree import ElementTree

    from PIL import Image, ImageChops

    label = "{http://www.inkscape.org/namespaces/inkscape}label"
    mode = "{http://www.inkscape.org/namespaces/inkscape}groupmode"
    groups = ElementTree.parse(folder / "comic.svg").getroot().iter("{http://www.w3.org/2000/svg}g")
    ids = {group.get("id") for group in groups if group.get(mode) == "layer" and group.get(label)}
    status, text = said("inkscape", str(folder / "comic.svg"), "--query-all")
    seen = {line.split(",")[0] for line in text.splitlines()}
    if status or len(ids) < 20 or ids - seen:
        fault(f"comic.svg: Inkscape does not see {sorted(ids - seen)} of {len(ids)} layers")
    with tempfile.TemporaryDirectory() as made:
        said("inkscape", str(folder / "comic.svg"), "--export-type=png", f"--export-filename={made}/a.png", "--export-dpi=96")
        theirs = Image.open(f"{made}/a.png").convert("RGB")
    ours = Image.open(folder / "comic.png").convert("RGB")
    if theirs.size != ours.size:
        fault(f"comic.svg: {theirs.size} pixels in Inkscape, not {ours.size}")
        return
    apart = ImageChops.difference(ours, theirs).convert("L").histogram()
    share = sum(apart[64:]) / sum(apart)
    print(f"  comic.svg: {len(ids)} layers in Inkscape, {100 * share:.3f} % of the pixels differ")
    if share > 0.001:
        fault(f"comic.svg: {100 * share:.2f} % of the pixels differ in Inkscape")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    missing = [name for name in ("qpdf", "pdfinfo", "pdffonts", "pdftotext", "gs") if not shutil.which(name)]
    for module in ("pikepdf", "PIL"):
        try:
            __import__(module)
        except ImportError:
            missing.append(f"the Python module {module}")
    for name in missing:
        fault(f"{name} is missing")
    if missing:
        sys.exit(1)
    files = sorted(folder.glob("*.pdf"))
    wanted = {"screen.pdf", "archive.pdf", "k.pdf", "spot.pdf", "outlined.pdf", "x4-k.pdf", "x4.pdf", "cmyk.pdf"}
    wanted |= {"dots.pdf", "cmyk-dots.pdf"}
    comic = {"comic-archive.pdf", "comic-k.pdf", "comic-x4.pdf", "comic-dots.pdf"}
    if not wanted | comic <= {file.name for file in files}:
        sys.exit(f"{folder} lacks {sorted((wanted | comic) - {file.name for file in files})}; see the head of this file")
    files = [file for file in files if file.name in wanted]
    found = {}
    for file in files:
        check_syntax(file)
        check_boxes(file)
        check_fonts(file)
        check_structure(file)
        if file.name not in ("screen.pdf", "archive.pdf"):
            found[file.name] = check_plates(file)
    # Dots cover as much as the tones they stand for; Ghostscript paints every pixel that is touched, so that they are a little more.
    for name, tones in (("dots.pdf", "k.pdf"), ("cmyk-dots.pdf", "cmyk.pdf")):
        for plate in PLATES:
            dots, tone = found[name][plate], found[tones][plate]
            if not tone - 0.005 <= dots <= tone * 1.15 + 0.005:
                fault(f"{name}: {100 * dots:.2f} % on the plate {plate}, not {100 * tone:.2f} %")
    for name in ("cmyk.pdf", "x4.pdf"):
        most = limit_of(folder / name)
        print(f"  {name}: at most {most:.0f} % ink")
        if most > 240.01:
            fault(f"{name}: {most} % ink, more than 240 %")
    check_comic(folder)
    if shutil.which("inkscape"):
        check_inkscape(folder)
    else:
        print("  inkscape is missing: what it sees of comic.svg was not asked")
    for name in ("archive.pdf", "comic-archive.pdf"):
        if not shutil.which("verapdf"):
            print(f"  verapdf is missing: that {name} is PDF/A-2b was not asked")
            continue
        status, text = said("verapdf", "--flavour", "2b", "--format", "text", str(folder / name))
        print(" ", text.strip())
        if status or "PASS" not in text:
            fault(f"{name} is no PDF/A-2b")
    print(f"{len(files)} files, {len(faults)} faults")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
