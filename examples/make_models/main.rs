//! Writes the example models: `cargo run --release --example make_models [-- DIR]`.
//!
//! The files come out the same to the byte on every machine; DIR is `examples/models` unless given.

mod bear;
mod bevels;
mod biplane;
mod bracket;
mod brick;
mod brush;
mod castle;
mod castle_parts;
mod cogs;
mod crane;
mod creased;
mod drive;
mod drum;
mod easter;
mod elbow;
mod gear;
mod glb;
mod goose;
mod helmet;
mod horn;
mod jar;
mod knot;
mod obj;
mod outline;
mod part;
mod patches;
mod picnic;
mod ply;
mod polygon;
mod pump;
mod pump_motor;
mod pump_parts;
mod rack;
mod shaft;
mod shelf;
mod shop;
mod solid;
mod stl;
mod street;
mod sweep;
mod teapot;
mod trellis;

use std::path::PathBuf;

use glam::DVec3;

use part::{Material, Part};

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

    let (parts, normals) = teapot::teapot();
    write(
        "teapot.obj",
        obj::text("The Utah teapot, from its published patches", None, &parts, &normals).as_bytes(),
    )?;
    let gear = Part::new("gear", STEEL, gear::gear());
    write("gear.obj", obj::text("A spur gear of 24 teeth, in mm", None, &[gear], &[]).as_bytes())?;
    write("bracket.stl", &stl::bytes("angle bracket, in mm", &bracket::bracket()))?;
    write("pump.glb", &glb::bytes("ligne make_models", &pump::pump()))?;
    write("drive.glb", &glb::bytes("ligne make_models", &drive::drive()))?;
    let castle = castle::castle();
    let title = "A little castle, in metres";
    write("castle.obj", obj::text(title, Some("castle.mtl"), &castle, &[]).as_bytes())?;
    write("castle.mtl", obj::library(title, &castle).as_bytes())?;
    let (knot, normals) = knot::knot();
    write("knot.ply", &ply::bytes("a trefoil knot", &knot, &normals))?;
    let (bear, normals) = bear::bear();
    write("bear.ply", &ply::bytes("a bear of soft blobs", &bear, &normals))?;

    // Small models that are hard to see right.
    let text = |title: &str, parts: &[Part], normals: &[Vec<DVec3>]| obj::text(title, None, parts, normals);
    write("shaft.obj", text("A shaft in its bearing, in mm", &shaft::parts(), &[]).as_bytes())?;
    write("drum.obj", text("Planetary gears in a drum, in mm", &drum::parts(), &[]).as_bytes())?;
    let elbow = Part::new("elbow", STEEL, elbow::elbow());
    write("elbow.obj", text("A pipe elbow with flanges, in mm", &[elbow], &[]).as_bytes())?;
    let (blocks, normals) = bevels::parts();
    write("bevels.obj", text("Bevelled blocks with smooth normals, in mm", &blocks, &normals).as_bytes())?;
    write("horn.obj", text("A post horn", &horn::parts(), &[]).as_bytes())?;
    write("goose.obj", text("A goose of few faces", &goose::parts(), &[]).as_bytes())?;
    write("biplane.obj", text("A biplane with doubled skins", &biplane::parts(), &[]).as_bytes())?;
    let (helmet, normals) = helmet::parts();
    let title = "A helmet, one part of four materials";
    write("helmet.obj", obj::text(title, Some("helmet.mtl"), &helmet, &normals).as_bytes())?;
    write("helmet.mtl", obj::library(title, &helmet).as_bytes())?;
    let title = "A jar of marbles, in cm";
    let jar = jar::parts();
    write("jar.obj", obj::text(title, Some("jar.mtl"), &jar, &[]).as_bytes())?;
    write("jar.mtl", jar::library(title, &jar).as_bytes())?;
    write("street.glb", &glb::bytes("ligne make_models", &street::street()))?;
    write("crane.glb", &glb::bytes("ligne make_models", &crane::crane()))?;
    write("brick.glb", &glb::bytes("ligne make_models", &brick::brick()))?;
    write("shelf.ply", &ply::bytes("a scanned vase and a machined gear", &shelf::shelf(), &[]))?;
    write("rack.stl", &stl::bytes("rods behind a wall", &rack::rack()))?;
    write("picnic.obj", picnic::text().as_bytes())?;
    write("picnic.mtl", picnic::library().as_bytes())?;
    write("picnic-ball.png", &picnic::sectors())?;
    write("picnic-cloth.png", &picnic::checks())?;
    write("easter.obj", easter::text().as_bytes())?;
    write("trellis.obj", trellis::text().as_bytes())?;
    write("trellis.mtl", trellis::library().as_bytes())?;
    write("trellis-hole.png", &trellis::hole())?;
    write("trellis-leaf.png", &trellis::leaf())?;
    // No model, but a brush to draw one with.
    write("brush-dry.png", &brush::dry())
}
