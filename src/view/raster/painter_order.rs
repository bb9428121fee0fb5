//! Painter's order: the visible faces, each after the faces it covers.
//!
//! Source: Newell, Newell and Sancha, "A solution to the hidden surface problem", 1972. Here the buffer gives
//! the last face at each pixel, and depth only breaks ties.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::parallel::prelude::*;

use super::{FaceBuffer, PixelGrid};

/// Triangles per task.
const TRIANGLES_PER_TASK: usize = 1 << 13;

/// Visible faces, in an order that paints what `buffer` shows. In a cycle, the farthest face comes first.
#[must_use]
pub(crate) fn back_to_front(screen: &PixelGrid, buffer: &FaceBuffer) -> Vec<u32> {
    let mut shown: Vec<u32> =
        (0..buffer.columns * buffer.rows).filter_map(|pixel| buffer.front(pixel)).collect();
    shown.par_sort_unstable();
    shown.dedup();
    let slot = |face: u32| shown.binary_search(&face).ok();
    // Nearness of each face, as bits that sort positive numbers, and pairs of faces painted over each other.
    let count = screen.triangle_count();
    type Task = (Vec<(usize, u32)>, Vec<[u32; 2]>);
    let tasks: Vec<Task> = (0..count.div_ceil(TRIANGLES_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|task| {
            let (mut nearness_bits, mut overlaps) = (Vec::new(), Vec::new());
            for id in task * TRIANGLES_PER_TASK..((task + 1) * TRIANGLES_PER_TASK).min(count) {
                let (corners, face) = screen.triangle(id);
                let Some(slot_index) = slot(face) else { continue };
                nearness_bits.push((
                    slot_index,
                    ((corners[0][2] + corners[1][2] + corners[2][2]) / 3.0).max(0.0).to_bits(),
                ));
                screen.cover(&corners, |pixel, _| {
                    if let Some(front) = buffer.front(pixel).filter(|front| *front != face)
                        && let Some(front) = slot(front)
                    {
                        overlaps.push([slot_index as u32, front as u32]);
                    }
                });
                overlaps.dedup();
            }
            (nearness_bits, overlaps)
        })
        .collect();
    let mut nearness = vec![0; shown.len()];
    let mut over: Vec<[u32; 2]> = Vec::new();
    for (near, pairs) in tasks {
        for (index, bits) in near {
            nearness[index] = bits.max(nearness[index]);
        }
        over.extend(pairs);
    }
    over.par_sort_unstable();
    over.dedup();
    sorted(&nearness, &over).into_iter().map(|slot| shown[slot as usize]).collect()
}

/// Topological sort: every slot once, and the first of each pair before the second. In a cycle, the farthest
/// slot comes first.
pub(crate) fn sorted(nearness: &[u32], over: &[[u32; 2]]) -> Vec<u32> {
    let mut awaited = vec![0_u32; nearness.len()];
    for [_, above] in over {
        awaited[*above as usize] += 1;
    }
    let key = |slot: u32| (nearness[slot as usize], slot);
    let mut by_depth: Vec<u32> = (0..nearness.len() as u32).collect();
    by_depth.sort_unstable_by_key(|slot| key(*slot));
    let free = by_depth.iter().filter(|slot| awaited[**slot as usize] == 0);
    let mut ready: BinaryHeap<Reverse<(u32, u32)>> = free.map(|slot| Reverse(key(*slot))).collect();
    let mut done = vec![false; nearness.len()];
    let mut order = Vec::with_capacity(nearness.len());
    let mut left = by_depth.into_iter();
    while order.len() < nearness.len() {
        let next = match ready.pop() {
            Some(Reverse((_, slot))) => Some(slot),
            None => left.by_ref().find(|slot| !done[*slot as usize]),
        };
        let Some(slot) = next else { break };
        if std::mem::replace(&mut done[slot as usize], true) {
            continue;
        }
        order.push(slot);
        let first = over.partition_point(|pair| pair[0] < slot);
        for [_, above] in over[first..].iter().take_while(|pair| pair[0] == slot) {
            let waits = &mut awaited[*above as usize];
            *waits -= 1;
            if *waits == 0 && !done[*above as usize] {
                ready.push(Reverse(key(*above)));
            }
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::{Mesh, Soup};
    use crate::scene::{Camera, UpAxis};
    use crate::view::View;

    #[test]
    fn painter_order_breaks_cycles_at_the_farthest_face() {
        assert_eq!(sorted(&[3, 2, 1], &[[0, 1], [1, 2], [2, 0]]), [2, 0, 1]);
        assert_eq!(sorted(&[3, 2, 1], &[[0, 2]]), [1, 0, 2]);
        assert_eq!(sorted(&[5, 5, 5], &[]), [0, 1, 2]);
    }

    #[test]
    fn painter_order_draws_a_plate_before_a_face_above_it() {
        // The middle of the plate is nearer to the eye than the small triangle above its far corner.
        let corners = [[0., 0., 0.], [90., 0., 40.], [0., 90., 0.], [1., 1., 5.], [6., 1., 5.], [1., 6., 5.]];
        let positions: Vec<DVec3> = corners.iter().map(|p| DVec3::from(*p)).collect();
        let soup =
            Soup { positions: positions.clone(), triangles: vec![[0, 1, 2], [3, 4, 5]], ..Soup::default() };
        let mesh = Mesh::build(soup);
        let camera = Camera::azimuth_elevation(0.0, 90.0, UpAxis::Z).fit_points(&positions, 0.0);
        let view = View::new(&mesh, &camera);
        let screen = PixelGrid::new(&mesh, &view);
        let buffer = FaceBuffer::new(&screen);
        assert_eq!(back_to_front(&screen, &buffer), [0, 1]);
    }
}
