use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use super::*;
use crate::mesh::Mesh;
use crate::scene::{Alpha, Material, Part, Wrap};

/// Random numbers for tests.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// PNG of white pixels with given opacities.
fn opacity_png(width: usize, opacity: &[u8]) -> Arc<[u8]> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, (opacity.len() / width) as u32);
    encoder.set_color(png::ColorType::GrayscaleAlpha);
    let pixels: Vec<u8> = opacity.iter().flat_map(|o| [255, *o]).collect();
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    Arc::from(bytes)
}

/// Corners of a triangle, their texture coordinates, and its material.
type TexturedTriangle = ([u32; 3], [[f32; 2]; 3], u32);

/// Scene of triangles in the plane z = 0, with a cut-out material (0) and an opaque one (1).
fn scene(positions: &[[f64; 2]], triangles: &[TexturedTriangle], material: Material) -> Scene {
    let geometry = Geometry {
        positions: positions.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).collect(),
        triangles: triangles.iter().map(|t| t.0).collect(),
        uvs: triangles.iter().flat_map(|t| t.1).collect(),
        corner_uvs: (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect(),
        triangle_material: triangles.iter().map(|t| t.2).collect(),
        ..Geometry::default()
    };
    let part = Part { name: "plate".to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY };
    let materials = vec![material, Material::default()];
    Scene { format: "glTF", materials, geometries: vec![geometry], parts: vec![part], ..Scene::default() }
}

fn masked_material(picture: Arc<[u8]>, wrap: Wrap) -> Material {
    let alpha = Alpha::Mask { cutoff: 0.5 };
    Material {
        name: "leaf".to_owned(),
        picture: Some(picture),
        alpha,
        wrap: [wrap; 2],
        ..Material::default()
    }
}

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// Square that shows the whole picture once.
fn square_scene(material: Material) -> Scene {
    let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    scene(&SQUARE, &[([0, 1, 2], [a, b, c], 0), ([0, 2, 3], [a, c, d], 0)], material)
}

fn round_hole_opacity(size: usize, radius: f64) -> Vec<u8> {
    let middle = (size as f64 - 1.0) / 2.0;
    let off = |k: usize| DVec2::new((k % size) as f64 - middle, (k / size) as f64 - middle).length() - radius;
    (0..size * size).map(|k| (127.5 + 255.0 * off(k)).clamp(0.0, 255.0) as u8).collect()
}

/// Ends of the border edges of a scene, and the area of its faces.
fn border_edges_and_area(scene: &Scene) -> (Vec<[DVec2; 2]>, f64) {
    let mesh = Mesh::build(scene.to_soup());
    let at = |v: u32| (mesh.origin + mesh.positions[v as usize]).truncate();
    let is_border = |edge: &usize| matches!(mesh.edges.faces(*edge), crate::mesh::EdgeFaces::One { .. });
    let ends =
        (0..mesh.edges.len()).filter(is_border).map(|edge| mesh.edges.vertices[edge].map(at)).collect();
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(at);
        (b - a).perp_dot(c - a) / 2.0
    };
    (ends, mesh.triangles.iter().map(area).sum())
}

#[test]
fn cut_out_of_a_round_mask_is_a_circle() {
    let scene = square_scene(masked_material(opacity_png(256, &round_hole_opacity(256, 90.0)), Wrap::Repeat));
    let CutScene { scene: cut, warnings, .. } = cut_out(&scene);
    assert!(warnings.is_empty());
    let (edges, area) = border_edges_and_area(&cut);
    let radius = 90.0 / 256.0;
    assert!((area - (1.0 - std::f64::consts::PI * radius * radius)).abs() < 2e-4, "{area}");
    let mut round = 0.0;
    for [a, b] in edges {
        let on_side = |p: DVec2| p.x.min(p.y).min(1.0 - p.x).min(1.0 - p.y);
        if on_side(a).max(on_side(b)) > 1e-9 {
            for p in [a, b, (a + b) / 2.0] {
                let off = (p.distance(DVec2::splat(0.5)) - radius).abs() * 1024.0;
                assert!(off < 0.1 * 4.0, "{off} px at 1024");
            }
            round += a.distance(b);
        }
    }
    // One circle only: no seam along the diagonal.
    assert!((round - std::f64::consts::TAU * radius).abs() < 0.02, "{round}");
}

