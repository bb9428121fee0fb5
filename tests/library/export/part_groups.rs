//! SVG grouped by part looks like SVG grouped by layer when rendered by resvg, and has few groups per part.

use std::collections::BTreeSet;

use ligne::drawing::Drawing;
use ligne::export::{Grouping, SvgOptions};
use ligne::{Camera, Scene, Style, render};
use resvg::tiny_skia::{Pixmap, Transform};

fn drawn(model: &str, style: &str, sets: &[&str]) -> Drawing {
    let scene = Scene::open(model).unwrap();
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let style = Style::load_with(style, &sets).unwrap();
    render(&scene, &Camera::three_quarter_of(scene.up).fit(&scene), &style).unwrap()
}

fn by_part(drawing: &Drawing) -> String {
    drawing.to_svg(&SvgOptions::default().grouped_by(Grouping::Part))
}

fn pixels(svg: &str) -> Pixmap {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default()).unwrap();
    let mut pixels = Pixmap::new(1000, 1000).unwrap();
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
    pixels
}

/// Ids of the part groups in an SVG.
fn part_group_ids(svg: &str) -> Vec<&str> {
    svg.split("<g id=\"part-").skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn grouping_by_part_does_not_change_the_picture() {
    let sets: [(&str, &str, &[&str]); 6] = [
        ("pump.glb", "toon", &[]),
        ("pump.glb", "comic", &[]),
        ("crane.glb", "pencil", &[]),
        ("street.glb", "toon", &["lines.hidden=dashed"]),
        ("jar.obj", "toon", &["glass.draw=glass"]),
        ("picnic.obj", "toon", &["fills.texture=image"]),
    ];
    for (model, style, sets) in sets {
        let drawing = drawn(&format!("examples/models/{model}"), style, sets);
        let [layers, parts] =
            [drawing.to_svg(&SvgOptions::default()), by_part(&drawing)].map(|svg| pixels(&svg));
        // The order of overlapping marks of one colour changes a channel only by rounding, twice.
        let most = layers.data().iter().zip(parts.data()).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
        assert!(most <= 3, "{model} {style}: {most} of 255");
    }
}

#[test]
fn parts_have_few_groups() {
    let svg = by_part(&drawn("examples/models/pump.glb", "ink", &[]));
    let names: BTreeSet<&str> =
        svg.split("data-part=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    assert_eq!(part_group_ids(&svg).len(), names.len());
    // Lines lie over the fills of neighbours, so most parts need two groups and few need more.
    let svg = by_part(&drawn("examples/models/pump.glb", "toon", &[]));
    assert!(
        part_group_ids(&svg).len() <= 3 * names.len(),
        "{} of {}",
        part_group_ids(&svg).len(),
        names.len()
    );
    let unique: BTreeSet<&str> = part_group_ids(&svg).into_iter().collect();
    assert_eq!(unique.len(), part_group_ids(&svg).len());
}
