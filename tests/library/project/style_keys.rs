//! The table of style keys matches the parser: keys, allowed values, defaults and texts.

use std::collections::BTreeSet;

use ligne::style::{KeyType, Style, StyleKey};

/// A word that is not a key and not similar to one.
const UNKNOWN_WORD: &str = "qqqqqqqqqqqq";

/// Keys without a row in the table: they are accepted only to report where they belong.
const UNLISTED_KEYS: [&str; 1] = ["fills.material[].highlight.near"];

/// A style sheet that sets one key, with the other keys that its table requires.
fn sheet_with_key(path: &str, value: &str) -> String {
    // Tables that require more keys: the end of the table's path, the keys that this entry applies to
    // (empty: all), and the required fields.
    const BRUSH: &str = "path = \"M0 0L10 1L0 2Z\"";
    let needs: [(&str, &[&str], &str); 14] = [
        ("fills.material[].gooch", &[], "enabled = true"),
        ("fills.gooch", &[], "enabled = true"),
        ("fills.material[]", &[], "name = \"x\""),
        ("fills.pattern[]", &["file", "image"], "kind = \"tile\""),
        ("fills.pattern[]", &["kind"], "path = \"M0 0L10 10\""),
        ("hatching.material[]", &[], "name = \"x\""),
        ("light.sources[]", &["direction"], "kind = \"directional\""),
        (
            "light.sources[]",
            &["kind"],
            if value.contains("point") { "position = [0; 0; 1]" } else { "direction = [0; 0; 1]" },
        ),
        ("light.sources[]", &[], "kind = \"point\", position = [0; 0; 1]"),
        (".brush", &["file", "image"], ""),
        (".brush", &["mode"], BRUSH),
        (".brush", &["inside"], "image = \"a.png\""),
        (".brush", &["turn"], "path = \"M0 0L10 1L0 2Z\", mode = \"repeat\", left = \"M0 0L10 1L0 2Z\""),
        (".brush", &[], "path = \"M0 0L10 1L0 2Z\", mode = \"repeat\""),
    ];
    let mut parts: Vec<&str> = path.split('.').collect();
    let mut value = value.to_owned();
    while let Some(part) = parts.pop() {
        let (name, is_list) = (part.trim_end_matches("[]"), part.ends_with("[]"));
        let written = if is_list { format!("[{value}]") } else { value };
        let holder = parts.join(".");
        // Turn shapes require the same fields as a brush.
        let table = holder.trim_end_matches(".left").trim_end_matches(".right");
        let is_turn = table != holder;
        let fits = |(end, names, _): &&(&str, &[&str], &str)| {
            table.ends_with(end) && (names.is_empty() || names.contains(&name))
        };
        let fields = needs.iter().find(fits).map_or("", |(_, _, fields)| fields);
        let fields = if is_turn && fields.contains("mode") { BRUSH } else { fields };
        let others =
            fields.split(", ").filter(|field| !field.is_empty() && !field.starts_with(&format!("{name} =")));
        // Semicolons stand for commas inside lists, because `, ` separates the fields.
        let others: String = others.map(|field| format!("{}, ", field.replace(';', ","))).collect();
        if parts.is_empty() {
            return format!("{name} = {written}\n");
        }
        value = format!("{{ {others}{name} = {written} }}");
    }
    value
}

/// The first line of the error of a sheet, or `None` if the sheet is valid.
fn first_error_line(text: &str) -> Option<String> {
    let error = Style::from_toml(text).err()?;
    // Files that a sheet names do not exist, so `cannot read` means that the sheet is valid.
    let is_unread = error.to_string().contains("cannot read");
    (!is_unread).then(|| error.to_string().lines().next().unwrap_or_default().to_owned())
}

/// The words after a phrase such as `listed_words keys: ` in an error.
fn listed_words(fault: &str, list: &str) -> Vec<String> {
    let Some((_, words)) = fault.split_once(list) else { return Vec::new() };
    words.split(", ").map(|word| word.trim().to_owned()).collect()
}