#[test]
fn cut_out_matches_the_opacity_mask_at_sampled_points() {
    let mut dice = Dice(3);
    for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
        for _ in 0..12 {
            let width = 3 + (dice.roll() * 9.0) as usize;
            let opacity: Vec<u8> = (0..width * 7).map(|_| (dice.roll() * 256.0) as u8).collect();
            let mut uv = || [0, 1].map(|_| (dice.roll() * 4.0 - 1.5) as f32);
            let uvs = [uv(), uv(), uv(), uv()];
            let triangles =
                [([0, 1, 2], [uvs[0], uvs[1], uvs[2]], 0), ([0, 2, 3], [uvs[0], uvs[2], uvs[3]], 0)];
            let material = masked_material(opacity_png(width, &opacity), wrap);
            let scene = scene(&SQUARE, &triangles, material);
            let Ok(CutExtent::Where(mask)) = CutExtent::of(&scene, &scene.materials[0]) else {
                panic!("a mask")
            };
            let CutScene { scene: cut, .. } = cut_out(&scene);
            let mesh = Mesh::build(cut.to_soup());
            let at = |v: u32| (mesh.origin + mesh.positions[v as usize]).truncate();
            let covered = |p: DVec2| {
                mesh.triangles.iter().any(|t| {
                    let [a, b, c] = t.map(at);
                    doubled_area(a, b, p) >= 0.0
                        && doubled_area(b, c, p) >= 0.0
                        && doubled_area(c, a, p) >= 0.0
                })
            };
            for _ in 0..300 {
                let p = DVec2::new(dice.roll(), dice.roll());
                let (_, uvs, _) = triangles[usize::from(p.y > p.x)];
                let corners = uvs.map(|uv| mask.texels.place(uv).unwrap());
                let shares =
                    if p.y > p.x { [1.0 - p.y, p.x, p.y - p.x] } else { [1.0 - p.x, p.x - p.y, p.y] };
                let texel = corners[0] * shares[0] + corners[1] * shares[1] + corners[2] * shares[2];
                let around = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y]
                    .map(|way| mask.is_opaque(texel + way * 0.03));
                // Points closer to the border than the tolerance are not tested.
                if around == [mask.is_opaque(texel); 4] {
                    assert_eq!(covered(p), mask.is_opaque(texel), "{p} at {texel}, {wrap:?}");
                }
            }
        }
    }
}

#[test]
fn cut_out_leaves_no_seam_between_neighbours() {
    let opacity = round_hole_opacity(64, 30.0);
    // The second triangle shows the picture rotated, is opaque, or shows nothing of it.
    for (uvs, material) in [
        ([[1.0, 1.0], [0.0, 0.0], [1.0, 0.0]], 0),
        ([[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]], 1),
        ([[0.0, 0.0]; 3], 0),
    ] {
        let first = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        let triangles = [([0, 1, 2], first, 0), ([0, 2, 3], uvs, material)];
        let scene = scene(&SQUARE, &triangles, masked_material(opacity_png(64, &opacity), Wrap::Repeat));
        let CutScene { scene: cut, .. } = cut_out(&scene);
        // The diagonal is a border where one side is transparent; there the other side is complete.
        let on_diagonal = |[a, b]: &[DVec2; 2]| a.x == a.y && b.x == b.y;
        let (edges, _) = border_edges_and_area(&cut);
        let length: f64 = edges.iter().filter(|e| on_diagonal(e)).map(|[a, b]| a.distance(*b)).sum();
        let clear = if material == 0 && uvs[0] == [1.0, 1.0] { 0.0 } else { 60.0 / 64.0 };
        assert!((length - clear).abs() < 0.01, "{length} of {clear}");
    }
}

#[test]
fn cut_out_interpolates_corner_attributes() {
    let mut scene = square_scene(masked_material(opacity_png(4, &[255, 255, 0, 0].repeat(4)), Wrap::Clamp));
    let geometry = &mut scene.geometries[0];
    geometry.colours = vec![[0.0; 4], [1.0; 4], [1.0; 4], [0.0; 4]];
    geometry.normals = vec![[0.0, 0.0, 1.0]];
    geometry.corner_normals = vec![[0; 3]; 2];
    geometry.edge_marks = vec![[crate::mesh::EdgeMark::Hard; 3]; 2];
    let CutScene { scene: cut, .. } = cut_out(&scene);
    let cut = &cut.geometries[0];
    let used: Vec<u32> = cut.triangles.as_flattened().to_vec();
    for v in used {
        let (at, colour) = (cut.positions[v as usize], cut.colours[v as usize]);
        assert!(at.x <= 0.5 + 1e-9 && (f64::from(colour[0]) - at.x).abs() < 1e-6, "{at} {colour:?}");
    }
    assert_eq!(
        [cut.corner_normals.len(), cut.corner_uvs.len(), cut.edge_marks.len()],
        [cut.triangles.len(); 3]
    );
    assert!(cut.corner_normals.as_flattened().iter().all(|n| cut.normals[*n as usize] == [0.0, 0.0, 1.0]));
    assert!(
        border_edges_and_area(&scene).1 == 1.0
            && (border_edges_and_area(&Scene { geometries: vec![cut.clone()], ..scene.clone() }).1 - 0.5)
                .abs()
                < 1e-9
    );
}

