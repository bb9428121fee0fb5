//! Hints of `ligne draw` and `ligne info`: notes about a model, each with the option that helps.

use crate::folder::TestFolder;

/// A box between two opposite corners, as an OBJ object. `first` is the index of its first vertex.
fn box_obj(name: &str, low: [f64; 3], high: [f64; 3], first: usize) -> String {
    let mut text = format!("o {name}\n");
    for corner in 0..8 {
        let [x, y, z] =
            std::array::from_fn(|axis| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] });
        text += &format!("v {x} {y} {z}\n");
    }
    for face in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
        let [a, b, c, d] = face.map(|corner| corner + first);
        text += &format!("f {a} {b} {c} {d}\n");
    }
    text
}

/// The notes that a run prints, joined by newlines.
fn notes(folder: &TestFolder, line: &str) -> String {
    let run = folder.ligne(line);
    run.expect_success();
    run.err.lines().filter(|line| line.starts_with("note: ")).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_model_lying_on_its_back_gets_the_up_z_hint() {
    let folder = TestFolder::with_cubes("hint-back");
    folder.write("tower.obj", &box_obj("tower", [-2.0, -1.5, 0.0], [2.0, 1.5, 9.0], 1));
    let note = notes(&folder, "draw tower.obj a.svg --strict");
    assert!(note.contains("lie on its back; --up z"), "{note}");
    for silent in ["--up z", "--up y", "--quiet"] {
        assert_eq!(notes(&folder, &format!("draw tower.obj b.svg {silent}")), "");
    }
    folder.ligne("draw tower.obj c.svg --save-camera camera.json").expect_success();
    assert_eq!(notes(&folder, "draw tower.obj d.svg --camera camera.json"), "");
    assert_eq!(notes(&folder, "draw cubes.obj e.svg"), "");
    folder
        .ligne("info tower.obj")
        .expect_success()
        .expect_output("1 note:\n    the model seems to have z up");
    let json: serde_json::Value =
        serde_json::from_str(&folder.ligne("info tower.obj --json").expect_success().out).unwrap();
    assert!(json["notes"][0].as_str().unwrap().contains("--up z"), "{json}");
}

#[test]
fn example_models_get_no_hints() {
    let models = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
    let folder = TestFolder::new("hint-none");
    for entry in std::fs::read_dir(models).unwrap().flatten() {
        let path = entry.path();
        let is_model =
            path.extension().is_some_and(|ending| ["obj", "ply", "stl", "glb"].iter().any(|e| ending == *e));
        if is_model {
            let run = folder.run(&["info", &path.to_string_lossy()]);
            assert!(!run.expect_success().out.contains(" note"), "{run:?}");
        }
    }
}

#[test]
fn a_huge_ground_plane_gets_the_hide_hint() {
    let folder = TestFolder::new("hint-ground");
    let ground = box_obj("ground plane", [-1000.0, -0.1, -1000.0], [1000.0, 0.0, 1000.0], 9);
    let house = box_obj("house", [-5.0, 0.0, -4.0], [5.0, 8.0, 4.0], 1);
    folder.write("village.obj", &(house + &ground));
    let note = notes(&folder, "draw village.obj a.svg --strict");
    assert!(note.contains("the part `ground plane` shrinks everything else to 1 %"), "{note}");
    assert!(note.contains("--hide 'ground plane'"), "{note}");
    let run = folder.run(&["draw", "village.obj", "b.svg", "--hide", "ground plane"]);
    assert!(!run.expect_success().err.contains("note: "), "{run:?}");
    folder.ligne("info village.obj").expect_success().expect_output("--hide 'ground plane'");
}
