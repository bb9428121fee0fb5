//! `ligne info`: what is in a model file, and what is wrong with it.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use super::model_unit::{self, ModelUnit};
use super::number::{counted, plain};
use super::{pipeline, print};
use crate::error::Error;
use crate::math::colour::Colour;
use crate::pose::{Clip, Rigged};
use crate::scene::framing::{bounds, world_points};
use crate::scene::texture::picture_of;
use crate::scene::{Alpha, LightKind, Projection, Scene, UpAxis};

/// Entries of a list that are shown to people; programs get all.
const SHOWN: usize = 20;

/// What was typed.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne info bunny.obj
  ligne info bracket.stl --unit in
  ligne info drive.glb --json | jq '.parts[].name'")]
pub(super) struct InfoArgs {
    /// The model: .obj, .gltf, .glb, .stl or .ply
    model: PathBuf,

    /// What a unit of the model is: mm, cm, m, in, ft [default: m in glTF, which demands it; the other formats do not say]
    #[arg(long, value_name = "UNIT", value_enum, hide_possible_values = true)]
    unit: Option<ModelUnit>,

    /// Write JSON, for programs
    #[arg(long)]
    json: bool,
}

/// What is in a model file.
#[derive(Debug, Serialize)]
struct Info {
    file: String,
    format: &'static str,
    up: &'static str,
    triangles: u64,
    /// As stored, those that are drawn; instances counted each.
    vertices: u64,
    /// Triangles that the file winds inward or against their neighbours; they are drawn turned.
    turned: TurnedInfo,
    parts: Vec<PartInfo>,
    materials: Vec<MaterialInfo>,
    lights: Vec<LightInfo>,
    cameras: Vec<CameraInfo>,
    animations: Vec<ClipInfo>,
    bounds: Option<BoundsInfo>,
    /// What a unit is, where the format or the call says so.
    unit: Option<&'static str>,
    warnings: Vec<String>,
}

#[derive(Debug, Serialize)]
struct PartInfo {
    name: String,
    triangles: u64,
    wires: u64,
    /// Whether the file says where pictures lie on it.
    texture_coordinates: bool,
    /// Whether its vertices are painted.
    vertex_colours: bool,
    turned: TurnedInfo,
}

/// How many triangles are turned, and in how many connected surfaces.
#[derive(Debug, Clone, Copy, Default, Serialize)]
struct TurnedInfo {
    triangles: u64,
    surfaces: u64,
}

#[derive(Debug, Serialize)]
struct MaterialInfo {
    name: String,
    colour: Colour,
    texture: Option<String>,
    /// Pixels along x and y of the texture, if it can be read; also of one inside the model's file.
    #[serde(skip_serializing_if = "Option::is_none")]
    texture_size: Option<[usize; 2]>,
    /// `opaque`, `mask` or `blend`.
    alpha: &'static str,
    /// How opaque it is, 0 to 1, where one sees through it.
    #[serde(skip_serializing_if = "Option::is_none")]
    opacity: Option<f64>,
    /// The least alpha that a mask leaves.
    #[serde(skip_serializing_if = "Option::is_none")]
    cutoff: Option<f32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    opacity_map: Option<String>,
}

#[derive(Debug, Serialize)]
struct LightInfo {
    name: String,
    kind: &'static str,
}

#[derive(Debug, Serialize)]
struct CameraInfo {
    name: String,
    r#type: &'static str,
}

#[derive(Debug, Serialize)]
struct ClipInfo {
    name: String,
    /// When it begins and ends, in seconds.
    from: f64,
    to: f64,
    /// How many keys a second it has, where it has most; none without two keys.
    rate: Option<f64>,
}

#[derive(Debug, Serialize)]
struct BoundsInfo {
    min: [f64; 3],
    max: [f64; 3],
    /// Along x, y and z, where it is known what a unit is.
    #[serde(skip_serializing_if = "Option::is_none")]
    size_mm: Option<[f64; 3]>,
}

/// Reads the model and says what is in it.
pub(super) fn run(args: &InfoArgs) -> Result<(), Error> {
    let rigged = Rigged::open(&args.model)?;
    let info = Info::of(&rigged.posed(&[])?, &rigged.rig.clips, args);
    if args.json {
        let json = serde_json::to_string_pretty(&info).unwrap_or_default();
        print(format!("{json}\n").as_bytes())
    } else {
        print(info.text().as_bytes())
    }
}

