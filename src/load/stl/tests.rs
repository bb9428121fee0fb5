use super::*;

const FACET: &str =
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 .0\nendloop\nendfacet\n";

fn binary_stl(header: &str, triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes[..header.len()].copy_from_slice(header.as_bytes());
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|v| v.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]];

fn error(bytes: &[u8]) -> String {
    read_bytes(bytes, "stem").unwrap_err().to_string()
}

#[test]
fn binary_stl_may_begin_with_solid() {
    let turned = [TRIANGLE[1], TRIANGLE[0], [0.0, 0.0, -1.0]];
    let scene = read_bytes(&binary_stl("solid trap", &[TRIANGLE, turned]), "stem").unwrap();
    let geometry = &scene.geometries[0];
    assert_eq!(geometry.triangles, [[0, 1, 2], [1, 0, 3]]);
    assert_eq!(geometry.positions[2], DVec3::new(0.0, 1.0, 0.5));
    assert!(geometry.single_precision);
    assert_eq!((scene.parts[0].name.as_str(), scene.up), ("stem", UpAxis::Z));
}

#[test]
fn truncated_binary_stl_files_are_refused() {
    let bytes = binary_stl("", &[TRIANGLE; 3]);
    assert!(error(&bytes[..bytes.len() - 1]).contains("says it has 3 triangles, but ends after 2"));
    assert!(error(&bytes[..50]).contains("too few"));
    let mut huge = bytes.clone();
    huge[80..84].copy_from_slice(&[255; 4]);
    assert!(error(&huge).contains("4294967295"));
    let mut long = bytes;
    long.push(0);
    assert_eq!(read_bytes(&long, "").unwrap().warnings.lines(), ["1 bytes after the last triangle left out"]);
}

#[test]
fn text_stl_solids_become_parts() {
    let text = format!("solid one a\n{FACET}endsolid one a\r\nSOLID\n{}endsolid", FACET.to_uppercase());
    let scene = read_bytes(text.as_bytes(), "stem").unwrap();
    let names: Vec<_> = scene.parts.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["one a", "stem"]);
    assert_eq!(scene.geometries[1].positions.len(), 3);
    assert!(!scene.geometries[0].single_precision);
}

#[test]
fn a_solid_without_endsolid_is_read_with_a_warning() {
    for text in [format!("solid x\n{FACET}"), format!("solid x\n{FACET}{FACET}\n\n  ")] {
        let scene = read_bytes(text.as_bytes(), "stem").unwrap();
        assert_eq!(scene.geometries[0].triangles.len(), text.matches("facet normal").count());
        let lines = scene.warnings.lines();
        assert!(lines.len() == 1 && lines[0].contains("without `endsolid`"), "{lines:?}");
    }
    let two = format!("solid a\n{FACET}solid b\n{FACET}endsolid");
    let scene = read_bytes(two.as_bytes(), "stem").unwrap();
    let names: Vec<_> = scene.parts.iter().map(|p| p.name.as_str()).collect();
    assert_eq!((names, scene.warnings.lines().len()), (vec!["a", "b"], 1));
    // A facet that is cut off is an error, as its content is lost.
    for words in 1..FACET.split(' ').count() {
        let cut: Vec<&str> = FACET.split_inclusive(char::is_whitespace).take(words).collect();
        assert!(error(format!("solid x\n{FACET}{}", cut.concat()).as_bytes()).contains("line "), "{words}");
    }
}

#[test]
fn stl_triangles_keep_their_colours_when_others_are_left_out() {
    let mut bad = TRIANGLE;
    bad[2][1] = f32::INFINITY;
    let mut bytes = binary_stl("", &[bad, TRIANGLE, TRIANGLE]);
    for (k, colour) in [0x83e0_u16, 0xfc00, 0x801f].into_iter().enumerate() {
        let at = HEADER_BYTES + RECORD_BYTES * (k + 1) - 2;
        bytes[at..at + 2].copy_from_slice(&colour.to_le_bytes());
    }
    let scene = read_bytes(&bytes, "").unwrap();
    let names: Vec<_> = scene.materials.iter().map(|own| own.name.as_str()).collect();
    assert_eq!((names, &scene.geometries[0].triangle_material), (vec!["#0000ff", "#ff0000"], &vec![1, 0]));
}

#[test]
fn text_stl_errors_name_the_line() {
    assert_eq!(
        error(b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 a"),
        "line 4: `a` stands where a number should"
    );
    assert!(error(b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0").contains("line 4: the file ends"));
    assert!(error(b"solid x\nendsolid\nnonsense").contains("line 3: `nonsense`"));
    assert!(error(b"solid x\nendsolid x").contains("nothing to draw"));
}

#[test]
fn stl_triangles_with_non_finite_vertices_are_left_out() {
    let text = format!("solid\n{FACET}{}endsolid", FACET.replace("vertex 1", "vertex nan"));
    let scene = read_bytes(text.as_bytes(), "").unwrap();
    assert_eq!((scene.geometries[0].triangles.len(), scene.warnings.lines().len()), (1, 1));
    let mut bad = TRIANGLE;
    bad[2][1] = f32::INFINITY;
    let scene = read_bytes(&binary_stl("", &[bad, TRIANGLE]), "").unwrap();
    assert_eq!((scene.geometries[0].triangles.len(), scene.warnings.lines().len()), (1, 1));
    assert!(error(&binary_stl("", &[bad])).contains("nothing to draw"));
}
