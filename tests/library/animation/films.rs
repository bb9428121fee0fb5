//! Films in SVG, GIF, APNG and WebP read back equal with independent decoders.

use std::io::Cursor;

use ligne::animate::{Animator, FrameSpec};
use ligne::drawing::Page;
use ligne::export::film::{ApngFilm, GifFilm, SvgFilm, WebpFilm};
use ligne::export::{Pixels, PngOptions};
use ligne::{Style, SvgOptions};

use super::frames::{PAGE_SIDE_PX, crane, drawings, moments};

/// Paths of one frame of an SVG film, with every `<use>` resolved.
fn resolve_film_frame(film: &str, frame: usize) -> Vec<String> {
    let text = film.replace("xlink:href", "href");
    let document = usvg::roxmltree::Document::parse(&text).unwrap();
    let by_id = |id: &str| document.descendants().find(|node| node.attribute("id") == Some(id)).unwrap();
    fn walk<'a>(
        node: usvg::roxmltree::Node<'a, 'a>,
        shift: (f64, f64),
        by_id: &dyn Fn(&str) -> usvg::roxmltree::Node<'a, 'a>,
        out: &mut Vec<String>,
    ) {
        let number = |name: &str| node.attribute(name).map_or(0.0, |text| text.parse::<f64>().unwrap());
        match node.tag_name().name() {
            "use" => {
                let target = by_id(node.attribute("href").unwrap().trim_start_matches('#'));
                walk(target, (shift.0 + number("x"), shift.1 + number("y")), by_id, out);
            }
            "path" => {
                let path = kurbo::BezPath::from_svg(node.attribute("d").unwrap()).unwrap();
                let moved = kurbo::Affine::translate(shift) * path;
                let first = moved.elements()[0];
                let rest: Vec<String> = moved.elements()[1..]
                    .iter()
                    .map(|element| format!("{:.1?}", kurbo::Affine::translate((0.01, 0.01)) * *element))
                    .collect();
                let class = node.attribute("class").unwrap_or_default();
                out.push(format!("{class} {:.1?} {rest:?}", kurbo::Affine::translate((0.01, 0.01)) * first));
            }
            _ => node.children().for_each(|child| walk(child, shift, by_id, out)),
        }
    }
    let mut out = Vec::new();
    walk(by_id(&format!("frame-{frame}")), (0.0, 0.0), &by_id, &mut out);
    out
}

#[test]
fn animated_svg_shows_the_frames_it_was_given() {
    for name in ["ink", "toon", "comic"] {
        let (crane, style) = (crane(), Style::load(name).unwrap());
        let drawings = drawings(&moments(&crane, 3.0), &crane, &style);
        let mut film = SvgFilm::new(12.0, &SvgOptions::default());
        drawings.iter().for_each(|drawing| film.push(drawing, 4));
        let film = film.finish();
        assert!(film.contains("dur=\"4s\"") && film.contains("calcMode=\"discrete\""), "{name}");
        let mut single = 0;
        for (number, drawing) in drawings.iter().enumerate() {
            let mut alone = SvgFilm::new(12.0, &SvgOptions::default());
            alone.push(drawing, 1);
            let alone = alone.finish();
            single += alone.len();
            assert_eq!(
                resolve_film_frame(&film, number),
                resolve_film_frame(&alone, 0),
                "{name}, frame {number}"
            );
        }
        assert!(film.len() < single, "{name}: {} of {single}", film.len());
        usvg::Tree::from_str(&film, &usvg::Options::default()).unwrap();
    }
}

#[test]
fn animated_svg_stores_unchanged_frames_once() {
    let (crane, style) = (crane(), Style::load("ink").unwrap());
    let moments = moments(&crane, 3.0);
    let animator = Animator::new(&crane, &style);
    let (still, _) = animator.draw(&moments[0]).unwrap();
    let mut film = SvgFilm::new(12.0, &SvgOptions::default().with_id_prefix("a-"));
    (0..5).for_each(|_| film.push(&still, 2));
    let text = film.finish();
    assert_eq!(text.matches("<g id=\"a-frame-").count(), 1);
    assert!(!text.contains("<animate"), "nothing moves");
    assert!(SvgFilm::new(12.0, &SvgOptions::default()).finish().is_empty());
}

