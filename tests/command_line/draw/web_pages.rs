//! Drawings for web pages: hot-spots, titles for screen readers, ink in the text colour, and `.svgz`.

use std::process::Command;

use ligne::diff::canonical_svg;

use crate::folder::TestFolder;

/// The hot-spot layer of a drawing, and the drawing without that layer.
fn split_hotspots(svg: &str) -> (&str, String) {
    let begin = svg.find("<g id=\"hotspots\"").expect("hot-spots");
    let end = begin + svg[begin..].find("</g>\n").expect("an end") + 5;
    (&svg[begin..end], format!("{}{}", &svg[..begin], &svg[end..]))
}

#[test]
fn hotspots_add_a_top_layer_and_change_nothing_else() {
    let folder = TestFolder::with_cubes("hotspots");
    for style in ["ink", "technical", "toon", "pencil", "plotter --page A5", "toon --group part"] {
        let draw = |out: &str, more: &str| {
            folder.ligne(&format!("draw cubes.obj {out} --style {style} {more}")).expect_success();
        };
        draw("plain.svg", "");
        draw("spots.svg", "--hotspots");
        let (plain, spots) = (folder.text("plain.svg"), folder.text("spots.svg"));
        let (layer, rest) = split_hotspots(&spots);
        assert_eq!(rest, plain, "{style}");
        assert!(spots.ends_with(&format!("{layer}</svg>\n")), "{style}");
        assert!(layer.contains("fill=\"none\" pointer-events=\"all\""));
        for part in ["base", "knob"] {
            assert_eq!(layer.matches(&format!("data-part=\"{part}\"")).count(), 1, "{style}");
            assert_eq!(layer.matches(&format!("<title>{part}</title>")).count(), 1, "{style}");
        }
        assert_eq!(canonical_svg(&spots, None).as_deref(), Ok(spots.as_str()), "{style}");
        // Hot-spots are invisible: they change neither the comparison nor the pixels.
        folder.ligne("diff plain.svg spots.svg").expect_success();
        draw("plain.png", "");
        draw("spots.png", "--hotspots");
        assert_eq!(folder.read("plain.png"), folder.read("spots.png"), "{style}");
    }
    folder.ligne("draw cubes.obj plain.pdf").expect_success();
    folder.ligne("draw cubes.obj spots.pdf --hotspots").expect_success();
    assert_eq!(folder.read("plain.pdf"), folder.read("spots.pdf"));
}

#[test]
fn hotspots_give_the_browser_the_part_under_each_point() {
    let folder = TestFolder::with_cubes("hotspots-browser");
    folder.ligne("draw cubes.obj spots.svg --hotspots --view front --size 400").expect_success();
    let page = format!(
        "<!DOCTYPE html><body style=\"margin:0\">{}<p id=found></p><script>\
         const at = (x, y) => document.elementFromPoint(x, y)?.dataset.part ?? 'none';\
         document.getElementById('found').textContent =\
         [[200,250],[200,50],[100,380],[30,30],[200,160]].map(([x, y]) => at(x, y)).join(' ');</script>",
        folder.text("spots.svg")
    );
    folder.write("page.html", &page);
    let url = format!("file://{}", folder.path("page.html").display());
    let run = Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--window-size=800,800", "--dump-dom", &url])
        .output();
    let Ok(output) = run else {
        eprintln!("skipped: there is no chromium");
        return;
    };
    let page = String::from_utf8_lossy(&output.stdout);
    // Front view: the base, 2 wide, is at the bottom. The knob, 1 wide, is above a gap.
    assert!(page.contains(">base knob base none none</p>"), "{}", &page[page.len().saturating_sub(600)..]);
}

#[test]
fn hotspots_of_titled_drawings_are_accessible_buttons() {
    let folder = TestFolder::with_cubes("hotspots-titled");
    let drawn = |more: &str| {
        folder.ligne(&format!("draw cubes.obj a.svg --style toon --hotspots {more}")).expect_success();
        let svg = folder.text("a.svg");
        assert_eq!(canonical_svg(&svg, None).as_deref(), Ok(svg.as_str()), "{more}");
        svg
    };
    let plain = drawn("--id-prefix x-");
    assert!(plain.contains("<g id=\"x-hotspots\"") && plain.contains(" class=\"hotspots\""), "{plain}");
    assert!(!plain.contains("role=") && !plain.contains("tabindex="));
    for more in ["--title Cubes", "--desc Cubes --id-prefix x-", "--title Cubes --group part"] {
        let svg = drawn(more);
        // An element inside `role="img"` cannot have a role, so the drawing has the role `group`.
        assert!(
            svg.contains(" role=\"group\" aria-labelledby=\"") && !svg.contains("role=\"img\""),
            "{more}"
        );
        for part in ["base", "knob"] {
            let button = format!("data-part=\"{part}\" role=\"button\" tabindex=\"0\" aria-label=\"{part}\"");
            assert_eq!(svg.matches(&button).count(), 1, "{more}");
        }
        assert_eq!(svg.matches("tabindex=").count(), 2, "{more}");
        let groups = svg.matches("<g id=\"part-").count();
        assert_eq!(svg.matches("aria-hidden=\"true\"").count(), groups, "{more}");
    }
}

