//! [`ClipBlend`]: clips selected by `--animation`, and their weights over time.

use crate::animation::{Clip, Playing};
use crate::error::Error;
use crate::error::nearest::{nearest, suggestion};
use crate::geometry::names::glob::Glob;

/// Maximum number of clip names in a message.
const MAX_SHOWN_CLIPS: usize = 12;

/// Clips that play together, and their weights over time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ClipBlend {
    asked: Vec<BlendedClip>,
    /// Earliest start and latest end of the clips, seconds.
    span: [f64; 2],
    /// Time span of weights without explicit times, seconds.
    time_span: [f64; 2],
    repeats: bool,
    /// Notes on choices made for the user.
    notes: Vec<String>,
}

/// Clip with its weight.
#[derive(Debug, Clone, PartialEq)]
struct BlendedClip {
    clip: usize,
    span: [f64; 2],
    /// Weight; a clip without one gets an equal share of the remaining weight.
    weight: Option<ClipWeight>,
}

/// Weight over time: linear between keys, constant before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
enum ClipWeight {
    /// Keys of time in seconds and weight.
    Timed(Vec<(f64, f64)>),
    /// Weights at evenly spaced times.
    Spread(Vec<f64>),
}

impl ClipBlend {
    /// Selects clips by texts: `NAME`, `NAME:WEIGHT`, or a comma-separated list. A name may be a pattern such
    /// as `Walk*`. Without texts the first clip plays. With `repeats` each clip loops.
    ///
    /// # Errors
    /// If there are no clips, if no clip matches a name, or if a weight is not a number.
    pub(crate) fn new(clips: &[Clip], texts: &[String], repeats: bool) -> Result<Self, Error> {
        if clips.is_empty() {
            return Err(Error::new("the model has no animations").remedy("leave out --animation and --time"));
        }
        let mut notes = Vec::new();
        if let ([], [first, other_clips @ ..]) = (texts, clips)
            && !other_clips.is_empty()
        {
            let (count, name, other_names) = (clips.len(), &first.name, names(other_clips));
            notes.push(format!(
                "uses the first of {count} animations, `{name}`; --animation selects others: {other_names}"
            ));
        }
        let find = |name: &str| clips.iter().position(|clip| clip.name == name);
        let mut blended_clips = Vec::new();
        let mut add = |name: &str, weight: Option<ClipWeight>| {
            let clip = match find(name) {
                Some(clip) => clip,
                None => matching(clips, name, &mut notes)?,
            };
            let span = clips.get(clip).map_or([0.0; 2], Clip::span);
            blended_clips.push(BlendedClip { clip, span, weight });
            Ok(())
        };
        for text in texts {
            // Clip names may contain commas and colons.
            if find(text).is_some() {
                add(text, None)?;
                continue;
            }
            for item in text.split(',').map(str::trim) {
                match item.rsplit_once(':').filter(|_| find(item).is_none()) {
                    Some((name, weight)) => add(name, Some(ClipWeight::parse(weight)?))?,
                    None => add(item, None)?,
                }
            }
        }
        if texts.is_empty() {
            blended_clips.push(BlendedClip {
                clip: 0,
                span: clips.first().map_or([0.0; 2], Clip::span),
                weight: None,
            });
        }
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let span = blended_clips.iter().fold(none, |[from, to], blended_clip| {
            [from.min(blended_clip.span[0]), to.max(blended_clip.span[1])]
        });
        Ok(Self { asked: blended_clips, span, time_span: span, repeats, notes })
    }

    /// Notes on choices made for the user, such as the first of several clips.
    pub(crate) fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Spreads weights without times over another time span.
    pub(crate) fn over(self, over: [f64; 2]) -> Self {
        Self { time_span: over, ..self }
    }

    /// Earliest start and latest end of the clips, seconds.
    pub(crate) fn span(&self) -> [f64; 2] {
        self.span
    }

    /// Whether clips loop.
    pub(crate) fn repeats(&self) -> bool {
        self.repeats
    }

    /// Clips with their local times and weights at a time in seconds.
    pub(crate) fn playing(&self, time: f64) -> Vec<Playing> {
        let weights: Vec<Option<f64>> = (self.asked.iter())
            .map(|blended_clip| blended_clip.weight.as_ref().map(|weight| weight.at(time, self.time_span)))
            .collect();
        let explicit_sum: f64 = weights.iter().flatten().sum();
        let equal = weights.iter().filter(|weight| weight.is_none()).count();
        let remaining_weight = (1.0 - explicit_sum).max(0.0) / equal.max(1) as f64;
        let to_playing = |(own, weight): (&BlendedClip, Option<f64>)| {
            let [from, to] = own.span;
            let time =
                if self.repeats && to > from { from + (time - from).rem_euclid(to - from) } else { time };
            Playing { clip: own.clip, time, weight: weight.unwrap_or(remaining_weight) }
        };
        self.asked.iter().zip(weights).map(to_playing).collect()
    }
}