/// Rasterised frames of the crane at 2 frames per second, with or without a background.
fn pixels(style: &str, background: bool) -> Vec<Pixels> {
    let set = format!("page.background={}", if background { "#fdf6e3" } else { "none" });
    let (crane, style) = (crane(), Style::load_with(style, &[set]).unwrap());
    let moments: Vec<FrameSpec> = moments(&crane, 2.0)
        .into_iter()
        .map(|moment| FrameSpec { page: Page { background: style.background, ..moment.page }, ..moment })
        .collect();
    let drawings = drawings(&moments, &crane, &style);
    drawings.iter().map(|drawing| drawing.to_pixels(&PngOptions::default()).unwrap()).collect()
}

/// Canvas of a GIF player after each picture, and the delay of the picture in hundredths of a second.
fn play_gif(bytes: Vec<u8>) -> Vec<(Vec<u8>, u32)> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(Cursor::new(bytes)).unwrap();
    let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
    let mut screen = vec![0_u8; width * height * 4];
    let mut shown = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let to =
            |x: usize, y: usize| ((y + usize::from(frame.top)) * width + x + usize::from(frame.left)) * 4;
        let places = || {
            let (wide, high) = (usize::from(frame.width), usize::from(frame.height));
            (0..high).flat_map(move |y| (0..wide).map(move |x| (x, y)))
        };
        for (x, y) in places() {
            let from = (y * usize::from(frame.width) + x) * 4;
            if frame.buffer[from + 3] > 0 {
                screen[to(x, y)..to(x, y) + 4].copy_from_slice(&frame.buffer[from..from + 4]);
            }
        }
        shown.push((screen.clone(), u32::from(frame.delay)));
        if frame.dispose == gif::DisposalMethod::Background {
            places().for_each(|(x, y)| screen[to(x, y)..to(x, y) + 4].fill(0));
        }
    }
    shown
}

#[test]
fn gif_films_read_back_with_their_delays() {
    for background in [true, false] {
        let frames = pixels("ink", background);
        let mut film = GifFilm::new(Vec::new(), 24.0);
        frames.iter().for_each(|frame| film.push(frame, 5).unwrap());
        assert_eq!(film.left_out(), 0);
        let shown = play_gif(film.finish().unwrap());
        assert_eq!(shown.len(), frames.len());
        let mut clear = 0;
        for ((screen, _), wanted) in shown.iter().zip(&frames) {
            for (own, wanted) in screen.chunks_exact(4).zip(wanted.rgba.chunks_exact(4)) {
                assert_eq!(own[3], if wanted[3] < 128 { 0 } else { 255 });
                let apart = own.iter().zip(wanted).take(3).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
                assert!(own[3] == 0 || apart <= 16, "{own:?} {wanted:?}");
                clear += usize::from(own[3] == 0);
            }
        }
        assert_eq!(clear > 0, !background);
        let delays: u32 = shown.iter().map(|(_, delay)| delay).sum();
        assert_eq!(delays, (frames.len() as f64 * 500.0 / 24.0).round() as u32);
    }
    assert!(GifFilm::new(Vec::new(), 24.0).finish().is_err());
}

/// GIF delays are at least 0.02 s. At higher frame rates pictures are left out. The total time and the start
/// times of the others stay exact.
#[test]
fn gif_films_keep_their_duration_at_any_frame_rate() {
    let picture = |k: u32| {
        let rgba = (0..16_u32).flat_map(|pixel| [(k * 7 + pixel) as u8, (k / 8) as u8, 9, 255]).collect();
        Pixels { width: 4, height: 4, rgba, dpi: 96.0 }
    };
    for (fps, frames) in [
        (60.0, 60),
        (50.0, 7),
        (51.0, 51),
        (75.0, 40),
        (100.0, 101),
        (120.0, 7),
        (240.0, 240),
        (60.0, 1),
        (23.976, 48),
    ] {
        let mut film = GifFilm::new(Vec::new(), fps);
        (0..frames).for_each(|k| film.push(&picture(k), 1).unwrap());
        let left_out = film.left_out();
        let shown = play_gif(film.finish().unwrap());
        assert_eq!(shown.len() as u64 + left_out, u64::from(frames), "{fps}");
        assert_eq!(left_out > 0, fps > 50.0 && frames > 1, "{fps}");
        assert!(shown.iter().all(|(_, delay)| *delay >= 2), "{fps}");
        let whole: u32 = shown.iter().map(|(_, delay)| delay).sum();
        assert_eq!(whole, ((f64::from(frames) / fps * 100.0).round() as u32).max(2), "{fps}");
        // Each picture starts at the time of its frame.
        let mut at = 0;
        for (screen, delay) in shown {
            let k = (0..frames).find(|k| picture(*k).rgba == screen).expect("a frame");
            assert_eq!(at, (f64::from(k) / fps * 100.0).round() as u32, "{fps}: {k}");
            at += delay;
        }
    }
}

