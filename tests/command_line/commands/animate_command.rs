//! `ligne animate`: numbered frames, films, shards, `--resume`, fading, levels of detail, and refused calls.

use crate::folder::TestFolder;

const CRANE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/crane.glb");
const GEAR: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/gear.obj");

/// Runs `ligne animate` at 160 px.
fn animate(folder: &TestFolder, model: &str, out: &str, more: &str) -> crate::folder::RunResult {
    let more: Vec<&str> = more.split_whitespace().collect();
    folder.run(&[&["animate", model, out, "--size", "160"], &more[..]].concat())
}

#[test]
fn frames_are_written_as_numbered_files() {
    let folder = TestFolder::new("frames");
    let run = animate(&folder, CRANE, "f/%03d.svg", "--fps 2");
    assert!(run.expect_success().err.starts_with("f/%03d.svg: 8 frames, "), "{run:?}");
    assert_eq!(folder.names_in("f").first().map(String::as_str), Some("000.svg"));
    assert_eq!(folder.names_in("f").len(), 8);
    assert!(folder.text("f/003.svg").contains(" data-id=\""));
    assert_ne!(folder.text("f/000.svg"), folder.text("f/003.svg"));
    // `--hold 2` writes every drawing twice.
    animate(&folder, CRANE, "held/%d.svg", "--fps 4 --hold 2 --quiet").expect_success();
    assert_eq!(folder.names_in("held").len(), 16);
    for frame in 0..8 {
        let of = |frame: usize| folder.text(&format!("held/{frame}.svg"));
        assert_eq!(of(2 * frame), of(2 * frame + 1));
        assert_eq!(of(2 * frame), folder.text(&format!("f/{frame:03}.svg")));
    }
    animate(&folder, CRANE, "p/%d.png", "--from 1 --to 2 --fps 2 --threads 1").expect_success();
    animate(&folder, CRANE, "p/%d.pdf", "--from 1 --to 2 --fps 2").expect_success();
    assert_eq!(folder.names_in("p"), ["0.pdf", "0.png", "1.pdf", "1.png"]);
}

#[test]
fn sharded_and_resumed_runs_give_the_same_frames_as_one_run() {
    let folder = TestFolder::new("shards");
    animate(&folder, CRANE, "all/%d.svg", "--fps 3 --style sketch --threads 2").expect_success();
    for shard in ["2/3", "1/3", "3/3"] {
        animate(
            &folder,
            CRANE,
            "parts/%d.svg",
            &format!("--fps 3 --style sketch --threads 1 --shard {shard}"),
        )
        .expect_success();
    }
    assert_eq!(folder.names_in("all"), folder.names_in("parts"));
    for name in folder.names_in("all") {
        assert_eq!(folder.text(&format!("all/{name}")), folder.text(&format!("parts/{name}")), "{name}");
    }
    // Existing files are kept. Missing ones are drawn.
    folder.write("parts/4.svg", "drawn already");
    std::fs::remove_file(folder.path("parts/5.svg")).unwrap();
    let run = animate(&folder, CRANE, "parts/%d.svg", "--fps 3 --style sketch --resume");
    assert!(run.expect_success().err.contains("12 frames, 1 drawing, "), "{run:?}");
    assert_eq!(folder.text("parts/4.svg"), "drawn already");
    assert_eq!(folder.text("parts/5.svg"), folder.text("all/5.svg"));
}

#[test]
fn stroke_fading_is_the_same_in_every_shard() {
    let folder = TestFolder::new("fade");
    let fade = "--fps 6 --style sketch --set motion.fade=2";
    animate(&folder, CRANE, "plain/%d.svg", "--fps 6 --style sketch").expect_success();
    let run = animate(&folder, CRANE, "all/%d.svg", &format!("{fade} --threads 2"));
    assert!(run.expect_success().err.contains("24 frames, "), "{run:?}");
    animate(&folder, CRANE, "parts/%d.svg", &format!("{fade} --threads 1 --shard 2/5")).expect_success();
    assert_eq!(folder.names_in("parts").len(), 5);
    for name in folder.names_in("parts") {
        assert_eq!(folder.text(&format!("all/{name}")), folder.text(&format!("parts/{name}")), "{name}");
    }
    std::fs::remove_file(folder.path("all/7.svg")).unwrap();
    let seventh = animate(&folder, CRANE, "all/%d.svg", &format!("{fade} --resume"));
    assert!(seventh.expect_success().err.contains("24 frames, 1 drawing, "), "{seventh:?}");
    let other =
        |frame: usize| folder.text(&format!("all/{frame}.svg")) != folder.text(&format!("plain/{frame}.svg"));
    assert!((0..24).filter(|frame| other(*frame)).count() > 4);
    animate(&folder, CRANE, "again/%d.svg", fade).expect_success();
    assert_eq!(folder.text("again/7.svg"), folder.text("all/7.svg"));
    // With `--hold`, fading counts drawings, not frames.
    animate(&folder, CRANE, "held/%d.svg", &format!("--fps 12 --hold 2 {}", &fade[8..])).expect_success();
    assert_eq!(folder.text("held/15.svg"), folder.text("all/7.svg"));
    // A single moment has no neighbours, so nothing fades.
    for (name, more) in [("a.svg", ""), ("b.svg", "--set motion.fade=2")] {
        folder.ligne(&format!("draw {CRANE} {name} --time 1 --size 160 {more}")).expect_success();
    }
    assert_eq!(folder.text("a.svg"), folder.text("b.svg"));
    let refused = |more: &str, why: &str| {
        animate(&folder, CRANE, "no/%d.svg", more).expect_refusal(why);
    };
    refused("--set motion.fade=2 --budget 1s", "motion.fade");
    refused("--set motion.fade=-1", "a whole number from 0 to 24");
    refused("--set motion.fade=1.5", "a whole number from 0 to 24");
    refused("--set motion.fade_by=ink", "fade_by");
}