/// Collects the paths of all keys and tables below a path, from the lists in errors about unknown keys.
fn collect_keys(path: &str, leaves: &mut BTreeSet<String>, tables: &mut BTreeSet<String>) {
    let below = |form: &str| {
        let path =
            if path.is_empty() { UNKNOWN_WORD.to_owned() } else { format!("{path}{form}.{UNKNOWN_WORD}") };
        let fault = first_error_line(&sheet_with_key(&path, "1")).unwrap_or_default();
        if fault.contains(&format!("unknown key `{UNKNOWN_WORD}`")) {
            listed_words(&fault, "known keys: ")
        } else {
            Vec::new()
        }
    };
    for form in ["", "[]"] {
        let keys = below(form);
        for key in &keys {
            let path = if path.is_empty() { key.clone() } else { format!("{path}{form}.{key}") };
            collect_keys(&path, leaves, tables);
        }
        if !keys.is_empty() {
            tables.insert(path.to_owned());
            return;
        }
    }
    leaves.insert(path.to_owned());
}

#[test]
fn the_key_table_lists_exactly_the_accepted_keys() {
    let (mut leaves, mut tables) = (BTreeSet::new(), BTreeSet::new());
    collect_keys("", &mut leaves, &mut tables);
    assert!(leaves.len() > 700, "{} keys found", leaves.len());
    let listed: BTreeSet<String> = StyleKey::all().iter().map(|key| key.path.clone()).collect();
    assert_eq!(listed.len(), StyleKey::all().len(), "a key is listed twice");
    let lacking: Vec<&String> = leaves.iter().filter(|path| !listed.contains(*path)).collect();
    assert_eq!(lacking, UNLISTED_KEYS, "src/style/keys/table.txt lacks keys");
    // A key that accepts either a table or another value has a row, although it is a table.
    let is_key = |path: &&String| leaves.contains(*path) || tables.contains(*path);
    let wrong: Vec<&String> = listed.iter().filter(|path| !is_key(path)).collect();
    assert!(wrong.is_empty(), "src/style/keys/table.txt has keys that sheets do not: {wrong:?}");
}

