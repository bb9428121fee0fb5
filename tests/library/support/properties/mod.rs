//! One harness for what must not change a drawing: subjects, changes to them, ways to draw them, and how alike the
//! drawings have to be.
//!
//! [`table`] lists what holds of what; [`holds`] asks one property of all of it. A new way to draw, a new scene or a
//! new change is a row there.

pub mod bound;
pub mod change;
pub mod numbering;
pub mod option_set;
pub mod picture;
mod shape;
mod sheets;
pub mod subject;
pub mod table;

use rayon::prelude::*;

use self::bound::Bound;
use self::change::{Change, Property};
use self::option_set::OptionSet;
use self::picture::Picture;
use self::subject::Subject;
use crate::support::scenes::random_dice::Dice;

/// Ways to draw, what they are asked to draw, and what must not change it by more than the bounds allow.
pub struct Row {
    pub options: &'static [OptionSet],
    pub subjects: fn() -> Vec<Subject>,
    pub unchanged_by: &'static [(Change, &'static [Bound])],
    /// With fewer segments of visible lines a drawing proves nothing.
    pub least: usize,
}

/// A subject drawn in one way, and what is done to it.
pub struct Job {
    pub options: OptionSet,
    pub subject: Subject,
    pub changes: Vec<(Change, &'static [Bound])>,
    pub least: usize,
    /// Of the dice that changes throw.
    pub seed: u64,
}

impl Job {
    /// What does not hold, in words.
    pub fn faults(&self) -> Vec<String> {
        let name = format!("{}, {}", self.subject.name, self.options.name);
        // Where the number of threads matters, it is told here as well.
        let threads = self.changes.iter().find_map(|(change, _)| change.threads()).map(|_| 2);
        let here = self.draw(&self.subject, threads);
        let count: usize = here.lines.values().map(Vec::len).sum();
        if count < self.least {
            return vec![format!("{name}: {count} segments are drawn, fewer than {}", self.least)];
        }
        let mut faults = Vec::new();
        for (change, bounds) in &self.changes {
            let changed = change.apply(&self.subject, &mut Dice::new(self.seed));
            let there = self.draw(&changed, change.threads());
            for words in bounds.iter().filter_map(|bound| bound.check(&here, &there).err()) {
                faults.push(format!("{name}, {change:?}: {words}"));
            }
        }
        faults
    }

    fn draw(&self, subject: &Subject, threads: Option<usize>) -> Picture {
        let Some(count) = threads else { return self.options.draw(subject) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        pool.install(|| {
            let picture = self.options.draw(subject);
            // These threads write it, too.
            picture.bytes();
            picture
        })
    }
}

fn jobs(rows: &[Row], property: Property) -> Vec<Job> {
    let mut jobs = Vec::new();
    for row in rows {
        let of_property = |(change, _): &&(Change, _)| change.property() == property;
        let changes: Vec<_> = row.unchanged_by.iter().filter(of_property).copied().collect();
        if changes.is_empty() {
            continue;
        }
        for (subject, seed) in (row.subjects)().into_iter().zip(31..) {
            for options in row.options {
                let (subject, changes) = (subject.clone(), changes.clone());
                jobs.push(Job { options: *options, subject, changes, least: row.least, seed });
            }
        }
    }
    jobs
}

/// Fails with a line for each subject that is not drawn alike after a change that belongs to the property.
pub fn holds(rows: &[Row], property: Property) {
    let is_asked = |row: &Row| row.unchanged_by.iter().any(|(change, _)| change.property() == property);
    assert!(rows.iter().any(is_asked), "nothing is said of {property:?}");
    let jobs = jobs(rows, property);
    let faults: Vec<String> = if property == Property::Threads {
        // One after another: a thread that waits for others would begin the next drawing on top.
        jobs.iter().flat_map(Job::faults).collect()
    } else {
        jobs.par_iter().flat_map_iter(Job::faults).collect()
    };
    assert!(faults.is_empty(), "{} faults in {} drawings\n{}", faults.len(), jobs.len(), faults.join("\n"));
}
