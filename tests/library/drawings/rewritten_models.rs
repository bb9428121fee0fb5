//! Random scenes give the same drawing in other formats, precisions, places, orders and triangulations.
//!
//! A failure names the scene by its seed. `LIGNE_SCENE=SEED` runs all relations on that scene only.
//! `LIGNE_CASES=FOLDER` reduces failing scenes to the fewest bodies, and writes both files and their cameras
//! to the folder:
//!
//! ```text
//! LIGNE_SCENE=17 LIGNE_CASES=cases cargo test --lib rewritten_models::a_hundred -- --nocapture
//! ```
//!
//! `LIGNE_SCENES=300` sets the number of scenes in the long run, by default five thousand.

use std::ops::Range;
use std::path::Path;

use rayon::prelude::*;

use crate::library::support::rewriting::known;
use crate::library::support::rewriting::model::RandomModel;
use crate::library::support::rewriting::relations::Relation;
use crate::library::support::rewriting::table::Table;
use crate::library::support::rewriting::trial::Trial;
use crate::library::support::scenes::random_dice::Dice;

/// Six relations, chosen by the seed.
fn six_relations(seed: u64) -> Vec<Relation> {
    let mut relations = Dice::new(7000 + seed).shuffled(Relation::ALL.to_vec());
    relations.truncate(6);
    relations
}

fn all_relations(_: u64) -> Vec<Relation> {
    Relation::ALL.to_vec()
}

/// Draws random scenes and their rewritten files, prints the table, and fails if more drawings differ than
/// the known failures allow.
fn assert_relations_hold(seeds: Range<u64>, relations: fn(u64) -> Vec<Relation>, is_short: bool) {
    let one =
        std::env::var("LIGNE_SCENE").ok().map(|seed| seed.parse::<u64>().expect("LIGNE_SCENE is a seed"));
    let run = |seed: u64| {
        let relations = if one.is_some() { all_relations(seed) } else { relations(seed) };
        Trial::run_all(&RandomModel::random(seed), &relations)
    };
    let seeds: Vec<u64> = one.map_or_else(|| seeds.collect(), |seed| vec![seed]);
    let trials: Vec<Trial> = seeds.into_par_iter().flat_map_iter(run).collect();
    let faults: Vec<&Trial> = trials.iter().filter(|trial| trial.outcome.is_failure()).collect();
    if let Some(folder) = std::env::var_os("LIGNE_CASES") {
        faults.par_iter().for_each(|fault| fault.reduced().save_in(Path::new(&folder)));
    }
    let table = Table::of(&trials);
    println!("{table}");
    let words = |of: Relation| {
        faults.iter().filter(move |fault| fault.relation == of).map(|fault| fault.description())
    };
    let mut beyond = Vec::new();
    for (relation, row) in &table.0 {
        let known = known::accepted_difference(*relation).filter(|_| one.is_none());
        let limit = known.map_or(0, |known| {
            if is_short {
                known.max_in_short_run
            } else {
                (known.max_share * row.compared as f64).ceil() as usize
            }
        });
        if row.different() > limit {
            let (name, different, made) = (relation.name(), row.different(), row.compared);
            let why = known.map_or("none is known", |known| known.reason);
            beyond.push(format!("{name}: {different} of {made} differ, {limit} may ({why})"));
            beyond.extend(words(*relation));
        }
    }
    assert!(beyond.is_empty(), "{table}\n{}", beyond.join("\n"));
}

#[test]
fn a_hundred_rewritten_scenes_give_the_same_drawings() {
    assert_relations_hold(0..100, six_relations, true);
}

#[test]
#[ignore = "long: .ci/nightly"]
fn five_thousand_rewritten_scenes_give_the_same_drawings() {
    let count =
        std::env::var("LIGNE_SCENES").map_or(5000, |count| count.parse().expect("a number of scenes"));
    assert_relations_hold(1000..1000 + count, all_relations, false);
}
