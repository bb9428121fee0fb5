//! Random small SVG drawings, and pairs of them: equal pictures written in two ways, or different pictures.

use super::random_dice::Dice;

/// An SVG element: its name and its attributes.
#[derive(Clone)]
pub(crate) struct SvgElement {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
}

/// A drawing of 160 × 120 px.
#[derive(Clone)]
pub(crate) struct SvgScene {
    marks: Vec<SvgElement>,
    /// Numbers in the definitions: a gradient's end, a pattern's width, a blur radius, a clip path's side, a
    /// mask's radius.
    numbers: [f64; 5],
}

/// Five colours in four notations each.
const COLOURS: [[&str; 4]; 5] = [
    ["#ff0000", "red", "rgb(255,0,0)", "#f00"],
    ["#008000", "green", "rgb(0,128,0)", "rgb(0, 128, 0)"],
    ["#0000ff", "blue", "rgb(0,0,255)", "#00f"],
    ["#ffa500", "orange", "rgb(255,165,0)", "#FFA500"],
    ["#808080", "grey", "gray", "rgb(128,128,128)"],
];

impl SvgElement {
    fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(n, _)| *n == name).map(|(_, value)| value.as_str())
    }

    fn set(&mut self, name: &'static str, value: String) {
        self.attributes.retain(|(n, _)| *n != name);
        self.attributes.push((name, value));
    }

    fn number(&self, name: &str) -> f64 {
        self.get(name).and_then(|value| value.parse().ok()).unwrap_or(0.0)
    }

    fn svg(&self) -> String {
        let attributes: String = self.attributes.iter().map(|(n, v)| format!(" {n}=\"{v}\"")).collect();
        format!("<{}{attributes}/>", self.name)
    }
}

fn round_to_tenth(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}

fn random_mark(dice: &mut Dice) -> SvgElement {
    let mut at = |low: f64, high: f64| round_to_tenth(dice.between(low, high)).to_string();
    let (name, attributes) = match at(0.0, 0.3).as_str() {
        "0" => (
            "rect",
            vec![
                ("x", at(5.0, 80.0)),
                ("y", at(5.0, 60.0)),
                ("width", at(20.0, 70.0)),
                ("height", at(15.0, 50.0)),
            ],
        ),
        "0.1" => ("circle", vec![("cx", at(30.0, 120.0)), ("cy", at(30.0, 90.0)), ("r", at(8.0, 28.0))]),
        "0.2" => (
            "polygon",
            vec![(
                "points",
                format!(
                    "{},{} {},{} {},{}",
                    at(5.0, 60.0),
                    at(5.0, 50.0),
                    at(80.0, 150.0),
                    at(20.0, 60.0),
                    at(20.0, 140.0),
                    at(70.0, 115.0)
                ),
            )],
        ),
        _ => (
            "path",
            vec![(
                "d",
                format!(
                    "M{} {}C{} {} {} {} {} {}",
                    at(5.0, 50.0),
                    at(5.0, 100.0),
                    at(20.0, 140.0),
                    at(5.0, 110.0),
                    at(20.0, 140.0),
                    at(5.0, 110.0),
                    at(90.0, 150.0),
                    at(10.0, 110.0)
                ),
            )],
        ),
    };
    let mut mark = SvgElement { name, attributes };
    let colour = COLOURS[dice.below(5)][0];
    let paint = ["url(#g)", "url(#p)", colour, colour, colour][dice.below(5)];
    mark.set("fill", if name == "path" { "none" } else { paint }.to_owned());
    if name == "path" || dice.below(3) == 0 {
        mark.set("stroke", COLOURS[dice.below(5)][0].to_owned());
        mark.set("stroke-width", round_to_tenth(dice.between(1.0, 7.0)).to_string());
        match dice.below(4) {
            0 => mark.set("stroke-dasharray", "9 4".to_owned()),
            1 => mark.set("stroke-linecap", "round".to_owned()),
            2 => mark.set("stroke-linejoin", "round".to_owned()),
            _ => {}
        }
    }
    match dice.below(8) {
        0 => mark.set("opacity", "0.5".to_owned()),
        1 => mark.set("clip-path", "url(#c)".to_owned()),
        2 => mark.set("mask", "url(#m)".to_owned()),
        3 => mark.set("filter", "url(#f)".to_owned()),
        _ => {}
    }
    mark
}