/// Values that a key accepts, and values that it rejects.
fn accepted_and_rejected_values(key: &StyleKey) -> (Vec<String>, Vec<String>) {
    let word = |word: &str| format!("\"{word}\"");
    let mut good: Vec<String> = match key.kind {
        KeyType::Choice => Vec::new(),
        KeyType::Choices => vec!["[]".to_owned()],
        _ => key.words.iter().map(|one| word(one)).collect(),
    };
    let mut bad: Vec<String> = Vec::new();
    match key.kind {
        KeyType::Switch => good.extend(["true".to_owned(), "false".to_owned()]),
        KeyType::Choice => {
            good.extend(key.words.iter().map(|one| word(one)));
            bad.extend([word(UNKNOWN_WORD), "true".to_owned(), "3".to_owned()]);
        }
        KeyType::Choices => {
            good.extend(key.words.iter().map(|one| format!("[\"{one}\"]")));
            bad.extend([format!("[\"{UNKNOWN_WORD}\"]"), word(key.words[0])]);
        }
        KeyType::Colour => good.extend([word("#123456"), word("teal")]),
        KeyType::Ink => good.extend([word("#123456"), "{ shade = 0.4 }".to_owned()]),
        KeyType::Colours => good.push("[\"#000\", \"#fff\"]".to_owned()),
        KeyType::Palette => good.push("[[\"#000\", \"#fff\"]]".to_owned()),
        KeyType::Point => good.push("[0, 1, 2]".to_owned()),
        KeyType::Names => good.push("[\"a*\"]".to_owned()),
        KeyType::Text => good.push(word("ink")),
        KeyType::Name | KeyType::Path | KeyType::Texture => good.push(word("a*")),
        KeyType::Outline => good.push(word("M0 0L10 1L0 2Z")),
        KeyType::Brush => good.push("{ path = \"M0 0L10 1L0 2Z\" }".to_owned()),
        KeyType::Tables => good.push("[]".to_owned()),
        KeyType::Speed => good.extend(["3".to_owned(), word("200px")]),
        KeyType::Wholes => good.push("[0, -1]".to_owned()),
        _ => {}
    }
    if matches!(key.kind, KeyType::Colour | KeyType::Ink) {
        bad.extend([word("no colour"), "3".to_owned()]);
    }
    let numbers = |ends: [Option<f64>; 2], above: bool| {
        let [low, high] = ends;
        let step = if key.kind == KeyType::Whole { 1.0 } else { 0.001 };
        let low_good = low.map_or(-3.0, |low| if above { low + step } else { low });
        let low_bad = low.map(|low| if above { low } else { low - step });
        ([low_good, high.unwrap_or(low_good + 1.0)], [low_bad, high.map(|high| high + step)])
    };
    let ends = |range: &str| -> Option<([Option<f64>; 2], bool)> {
        let (start, high) = match range.split_once(" to ") {
            Some((start, high)) => (start, Some(high.parse().unwrap())),
            None => (range, None),
        };
        let above = start.starts_with("above ");
        let low = start.trim_start_matches("above ").trim_start_matches("at least ");
        (range != "any").then(|| ([low.parse().ok(), high], above))
    };
    if !key.range.is_empty() && key.kind != KeyType::Speed && key.kind != KeyType::Wholes {
        let (ends, above) = ends(key.range).unwrap_or(([None, None], false));
        let (fits, misfits) = numbers(ends, above);
        let in_list = matches!(key.kind, KeyType::Numbers | KeyType::Lengths);
        let written = |number: f64| if in_list { format!("[{number}]") } else { number.to_string() };
        good.extend(fits.into_iter().map(written));
        bad.extend(misfits.into_iter().flatten().map(written));
        if key.kind == KeyType::Length {
            good.push("\"0.35mm\"".to_owned());
            bad.push("\"1 ell\"".to_owned());
        }
        // A dash pattern needs a length above 0.
        if key.name == "dash" {
            good.retain(|value| value != "[0]");
        }
    }
    (good, bad)
}

