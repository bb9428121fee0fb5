//! Reference reader for the entities of DXF files.

/// The group codes and values of a file.
pub(crate) fn group_codes(bytes: &[u8]) -> Vec<(u16, String)> {
    let text = std::str::from_utf8(bytes).expect("text");
    assert!(text.is_ascii());
    let lines: Vec<&str> = text.split_terminator("\r\n").collect();
    assert_eq!(lines.len() % 2, 0);
    lines.chunks(2).map(|pair| (pair[0].parse().expect("a code"), pair[1].to_owned())).collect()
}

/// An entity with its group codes and values; each vertex of a polyline is a separate entity.
pub(crate) struct Entity {
    /// The entity type.
    pub kind: String,
    /// Codes and values.
    pub pairs: Vec<(u16, String)>,
}

impl Entity {
    /// The first value with a group code.
    pub(crate) fn text(&self, code: u16) -> Option<&str> {
        self.pairs.iter().find(|pair| pair.0 == code).map(|pair| pair.1.as_str())
    }

    /// The first value with a group code as a number, or 0 without one.
    pub(crate) fn number(&self, code: u16) -> f64 {
        self.text(code).and_then(|text| text.parse().ok()).unwrap_or(0.0)
    }
}

/// The entities of the ENTITIES section.
pub(crate) fn entities(pairs: &[(u16, String)]) -> Vec<Entity> {
    let at = |wanted: (u16, &str), from: usize| {
        from + pairs[from..]
            .iter()
            .position(|(code, value)| (*code, value.as_str()) == wanted)
            .expect("a section")
    };
    let begin = at((2, "ENTITIES"), 0) + 1;
    let mut entities: Vec<Entity> = Vec::new();
    for (code, value) in &pairs[begin..at((0, "ENDSEC"), begin)] {
        if *code == 0 {
            entities.push(Entity { kind: value.clone(), pairs: Vec::new() });
        } else {
            entities.last_mut().expect("an entity").pairs.push((*code, value.clone()));
        }
    }
    entities
}