impl Info {
    fn of(scene: &Scene, clips: &[Clip], args: &InfoArgs) -> Self {
        let points = world_points(scene);
        let (of_mesh, turned) = pipeline::mesh_findings(scene);
        let turned_of = |part: usize| {
            let own = turned.iter().find(|own| own.part.index() == part);
            own.map_or_else(TurnedInfo::default, |own| TurnedInfo {
                triangles: own.faces,
                surfaces: own.surfaces,
            })
        };
        let parts: Vec<PartInfo> = scene
            .parts
            .iter()
            .enumerate()
            .map(|(number, part)| {
                let geometry = scene.geometries.get(part.geometry);
                PartInfo {
                    name: part.name.clone(),
                    triangles: geometry.map_or(0, |geometry| geometry.triangles.len() as u64),
                    wires: geometry.map_or(0, |geometry| geometry.wires.len() as u64),
                    texture_coordinates: geometry.is_some_and(|geometry| !geometry.corner_uvs.is_empty()),
                    vertex_colours: geometry.is_some_and(|geometry| !geometry.colours.is_empty()),
                    turned: turned_of(number),
                }
            })
            .collect();
        let mut warnings = scene.warnings.clone();
        warnings.extend(&of_mesh);
        let mut warnings = warnings.lines();
        let bounds = bounds(&points);
        let unit =
            (args.unit.is_some() || model_unit::is_in_metres(scene)).then(|| ModelUnit::of(scene, args.unit));
        if let Some((min, max)) = bounds.filter(|_| args.unit.is_none()) {
            warnings.extend(model_unit::doubt(scene, (max - min).max_element()));
        }
        Self {
            file: args.model.display().to_string(),
            format: scene.format,
            up: match scene.up {
                UpAxis::Y => "y",
                UpAxis::Z => "z",
            },
            triangles: parts.iter().map(|part| part.triangles).sum(),
            vertices: points.len() as u64,
            turned: TurnedInfo {
                triangles: turned.iter().map(|own| own.faces).sum(),
                surfaces: turned.iter().map(|own| own.surfaces).sum(),
            },
            parts,
            materials: scene.materials.iter().map(|material| MaterialInfo::of(scene, material)).collect(),
            lights: scene
                .lights
                .iter()
                .map(|light| LightInfo { name: light.name.clone(), kind: light_kind(light.kind) })
                .collect(),
            cameras: scene
                .cameras
                .iter()
                .map(|named| CameraInfo {
                    name: named.name.clone(),
                    r#type: match named.camera.projection {
                        Projection::Perspective { .. } => "perspective",
                        Projection::Orthographic { .. } => "orthographic",
                    },
                })
                .collect(),
            animations: clips.iter().map(ClipInfo::of).collect(),
            bounds: bounds.map(|(min, max)| BoundsInfo {
                min: min.to_array(),
                max: max.to_array(),
                size_mm: unit.map(|unit| ((max - min) * unit.mm()).to_array()),
            }),
            unit: unit.map(ModelUnit::name),
            warnings,
        }
    }

    /// What is in the file, for people.
    fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}: {}, {} up", self.file, self.format, self.up);
        let _ = writeln!(text, "  {}, {}", counted(self.triangles, "triangle"), vertices(self.vertices));
        if let Some(BoundsInfo { min, max, .. }) = &self.bounds {
            let size: Vec<String> = min.iter().zip(max).map(|(low, high)| short(high - low)).collect();
            let corner = |corner: &[f64; 3]| corner.map(short).join(", ");
            let unit = self.unit.map_or_else(String::new, |unit| format!(" {unit}"));
            let _ =
                writeln!(text, "  {}{unit}, from ({}) to ({})", size.join(" x "), corner(min), corner(max));
        }
        if let Some(turned) = self.turned.words() {
            let _ = writeln!(text, "  {turned}: wound inward or against their neighbours in the file");
        }
        list(&mut text, "part", self.parts.iter().map(PartInfo::line));
        list(&mut text, "material", self.materials.iter().map(MaterialInfo::line));
        list(&mut text, "light", self.lights.iter().map(|light| aside(&light.name, light.kind)));
        list(&mut text, "camera", self.cameras.iter().map(|camera| aside(&camera.name, camera.r#type)));
        list(&mut text, "animation", self.animations.iter().map(ClipInfo::line));
        list(&mut text, "warning", self.warnings.iter().cloned());
        text
    }
}

impl ClipInfo {
    fn of(clip: &Clip) -> Self {
        let [from, to] = clip.span();
        Self { name: clip.name.clone(), from, to, rate: clip.rate() }
    }

    fn line(&self) -> String {
        let begins = if self.from == 0.0 { String::new() } else { format!(", from {} s", short(self.from)) };
        let keys = |rate: f64| {
            let rate = short(rate);
            format!(", {rate} {} a second", if rate == "1" { "key" } else { "keys" })
        };
        let keys = self.rate.map_or_else(String::new, keys);
        format!("{}: {} s{begins}{keys}", named(&self.name), short(self.to - self.from))
    }
}

impl PartInfo {
    fn line(&self) -> String {
        let lines = if self.wires > 0 { format!(", {}", counted(self.wires, "line")) } else { String::new() };
        let painted = match (self.texture_coordinates, self.vertex_colours) {
            (true, true) => ", texture coordinates, coloured vertices",
            (true, false) => ", texture coordinates",
            (false, true) => ", coloured vertices",
            (false, false) => "",
        };
        let turned = self.turned.words().map_or_else(String::new, |turned| format!(", {turned}"));
        format!("{}: {}{lines}{painted}{turned}", named(&self.name), counted(self.triangles, "triangle"))
    }
}

impl TurnedInfo {
    /// The counts, for people; none if nothing is turned.
    fn words(&self) -> Option<String> {
        let Self { triangles, surfaces } = *self;
        let is_any = triangles > 0;
        is_any
            .then(|| format!("{} turned in {}", counted(triangles, "triangle"), counted(surfaces, "surface")))
    }
}

impl MaterialInfo {
    fn of(scene: &Scene, material: &crate::scene::Material) -> Self {
        let (alpha, cutoff) = match material.alpha {
            Alpha::Mask { cutoff } => ("mask", Some(cutoff)),
            Alpha::Blend => ("blend", None),
            Alpha::Opaque => ("opaque", None),
        };
        Self {
            name: material.name.clone(),
            colour: material.colour,
            texture: material.texture.clone(),
            texture_size: picture_of(scene, material)
                .and_then(Result::ok)
                .map(|picture| [picture.width, picture.height]),
            alpha,
            opacity: Some(material.opacity()).filter(|own| *own < 1.0),
            cutoff,
            opacity_map: material.opacity_map.clone(),
        }
    }

    fn line(&self) -> String {
        let texture = match (&self.texture, self.texture_size) {
            (Some(file), Some([width, height])) => format!(", texture {file}, {width} x {height} px"),
            (Some(file), None) => format!(", texture {file}"),
            (None, Some([width, height])) => format!(", texture inside the file, {width} x {height} px"),
            (None, None) => String::new(),
        };
        let alpha = match (self.alpha, self.cutoff) {
            (_, Some(cutoff)) => format!(", cut out below alpha {cutoff}"),
            ("blend", _) => ", blended".to_owned(),
            _ => String::new(),
        };
        let clear = self.opacity.map_or(String::new(), |own| format!(", {} % opaque", plain(own * 100.0, 0)));
        let map = self.opacity_map.as_ref().map_or(String::new(), |file| format!(", cut out by {file}"));
        format!("{}: {}{texture}{alpha}{clear}{map}", named(&self.name), String::from(self.colour))
    }
}

fn light_kind(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Directional { .. } => "directional",
        LightKind::Point { .. } => "point",
        LightKind::Spot { .. } => "spot",
    }
}