#[test]
fn apng_films_read_back_exactly() {
    let frames = pixels("ink", false);
    let mut bytes = Vec::new();
    let mut film = ApngFilm::new(&mut bytes, 24.0, frames.len() as u32);
    frames.iter().for_each(|frame| film.push(frame, 5).unwrap());
    film.finish().unwrap();
    let mut reader = png::Decoder::new(Cursor::new(&bytes)).read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames as usize, frames.len());
    let side = PAGE_SIDE_PX as usize;
    let mut screen = vec![0_u8; side * side * 4];
    let mut seconds = 0.0;
    for wanted in &frames {
        let mut part = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut part).unwrap();
        let control = *reader.info().frame_control().unwrap();
        seconds += f64::from(control.delay_num) / f64::from(control.delay_den);
        let (width, height) = (control.width as usize, control.height as usize);
        for y in 0..height {
            let to = ((y + control.y_offset as usize) * side + control.x_offset as usize) * 4;
            screen[to..to + width * 4].copy_from_slice(&part[y * width * 4..][..width * 4]);
        }
        assert!(screen == wanted.rgba);
    }
    assert!((seconds - frames.len() as f64 * 5.0 / 24.0).abs() < 1e-3, "{seconds}");
    let mut short = ApngFilm::new(Vec::new(), 24.0, 2);
    short.push(&frames[0], 1).unwrap();
    assert!(short.finish().is_err(), "a frame is missing");
}

#[test]
fn webp_films_read_back_exactly() {
    let frames = pixels("ink", false);
    let mut film = WebpFilm::new(24.0);
    frames.iter().for_each(|frame| film.push(frame, 5).unwrap());
    let bytes = film.finish().unwrap();
    let mut decoder = image_webp::WebPDecoder::new(Cursor::new(&bytes)).unwrap();
    assert!(decoder.is_animated() && decoder.has_alpha());
    assert_eq!(
        (decoder.num_frames() as usize, decoder.dimensions()),
        (frames.len(), (PAGE_SIDE_PX as u32, PAGE_SIDE_PX as u32))
    );
    let mut milliseconds = 0;
    for wanted in &frames {
        let mut screen = vec![0; decoder.output_buffer_size().unwrap()];
        milliseconds += decoder.read_frame(&mut screen).unwrap();
        let same = |(a, b): (&[u8], &[u8])| a == b || (a[3] == 0 && b[3] == 0);
        assert!(screen.chunks(4).zip(wanted.rgba.chunks(4)).all(same));
    }
    assert_eq!(milliseconds, (frames.len() as f64 * 5000.0 / 24.0).round() as u32);
    assert!(WebpFilm::new(24.0).finish().is_err());
}

#[test]
fn film_frames_of_another_size_are_refused() {
    let [a, b] =
        [8, 9].map(|width| Pixels { width, height: 4, rgba: vec![255; width as usize * 16], dpi: 96.0 });
    let mut gif = GifFilm::new(Vec::new(), 12.0);
    gif.push(&a, 1).unwrap();
    assert!(gif.push(&b, 1).is_err());
    let mut png = ApngFilm::new(Vec::new(), 12.0, 2);
    png.push(&a, 1).unwrap();
    assert!(png.push(&b, 1).is_err());
    let mut webp = WebpFilm::new(12.0);
    webp.push(&a, 1).unwrap();
    assert!(webp.push(&b, 1).is_err());
}