impl SvgScene {
    pub(crate) fn random(dice: &mut Dice) -> Self {
        let marks = (0..2 + dice.below(4)).map(|_| random_mark(dice)).collect();
        let mut between = |low, high| round_to_tenth(dice.between(low, high));
        let numbers = [
            between(0.5, 1.0),
            between(7.0, 12.0),
            between(1.0, 3.0),
            between(60.0, 110.0),
            between(25.0, 50.0),
        ];
        Self { marks, numbers }
    }

    fn definitions(&self) -> String {
        let [end, cell, blur, side, radius] = self.numbers;
        format!(
            r##"<defs><linearGradient id="g" x2="{end}"><stop stop-color="#004466"/><stop offset="1" stop-color="#ffcc88"/></linearGradient>
<pattern id="p" width="{cell}" height="8" patternUnits="userSpaceOnUse"><path d="M1 1h4v4h-4z" fill="#007700"/></pattern>
<filter id="f"><feGaussianBlur stdDeviation="{blur}"/></filter>
<clipPath id="c"><path d="M20 20H{side}V90H20z"/></clipPath>
<mask id="m"><circle cx="70" cy="60" r="{radius}" fill="#ffffff"/></mask></defs>
"##
        )
    }

    pub(crate) fn svg(&self) -> String {
        svg_page(&self.definitions(), &self.marks.iter().map(SvgElement::svg).collect::<Vec<_>>())
    }
}

fn svg_page(definitions: &str, marks: &[String]) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"160\" height=\"120\">\n{definitions}{}\n</svg>\n",
        marks.join("\n")
    )
}

/// Two SVG texts that show the same picture, and the name of the rewriting.
pub(crate) fn equal_picture_pair(scene: &SvgScene, dice: &mut Dice) -> (String, String, &'static str) {
    let before = scene.svg();
    let mut definitions = scene.definitions();
    let mut marks: Vec<String> = scene.marks.iter().map(SvgElement::svg).collect();
    let at = dice.below(marks.len());
    let mark = &scene.marks[at];
    let way = match dice.below(11) {
        0 => {
            marks[at] = format!("<g><g>{}</g></g>", marks[at]);
            "in groups"
        }
        1 => {
            marks[at] = format!(
                "<g transform=\"translate(7 -3)\"><g transform=\"translate(-7 3)\">{}</g></g>",
                marks[at]
            );
            "moved there and back"
        }
        2 => {
            for names in COLOURS {
                let name = names[1 + dice.below(3)];
                marks[at] = marks[at].replace(&format!("\"{}\"", names[0]), &format!("\"{name}\""));
            }
            "colours by other names"
        }
        3 => {
            definitions = definitions
                .replace("</defs>", &format!("{}</defs>", marks[at].replacen(' ', " id=\"u\" ", 1)));
            marks[at] = "<use href=\"#u\"/>".to_owned();
            "used from elsewhere"
        }
        4 => {
            let (places, paints): (Vec<_>, Vec<_>) = mark.attributes.iter().partition(|(name, _)| {
                ["x", "y", "width", "height", "cx", "cy", "r", "points", "d"].contains(name)
            });
            let places: String = places.iter().map(|(n, v)| format!(" {n}=\"{v}\"")).collect();
            let style: String = paints.iter().map(|(n, v)| format!("{n}:{v};")).collect();
            marks[at] = format!("<{}{places} style=\"{style}\"/>", mark.name);
            "a style"
        }
        5 => {
            let nothing = [
                "<path d=\"M5 5H90V90\" fill=\"none\"/>",
                "<rect x=\"5\" y=\"5\" width=\"0\" height=\"50\" fill=\"#f00\"/>",
                "<rect x=\"5\" y=\"5\" width=\"60\" height=\"50\" fill=\"#f00\" opacity=\"0\"/>",
                "<rect x=\"5\" y=\"5\" width=\"60\" height=\"50\" fill=\"#f00\" display=\"none\"/>",
                "<rect x=\"5\" y=\"5\" width=\"60\" height=\"50\" fill=\"#f00\" visibility=\"hidden\"/>",
                "<image x=\"5\" y=\"5\" width=\"60\" height=\"50\"/>",
                "<rect x=\"-90\" y=\"5\" width=\"60\" height=\"50\" fill=\"#f00\"/>",
            ];
            marks.insert(at, nothing[dice.below(nothing.len())].to_owned());
            "a mark of nothing"
        }
        6 => {
            let d = match mark.name {
                "rect" => {
                    let [x, y, w, h] = ["x", "y", "width", "height"].map(|name| mark.number(name));
                    format!("M{x} {y}h{w}v{h}h{}z", -w)
                }
                "circle" => {
                    let [x, y, r] = ["cx", "cy", "r"].map(|name| mark.number(name));
                    format!("M{} {y}A{r} {r} 0 0 1 {} {y}A{r} {r} 0 0 1 {} {y}z", x + r, x - r, x + r)
                }
                "polygon" => format!("M{}z", mark.get("points").unwrap_or_default()),
                _ => mark.get("d").unwrap_or_default().replace('C', " C ").replace('M', "M "),
            };
            let rest = mark.attributes.iter().filter(|(name, _)| {
                !["x", "y", "width", "height", "cx", "cy", "r", "points", "d"].contains(name)
            });
            let rest: String = rest.map(|(n, v)| format!(" {n}=\"{v}\"")).collect();
            marks[at] = format!("<path d=\"{d}\"{rest}/>");
            "a path"
        }
        7 => {
            definitions = definitions
                .replace("<linearGradient id=\"g\"", "<linearGradient id=\"h\" href=\"#s\"")
                .replace("href=\"#s\" x2", "x2")
                .replace(
                    "<stop stop-color=\"#004466\"/>",
                    "<stop offset=\"0%\" stop-color=\"rgb(0,68,102)\"/>",
                )
                .replace("</defs>", "<linearGradient id=\"g\" href=\"#h\"/></defs>");
            "a gradient of a gradient"
        }
        8 => {
            marks[at] =
                marks[at].replace("\"9 4\"", "\"9 4 9 4\"").replace("opacity=\"0.5\"", "opacity=\"50%\"");
            "dashes said twice"
        }
        9 => {
            definitions = definitions
                .replace("<path d=\"M1 1h4v4h-4z\"", "<path transform=\"translate(1 1)\" d=\"M0 0h4v4h-4z\"")
                .replace("<path d=\"M20 20H", "<path d=\"M 20,20 H");
            "definitions written otherwise"
        }
        _ => {
            let side = 300;
            let cover =
                format!("<rect x=\"-50\" y=\"-50\" width=\"{side}\" height=\"{side}\" fill=\"#eeeeee\"/>");
            let hidden = marks.remove(at);
            let mut before = scene.marks.iter().map(SvgElement::svg).collect::<Vec<_>>();
            before.push(cover.clone());
            drop(hidden);
            marks.push(cover);
            return (
                svg_page(&definitions, &before),
                svg_page(&definitions, &marks),
                "a mark behind another",
            );
        }
    };
    (before, svg_page(&definitions, &marks), way)
}