#[test]
fn turntable_fading_wraps_from_the_last_frame_to_the_first() {
    let folder = TestFolder::with_cubes("fade-turn");
    let turn = |out: &str, more: &str| {
        folder
            .ligne(&format!("animate cubes.obj {out}/%d.svg --turntable 12 --size 160 {more}"))
            .expect_success();
    };
    turn("once", "--set motion.fade=1");
    turn("shard", "--set motion.fade=1 --shard 1/12");
    assert_eq!(folder.text("once/0.svg"), folder.text("shard/0.svg"));
    turn("plain", "");
    // Faded strokes are thinner and need more `stroke-width` attributes.
    let thin = |frame: usize| folder.text(&format!("once/{frame}.svg")).matches("stroke-width").count();
    let plain = |frame: usize| folder.text(&format!("plain/{frame}.svg")).matches("stroke-width").count();
    assert!((0..12).any(|frame| thin(frame) > plain(frame)));
}

#[test]
fn animation_weights_change_from_frame_to_frame() {
    let folder = TestFolder::new("weights");
    animate(&folder, CRANE, "fade/%d.svg", "--fps 1 --to 8 --repeat --animation lift:0..1 --view iso")
        .expect_success();
    assert_eq!(folder.names_in("fade").len(), 8);
    // A range without times spans all frames. Each frame depends on its moment only, in any shard.
    let all = "--fps 1 --to 8 --repeat --animation lift:0@0..1@8 --view iso";
    animate(&folder, CRANE, "shard/%d.svg", &format!("{all} --shard 3/4 --threads 1")).expect_success();
    assert_eq!(folder.names_in("shard"), ["2.svg", "6.svg"]);
    for name in ["2.svg", "6.svg"] {
        assert_eq!(folder.text(&format!("fade/{name}")), folder.text(&format!("shard/{name}")));
    }
    // With `--repeat` the animation is at 2 s in both frames, so only the weight differs.
    assert_ne!(folder.text("fade/2.svg"), folder.text("fade/6.svg"));
    animate(&folder, CRANE, "no.svg", "--animation lift:1@2..0@1").expect_refusal("do not rise");
}

#[test]
fn films_are_written_in_every_format() {
    let folder = TestFolder::new("films");
    for (name, begins) in
        [("a.svg", &b"<svg "[..]), ("a.gif", b"GIF89a"), ("a.png", b"\x89PNG"), ("a.webp", b"RIFF")]
    {
        animate(&folder, CRANE, name, "--fps 2 --quiet").expect_success();
        assert!(folder.read(name).starts_with(begins), "{name}");
    }
    animate(&folder, CRANE, "b.svg", "--fps 2 --quiet --threads 1").expect_success();
    assert_eq!(folder.text("a.svg"), folder.text("b.svg"));
    let turn = animate(&folder, GEAR, "turn.svg", "--turntable 6 --report r.json");
    assert!(turn.expect_success().err.starts_with("turn.svg: 6 frames, "), "{turn:?}");
    let report: serde_json::Value = serde_json::from_str(&folder.text("r.json")).unwrap();
    assert_eq!((report["frames"].as_u64(), report["drawings"].as_u64()), (Some(6), Some(6)));
    assert!(
        report["stages_ms"]["visibility"].as_f64() > Some(0.0)
            && report["counts"]["paths"].as_u64() > Some(6)
    );
    assert_eq!(folder.names(), ["a.gif", "a.png", "a.svg", "a.webp", "b.svg", "r.json", "turn.svg"]);
}

