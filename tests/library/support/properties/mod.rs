//! Metamorphic tests: a drawing is invariant under changes such as rotation, renumbering or reversed winding.
//!
//! [`table`] lists which changes keep which drawings, and within which bounds; [`assert_property`] tests all rows for
//! one property. A new scene, style or change needs only a new row.
//!
//! Reading order:
//!
//! 1. [`subject`]: scenes with cameras; [`sheets`] builds one with rare features.
//! 2. [`change`]: the changes, implemented in [`shape`] and [`numbering`].
//! 3. [`option_set`]: the ways to draw. [`picture`]: the result of a drawing.
//! 4. [`bound`]: how closely two pictures must agree.
//! 5. [`table`]: the rows.

pub(crate) mod bound;
pub(crate) mod change;
pub(crate) mod numbering;
pub(crate) mod option_set;
pub(crate) mod picture;
mod shape;
mod sheets;
pub(crate) mod subject;
pub(crate) mod table;

use rayon::prelude::*;

use self::bound::Bound;
use self::change::{Change, Property};
use self::option_set::OptionSet;
use self::picture::Picture;
use self::subject::Subject;
use crate::library::support::scenes::random_dice::Dice;

/// A row of the table: every subject is drawn in every way, before and after each change.
pub(crate) struct InvarianceRow {
    pub options: &'static [OptionSet],
    pub subjects: fn() -> Vec<Subject>,
    pub unchanged_by: &'static [(Change, &'static [Bound])],
    /// Minimum number of visible line segments; a drawing with fewer fails the test.
    pub min_segments: usize,
}

/// A subject, a way to draw it, and the changes to test.
pub(crate) struct InvarianceJob {
    pub options: OptionSet,
    pub subject: Subject,
    pub changes: Vec<(Change, &'static [Bound])>,
    pub min_segments: usize,
    /// Random seed of the changes.
    pub seed: u64,
}

impl InvarianceJob {
    /// A message for each bound that is violated.
    pub(crate) fn violations(&self) -> Vec<String> {
        let name = format!("{}, {}", self.subject.name, self.options.name);
        // Changes of the number of threads are compared with a drawing on two threads.
        let threads = self.changes.iter().find_map(|(change, _)| change.threads()).map(|_| 2);
        let here = self.draw(&self.subject, threads);
        let count: usize = here.lines.values().map(Vec::len).sum();
        if count < self.min_segments {
            return vec![format!("{name}: {count} segments are drawn, fewer than {}", self.min_segments)];
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
            // Write the output on these threads, too.
            picture.bytes();
            picture
        })
    }
}

/// The jobs of all rows for one property.
fn jobs(rows: &[InvarianceRow], property: Property) -> Vec<InvarianceJob> {
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
                jobs.push(InvarianceJob {
                    options: *options,
                    subject,
                    changes,
                    min_segments: row.min_segments,
                    seed,
                });
            }
        }
    }
    jobs
}

/// Fails with a message for each drawing that violates a bound under a change of the given property.
pub(crate) fn assert_property(rows: &[InvarianceRow], property: Property) {
    let is_asked =
        |row: &InvarianceRow| row.unchanged_by.iter().any(|(change, _)| change.property() == property);
    assert!(rows.iter().any(is_asked), "nothing is said of {property:?}");
    let jobs = jobs(rows, property);
    let faults: Vec<String> = if property == Property::Threads {
        // Run sequentially: a waiting thread would otherwise start the next drawing nested in the current
        // one.
        jobs.iter().flat_map(InvarianceJob::violations).collect()
    } else {
        jobs.par_iter().flat_map_iter(InvarianceJob::violations).collect()
    };
    assert!(faults.is_empty(), "{} faults in {} drawings\n{}", faults.len(), jobs.len(), faults.join("\n"));
}