/// A drawing, the drawing with one property changed, and the name of the change.
pub(crate) fn changed_picture_pair(scene: &SvgScene, dice: &mut Dice) -> (String, String, &'static str) {
    let before = scene.svg();
    let mut scene = scene.clone();
    let at = dice.below(scene.marks.len());
    let other = COLOURS[dice.below(5)][0].to_owned();
    let factor = dice.between(1.1, 1.6);
    let mark = &mut scene.marks[at];
    let mut set = |name: &'static str, value: &str| {
        mark.set(name, value.to_owned());
        name
    };
    let way = match dice.below(20) {
        0 => set("fill", &other),
        1 => set("stroke", &other),
        2 => set("stroke-width", "9"),
        3 => set("opacity", "0.2"),
        4 => set("stroke-dasharray", "5 8"),
        5 => set("stroke-dashoffset", "6"),
        6 => set("stroke-linecap", "square"),
        7 => set("stroke-linejoin", "bevel"),
        8 => set("transform", "rotate(9 80 60)"),
        9 => set("clip-path", "url(#c)"),
        10 => set("mask", "url(#m)"),
        11 => set("filter", "url(#f)"),
        12 => set("fill", "url(#g)"),
        13 => set("style", "mix-blend-mode:multiply"),
        14 => set("transform", "translate(0.8 1.2)"),
        15 => set("paint-order", "stroke"),
        16 => {
            scene.marks.remove(at);
            "a mark less"
        }
        17 => {
            let last = scene.marks.len() - 1;
            scene.marks.swap(at, last);
            "another order"
        }
        _ => {
            let number = &mut scene.numbers[dice.below(5)];
            *number = round_to_tenth(*number * factor);
            "a number of a definition"
        }
    };
    (before, scene.svg(), way)
}