#[test]
fn gif_drops_frames_above_its_maximum_frame_rate() {
    let folder = TestFolder::with_cubes("gif-rate");
    let run = folder.ligne("animate cubes.obj a.gif --turntable 30 --fps 60 --size 40");
    assert!(run.expect_success().err.contains("10 of 30 frames are left out"), "{run:?}");
    folder
        .ligne("animate cubes.obj b.gif --turntable 30 --fps 60 --size 40 --strict")
        .expect_refusal("left out");
    assert_eq!(folder.names(), ["a.gif", "cubes.obj"]);
    let run = folder.ligne("animate cubes.obj c.gif --turntable 30 --fps 50 --size 40 --strict");
    assert!(!run.expect_success().err.contains("warning"), "{run:?}");
}

#[test]
fn levels_chosen_by_a_budget_are_reproducible() {
    let folder = TestFolder::new("levels");
    let horn = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/horn.obj");
    let run = animate(&folder, horn, "a/%d.svg", "--turntable 6 --budget 5s --levels levels.json");
    assert!(run.expect_success().err.contains(" faces, 99 % within "), "{run:?}");
    let levels: serde_json::Value = serde_json::from_str(&folder.text("levels.json")).unwrap();
    assert_eq!(levels["faces"].as_array().map(Vec::len), Some(6));
    animate(&folder, horn, "b/%d.svg", "--turntable 6 --levels levels.json --threads 2").expect_success();
    // Each drawing has its own face count.
    folder.write("mine.json", "{\"faces\": [100000, 100000, 300, 300, 200, 100000]}");
    animate(&folder, horn, "c/%d.svg", "--turntable 6 --levels mine.json").expect_success();
    for frame in 0..6 {
        let of = |run: &str| folder.text(&format!("{run}/{frame}.svg"));
        assert_eq!(of("a"), of("b"));
        assert_eq!(of("a") == of("c"), [0, 1, 5].contains(&frame), "{frame}");
    }
    animate(&folder, horn, "d/%d.svg", "--turntable 6 --faces 300 --set lines.contours=mesh")
        .expect_success();
    assert_eq!(folder.text("c/2.svg"), folder.text("d/2.svg"));
    animate(&folder, horn, "e/%d.svg", "--turntable 7 --levels mine.json").expect_refusal("it has 6 levels");
    folder.write("mine.json", "[3]");
    animate(&folder, horn, "e/%d.svg", "--turntable 6 --levels mine.json")
        .expect_refusal("not a list of face counts");
    animate(&folder, horn, "e/%d.svg", "--turntable 6 --budget soon").expect_refusal("a time, such as 33ms");
    animate(&folder, horn, "e/%d.svg", "--turntable 6 --budget 9ms --shard 1/2")
        .expect_refusal("cannot be used with");
}

#[test]
fn a_camera_path_sets_the_camera_of_each_frame() {
    let folder = TestFolder::with_cubes("path");
    let record = |x: f64| {
        format!(
            "{{\"type\":\"perspective\",\"eye\":[{x},3,9],\"target\":[0,0,0],\"up\":[0,1,0],\"fov_y_deg\":35}}"
        )
    };
    folder.write("path.json", &format!("[{},{}]", record(0.0), record(4.0)));
    folder.ligne("animate cubes.obj p/%d.svg --path path.json --size 200").expect_success();
    for (frame, x) in [(0, 0.0), (1, 4.0)] {
        folder.write("one.json", &record(x));
        folder.ligne("draw cubes.obj one.svg --camera one.json --size 200").expect_success();
        let drawn = folder.text(&format!("p/{frame}.svg"));
        let plain: String = drawn
            .split(" data-id=\"")
            .map(|part| part.split_once("\" d=").map_or(part.to_owned(), |(_, rest)| format!(" d={rest}")))
            .collect();
        assert_eq!(plain, folder.text("one.svg"));
    }
    folder.write("bad.json", "[{\"eye\": 3}]");
    folder.ligne("animate cubes.obj p/%d.svg --path bad.json").expect_refusal("camera 0");
    folder.write("none.json", "[]");
    folder
        .ligne("animate cubes.obj p/%d.svg --path none.json")
        .expect_refusal("the list of cameras is empty");
    folder.ligne("animate cubes.obj p/%d.svg --path absent.json").expect_refusal("absent.json");
}

