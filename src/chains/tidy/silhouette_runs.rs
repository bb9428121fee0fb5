//! Cuts lines where they change between silhouette and inner contour.
//!
//! On rounded surfaces the property flickers, so runs that are too short are merged into their neighbours.

use super::raw_line::RawLine;
use crate::chains::link::edge_class::EdgeClass;
use crate::chains::sampled_line::SampledLine;
use crate::geometry::plane::planar_distance::length;

/// Run of sides that are all silhouette, or all not.
#[derive(Debug, Clone, Copy)]
struct SilhouetteRun {
    first: usize,
    end: usize,
    length: f64,
    value: bool,
    /// Whether all of it lies on sharp edges, where its ends are exact.
    is_hard: bool,
}

/// Minimum lengths of runs, user units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MinRunLengths {
    /// On rounded surfaces, and for lines found in the image.
    pub soft: f64,
    /// On sharp edges.
    pub hard: f64,
}

/// Cuts a line into parts that are all silhouette, or all not, each of the minimum length.
///
/// Returns `None` for a line with a single part. Its class is then set.
pub(crate) fn split_at_silhouette(raw: &mut RawLine, shortest: MinRunLengths) -> Option<Vec<RawLine>> {
    let sides = &raw.line.sides;
    if sides.iter().all(|side| side.silhouette == sides[0].silhouette) {
        raw.class.silhouette = sides[0].silhouette;
        return None;
    }
    // A closed line is opened where the value changes, so that no run passes its seam.
    let n = raw.line.len();
    let change = (0..n).find(|i| sides[*i].silhouette != sides[(i + n - 1) % n].silhouette);
    let opened = raw.line.closed.then(|| raw.line.opened_at(change.unwrap_or(0)));
    let open = opened.as_ref().unwrap_or(&raw.line);
    let runs = merge_short_runs(runs(open), shortest);
    if let [run] = runs[..] {
        raw.class.silhouette = run.value;
        return None;
    }
    let part = |(i, run): (usize, &SilhouetteRun)| {
        let mut part = with_silhouette(raw, open.slice(run.first, run.end), run.value);
        part.covered = [i == 0 && raw.covered[0], i + 1 == runs.len() && raw.covered[1]];
        part
    };
    Some(runs.iter().enumerate().map(part).collect())
}

/// Part of a line. Its vertices are not needed any more.
fn with_silhouette(raw: &RawLine, line: SampledLine, silhouette: bool) -> RawLine {
    RawLine { line, class: EdgeClass { silhouette, ..raw.class }, vertices: Vec::new(), ..*raw }
}

fn runs(line: &SampledLine) -> Vec<SilhouetteRun> {
    let mut runs: Vec<SilhouetteRun> = Vec::new();
    for i in 0..line.len() - 1 {
        let (value, side) = (line.sides[i].silhouette, length(line.points[i + 1] - line.points[i]));
        let is_hard = !line.sides[i].soft;
        match runs.last_mut() {
            Some(run) if run.value == value => {
                run.end = i + 1;
                run.length += side;
                run.is_hard &= is_hard;
            }
            _ => runs.push(SilhouetteRun { first: i, end: i + 1, length: side, value, is_hard }),
        }
    }
    runs
}

/// Merges the shortest run below the minimum with its neighbours, until all runs are long enough.
fn merge_short_runs(mut runs: Vec<SilhouetteRun>, shortest: MinRunLengths) -> Vec<SilhouetteRun> {
    while runs.len() > 1 {
        let least = |run: &SilhouetteRun| if run.is_hard { shortest.hard } else { shortest.soft };
        let too_short = (0..runs.len()).filter(|k| runs[*k].length < least(&runs[*k]));
        let Some(least) = too_short.min_by(|a, b| runs[*a].length.total_cmp(&runs[*b].length)) else { break };
        let low = least.saturating_sub(1);
        let high = (least + 1).min(runs.len() - 1);
        let value = if low == least { runs[high].value } else { runs[low].value };
        let joined = SilhouetteRun {
            first: runs[low].first,
            end: runs[high].end,
            length: runs[low..=high].iter().map(|r| r.length).sum(),
            value,
            is_hard: runs[low..=high].iter().all(|r| r.is_hard),
        };
        runs.splice(low..=high, [joined]);
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lengths that remain of runs that alternate between silhouette and not.
    fn merged_lengths(lengths: &[f64], is_hard: bool) -> Vec<f64> {
        let stretch = |(k, length): (usize, &f64)| SilhouetteRun {
            first: k,
            end: k + 1,
            length: *length,
            value: k % 2 == 0,
            is_hard,
        };
        let stretches = lengths.iter().enumerate().map(stretch).collect();
        merge_short_runs(stretches, MinRunLengths { soft: 12.0, hard: 4.0 })
            .iter()
            .map(|stretch| stretch.length)
            .collect()
    }

    #[test]
    fn merge_short_runs_keeps_shorter_runs_on_sharp_edges() {
        assert_eq!(merged_lengths(&[30.0, 9.0, 40.0], false), [79.0]);
        assert_eq!(merged_lengths(&[30.0, 9.0, 40.0], true), [30.0, 9.0, 40.0]);
        assert_eq!(merged_lengths(&[30.0, 3.0, 40.0], true), [73.0]);
        assert_eq!(merged_lengths(&[3.0, 30.0], true), [33.0]);
    }
}
