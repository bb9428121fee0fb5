//! [`SvgFilm`]: writes the frames of an animation as one animated SVG file.
//!
//! Every frame is a group inside `defs`. One `use` shows the frames in turn through a discrete `animate` of
//! its `xlink:href`. This plays in browsers, also inside `img`, and programs without animation show the first
//! frame.
//!
//! Content shared by several frames is written once: unchanged paths, alone or in runs, and paths that only
//! moved by a shift.

use std::fmt::Write as _;

use super::frame_clock::FrameClock;
use super::frame_tokens::{FrameToken, FrameTokens, TokenPath, coordinates};
use super::path_runs::runs;
use crate::drawing::{Drawing, Unit};
use crate::export::SvgOptions;

/// Shorter paths are repeated, because a reference would not be shorter.
const MIN_SHARED_BYTES: usize = 48;

/// Default decimals of coordinates in px and mm. Motion hides small errors.
const DEFAULT_DECIMALS: [u8; 2] = [1, 2];

/// Attributes that make a group a layer in drawing programs. Frames cannot be opened as layers.
const LAYER_ATTRIBUTES: &str = " inkscape:groupmode=\"layer\" inkscape:label=\"";

/// Writer of an animated SVG.
#[derive(Debug)]
pub struct SvgFilm {
    options: SvgOptions,
    fps: f64,
    pace: FrameClock,
    /// Root element and title of the first frame.
    head: String,
    tokens: FrameTokens,
    /// Distinct frames.
    frames: Vec<Vec<FrameToken>>,
    /// Frames in display order with their numbers of ticks.
    shown: Vec<(usize, u32)>,
}

impl SvgFilm {
    /// Creates a film with `fps` ticks per second. Without a precision in the options, coordinates have one
    /// decimal in px and two in mm.
    #[must_use]
    pub fn new(fps: f64, options: &SvgOptions) -> Self {
        Self {
            options: options.clone(),
            fps,
            pace: FrameClock::new(fps),
            head: String::new(),
            tokens: FrameTokens::default(),
            frames: Vec::new(),
            shown: Vec::new(),
        }
    }

    /// Adds a frame that is shown for `ticks` ticks. A frame equal to an earlier one is stored once.
    pub fn push(&mut self, drawing: &Drawing, ticks: u32) {
        let precision = self.options.precision.unwrap_or(match drawing.page.unit {
            Unit::Px => DEFAULT_DECIMALS[0],
            Unit::Mm => DEFAULT_DECIMALS[1],
        });
        let id_prefix = format!("{}f{}-", self.options.id_prefix, self.frames.len());
        let options =
            SvgOptions { precision: Some(precision), id_prefix: id_prefix.clone(), ..self.options.clone() };
        let text = drawing.to_svg(&options);
        let body = text.strip_suffix("</svg>\n").unwrap_or(&text);
        let is_head = |line: &&str| line.starts_with("<svg") || line.starts_with("<title>");
        if self.head.is_empty() {
            self.head = body.lines().take_while(is_head).fold(String::new(), |head, line| head + line + "\n");
        }
        // Groups must be equal in all frames, so only ids that are referenced are kept.
        let id_attribute = format!(" id=\"{id_prefix}");
        let lines: Vec<String> =
            body.lines().skip_while(is_head).map(|line| plain(line, &id_attribute)).collect();
        let frame = self.tokens.of(lines.iter().map(String::as_str));
        let earlier_frame = self.frames.iter().position(|known| *known == frame);
        let number = earlier_frame.unwrap_or(self.frames.len());
        if earlier_frame.is_none() {
            self.frames.push(frame);
        }
        self.pace.next(ticks, self.fps);
        match self.shown.last_mut() {
            Some((last, shown)) if *last == number => *shown += ticks,
            _ => self.shown.push((number, ticks)),
        }
    }

    /// The film as SVG text; empty without frames.
    #[must_use]
    pub fn finish(self) -> String {
        if self.frames.is_empty() {
            return String::new();
        }
        let prefix = &self.options.id_prefix;
        let shared = SharedPaths::of(&self.frames, &self.tokens, prefix);
        let mut out = self.head.clone();
        if !out.contains(" xmlns:xlink=") {
            out = out.replacen(
                " xmlns:inkscape=",
                " xmlns:xlink=\"http://www.w3.org/1999/xlink\" xmlns:inkscape=",
                1,
            );
        }
        out.push_str("<defs>\n");
        shared.define(&mut out, &self.tokens.shapes);
        for (number, frame) in self.frames.iter().enumerate() {
            let _ = writeln!(out, "<g id=\"{prefix}frame-{number}\">");
            shared.write(&mut out, frame, &self.tokens);
            out.push_str("</g>\n");
        }
        out.push_str("</defs>\n");
        let first = self.shown.first().map_or(0, |(number, _)| *number);
        let _ = write!(out, "<use xlink:href=\"#{prefix}frame-{first}\">");
        self.animate(&mut out);
        out.push_str("</use>\n</svg>\n");
        out
    }

