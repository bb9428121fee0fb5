use super::*;
use crate::mesh::Soup;

/// Squares, each with a corner, size, material and part.
fn squares(some: &[([f64; 3], f64, u32, u32)]) -> Soup {
    let mut soup = Soup::default();
    for (corner, size, material, part) in some {
        let first = soup.positions.len() as u32;
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
            soup.positions.push(DVec3::from(*corner) + DVec3::new(x, y, 0.0) * *size);
        }
        soup.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        soup.triangle_material.extend([MaterialId(*material); 2]);
        soup.triangle_part.extend([PartId(*part); 2]);
    }
    soup
}

/// For each material the rank of its faces plus one, or 0 where they overlap nothing.
fn overlay_ranks(mesh: &Mesh, materials: u32) -> Vec<u32> {
    let rank = |material: u32| {
        let own = (0..mesh.triangles.len() as u32)
            .filter(|face| mesh.face_material[*face as usize] == MaterialId(material));
        let ranks: Vec<u32> =
            own.map(|face| mesh.overlay(face)).map(|o| if o.plane == 0 { 0 } else { o.rank + 1 }).collect();
        assert!(ranks.iter().all(|rank| *rank == ranks[0]), "{ranks:?}");
        ranks[0]
    };
    (0..materials).map(rank).collect()
}

#[test]
fn overlay_order_puts_smaller_and_later_surfaces_on_top() {
    let wall = ([0.0; 3], 10.0, 0, 0);
    let label = |at: [f64; 3], size, material| (at, size, material, 0);
    let of = |some: &[_], count| overlay_ranks(&Mesh::build(squares(some)), count);
    assert_eq!(of(&[wall, label([2.0, 3.0, 0.0], 3.0, 1)], 2), [1, 2]);
    assert_eq!(of(&[wall, label([2.0, 3.0, 0.0], 3.0, 1), label([3.0, 4.0, 0.0], 1.0, 2)], 3), [1, 2, 3]);
    assert_eq!(of(&[wall, label([2.0, 3.0, 0.0], 10.0, 1)], 2), [1, 2]);
    // Next to the wall, at a distance from it, and of the same colour.
    assert_eq!(of(&[wall, label([10.0, 3.0, 0.0], 3.0, 1)], 2), [0, 0]);
    assert_eq!(of(&[wall, label([2.0, 3.0, 0.01], 3.0, 1)], 2), [0, 0]);
    assert_eq!(of(&[wall, (([2.0, 3.0, 0.0]), 3.0, 0, 1)], 1), [0]);
}

#[test]
fn overlay_order_survives_rotation_and_rounding() {
    let turn = glam::DMat3::from_axis_angle(DVec3::new(0.3, -0.5, 0.81).normalize(), 0.7);
    for far in [0.0, 700.0] {
        let mut soup = squares(&[
            ([0.0; 3], 40.0, 0, 0),
            ([12.0, 8.0, 0.0], 12.0, 1, 1),
            ([30.0, 30.0, 0.5], 5.0, 2, 2),
        ]);
        for p in &mut soup.positions {
            *p = (turn * *p + DVec3::splat(far)).as_vec3().as_dvec3();
        }
        soup.single_precision = true;
        assert_eq!(overlay_ranks(&Mesh::build(soup), 3), [1, 2, 0], "{far}");
    }
}

/// Plate with a round hole of 24 facets, and a disc in it whose facets are rotated by `turn` facets.
fn pin_in_plate(turn: f64, radius: f64) -> Soup {
    let at = |radius: f64, k: f64| {
        let angle = std::f64::consts::TAU * k / 24.0;
        DVec3::new(
            radius * crate::geometry::numbers::portable_math::cos(angle),
            radius * crate::geometry::numbers::portable_math::sin(angle),
            0.0,
        )
    };
    let mut soup = Soup::default();
    for k in 0..24 {
        soup.positions.extend([
            at(10.0, f64::from(k)),
            at(4.0, f64::from(k)),
            at(radius, f64::from(k) + turn),
        ]);
        let [a, b, c, d] = [3 * k, 3 * ((k + 1) % 24), 3 * k + 1, 3 * ((k + 1) % 24) + 1];
        soup.triangles.extend([[a, b, c], [c, b, d]]);
        soup.triangle_material.extend([MaterialId(0); 2]);
        if (1..23).contains(&k) {
            soup.triangles.push([2, 3 * k + 2, 3 * k + 5]);
            soup.triangle_material.push(MaterialId(1));
        }
    }
    soup
}

#[test]
fn a_flush_pin_does_not_overlap_its_plate() {
    for turn in [0.0, 0.25, 0.5, 0.9] {
        assert_eq!(overlay_ranks(&Mesh::build(pin_in_plate(turn, 4.0)), 2), [0, 0], "{turn}");
        // A head wider than the hole overlaps the plate.
        assert_eq!(overlay_ranks(&Mesh::build(pin_in_plate(turn, 4.4)), 2), [1, 2], "{turn}");
    }
}