#[test]
fn invalid_animate_calls_are_refused_and_write_nothing() {
    let folder = TestFolder::with_cubes("refused");
    let refused = |line: &str, why: &str| {
        folder.ligne(line).expect_refusal(why);
    };
    refused("animate cubes.obj f.svg", "--turntable 36");
    refused("animate cubes.obj f.svg --animation Walk", "the model has no animations; leave out --animation");
    refused("animate cubes.obj f.pdf --turntable 4", "a PDF file cannot hold a film");
    refused("animate cubes.obj f.avi --turntable 4", "ligne cannot write films as .avi");
    refused("animate cubes.obj - --turntable 4", "standard output");
    refused("animate cubes.obj %s.svg --turntable 4", "no place for the number of a frame");
    refused("animate cubes.obj f.svg --turntable 4 --time 2", "--from and --to");
    refused("animate cubes.obj f.svg --turntable 4 --shard 1/2", "one file per frame");
    refused("animate cubes.obj f.gif --turntable 4 --resume", "one file per frame");
    refused("animate cubes.obj f.svg --turntable 0", "0");
    refused("animate cubes.obj f.svg --turntable 4 --fps 0", "frames per second");
    refused("animate cubes.obj f.svg --turntable 4 --fps nan", "frames per second");
    refused("animate cubes.obj f.svg --turntable 4 --hold 0", "0");
    refused("animate cubes.obj f.svg --turntable 4 --path p.json", "cannot be used with");
    refused("animate cubes.obj cubes.obj --turntable 4", "ligne cannot write films as .obj");
    refused("animate cubes.obj no/such/f.svg --turntable 4", "there is no folder");
    refused("animate none.obj f.svg --turntable 4", "none.obj");
    let crane = |more: &str, why: &str| {
        animate(&folder, CRANE, "f.svg", more).expect_refusal(why);
    };
    crane("--animation walk", "no animation `walk`; its animations are lift");
    crane("--from 3 --to 1", "make the end later than the start");
    crane("--to 1e12", "too many");
    crane("--shard 3/2", "K/N");
    assert_eq!(folder.names(), ["cubes.obj"]);
    let beyond = animate(&folder, CRANE, "f.svg", "--to 6 --fps 1");
    assert!(beyond.expect_success().err.contains("the animation lasts from 0 s to 4 s"), "{beyond:?}");
    animate(&folder, CRANE, "g.svg", "--to 6 --fps 1 --strict")
        .expect_refusal("outside that time nothing moves");
}

#[test]
fn video_output_needs_ffmpeg() {
    let folder = TestFolder::new("video");
    let run = folder.run_with(&[("PATH", "")], &format!("animate {CRANE} f.mp4 --fps 2"));
    run.expect_refusal("ffmpeg is not installed");
    assert!(folder.names().is_empty());
    if std::process::Command::new("ffmpeg").arg("-version").output().is_err() {
        println!("skipped: no ffmpeg to write a video with");
        return;
    }
    for name in ["a.mp4", "b.mp4"] {
        folder.run(&["animate", CRANE, name, "--fps", "5", "--hold", "2", "--size", "161"]).expect_success();
    }
    assert_eq!(folder.read("a.mp4"), folder.read("b.mp4"));
    assert_eq!(folder.read("a.mp4").get(4..8), Some(&b"ftyp"[..]));
}

/// Browsers that can play an animated SVG.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

#[test]
fn a_browser_plays_an_animated_svg() {
    let there = |name: &&&str| std::process::Command::new(name).arg("--version").output().is_ok();
    let Some(browser) = BROWSERS.iter().find(there) else {
        println!("skipped: no browser to play an animated SVG in");
        return;
    };
    let folder = TestFolder::new("browser");
    animate(&folder, CRANE, "a.svg", "--fps 2 --quiet").expect_success();
    let script = "<script>const svg = document.querySelector('svg'), used = svg.querySelector(':scope > use'), seen = [];\n\
        const times = [0, 0.6, 1.1, 3.9, 4.1];\n\
        const next = () => {\n\
            const time = times.shift();\n\
            if (time === undefined) { document.body.append('seen ' + seen.join(' ') + ' end'); return; }\n\
            svg.setCurrentTime(time);\n\
            setTimeout(() => { seen.push(used.href.animVal); next(); }, 100);\n\
        };\n\
        svg.pauseAnimations();\n\
        next();</script>";
    let text = folder.text("a.svg").replace("xmlns:inkscape", "data-inkscape").replace("inkscape:", "data-");
    folder.write("page.html", &format!("<!doctype html><body>{text}{script}"));
    let output = std::process::Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=4000", "--dump-dom"])
        .arg(format!("--user-data-dir={}", folder.path("profile").display()))
        .arg(folder.path("page.html"))
        .output()
        .unwrap();
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    let seen = dom.rsplit_once("seen ").and_then(|(_, rest)| rest.split_once(" end")).map(|(seen, _)| seen);
    if seen.is_none() {
        println!("skipped: {browser} shows no page here: {}", String::from_utf8_lossy(&output.stderr));
        return;
    }
    assert_eq!(seen, Some("#frame-0 #frame-1 #frame-2 #frame-7 #frame-0"), "{dom}");
}
