//! Parts lists of technical sheets, and their balloons: leaders do not cross.

use std::fs;

use ligne::kurbo::{PathEl, Point, Rect, Shape};
use ligne::page::PageFile;
use ligne::page::sheet::part_balloons::leader_assignment::{
    assign_leaders, balloon_slots, passes_through_balloon, segments_meet,
};

use super::technical_sheets::width;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::sheet_models::{
    block, item_texts, obj_text, page_item, placed_marks, temp_folder,
};
use crate::library::support::scenes::solids::cuboid;

#[test]
fn leaders_of_twenty_assemblies_do_not_cross() {
    let mut dice = Dice::new(17);
    for round in 0..20 {
        let folder = temp_folder(&format!("assembly-{round}"));
        let mut parts = Vec::new();
        for k in 0..6 + round {
            let at = dice.point(40.0);
            let size = dice.point(6.0).abs() + glam::DVec3::splat(2.0);
            parts.push((format!("part{k}x"), cuboid(at - size, at + size)));
        }
        fs::write(folder.join("a.obj"), obj_text(&parts)).expect("written");
        let text =
            "[page]\nkind = 'sheet'\nmodel = 'a.obj'\nviews = ['iso']\nparts_list = true\nsize = 'A2'\n";
        let page = PageFile::from_text(text, folder.join("a.toml")).expect("a page");
        let composed = page.compose().expect("drawn").remove(0);
        fs::remove_dir_all(&folder).expect("removed");
        let balloons = page_item(&composed, "balloons");
        let mut lines = Vec::new();
        let mut circles = Vec::new();
        for (_, mark) in placed_marks(balloons).filter(|(_, mark)| width(mark) > 0.0) {
            match mark.path.elements() {
                [PathEl::MoveTo(a), PathEl::LineTo(b)] => lines.push([*a, *b]),
                _ => circles.push(mark.path.bounding_box()),
            }
        }
        let hidden = composed
            .warnings
            .iter()
            .filter(|warning| warning.contains("is not visible in the view with balloons"))
            .count();
        assert_eq!([lines.len() + hidden, circles.len() + hidden], [parts.len(); 2], "round {round}");
        for (k, line) in lines.iter().enumerate() {
            for other in &lines[..k] {
                assert!(!segments_meet(*line, *other), "round {round}: {line:?} {other:?}");
            }
            // Each leader ends at its own balloon and crosses no other.
            let near = |circle: &&Rect| {
                let way = line[1] - line[0];
                let share = ((circle.center() - line[0]).dot(way) / way.hypot2()).clamp(0.0, 1.0);
                (line[0] + way * share - circle.center()).hypot() < 4.0 + 1e-6
            };
            assert_eq!(circles.iter().filter(near).count(), 1, "round {round}: {line:?}");
        }
        for (k, circle) in circles.iter().enumerate() {
            let centre = circle.center();
            assert!((circle.width() - 8.0).abs() < 0.01);
            assert!(
                circles[..k].iter().all(|other| (other.center() - centre).hypot2() > 64.0),
                "round {round}"
            );
        }
    }
}

#[test]
fn leaders_of_random_anchors_do_not_cross() {
    let mut dice = Dice::new(4);
    let mut hits = 0;
    for round in 0..200 {
        let count = 2 + dice.below(40);
        let border = Rect::new(0.0, 0.0, dice.between(60.0, 200.0), dice.between(60.0, 200.0));
        let mut point =
            || Point::new(dice.between(10.0, border.x1 - 10.0), dice.between(10.0, border.y1 - 10.0));
        let anchors: Vec<Point> = (0..count).map(|_| point()).collect();
        let room = (2.0 * (border.width() + border.height()) / (count as f64 + 0.5)).min(10.0);
        let slots = balloon_slots(border, room, 0.5);
        let of = assign_leaders(&anchors, &slots, &|_, _| false);
        let mut taken = of.clone();
        taken.sort_unstable();
        taken.dedup();
        assert_eq!(taken.len(), count);
        for a in 0..count {
            for b in 0..a {
                assert!(
                    !segments_meet([anchors[a], slots[of[a]]], [anchors[b], slots[of[b]]]),
                    "round {round}"
                );
            }
        }
        // Leaders cross no other balloons if there is enough room.
        for a in 0..count {
            let through = (0..count)
                .filter(|b| *b != a && passes_through_balloon([anchors[a], slots[of[a]]], slots[of[*b]]));
            hits += through.count();
        }
    }
    assert!(hits <= 2, "{hits} leaders run through balloons");
    let p = Point::new;
    assert!(segments_meet([p(0.0, 0.0), p(2.0, 2.0)], [p(0.0, 2.0), p(2.0, 0.0)]));
    assert!(segments_meet([p(0.0, 0.0), p(2.0, 0.0)], [p(1.0, 0.0), p(1.0, 5.0)]));
    assert!(!segments_meet([p(0.0, 0.0), p(1.0, 0.0)], [p(0.0, 1.0), p(1.0, 1.0)]));
}

