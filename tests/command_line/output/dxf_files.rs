//! DXF output of `ligne draw`: releases, lengths and dropped fills, audited with ezdxf.

use std::process::Command;

use crate::folder::TestFolder;

#[test]
fn dxf_options_set_release_and_lengths() {
    let folder = TestFolder::with_cubes("dxf");
    folder.ligne("draw cubes.obj a.dxf --view iso").expect_success();
    assert!(folder.text("a.dxf").contains("AC1009"));
    folder.ligne("draw cubes.obj b.dxf --view iso --dxf 2000 --dxf-length model").expect_success();
    let modern = folder.text("b.dxf");
    assert!(modern.contains("AC1015") && modern.contains("$INSUNITS\r\n70\r\n0\r\n"));
    assert_ne!(folder.text("a.dxf"), modern);
    folder.ligne("draw cubes.obj c.dxf --view iso --threads 1").expect_success();
    assert_eq!(folder.read("a.dxf"), folder.read("c.dxf"));
    // A perspective drawing has no true lengths.
    let run = folder.ligne("draw cubes.obj d.dxf --dxf-length model");
    assert_eq!(run.status, Some(2));
    assert!(run.err.contains("--ortho"), "{}", run.err);
    assert!(!folder.path("d.dxf").exists());
}

/// Drawings in model lengths line up: lines of a part have the same coordinates as in the whole model.
#[test]
fn dxf_model_lengths_are_measured_from_the_model_origin() {
    let folder = TestFolder::with_cubes("dxf-origin");
    let corners = |line: &str| -> Vec<[i64; 2]> {
        folder
            .ligne(&format!("draw cubes.obj a.dxf --style technical --dxf-length model {line}"))
            .expect_success();
        let text = folder.text("a.dxf");
        let lines: Vec<&str> = text.split("\r\n").skip_while(|line| *line != "ENTITIES").skip(1).collect();
        let pairs: Vec<(&str, &str)> = lines.chunks_exact(2).map(|pair| (pair[0].trim(), pair[1])).collect();
        let near = |value: &str| (value.parse::<f64>().expect("a number") * 1e4).round() as i64;
        let points = pairs.windows(2).filter(|two| two[0].0 == "10" && two[1].0 == "20");
        points.map(|two| [near(two[0].1), near(two[1].1)]).filter(|at| *at != [0, 0]).collect()
    };
    for view in ["top", "front", "right"] {
        let whole = corners(&format!("--view {view}"));
        for more in ["--only base", "--only knob --page A4 --scale 3:1", "--only base --page A3 --scale 1:2"]
        {
            let own = corners(&format!("--view {view} {more}"));
            assert!(!own.is_empty());
            let known = own.iter().filter(|at| whole.contains(at)).count();
            assert!(2 * known >= own.len(), "{view} {more}: {own:?} of {whole:?}");
        }
    }
}

#[test]
fn older_dxf_releases_warn_about_dropped_fills() {
    let folder = TestFolder::with_cubes("dxf-fills");
    let run = folder.ligne("draw cubes.obj a.dxf --style toon");
    assert!(run.err.contains("--dxf 2000 keeps fills"), "{}", run.err);
    let run = folder.ligne("draw cubes.obj b.dxf --style toon --dxf 2000");
    assert!(!run.err.contains("warning"), "{}", run.err);
}

/// The audit of ezdxf finds no errors and fixes nothing.
#[test]
fn ezdxf_finds_no_error() {
    let folder = TestFolder::with_cubes("dxf-audit");
    for (name, more) in
        [("a", "--style technical"), ("b", "--style toon --dxf 2000"), ("c", "--style pencil --dxf 2000")]
    {
        folder.ligne(&format!("draw cubes.obj {name}.dxf {more}")).expect_success();
    }
    folder.write(
        "audit.py",
        "import sys, ezdxf\nfor name in 'abc':\n    found = ezdxf.readfile(sys.argv[1] + '/' + name + '.dxf').audit()\n    \
         print(name, len(found.errors), len(found.fixes))\n",
    );
    let run = Command::new("python3").arg(folder.path("audit.py")).arg(folder.path("")).output();
    match run {
        Ok(run) if run.status.success() => {
            assert_eq!(String::from_utf8_lossy(&run.stdout), "a 0 0\nb 0 0\nc 0 0\n");
        }
        _ => println!("skipped: python3 with ezdxf is not there"),
    }
}