/// The script in the documentation handles clicks and keys in drawings with id prefixes.
#[test]
fn documented_hotspot_script_works_with_id_prefixes() {
    let folder = TestFolder::with_cubes("hotspots-recipe");
    let documentation = include_str!("../../../docs/how-to/web.md");
    // The page is given as its head and its tail. The drawings go between them.
    let part = |name: &str| {
        let fence = format!("```html file={name}\n");
        let begin = documentation.find(&fence).expect("a part of the page") + fence.len();
        &documentation[begin..begin + documentation[begin..].find("```").expect("an end")]
    };
    let (head, tail) = (part("head.html"), part("tail.html").replace("</html>", ""));
    let mut drawings = String::new();
    for prefix in ["a-", "b-"] {
        let call = format!(
            "draw cubes.obj a.svg --hotspots --title Cubes --view front --size 400 --id-prefix {prefix}"
        );
        folder.ligne(&call).expect_success();
        drawings += &folder.text("a.svg");
    }
    let page = format!(
        "{head}{drawings}{tail}<p id=found></p><script>\
         const chosen = document.getElementById('chosen');\
         const spots = [...document.querySelectorAll('.hotspots [data-part]')];\
         const after = (spot, event) => {{ chosen.textContent = ''; spot.dispatchEvent(event); return chosen.textContent; }};\
         const key = (key) => new KeyboardEvent('keydown', {{ key, bubbles: true }});\
         const found = [after(spots[0], new MouseEvent('click', {{ bubbles: true }})),\
             after(spots[1], key('Enter')), after(spots[2], key(' ')), after(spots[3], key('x')) || 'none',\
             spots.every((spot) => {{ spot.focus(); return document.activeElement === spot; }})];\
         document.getElementById('found').textContent = found.join(' ');</script>"
    );
    folder.write("page.html", &page);
    let url = format!("file://{}", folder.path("page.html").display());
    let run = Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--window-size=800,1200", "--dump-dom", &url])
        .output();
    let Ok(output) = run else {
        eprintln!("skipped: there is no chromium");
        return;
    };
    let page = String::from_utf8_lossy(&output.stdout);
    assert!(
        page.contains(">Cubes: base Cubes: knob Cubes: base none true</p>"),
        "{}",
        &page[page.len().saturating_sub(600)..]
    );
}

#[test]
fn a_model_without_part_names_gets_a_warning_instead_of_hotspots() {
    let folder = TestFolder::with_cubes("hotspots-none");
    folder.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let run = folder.ligne("draw bare.obj a.svg --hotspots --view front");
    let named = folder.text("a.svg").contains("id=\"hotspots\"");
    assert!(named != run.err.contains("no named part"), "{}", run.err);
}

#[test]
fn screen_readers_get_title_and_description() {
    let folder = TestFolder::with_cubes("title");
    let run = folder.run(&[
        "draw",
        "cubes.obj",
        "a.svg",
        "--title",
        "Two <cubes>",
        "--desc",
        "One on the other",
        "--id-prefix",
        "x-",
    ]);
    run.expect_success();
    let svg = folder.text("a.svg");
    assert!(svg.contains("role=\"img\" aria-labelledby=\"x-title x-desc\""), "{svg}");
    assert!(svg.contains(
        "<title id=\"x-title\">Two &lt;cubes&gt;</title>\n<desc id=\"x-desc\">One on the other</desc>"
    ));
    assert_eq!(canonical_svg(&svg, None).as_deref(), Ok(svg.as_str()));
    folder.run(&["draw", "cubes.obj", "b.svg", "--desc", "Cubes"]).expect_success();
    assert!(
        folder.text("b.svg").contains("<title id=\"title\">cubes</title>\n<desc id=\"desc\">Cubes</desc>")
    );
    folder.ligne("draw cubes.obj c.svg").expect_success();
    assert!(!folder.text("c.svg").contains("role="));
}