/// First clip whose name matches a pattern. Adds a note if several match.
///
/// # Errors
/// If no name matches.
fn matching(clips: &[Clip], pattern: &str, notes: &mut Vec<String>) -> Result<usize, Error> {
    let glob = Glob::new(pattern);
    let mut matches = clips.iter().enumerate().filter(|(_, clip)| glob.matches(&clip.name));
    if let Some((first, clip)) = matches.next() {
        let others = matches.count();
        if others > 0 {
            let name = &clip.name;
            notes.push(format!("`{pattern}` matches {} animations; uses the first, `{name}`", others + 1));
        }
        return Ok(first);
    }
    let known: Vec<&str> = clips.iter().map(|clip| clip.name.as_str()).collect();
    let other_case = known.iter().find(|name| name.eq_ignore_ascii_case(pattern)).copied();
    let remedy = suggestion(other_case.or_else(|| nearest(pattern, &known)), || {
        format!("its animations are {}", names(clips))
    });
    Err(Error::new(format!("the model has no animation `{pattern}`")).remedy(remedy))
}

/// Names of clips, shortened to [`MAX_SHOWN_CLIPS`].
fn names(clips: &[Clip]) -> String {
    let shown: Vec<&str> = clips.iter().take(MAX_SHOWN_CLIPS).map(|clip| clip.name.as_str()).collect();
    let more = clips.len().saturating_sub(MAX_SHOWN_CLIPS);
    if more > 0 { format!("{} and {more} more", shown.join(", ")) } else { shown.join(", ") }
}

impl ClipWeight {
    /// Reads `0.7`, `1..0` (over the drawn time), or `1@0.5..0@2` (times in seconds).
    fn parse(text: &str) -> Result<Self, Error> {
        let wrong = |message: String| {
            Error::new(message).at("--animation").remedy(
                "write a weight, such as Walk:0.7, or weights in time, such as Walk:1..0 or Walk:1@0.5..0@2",
            )
        };
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let mut keys = Vec::new();
        for key in text.split("..") {
            let (weight, time) =
                key.split_once('@').map_or((key, None), |(weight, time)| (weight, Some(time)));
            let weight = number(weight).filter(|weight| *weight >= 0.0);
            let weight = weight.ok_or_else(|| wrong(format!("`{text}` is not a weight of 0 or more")))?;
            let time = match time {
                Some(time) => {
                    Some(number(time).ok_or_else(|| wrong(format!("`{key}` has no time in seconds")))?)
                }
                None => None,
            };
            keys.push((time, weight));
        }
        let timed: Vec<(f64, f64)> =
            keys.iter().filter_map(|(time, weight)| Some(((*time)?, *weight))).collect();
        if timed.is_empty() {
            return Ok(Self::Spread(keys.into_iter().map(|(_, weight)| weight).collect()));
        }
        if timed.len() < keys.len() {
            return Err(wrong(format!("some weights of `{text}` have a time, and some have none")));
        }
        if timed.array_windows().any(|[(a, _), (b, _)]| a >= b) {
            return Err(wrong(format!("the times of `{text}` do not rise")));
        }
        Ok(Self::Timed(timed))
    }

    fn at(&self, time: f64, [from, to]: [f64; 2]) -> f64 {
        match self {
            Self::Timed(keys) => between(keys, time),
            Self::Spread(weights) => {
                let steps = weights.len().saturating_sub(1).max(1) as f64;
                let key = |(k, weight): (usize, &f64)| (from + (to - from) * k as f64 / steps, *weight);
                between(&weights.iter().enumerate().map(key).collect::<Vec<_>>(), time)
            }
        }
    }
}

