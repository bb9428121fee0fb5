//! [`Style`]: style sheets in TOML, the options of every stage.
