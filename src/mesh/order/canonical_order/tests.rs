//! Tests that the order of vertices and faces does not depend on the numbering of the file.

use super::*;
use crate::mesh::{EdgeMark, PaintId, Wire};

/// Two triangles that share a side, with all attributes.
fn soup() -> Soup {
    Soup {
        positions: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
            .map(|[x, y]| DVec3::new(x, y, 0.0))
            .to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        triangle_part: vec![PartId(0); 2],
        triangle_material: vec![MaterialId(1), MaterialId(0)],
        triangle_paint: vec![PaintId(4), PaintId(5)],
        normals: (0..6).map(|k| [k as f32, 0.0, 0.0]).collect(),
        corner_normals: vec![[0, 1, 2], [3, 4, 5]],
        uvs: (0..6).map(|k| [k as f32, 0.0]).collect(),
        corner_uvs: vec![[0, 1, NO_ATTRIBUTE], [3, 4, 5]],
        edge_marks: vec![
            [EdgeMark::Hard, EdgeMark::Hidden, EdgeMark::Contour],
            [EdgeMark::Unmarked, EdgeMark::Hard, EdgeMark::Unmarked],
        ],
        wires: vec![
            Wire { vertices: [0, 1], part: PartId(0), material: MaterialId(0) },
            Wire { vertices: [3, 2], part: PartId(0), material: MaterialId(0) },
        ],
        ..Soup::default()
    }
}

/// All contents of a soup, with ids replaced by values.
fn soup_contents(soup: &Soup) -> impl PartialEq + std::fmt::Debug {
    let normals = soup.corner_normals.iter().map(|t| t.map(|id| soup.normals.get(id as usize).copied()));
    let uvs = soup.corner_uvs.iter().map(|t| t.map(|id| soup.uvs.get(id as usize).copied()));
    (
        soup.positions.clone(),
        soup.triangles.clone(),
        (soup.triangle_part.clone(), soup.triangle_material.clone(), soup.triangle_paint.clone()),
        normals.collect::<Vec<_>>(),
        uvs.collect::<Vec<_>>(),
        (soup.edge_marks.clone(), soup.wires.clone()),
    )
}

#[test]
fn for_each_run_processes_whole_runs_in_parallel() {
    // Runs shorter and longer than a task.
    let mut items: Vec<(usize, usize)> = (0..5 * MIN_ITEMS_PER_TASK)
        .map(|k| (k * k / (3 * MIN_ITEMS_PER_TASK * MIN_ITEMS_PER_TASK), (k * 7919) % 10_007))
        .collect();
    let mut expected = items.clone();
    expected.chunk_by_mut(|a, b| a.0 == b.0).for_each(<[_]>::sort_unstable);
    for_each_run(&mut items, |a, b| a.0 == b.0, <[_]>::sort_unstable);
    assert!(items == expected && items[0].0 < items[items.len() - 1].0);
}

#[test]
fn canonical_order_sorts_faces_by_material_and_first_corner() {
    let mut soup = soup();
    assert_eq!(sort_by_position(&mut soup, 1.0), 0);
    // Order along the curve: 0 0, then 1 0, then 0 1, then 1 1.
    let places: Vec<[f64; 2]> = soup.positions.iter().map(|p| [p.x, p.y]).collect();
    assert_eq!(places, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    assert_eq!(soup.triangles, [[0, 3, 2], [0, 1, 3]]);
    assert_eq!(soup.triangle_material, [MaterialId(0), MaterialId(1)]);
    assert_eq!(soup.wires.iter().map(|w| w.vertices).collect::<Vec<_>>(), [[0, 1], [2, 3]]);
}

#[test]
fn canonical_order_does_not_depend_on_the_file_numbering() {
    let mut first = soup();
    sort_by_position(&mut first, 1.0);
    // Other ids, rotated faces, zeros of other sign, a duplicate vertex, and an unused one at an existing
    // position.
    let mut second = soup();
    second.positions = [3, 2, 0, 1, 2].map(|k: usize| soup().positions[k]).to_vec();
    second.triangles = vec![[4, 0, 2], [1, 2, 3]];
    for list in [&mut second.corner_normals, &mut second.corner_uvs] {
        list.reverse();
        *list = list.iter().enumerate().map(|(k, c)| turned(*c, if k == 0 { 1 } else { 2 })).collect();
    }
    second.edge_marks.reverse();
    second.edge_marks =
        second.edge_marks.iter().enumerate().map(|(k, c)| turned(*c, if k == 0 { 1 } else { 2 })).collect();
    second.triangle_material.reverse();
    second.triangle_paint.reverse();
    second.wires[0].vertices = [0, 1];
    second.wires[1].vertices = [3, 2];
    assert_eq!(sort_by_position(&mut second, 1.0), 1);
    assert_eq!(soup_contents(&first), soup_contents(&second));
}

#[test]
fn sort_by_position_merges_vertices_at_equal_positions() {
    let near = DVec3::new(0.5, 0.5, 0.5 + 1e-15);
    let mut soup = Soup {
        positions: vec![near, DVec3::splat(0.5), DVec3::X, near, DVec3::splat(0.5)],
        triangles: vec![[0, 1, 2], [3, 4, 2]],
        ..Soup::default()
    };
    // Two positions in one cell of the curve stay separate.
    assert_eq!(sort_by_position(&mut soup, 1.0), 2);
    assert_eq!(soup.positions, [DVec3::splat(0.5), near, DVec3::X]);
    assert_eq!(soup.triangles, [[0, 2, 1]; 2]);
}

#[test]
fn coincident_faces_are_ordered_by_their_attributes() {
    let twins = |paints: [u32; 2]| {
        let mut soup = Soup {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
            triangles: vec![[0, 1, 2], [1, 2, 0]],
            triangle_paint: paints.map(PaintId).to_vec(),
            ..Soup::default()
        };
        sort_by_position(&mut soup, 1.0);
        soup.triangle_paint
    };
    assert_eq!(twins([7, 8]), twins([8, 7]));
}

#[test]
fn added_vertices_do_not_change_the_order_of_the_others() {
    let order = |far: &[DVec3]| {
        let mut positions: Vec<DVec3> = (0..40)
            .map(|k| DVec3::new(f64::from(k % 7) - 3.0, f64::from(k % 5), f64::from(k)) / 7.0)
            .collect();
        let own = positions.len();
        positions.extend(far);
        let new_id = order_vertices(&mut positions, 1e3);
        let mut ids: Vec<usize> = (0..own).collect();
        ids.sort_by_key(|k| new_id[*k]);
        ids
    };
    assert_eq!(order(&[]), order(&[DVec3::splat(-900.0), DVec3::splat(0.3), DVec3::X * 1e3]));
}