/// Value of sorted keys at a time, linearly interpolated.
fn between(keys: &[(f64, f64)], time: f64) -> f64 {
    let after = keys.partition_point(|(key, _)| *key <= time);
    let before = after.checked_sub(1).and_then(|before| keys.get(before));
    match (before, keys.get(after)) {
        (Some((a, from)), Some((b, to))) => from + (to - from) * (time - a) / (b - a),
        (Some((_, only)), None) | (None, Some((_, only))) => *only,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::animation::{AnimationTarget, ClipChannel, Interpolation, NodeProperty, Track};

    fn clips() -> Vec<Clip> {
        let clip = |(name, to): (&str, f64)| {
            let track = Track::new(vec![0.0, to], vec![0.0; 6], Interpolation::Linear).unwrap();
            let target = AnimationTarget::Node(0, NodeProperty::Translation);
            Clip { name: name.to_owned(), channels: vec![ClipChannel { target, track }] }
        };
        [("Walk", 1.0), ("Run", 4.0), ("rig:Idle,slow", 2.0)].map(clip).to_vec()
    }

    fn blend(texts: &[&str]) -> Result<ClipBlend, Error> {
        ClipBlend::new(&clips(), &texts.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>(), false)
    }

    fn weights(texts: &[&str], time: f64) -> Vec<(usize, f64)> {
        blend(texts).unwrap().playing(time).iter().map(|own| (own.clip, own.weight)).collect()
    }

    #[test]
    fn clip_names_are_patterns_and_default_to_the_first_clip() {
        let named = |text: &str| blend(&[text]).map(|blend| (blend.playing(0.0)[0].clip, blend.notes));
        assert_eq!(named("R*").unwrap(), (1, Vec::new()));
        assert_eq!(weights(&["W??k:0.3,R*"], 0.0), [(0, 0.3), (1, 0.7)]);
        let (clip, notes) = named("*").unwrap();
        assert!(clip == 0 && notes[0].contains("matches 3 animations; uses the first, `Walk`"), "{notes:?}");
        let first = blend(&[]).unwrap();
        assert_eq!(first.playing(0.0)[0].clip, 0);
        assert!(first.notes[0].contains("the first of 3 animations, `Walk`"), "{:?}", first.notes);
        for (wrong, expected) in
            [("walk", "did you mean `Walk`?"), ("Rnu", "did you mean `Run`?"), ("Jump", "are Walk, Run, ")]
        {
            let error = named(wrong).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }

    #[test]
    fn clips_without_a_weight_share_the_rest() {
        assert_eq!(weights(&["Walk", "Run"], 0.0), [(0, 0.5), (1, 0.5)]);
        assert_eq!(weights(&["Walk,Run"], 0.0), [(0, 0.5), (1, 0.5)]);
        assert_eq!(weights(&["Walk:0.75, Run"], 0.0), [(0, 0.75), (1, 0.25)]);
        assert_eq!(weights(&["Walk:0.2"], 0.0), [(0, 0.2)]);
        assert_eq!(weights(&["rig:Idle,slow", "Run:0.5"], 0.0), [(2, 0.5), (1, 0.5)]);
        assert_eq!(weights(&["rig:Idle,slow"], 0.0), [(2, 1.0)]);
    }

    #[test]
    fn clip_weights_change_over_time() {
        let fade = |time| weights(&["Walk:1@1..0@3,Run:0@1..1@3"], time).weight_pair();
        assert_eq!(
            [0.0, 1.0, 1.5, 3.0, 9.0].map(fade),
            [[1.0, 0.0], [1.0, 0.0], [0.75, 0.25], [0.0, 1.0], [0.0, 1.0]]
        );
        // Over the span of the clips, or over the drawn time.
        assert_eq!(weights(&["Walk:1..0", "Run"], 1.0).weight_pair(), [0.75, 0.25]);
        let film = blend(&["Walk:0..1..0", "Run"]).unwrap().over([0.0, 8.0]);
        assert_eq!([0.0, 4.0, 6.0].map(|time| film.playing(time)[0].weight), [0.0, 1.0, 0.5]);
    }

    #[test]
    fn repeating_clips_start_again_after_their_end() {
        let blend = ClipBlend { repeats: true, ..blend(&["Walk", "Run"]).unwrap() };
        let times: Vec<f64> = blend.playing(5.25).iter().map(|own| own.time).collect();
        assert_eq!(times, [0.25, 1.25]);
    }

    #[test]
    fn invalid_clip_names_and_weights_are_rejected() {
        for (text, expected) in [
            ("Jump", "no animation `Jump`"),
            ("Jump:1", "no animation `Jump`"),
            ("Walk,", "no animation ``"),
            ("Walk:much", "`much` is not a weight"),
            ("Walk:-1", "`-1` is not a weight"),
            ("Walk:1@a", "`1@a` has no time"),
            ("Walk:1@0..1", "some have none"),
            ("Walk:1@1..0@1", "do not rise"),
        ] {
            let error = blend(&[text]).unwrap_err().to_string();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }

    trait WeightPair {
        fn weight_pair(&self) -> [f64; 2];
    }

    impl WeightPair for Vec<(usize, f64)> {
        fn weight_pair(&self) -> [f64; 2] {
            [self[0].1, self[1].1]
        }
    }
}