#[test]
fn ink_current_color_follows_the_surrounding_text() {
    let folder = TestFolder::with_cubes("ink");
    for (style, ink) in [("ink", "#1a1a1a"), ("plotter", "#000"), ("patent", "#000"), ("stipple", "#1a1a1a")]
    {
        let call = format!("draw cubes.obj a.svg --style {style} --background none");
        folder.ligne(&call).expect_success();
        let plain = folder.text("a.svg");
        folder.ligne(&format!("{call} --ink currentColor -o a.png")).expect_success();
        let current = folder.text("a.svg");
        assert!(current.contains("=\"currentColor\""), "{style}");
        assert!(!current.contains(&format!("=\"{ink}\"")), "{style}");
        let back = current.replace("=\"currentColor\"", &format!("=\"{ink}\""));
        // Black is the default fill, so the attribute may be missing.
        let without = |svg: &str| svg.replace(" fill=\"#000\"", "");
        assert_eq!(without(&back), without(&plain), "{style}");
    }
    let run = folder.ligne("draw cubes.obj b.svg --ink currentColor --set pen.colour={shade=0.5}");
    assert_eq!(run.status, Some(2));
    assert!(run.err.contains("no fixed colour"), "{}", run.err);
    assert_eq!(folder.ligne("draw cubes.obj b.svg --ink red").status, Some(2));
}

#[test]
fn svgz_is_gzipped_svg() {
    let folder = TestFolder::with_cubes("svgz");
    folder.ligne("draw cubes.obj a.svg --style toon -o a.svgz -o b.svgz").expect_success();
    assert_eq!(folder.read("a.svgz"), folder.read("b.svgz"));
    assert!(folder.read("a.svgz").starts_with(&[0x1f, 0x8b, 8]));
    assert!(folder.read("a.svgz").len() * 2 < folder.read("a.svg").len());
    if let Ok(unpacked) = Command::new("gzip").arg("-dc").arg(folder.path("a.svgz")).output() {
        assert_eq!(unpacked.stdout, folder.read("a.svg"));
    }
    folder.ligne("diff a.svg a.svgz").expect_success();
    folder.ligne("fmt --check a.svgz").expect_success();
    folder.ligne("fmt a.svgz -o c.svg").expect_success();
    assert_eq!(folder.text("c.svg"), folder.text("a.svg"));
}

#[test]
fn colour_and_view_values_accept_alternative_spellings() {
    let folder = TestFolder::with_cubes("typed");
    let drawn = |more: &str| {
        folder.ligne(&format!("draw cubes.obj a.svg {more}")).expect_success();
        folder.text("a.svg")
    };
    assert_eq!(drawn("--background Teal"), drawn("--background #008080"));
    assert_eq!(drawn("--background #fab"), drawn("--background #ffaabb"));
    assert_eq!(drawn("--background #fab8"), drawn("--background #ffaabb88"));
    assert_eq!(drawn("--set pen.colour=navy"), drawn("--set pen.colour=#000080"));
    folder.write("my.toml", "extends = 'ink'\n[pen]\ncolour = 'RebeccaPurple'\n[page]\nbackground = 'ivory'");
    assert_eq!(drawn("--style my.toml"), drawn("--set pen.colour=#639 --background #fffff0"));
    assert_eq!(drawn("--view isometric"), drawn("--view ISO"));
    assert_eq!(drawn("--view iso"), drawn("--view ISO"));
    assert_ne!(drawn("--view Front"), drawn("--view ISO"));
    for wrong in ["--background bluish", "--background #12", "--view sideways", "--set pen.colour=bluish"] {
        assert_eq!(folder.ligne(&format!("draw cubes.obj b.svg {wrong}")).status, Some(2), "{wrong}");
    }
}

#[test]
fn styles_sheet_shows_the_model_in_every_style() {
    let folder = TestFolder::with_cubes("sheet");
    let listed = folder.ligne("styles");
    folder.ligne("styles --sheet all.svg cubes.obj").expect_success();
    let svg = folder.text("all.svg");
    for line in listed.expect_success().out.lines() {
        let name = line.split(' ').next().unwrap_or_default();
        assert!(svg.contains(&format!("<title>{name}</title>")), "{name}");
        assert!(svg.contains(&format!("inkscape:label=\"{name}\"")), "{name}");
    }
    let mut ids: Vec<&str> = svg.split(" id=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count);
    folder.ligne("styles --sheet all.png cubes.obj").expect_success();
    assert!(folder.read("all.png").starts_with(b"\x89PNG"));
    assert_eq!(folder.ligne("styles --sheet all.svg").status, Some(2));
    assert_eq!(folder.ligne("styles --sheet all.svg none.obj").status, Some(2));
}
