//! Bounds on the difference between two pictures.

use std::collections::BTreeMap;

use kurbo::Point;

use super::picture::{LineKey, Picture};
use crate::library::support::measures::segment_sets::{total_length, uncovered_length};

/// How lines are grouped before they are compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum GroupBy {
    Class,
    ClassAndPart,
}

/// A bound on the difference between two pictures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Bound {
    /// All bytes are equal.
    Bytes,
    /// Visible lines agree within `nearness` px, except for `slack` px plus a `share` of their length.
    Lines { by: GroupBy, nearness: f64, slack: f64, share: f64 },
    /// The length of intersection lines per part is equal, and at least `least` parts have such lines.
    IntersectionLengths { least: usize },
    /// The filled area per colour and part agrees within a share of the total.
    Areas { share: f64 },
    /// The length of hatching strokes per part agrees within a share of the total.
    Strokes { share: f64 },
}

impl Bound {
    pub(crate) const fn by_class(nearness: f64, slack: f64) -> Self {
        Self::by_class_with_share(nearness, slack, 0.0)
    }

    pub(crate) const fn by_class_with_share(nearness: f64, slack: f64, share: f64) -> Self {
        Self::Lines { by: GroupBy::Class, nearness, slack, share }
    }

    pub(crate) const fn by_class_and_part(nearness: f64, slack: f64) -> Self {
        Self::Lines { by: GroupBy::ClassAndPart, nearness, slack, share: 0.0 }
    }

    /// Fails with the difference, or if there is nothing to compare.
    pub(crate) fn check(self, one: &Picture, other: &Picture) -> Result<(), String> {
        match self {
            Self::Bytes => check_bytes(one.bytes(), other.bytes()),
            Self::Lines { by, nearness, slack, share } => {
                let [one, other] = [one, other].map(|picture| group_lines(picture, by));
                check_lines(&one, &other, nearness, slack, share)
            }
            Self::IntersectionLengths { least } => {
                let (owned, others) = (one.intersection_lengths(), other.intersection_lengths());
                if owned.len() < least || owned != others {
                    return Err(format!("lines along intersections belong to {owned:?}, then to {others:?}"));
                }
                Ok(())
            }
            Self::Areas { share } => check_amounts(&one.fill_areas(), &other.fill_areas(), share),
            Self::Strokes { share } => {
                check_amounts(&one.hatching_lengths(), &other.hatching_lengths(), share)
            }
        }
    }
}

/// Lines by class and part.
type LineGroups = BTreeMap<LineKey, Vec<[Point; 2]>>;

fn group_lines(picture: &Picture, by: GroupBy) -> LineGroups {
    let mut groups = LineGroups::new();
    for ((class, part), lines) in &picture.lines {
        let part = if by == GroupBy::Class { String::new() } else { part.clone() };
        groups.entry((class.clone(), part)).or_default().extend(lines);
    }
    groups
}

/// Fails if the uncovered length, summed over all groups, exceeds the bound in either direction.
fn check_lines(
    one: &LineGroups,
    other: &LineGroups,
    nearness: f64,
    slack: f64,
    share: f64,
) -> Result<(), String> {
    let nothing = Vec::new();
    let lost = |from: &LineGroups, by: &LineGroups| -> BTreeMap<LineKey, f64> {
        let of = |(key, lines): (&LineKey, &Vec<_>)| {
            (key.clone(), uncovered_length(lines, by.get(key).unwrap_or(&nothing), nearness))
        };
        from.iter().map(of).collect()
    };
    let whole: f64 = one.values().map(|lines| total_length(lines)).sum();
    let most = slack + share * whole;
    for (what, lost) in [("gone", lost(one, other)), ("new", lost(other, one))] {
        let sum: f64 = lost.values().sum();
        if sum > most {
            let by_key: Vec<_> = lost.iter().filter(|(_, length)| **length > 1e-9).collect();
            return Err(format!("of {whole:.1} px {sum:.3e} are {what}: {by_key:?}"));
        }
    }
    Ok(())
}

/// Fails if an amount differs by more than a share of the total.
fn check_amounts(
    one: &BTreeMap<LineKey, f64>,
    other: &BTreeMap<LineKey, f64>,
    share: f64,
) -> Result<(), String> {
    let whole: f64 = one.values().sum();
    if whole <= 0.0 {
        return Err("there is nothing to compare".into());
    }
    for key in one.keys().chain(other.keys()) {
        let [a, b] = [one, other].map(|amounts| amounts.get(key).copied().unwrap_or_default());
        if (a - b).abs() > share * whole {
            return Err(format!("{key:?}: {a:.2}, then {b:.2}, of {whole:.2}"));
        }
    }
    Ok(())
}

/// Fails with the first differing byte and its surroundings.
fn check_bytes(one: &str, other: &str) -> Result<(), String> {
    if one == other {
        return Ok(());
    }
    let at = one.bytes().zip(other.bytes()).take_while(|(a, b)| a == b).count();
    let around = |text: &str| {
        let bytes = text.as_bytes();
        let end = (at + 60).min(bytes.len());
        String::from_utf8_lossy(&bytes[at.saturating_sub(80)..end]).into_owned()
    };
    let (one_part, other_part) = (around(one), around(other));
    Err(format!("differs at byte {at} of {} and {}:\n{one_part}\n{other_part}", one.len(), other.len()))
}