#[test]
fn cut_out_depends_on_alpha_mode_and_cutoff() {
    let faces = |material: Material| {
        let scene = square_scene(material);
        let CutScene { scene: cut, warnings, .. } = cut_out(&scene);
        (cut.geometries[0].triangles.len(), warnings.lines().len())
    };
    let half = || opacity_png(2, &[120, 60]);
    let of = |alpha, picture| Material { alpha, picture, ..Material::default() };
    assert_eq!(faces(of(Alpha::Opaque, Some(half()))), (2, 0));
    assert_eq!(faces(of(Alpha::Mask { cutoff: 0.9 }, Some(half()))), (0, 0));
    assert_eq!(faces(of(Alpha::Mask { cutoff: 0.1 }, Some(half()))), (2, 0));
    // Dirty glass, and a leaf.
    assert_eq!(faces(of(Alpha::Blend, Some(opacity_png(2, &[120, 20])))), (2, 0));
    assert!(faces(of(Alpha::Blend, Some(opacity_png(2, &[120, 0])))).0 > 2);
    let clear = crate::colour::srgb::Colour { a: 0, ..Material::default().colour };
    assert_eq!(faces(Material { colour: clear, ..of(Alpha::Blend, None) }), (0, 0));
    assert_eq!(faces(of(Alpha::Mask { cutoff: 0.5 }, Some(Arc::from(&b"no picture"[..])))), (2, 1));
}

#[test]
fn cut_out_leaves_noisy_masks_and_invalid_indices_uncut() {
    let noise: Vec<u8> = (0..128 * 128).map(|k| if (k + k / 128) % 2 == 0 { 255 } else { 0 }).collect();
    // Each triangle shows the picture eight hundred times.
    let [a, b, c] = [[0.0, 0.0], [40.0, 0.0], [40.0, 40.0]];
    let triangles = vec![([0, 1, 2], [a, b, c], 0); 4];
    let noisy = scene(&SQUARE, &triangles, masked_material(opacity_png(128, &noise), Wrap::Repeat));
    let CutScene { scene: whole, warnings, .. } = cut_out(&noisy);
    assert_eq!(whole.geometries[0].triangles.len(), 4);
    assert!(warnings.lines()[0].contains("too much"), "{:?}", warnings.lines());
    // A hand-made scene may have indices that are out of range.
    let mut scene = square_scene(masked_material(opacity_png(4, &[255, 255, 0, 0].repeat(4)), Wrap::Clamp));
    scene.geometries[0].triangles[1][2] = 99;
    assert_eq!(cut_out(&scene).scene.geometries[0].triangles.len(), 2);
}

#[test]
fn cut_out_borders_of_dense_masks_are_within_about_a_pixel() {
    // Sixteen round holes.
    const RADIUS: f64 = 20.3;
    let hole = round_hole_opacity(64, RADIUS);
    let holes: Vec<u8> = (0..256 * 256).map(|k| hole[k / 256 % 64 * 64 + k % 64]).collect();
    // Number of border segments and their error, for a square that shows the picture `times` times along each
    // side.
    let found = |times: f32| {
        let [a, b, c, d] = SQUARE.map(|at| at.map(|x| x as f32 * times));
        let triangles = [([0, 1, 2], [a, b, c], 0), ([0, 2, 3], [a, c, d], 0)];
        let scene = scene(&SQUARE, &triangles, masked_material(opacity_png(256, &holes), Wrap::Repeat));
        let Ok(CutExtent::Where(mask)) = CutExtent::of(&scene, &scene.materials[0]) else {
            panic!("no mask")
        };
        let outline = super::border_detail::border_index(&scene, 0, &mask).unwrap();
        let px_texels = 2.0_f64.sqrt() / 4096.0 * 256.0 * f64::from(times);
        let off = outline.segments.iter().map(|[a, b]| {
            let middle = (*a + *b) / 2.0;
            let centre = ((middle - 31.5) / 64.0).round() * 64.0 + 31.5;
            (middle.distance(centre) - RADIUS).abs() / px_texels
        });
        (outline.count(), off.fold(0.0, f64::max))
    };
    let (some, fine) = found(20.0);
    assert!(fine < 0.4, "{some} pieces, {fine} px off");
    // At a constant tolerance, three times smaller texels would need 0.58 times the segments.
    let (less, slight) = found(60.0);
    assert!(f64::from(less as u32) < 0.53 * f64::from(some as u32), "{less} pieces of {some}");
    assert!(slight > fine && slight < 1.1, "{fine} and {slight} px off");
}

#[test]
fn cut_out_origins_name_the_triangle_of_each_piece() {
    let scene = square_scene(masked_material(opacity_png(64, &round_hole_opacity(64, 20.0)), Wrap::Repeat));
    let CutScene { scene: cut, origins, .. } = cut_out(&scene);
    let origins = origins[0].as_ref().unwrap();
    let (was, is) = (&scene.geometries[0], &cut.geometries[0]);
    assert_eq!(origins.len(), is.triangles.len());
    for (triangle, origin) in is.triangles.iter().zip(origins) {
        let centre = triangle.iter().map(|v| is.positions[*v as usize]).sum::<DVec3>() / 3.0;
        let [a, b, c] = was.triangles[*origin as usize].map(|v| was.positions[v as usize].truncate());
        let p = centre.truncate();
        assert!(doubled_area(a, b, p) >= 0.0 && doubled_area(b, c, p) >= 0.0 && doubled_area(c, a, p) >= 0.0);
    }
}
