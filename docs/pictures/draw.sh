#!/usr/bin/env bash
# Draws the pictures of the README and the documents from the example models:
#
#     docs/pictures/draw.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
cargo build --release --quiet
ligne="${CARGO_TARGET_DIR:-target}/release/ligne"
models=examples/models
pictures=docs/pictures
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# SVG pictures are tested: docs/pictures/cases has a case for each (docs/how-to/ci.md).
"$ligne" test $pictures/cases --bless

# docs/explanation/fills.md: the presets, and the README's first picture
"$ligne" draw $models/castle.obj $pictures/castle-comic-flats.png --style comic-flats --size 640x470
# In 128 steps the SVG would be ten times as large.
"$ligne" draw $models/teapot.obj $pictures/fills-gradient.png --style gradient --size 320x240 --azimuth 20

# docs/explanation/hatching.md and the README: one model in all styles
hatched() {
    "$ligne" draw $models/teapot.obj "$pictures/hatch-$1.png" --size 360x270 --azimuth 20 --quiet "${@:2}"
}
for style in ink pencil pencil-plain pen engraving stipple woodcut comic sketch patent blueprint toon toon-highlight noir gooch comic-flats rim flat technical suggestive; do
    # Styles for plotters have no paper.
    hatched $style --style $style $([ "$style" = pencil-plain ] && echo --background white)
done
hatched object --style pen --set 'hatching.layer=[{ direction = "object", angle = 30 }, { direction = "object", angle = -50 }]'
hatched dots --style stipple --set 'hatching.layer=[{ kind = "dots", lpi = 20 }]'
"$ligne" draw $models/castle.obj $pictures/castle-pen.png --style pen --size 800x590

# docs/gallery.md: each built-in style on four models, as one page of four panels
gallery() {
    local file="$scratch/gallery.toml"
    cat > "$file" << END
[page]
kind = "comic"
size = "960x240px"
margin = 0
gutter = 0
border = 0
style = "$1"
layout = "[6 | 6 | 5 | 4]"
panel = [
    { model = "$PWD/$models/castle.obj", camera = { azimuth = 28, elevation = 16 } },
    { model = "$PWD/$models/pump.glb", camera = { azimuth = 35, elevation = 22 } },
    { model = "$PWD/$models/teapot.obj", camera = { azimuth = 20, elevation = 22 } },
    { model = "$PWD/$models/bear.ply", camera = { azimuth = 25, elevation = 12 } },
]
END
    "$ligne" page "$file" "$pictures/gallery/$1.png" --dpi 64 --quiet
}
mkdir -p $pictures/gallery
for file in styles/*.toml; do
    gallery "$(basename "$file" .toml)"
done

# docs/dev/stages.md
"$ligne" draw $models/bear.ply $pictures/stage-field.png --stage field --size 400x480 --azimuth 25 --elevation 12
"$ligne" draw $models/knot.ply $pictures/stage-zeros.svg --stage zeros --size 480x400 --precision 1
"$ligne" draw $models/pump.glb $pictures/stage-strengths.svg --stage strengths --size 560x400 --precision 1
"$ligne" draw $models/bear.ply $pictures/stage-removed.svg --stage removed --style suggestive --size 400x480 --azimuth 25 --elevation 12 --precision 1

# docs/explanation/diff.md and the README: a bolt gone, a coupling recoloured
changed=$(mktemp -d)
pump=(--size 560x400 --style toon --precision 1 --quiet)
"$ligne" draw $models/pump.glb "$changed/old.svg" "${pump[@]}"
"$ligne" draw $models/pump.glb "$changed/new.svg" "${pump[@]}" --hide frame-bolt-3 \
    --set 'fills.material=[{ name = "orange rubber", colour = "#3355ee" }]'
# Exit status 1 means that they differ.
"$ligne" diff "$changed/old.svg" "$changed/new.svg" --image $pictures/diff-pump.svg || [ $? = 1 ]
rm -r "$changed"

# docs/how-to/animation.md: moments of a clip, seen by the file's camera
for time in 0 1 2 3; do
    "$ligne" draw $models/crane.glb "$pictures/crane-$time.png" --camera camera --style toon --time $time --size 320x246 --quiet
done

# docs/how-to/animation.md: a brick flies past a man
brick=(--camera camera --size 480x370 --set motion.enabled=true --quiet)
"$ligne" draw $models/brick.glb $pictures/motion-brick.png --time 1 --style toon "${brick[@]}"
"$ligne" draw $models/brick.glb $pictures/motion-fist.png --time 1.05 --style comic "${brick[@]}" \
    --set motion.parts=fist-right --set motion.segments=10 --set motion.taper=1 --set motion.width=2

# docs/how-to/comic-pages.md and the README
"$ligne" page examples/pages/comic.toml $pictures/page-comic.png --dpi 110 --quiet

# docs/how-to/sheets.md and the README
"$ligne" page examples/pages/pump.toml $pictures/sheet-pump.png --dpi 90 --quiet