    /// Writes the `animate` element that switches frames; nothing for a still film.
    fn animate(&self, out: &mut String) {
        let all: u64 = self.shown.iter().map(|(_, ticks)| u64::from(*ticks)).sum();
        if self.shown.len() < 2 {
            return;
        }
        let prefix = &self.options.id_prefix;
        out.push_str(
            "<animate attributeName=\"xlink:href\" calcMode=\"discrete\" repeatCount=\"indefinite\" dur=\"",
        );
        let _ = write!(out, "{}s\" values=\"", short(self.pace.seconds()));
        for (place, (number, _)) in self.shown.iter().enumerate() {
            let _ = write!(out, "{}#{prefix}frame-{number}", if place > 0 { ";" } else { "" });
        }
        out.push('"');
        // Without `keyTimes` all frames are shown equally long.
        if self.shown.iter().any(|(_, ticks)| Some(ticks) != self.shown.first().map(|(_, ticks)| ticks)) {
            out.push_str(" keyTimes=\"");
            let mut before = 0_u64;
            for (place, (_, ticks)) in self.shown.iter().enumerate() {
                let time = short(before as f64 / all as f64);
                let _ = write!(out, "{}{time}", if place > 0 { ";" } else { "" });
                before += u64::from(*ticks);
            }
            out.push('"');
        }
        out.push_str("/>");
    }
}

/// A line without layer attributes and without the group's id, which nothing references.
fn plain(line: &str, own_id: &str) -> String {
    let Some(at) = line.find(LAYER_ATTRIBUTES) else { return line.to_owned() };
    let after = line.get(at + LAYER_ATTRIBUTES.len()..).and_then(|rest| rest.split_once('"'));
    let head = line.get(..at).unwrap_or_default();
    let layer = head.find(own_id).and_then(|at| head.get(at + own_id.len()..)).unwrap_or_default();
    let layer = layer.trim_end_matches('"');
    format!("<g class=\"{layer}\"{}", after.map_or("", |(_, rest)| rest))
}

/// A number with at most six decimals.
fn short(value: f64) -> String {
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Paths that several frames share, and how each path is written.
struct SharedPaths<'a> {
    prefix: &'a str,
    /// Lists of shapes that always occur together.
    runs: Vec<Vec<usize>>,
    /// One entry per shape.
    roles: Vec<PathRole>,
}

/// How a shape is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PathRole {
    /// As a path in each frame.
    Plain,
    /// As a reference to the shape.
    Alone,
    /// As a reference to the run with this number, which it starts.
    Begins(usize),
    /// Inside a run that has started.
    Within,
}

impl<'a> SharedPaths<'a> {
    /// Decides how each shape is written. `prefix` is the prefix of all ids.
    fn of(frames: &[Vec<FrameToken>], tokens: &FrameTokens, prefix: &'a str) -> Self {
        let shapes = &tokens.shapes;
        let role = |shape: &TokenPath| {
            let long = shape.before.len() + shape.after.len() >= MIN_SHARED_BYTES;
            if shape.count > 1 && long { PathRole::Alone } else { PathRole::Plain }
        };
        let mut roles: Vec<PathRole> = shapes.iter().map(role).collect();
        let runs = runs(frames, shapes);
        for (number, run) in runs.iter().enumerate() {
            for (place, shape) in run.iter().enumerate() {
                if let Some(role) = roles.get_mut(*shape) {
                    *role = if place == 0 { PathRole::Begins(number) } else { PathRole::Within };
                }
            }
        }
        Self { prefix, runs, roles }
    }

    /// Writes the definitions of shared content.
    fn define(&self, out: &mut String, shapes: &[TokenPath]) {
        for (number, (shape, role)) in shapes.iter().zip(&self.roles).enumerate() {
            if *role != PathRole::Alone {
                continue;
            }
            let (id, rest) = (format!("{}p{number}", self.prefix), shape.before.strip_prefix("<path"));
            let place = if shape.stays { &*shape.first } else { "0 0" };
            let _ = writeln!(out, "<path id=\"{id}\"{}{place}{}", rest.unwrap_or_default(), shape.after);
        }
        for (number, run) in self.runs.iter().enumerate() {
            let _ = writeln!(out, "<g id=\"{}r{number}\">", self.prefix);
            for TokenPath { before, first, after, .. } in run.iter().filter_map(|shape| shapes.get(*shape)) {
                let _ = writeln!(out, "{before}{first}{after}");
            }
            out.push_str("</g>\n");
        }
    }

    /// Writes a frame with references to shared content.
    fn write(&self, out: &mut String, frame: &[FrameToken], tokens: &FrameTokens) {
        for token in frame {
            let (number, place) = match token {
                FrameToken::Other(number) => {
                    out.push_str(tokens.other_lines.get(*number).map_or("", |text| text));
                    out.push('\n');
                    continue;
                }
                FrameToken::Path(number, place) => (*number, place),
            };
            let (Some(shape), Some(role)) = (tokens.shapes.get(number), self.roles.get(number)) else {
                continue;
            };
            let prefix = self.prefix;
            let _ = match role {
                PathRole::Within => Ok(()),
                PathRole::Begins(run) => writeln!(out, "<use xlink:href=\"#{prefix}r{run}\"/>"),
                PathRole::Alone if shape.stays => writeln!(out, "<use xlink:href=\"#{prefix}p{number}\"/>"),
                PathRole::Alone => {
                    let [x, y] = coordinates(place).unwrap_or(["0", "0"]);
                    writeln!(out, "<use xlink:href=\"#{prefix}p{number}\" x=\"{x}\" y=\"{y}\"/>")
                }
                PathRole::Plain => writeln!(out, "{}{place}{}", shape.before, shape.after),
            };
        }
    }
}
