//! The standard series of scales (ISO 5455:1979).

/// Length on paper per unit of real length, largest first.
pub(crate) const STANDARD_SCALES: [f64; 16] =
    [50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005];

/// Formats a scale: `1:2`, `5:1`.
pub(crate) fn format_scale(scale: f64) -> String {
    let number = |x: f64| {
        let rounded = (x * 100.0).round() / 100.0;
        format!("{rounded}")
    };
    if scale >= 1.0 { format!("{}:1", number(scale)) } else { format!("1:{}", number(1.0 / scale)) }
}

/// Parses a scale such as `1:2` or `5:1`.
pub(crate) fn parse_scale(text: &str) -> Option<f64> {
    let (paper, model) = text.split_once(':')?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|n| n.is_finite() && *n > 0.0);
    Some(number(paper)? / number(model)?).filter(|scale| scale.is_finite() && *scale > 0.0)
}
