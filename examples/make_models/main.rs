//! Writes the example models: `cargo run --release --example make_models [-- DIR]`.
//!
//! The files are identical on all machines, byte for byte. DIR defaults to `examples/models`.

mod buildings;
mod figures;
mod geometry;
mod machines;
mod objects;
mod writers;

use std::path::PathBuf;

use glam::DVec3;

use geometry::part::{Material, Part};

const STEEL: Material = Material { name: "steel", colour: [0.7, 0.72, 0.75], metallic: 1.0, roughness: 0.4 };

fn main() -> std::io::Result<()> {
    let folder = std::env::args_os().nth(1).map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models")),
        PathBuf::from,
    );
    std::fs::create_dir_all(&folder)?;
    let write = |name: &str, bytes: &[u8]| {
        println!("{name}: {} bytes", bytes.len());
        std::fs::write(folder.join(name), bytes)
    };

    let (parts, normals) = objects::teapot::teapot();
    write(
        "teapot.obj",
        writers::obj::text("The Utah teapot, from its published patches", None, &parts, &normals).as_bytes(),
    )?;
    let gear = Part::new("gear", STEEL, machines::gear::gear());
    write("gear.obj", writers::obj::text("A spur gear of 24 teeth, in mm", None, &[gear], &[]).as_bytes())?;
    write("bracket.stl", &writers::stl::bytes("angle bracket, in mm", &machines::bracket::bracket()))?;
    write("pump.glb", &writers::glb::bytes("ligne make_models", &machines::pump::pump_assembly::pump()))?;
    write("drive.glb", &writers::glb::bytes("ligne make_models", &machines::drive::drive()))?;
    let castle = buildings::castle::castle();
    let title = "A little castle, in metres";
    write("castle.obj", writers::obj::text(title, Some("castle.mtl"), &castle, &[]).as_bytes())?;
    write("castle.mtl", writers::obj::library(title, &castle).as_bytes())?;
    let (knot, normals) = objects::knot::knot();
    write("knot.ply", &writers::ply::bytes("a trefoil knot", &knot, &normals))?;
    let (bear, normals) = figures::bear::bear();
    write("bear.ply", &writers::ply::bytes("a bear of soft blobs", &bear, &normals))?;

    // Small models with cases that are difficult to draw.
    let text =
        |title: &str, parts: &[Part], normals: &[Vec<DVec3>]| writers::obj::text(title, None, parts, normals);
    write("shaft.obj", text("A shaft in its bearing, in mm", &machines::shaft::parts(), &[]).as_bytes())?;
    write("drum.obj", text("Planetary gears in a drum, in mm", &machines::drum::parts(), &[]).as_bytes())?;
    let elbow = Part::new("elbow", STEEL, machines::elbow::elbow());
    write("elbow.obj", text("A pipe elbow with flanges, in mm", &[elbow], &[]).as_bytes())?;
    let (blocks, normals) = machines::bevels::parts();
    write("bevels.obj", text("Bevelled blocks with smooth normals, in mm", &blocks, &normals).as_bytes())?;
    write("horn.obj", text("A post horn", &objects::horn::parts(), &[]).as_bytes())?;
    write("goose.obj", text("A goose of few faces", &figures::goose::parts(), &[]).as_bytes())?;
    write("biplane.obj", text("A biplane with doubled skins", &machines::biplane::parts(), &[]).as_bytes())?;
    let (helmet, normals) = figures::helmet::parts();
    let title = "A helmet, one part of four materials";
    write("helmet.obj", writers::obj::text(title, Some("helmet.mtl"), &helmet, &normals).as_bytes())?;
    write("helmet.mtl", writers::obj::library(title, &helmet).as_bytes())?;
    let title = "A jar of marbles, in cm";
    let jar = objects::jar::parts();
    write("jar.obj", writers::obj::text(title, Some("jar.mtl"), &jar, &[]).as_bytes())?;
    write("jar.mtl", objects::jar::library(title, &jar).as_bytes())?;
    write("street.glb", &writers::glb::bytes("ligne make_models", &buildings::street::street()))?;
    write("crane.glb", &writers::glb::bytes("ligne make_models", &machines::crane::crane()))?;
    write("brick.glb", &writers::glb::bytes("ligne make_models", &figures::brick::brick()))?;
    write(
        "shelf.ply",
        &writers::ply::bytes("a scanned vase and a machined gear", &objects::shelf::shelf(), &[]),
    )?;
    write("rack.stl", &writers::stl::bytes("rods behind a wall", &buildings::rack::rack()))?;
    write("picnic.obj", objects::picnic::text().as_bytes())?;
    write("picnic.mtl", objects::picnic::library().as_bytes())?;
    write("picnic-ball.png", &objects::picnic::sectors())?;
    write("picnic-cloth.png", &objects::picnic::checks())?;
    write("easter.obj", objects::easter::text().as_bytes())?;
    write("trellis.obj", buildings::trellis::text().as_bytes())?;
    write("trellis.mtl", buildings::trellis::library().as_bytes())?;
    write("trellis-hole.png", &buildings::trellis::hole())?;
    write("trellis-leaf.png", &buildings::trellis::leaf())?;
    // A brush picture, for drawing with a brush.
    write("brush-dry.png", &objects::brush::dry())
}