#[test]
fn allowed_values_are_accepted_and_others_refused() {
    let mut faults = Vec::new();
    for key in StyleKey::all() {
        let (good, bad) = accepted_and_rejected_values(key);
        if good.is_empty() {
            faults.push(format!("{}: no value is tried", key.path));
        }
        for value in good.iter().map(String::as_str).chain(key.default) {
            if let Some(fault) = first_error_line(&sheet_with_key(&key.path, value)) {
                faults.push(format!("{}: {value} is refused: {fault}", key.path));
            }
        }
        for value in &bad {
            if first_error_line(&sheet_with_key(&key.path, value)).is_none() {
                faults.push(format!("{}: {value} is accepted", key.path));
            }
        }
        // The words in the table are the words in the error.
        if key.kind == KeyType::Choice {
            let refused = first_error_line(&sheet_with_key(&key.path, &format!("\"{UNKNOWN_WORD}\"")))
                .unwrap_or_default();
            let words: BTreeSet<String> = listed_words(&refused, "known values: ").into_iter().collect();
            let own: BTreeSet<String> = key.words.iter().map(|word| (*word).to_owned()).collect();
            if words != own {
                faults.push(format!("{}: the words are {words:?}", key.path));
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn listed_defaults_equal_the_built_in_defaults() {
    let mut faults = Vec::new();
    let mut checked = 0;
    for key in StyleKey::all() {
        // Dashes of hidden lines are a built-in rule that precedes the rules of the sheet.
        let Some(default) = key.default.filter(|_| key.path != "pen.hidden.dash") else { continue };
        let of = |value: &str| Style::from_toml(&sheet_with_key(&key.path, value));
        // The same sheet without the key. Its table remains, because it holds the other required keys.
        let base = sheet_with_key(&key.path, "\u{1}").replace(&format!("{} = \u{1}", key_name(key)), "");
        let base = base.replace(", }", " }").replace("= \u{1}", "= []");
        let base = if key.prefix.is_empty() { String::new() } else { base };
        let Ok(base) = Style::from_toml(&base) else { continue };
        match of(default) {
            Ok(style) if style == base => {}
            Ok(_) => faults.push(format!("{}: the default is not {default}", key.path)),
            Err(error) => faults.push(format!("{}: {error}", key.path)),
        }
        // Another value must change the style, or else the comparison proves nothing.
        let (good, _) = accepted_and_rejected_values(key);
        let differs = |value: &String| of(value).is_ok_and(|style| style != base);
        if key.kind != KeyType::Tables && !key.path.contains("brush") && !good.iter().any(differs) {
            faults.push(format!("{}: no value makes a difference", key.path));
        }
        checked += 1;
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
    assert!(checked > 170, "{checked} defaults");
}

/// The last word of the path of a key.
fn key_name(key: &StyleKey) -> &str {
    key.path.rsplit('.').next().unwrap_or_default()
}

#[test]
fn key_table_rows_are_complete() {
    for key in StyleKey::all() {
        assert!(key.help.len() > 5 && key.help.len() <= 100, "{}: {}", key.path, key.help);
        assert!(
            !key.help.ends_with('.') && key.help.split_whitespace().count() <= 18,
            "{}: {}",
            key.path,
            key.help
        );
        let is_choice = matches!(key.kind, KeyType::Choice | KeyType::Choices);
        assert!(!is_choice || key.words.len() > 1, "{}", key.path);
    }
    let text = include_str!("../../../src/style/keys/table.txt");
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with(['#', '@', '!'])) {
        let cells: Vec<&str> = line.split(" | ").collect();
        assert_eq!(cells.len(), 6, "{line}");
        assert!(StyleKey::all().iter().any(|key| key.name == cells[0] && key.help == cells[5]), "{line}");
    }
}

#[test]
fn a_full_sheet_loads_as_the_same_style() {
    for name in Style::names() {
        let text = Style::full_sheet(name).unwrap();
        let style = Style::from_toml(&text).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
        assert_eq!(style, Style::preset(name).unwrap(), "{name}\n{text}");
        for key in
            StyleKey::all().iter().filter(|key| key.path != "extends" && !key.prefix.starts_with("pen."))
        {
            let name = key.path.rsplit_once("[].").map_or(key.name, |(_, name)| name);
            let is_there = text.contains(&format!("{name} = ")) || text.contains(name);
            assert!(is_there, "{}: {text}", key.path);
        }
    }
}

#[test]
fn american_spelling_is_accepted_for_every_key() {
    let mut tried = 0;
    for key in StyleKey::all().iter().filter(|key| key.path.contains("colour")) {
        let american = key.path.replace("colour", "color");
        for value in accepted_and_rejected_values(key).0 {
            let (own, other) = (sheet_with_key(&key.path, &value), sheet_with_key(&american, &value));
            let style = |text: &str| Style::from_toml(text).unwrap_or_else(|error| panic!("{text}: {error}"));
            assert_eq!(style(&own), style(&other), "{american}");
            if key.is_settable() {
                let set = |path: &str| Style::load_with("ink", &[format!("{path}={value}")]).unwrap();
                assert_eq!(set(&key.path), set(&american), "{american}");
            }
            tried += 1;
        }
    }
    assert!(tried > 80, "{tried}");
    // Sheets in both spellings can be combined.
    let style =
        Style::load_with("pencil", &["pen.color=#ff0000".to_owned(), "pen.colour=#00ff00".to_owned()])
            .unwrap();
    assert_eq!(style, Style::load_with("pencil", &["pen.color=#00ff00".to_owned()]).unwrap());
}