fn vertices(n: u64) -> String {
    counted(n, "vertex").replace("vertexs", "vertices")
}

fn aside(name: &str, kind: &str) -> String {
    format!("{}: {kind}", named(name))
}

fn named(name: &str) -> &str {
    if name.is_empty() { "(no name)" } else { name }
}

/// A coordinate with six digits that count.
fn short(value: f64) -> String {
    let large = value.abs() >= 1e9 || (value != 0.0 && value.abs() < 1e-4);
    if large {
        return format!("{value:.5e}");
    }
    let before_point = if value.abs() < 1.0 { 0 } else { value.abs() as u64 }.to_string().len();
    plain(value, 7_usize.saturating_sub(before_point).min(6))
}

/// A heading with the count, and the entries below it; nothing for an empty list.
fn list(text: &mut String, noun: &str, entries: impl ExactSizeIterator<Item = String>) {
    let n = entries.len();
    if n == 0 {
        return;
    }
    let _ = writeln!(text, "  {}:", counted(n as u64, noun));
    for entry in entries.take(SHOWN) {
        // A name may hold line ends or the codes of a terminal.
        let _ = writeln!(text, "    {}", entry.replace(char::is_control, " "));
    }
    if n > SHOWN {
        let _ = writeln!(text, "    and {} more (--json lists all)", n - SHOWN);
    }
}

#[cfg(test)]
mod tests {
    use glam::{DAffine3, DVec3};

    use super::*;
    use crate::pose::{Channel, Interpolation, Property, Target, Track};
    use crate::scene::{Geometry, Material, Part};

