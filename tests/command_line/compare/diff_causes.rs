//! `ligne diff`: one edit of a model or a drawing is reported as one finding.

use serde_json::{Value, json};

use crate::folder::TestFolder;

/// Writes `<name>-new.glb`: an example model with its glTF document edited.
fn write_edited_model(folder: &TestFolder, name: &str, edit: impl Fn(&mut Value)) {
    let path = format!("{}/examples/models/{name}.glb", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(path).unwrap();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let mut document: Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    edit(&mut document);
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let rest = &bytes[20 + length..];
    let mut out = bytes[..8].to_vec();
    out.extend(((20 + text.len() + rest.len()) as u32).to_le_bytes());
    out.extend((text.len() as u32).to_le_bytes());
    out.extend(b"JSON");
    out.extend(text);
    out.extend(rest);
    std::fs::write(folder.path(&format!("{name}-new.glb")), out).unwrap();
}

/// Index of the named entry in a list of the glTF document.
fn index_of(document: &Value, list: &str, name: &str) -> usize {
    let list = document[list].as_array().unwrap();
    list.iter().position(|entry| entry["name"] == name).unwrap()
}

/// An edit that moves a node.
fn move_node(name: &str, by: [f64; 3]) -> impl Fn(&mut Value) {
    move |document| {
        let node = index_of(document, "nodes", name);
        let was = document["nodes"][node]["translation"].clone();
        let at = |axis: usize| was[axis].as_f64().unwrap_or(0.0) + by[axis];
        document["nodes"][node]["translation"] = json!([at(0), at(1), at(2)]);
    }
}

/// An edit that removes the mesh of a node.
fn remove_mesh(name: &str) -> impl Fn(&mut Value) {
    move |document| {
        let node = index_of(document, "nodes", name);
        // A node without a mesh draws nothing.
        document["nodes"][node].as_object_mut().unwrap().remove("mesh");
    }
}

/// An edit that changes the base colour of a material.
fn recolour_material(name: &str, colour: [f64; 3]) -> impl Fn(&mut Value) {
    move |document| {
        let material = index_of(document, "materials", name);
        let [r, g, b] = colour;
        document["materials"][material]["pbrMetallicRoughness"]["baseColorFactor"] = json!([r, g, b, 1.0]);
    }
}

/// The findings in the output, one per line, without the summary at the end.
fn finding_lines(told: &str) -> Vec<&str> {
    let mut lines: Vec<&str> = told.lines().collect();
    lines.pop();
    lines
}

#[test]
fn one_model_edit_is_reported_as_one_finding() {
    let folder = TestFolder::new("diff-causes-models");
    type Edit = Box<dyn Fn(&mut Value)>;
    let edits: [(&str, Edit, &str); 6] = [
        ("pump", Box::new(remove_mesh("filler-plug")), "removed    part `filler-plug`: all its 22 marks"),
        (
            "pump",
            Box::new(recolour_material("brass", [0.1, 0.2, 0.8])),
            "restyled   material `brass`: colour #",
        ),
        (
            "pump",
            Box::new(move_node("terminal-box", [0.0, 0.0, 6.0])),
            "moved      `terminal-box` 0.268 px right, 8.88 px up; also changed around it: ",
        ),
        (
            "street",
            Box::new(move_node("chimney-15", [0.3, 0.0, 0.0])),
            "moved      `chimney-15` 5.41 px right, 1.11 px down; also changed around it: ",
        ),
        ("street", Box::new(remove_mesh("chimney-15")), "removed    part `chimney-15`: all its 8 marks"),
        (
            "street",
            Box::new(recolour_material("tile", [0.5, 0.1, 0.1])),
            "restyled   material `tile`: colour #",
        ),
    ];
    for (name, edit, wanted) in edits {
        write_edited_model(&folder, name, edit);
        let old = format!("{}/examples/models/{name}.glb", env!("CARGO_MANIFEST_DIR"));
        let told = folder.ligne(&format!("diff {old} {name}-new.glb --style toon"));
        told.expect_status(1);
        let lines = finding_lines(&told.out);
        assert!(lines.len() == 1 && lines[0].starts_with(wanted), "{wanted}: {}", told.out);
        let all = folder.ligne(&format!("diff {old} {name}-new.glb --style toon --all"));
        assert!(finding_lines(&all.out).len() > 2, "{}", all.out);
    }
}

#[test]
fn one_edit_of_a_whole_drawing_is_reported_as_one_finding() {
    let folder = TestFolder::new("diff-causes-drawings");
    let street = format!("{}/examples/models/street.glb", env!("CARGO_MANIFEST_DIR"));
    folder.ligne(&format!("draw {street} old.svg --style technical")).expect_success();
    let old = folder.text("old.svg");
    let (start, end) = (old.find("<title>").unwrap(), old.rfind("</svg>").unwrap());
    let within = |transform: &str| {
        format!("{}<g transform=\"{transform}\">{}</g></svg>", &old[..start], &old[start..end])
    };
    let head = &old[..old.find("viewBox").unwrap()];
    let bare: String = old
        .split_inclusive('"')
        .collect::<Vec<_>>()
        .chunks(2)
        .map(|pair| {
            let label = [
                " class=\"",
                " data-part=\"",
                " data-invisibility=\"",
                " data-material=\"",
                " data-tone=\"",
                " id=\"",
            ];
            match label.iter().find(|label| pair[0].ends_with(*label)) {
                Some(label) => pair[0][..pair[0].len() - label.len()].to_owned(),
                None => pair.concat(),
            }
        })
        .collect();
    let edits = [
        (within("translate(3 -4)"), "moved      the whole drawing 3 px right, 4 px up: "),
        (within("rotate(2 500 400)"), "moved      the whole drawing turned by 2° clockwise, its middle "),
        (
            old.replacen(head, &head.replace("1000", "2000"), 1),
            "moved      the whole drawing 2 times as large (size 1000 x 1000 px → 2000 x 2000 px): ",
        ),
        (bare, "relabelled "),
    ];
    for (new, wanted) in edits {
        folder.write("new.svg", &new);
        let told = folder.ligne("diff old.svg new.svg");
        told.expect_status(1);
        let lines = finding_lines(&told.out);
        assert!(lines.len() == 1 && lines[0].starts_with(wanted), "{wanted}: {}", told.out);
    }
    folder.ligne("diff old.svg new.svg --ignore labels").expect_status(0).expect_output("the same");
    folder.ligne("diff old.svg new.svg --ignore shapes").expect_status(2).expect_output("cannot be ignored");
}