#[test]
fn parts_lists_count_equal_parts() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/pump.glb");
    let items = ligne::page::sheet::parts_list::parts_list_items::parts_list_items(
        &ligne::Scene::open(path).expect("a model"),
    );
    let count = |name: &str| items.iter().find(|item| item.name == name).map_or(0, |item| item.parts.len());
    assert_eq!([count("anchor"), count("volute"), count("motor-housing")], [6, 1, 1]);
    assert_eq!(items.iter().map(|item| item.parts.len()).sum::<usize>(), 68);
}

#[test]
fn parts_lists_can_be_read_from_csv_and_toml() {
    let folder = temp_folder("list");
    let parts = [("plate", 0.0), ("bolt.1", 4.0), ("bolt.2", 8.0), ("nut", 12.0)];
    let parts = parts.map(|(name, x)| (name.to_owned(), block([x, 0.0, 0.0], [x + 2.0, 3.0, 4.0])));
    fs::write(folder.join("a.obj"), obj_text(&parts)).expect("written");
    let compose = |list: &str, text: &str| {
        fs::write(folder.join(list), text).expect("written");
        let text =
            format!("[page]\nkind = 'sheet'\nmodel = 'a.obj'\nviews = ['iso']\nparts_list = '{list}'\n");
        PageFile::from_text(&text, folder.join("a.toml")).expect("a page").compose()
    };
    let csv = "Pos;Part;Name;Qty;Material;Remark\n10;plate;Base plate;;S235;painted\n20;bolt*;Bolt M6;;8.8;\n30;;Oil;2;;litres\n";
    let composed = compose("list.csv", csv).expect("a sheet").remove(0);
    let told = item_texts(page_item(&composed, "parts-list"));
    for word in ["10", "20", "30", "Base plate", "Bolt M6", "S235", "painted", "8.8", "litres", "Remark", "2"]
    {
        assert!(told.contains(&word.to_owned()), "{word}: {told:?}");
    }
    let mut balloons = item_texts(page_item(&composed, "balloons"));
    balloons.sort();
    assert_eq!(balloons, ["10", "20"]);
    assert!(
        composed.warnings.contains(&"part 'nut' is in no row of the parts list".to_owned()),
        "{:?}",
        composed.warnings
    );
    let toml = "[[item]]\npart = 'bolt*'\nname = 'Bolt'\n[[item]]\nname = 'nut'\nnumber = 'N'\n";
    let composed = compose("list.toml", toml).expect("a sheet").remove(0);
    assert!(item_texts(page_item(&composed, "balloons")).contains(&"N".to_owned()));
    for (list, text, told) in [
        ("a.csv", "nme\nplate\n", "no column `nme`"),
        ("b.csv", "name,qty\nplate,many\n", "`many` is not a quantity"),
        ("c.csv", "name\nplate\ncrank\n", "no part has the name `crank`"),
        ("d.toml", "[[item]]\nnam = 'a'\n", "nam"),
    ] {
        let error = compose(list, text).expect_err(text);
        assert!(error.to_string().contains(told) && error.file.is_some(), "{error}");
    }
    fs::remove_file(folder.join("a.csv")).expect("removed");
    let text = "[page]\nkind = 'sheet'\nmodel = 'a.obj'\nparts_list = 'a.csv'\n";
    let error =
        PageFile::from_text(text, folder.join("a.toml")).expect("a page").compose().expect_err("none");
    assert!(error.to_string().contains("no parts list `a.csv`"), "{error}");
    fs::remove_dir_all(&folder).expect("removed");
}