    fn scene(parts: usize) -> Scene {
        let geometry = Geometry {
            positions: vec![DVec3::ZERO, DVec3::X * 12.5, DVec3::Y],
            triangles: vec![[0, 1, 2]],
            wires: vec![[0, 1]],
            ..Geometry::default()
        };
        let part = |n: usize| Part {
            name: format!("bolt\u{1b}{n}"),
            geometry: 0,
            world_from_part: DAffine3::from_translation(DVec3::Z * n as f64),
        };
        let mut scene = Scene {
            format: "OBJ",
            geometries: vec![geometry],
            parts: (0..parts).map(part).collect(),
            materials: vec![Material::default()],
            ..Scene::default()
        };
        scene.warnings.count("doubled faces", 3);
        scene
    }

    fn walk() -> Clip {
        let track = Track::new(vec![0.5, 1.0, 2.5], vec![0.0; 9], Interpolation::Linear).unwrap();
        Clip {
            name: "Walk".to_owned(),
            channels: vec![Channel { target: Target::Node(0, Property::Scale), track }],
        }
    }

    fn args(model: &str) -> InfoArgs {
        InfoArgs { model: model.into(), unit: None, json: false }
    }

    #[test]
    fn people_read_lists_of_a_bearable_length() {
        let text = Info::of(&scene(22), &[walk()], &args("m.obj")).text();
        let start = "m.obj: OBJ, y up\n  22 triangles, 66 vertices\n  12.5 x 1 x 21, from (0, 0, 0) to (12.5, 1, 21)\n  \
                     22 parts:\n    bolt 0: 1 triangle, 1 line\n";
        assert!(text.starts_with(start), "{text}");
        assert!(text.contains("    and 2 more (--json lists all)\n  1 material:\n    (no name): #cccccc\n"));
        assert!(
            text.contains("  1 animation:\n    Walk: 2 s, from 0.5 s, 1 key a second\n")
                && text.contains("    3 doubled faces\n"),
            "{text}"
        );
        assert!(!text.contains("camera") && !text.contains("light"));
    }

    #[test]
    fn people_read_what_parts_are_painted_by() {
        let mut scene = scene(1);
        scene.geometries[0].corner_uvs = vec![[0; 3]];
        assert!(
            Info::of(&scene, &[], &args("m.obj"))
                .text()
                .contains(": 1 triangle, 1 line, texture coordinates\n")
        );
        scene.geometries[0].colours = vec![[1.0; 4]; 3];
        let text = Info::of(&scene, &[], &args("m.obj")).text();
        assert!(text.contains(", texture coordinates, coloured vertices\n"), "{text}");
    }

    #[test]
    fn parts_that_are_wound_inward_are_named() -> Result<(), serde_json::Error> {
        let mut scene = scene(2);
        scene.geometries[0].positions.push(DVec3::Z);
        // A tetrahedron that is wound inward.
        scene.geometries[0].triangles = vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]];
        scene.geometries[0].wires.clear();
        let mut right = scene.geometries[0].clone();
        right.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        scene.geometries.push(right);
        scene.parts[1].geometry = 1;
        let info = Info::of(&scene, &[], &args("m.obj"));
        let text = info.text();
        let wanted = "  4 triangles turned in 1 surface: wound inward or against their neighbours in the file\n  2 parts:\n    \
                      bolt 0: 4 triangles, 4 triangles turned in 1 surface\n    bolt 1: 4 triangles\n";
        assert!(text.contains(wanted), "{text}");
        let value: serde_json::Value = serde_json::from_str(&serde_json::to_string(&info)?)?;
        assert_eq!(value["turned"], serde_json::json!({"triangles": 4, "surfaces": 1}));
        assert_eq!(value["parts"][0]["turned"]["triangles"], 4);
        assert_eq!(value["parts"][1]["turned"]["triangles"], 0);
        Ok(())
    }

    #[test]
    fn programs_read_everything() -> Result<(), serde_json::Error> {
        let json = serde_json::to_string(&Info::of(&scene(22), &[walk()], &args("m.obj")))?;
        let value: serde_json::Value = serde_json::from_str(&json)?;
        assert_eq!(value["parts"].as_array().map(Vec::len), Some(22));
        assert_eq!(value["parts"][3]["name"], "bolt\u{1b}3");
        assert_eq!(value["bounds"]["max"], serde_json::json!([12.5, 1.0, 21.0]));
        assert_eq!(value["warnings"][0], "3 doubled faces");
        Ok(())
    }

    #[test]
    fn an_empty_model_has_no_bounds() {
        assert!(
            Info::of(&scene(0), &[], &args("m.obj")).text().starts_with("m.obj: OBJ, y up\n  0 triangles")
        );
    }

    #[test]
    fn coordinates_are_short() {
        let numbers = [0.0, -1.5, 4_600_000.123, 1e-7, 3e9, 77.990_000_1, 0.25];
        let texts = ["0", "-1.5", "4600000", "1.00000e-7", "3.00000e9", "77.99", "0.25"];
        assert_eq!(numbers.map(short), texts);
    }
}
