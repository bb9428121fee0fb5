#!/usr/bin/env bash
# Draws the pictures of the README and of the library's documentation from the example models:
#
#     docs/pictures/draw.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
cargo build --release --quiet
ligne="${CARGO_TARGET_DIR:-target}/release/ligne"
models=examples/models
pictures=docs/pictures

"$ligne" draw $models/castle.obj $pictures/castle.svg --size 800x600 --precision 1
"$ligne" draw $models/pump.glb $pictures/pump.svg --size 800x560 --precision 1
"$ligne" draw $models/gear.obj $pictures/gear.svg --size 480x360 --elevation 35 --precision 1
"$ligne" draw $models/teapot.obj $pictures/teapot.svg --size 480x360 --azimuth 20 --precision 1
"$ligne" draw $models/knot.ply $pictures/knot.svg --size 480x360 --azimuth 0 --elevation 30 --precision 1
"$ligne" draw $models/bracket.stl $pictures/bracket.svg --size 480x480 --azimuth 140 --style technical --precision 1

# docs/smooth.md: along edges of the mesh, smooth, and with suggestive contours.
smooth() {
    "$ligne" draw "$1" "$2-mesh.svg" --set lines.contours=mesh "${@:3}"
    "$ligne" draw "$1" "$2.svg" "${@:3}"
    "$ligne" draw "$1" "$2-suggestive.svg" --style suggestive "${@:3}"
}
smooth $models/bear.ply $pictures/smooth-bear --size 320x400 --azimuth 25 --elevation 12 --precision 1
smooth $models/teapot.obj $pictures/smooth-teapot --size 320x240 --azimuth 20 --precision 1

# docs/fills.md: the presets, and the README's first picture
"$ligne" draw $models/castle.obj $pictures/castle-comic-flats.png --style comic-flats --size 640x470
for style in toon toon-highlight noir rim gooch flat; do
    "$ligne" draw $models/teapot.obj $pictures/fills-$style.svg --style $style --size 320x240 --azimuth 20 --precision 1
done
# In 128 steps the SVG would be ten times as large.
"$ligne" draw $models/teapot.obj $pictures/fills-gradient.png --style gradient --size 320x240 --azimuth 20
"$ligne" draw $models/knot.ply $pictures/fills-knot.svg --style comic-flats --set lines.enabled=false --size 320x240 --azimuth 0 --elevation 30 --precision 1
"$ligne" draw $models/pump.glb $pictures/fills-pump.svg --style toon --size 640x440 --precision 1

# docs/lines.md: pens
lines() {
    "$ligne" draw "$1" "$pictures/lines-$2.svg" --size 320x240 --precision 2 "${@:3}"
}
wide=(--set pen.width=1.6 --set pen.contour.width=2.6 --set pen.silhouette.width=3.4)
lines $models/teapot.obj taper --azimuth 20 "${wide[@]}" --set pen.swell.taper=36 --set pen.swell.taper_to=0.1
lines $models/teapot.obj lit --azimuth 20 "${wide[@]}" --set pen.swell.taper=20 --set pen.swell.lit=0.75
lines $models/teapot.obj bend --azimuth 20 "${wide[@]}" --set pen.swell.taper=30 --set pen.swell.bend=0.9 --set pen.swell.gap=0.6
lines $models/bracket.stl sketch --azimuth 140 --set pen.width=0.8 --set pen.contour.width=0.8 --set pen.silhouette.width=1 \
    --set pen.swell.taper=24 --set pen.hand.tremor=0.9 --set pen.hand.overshoot=8 --set pen.hand.passes=2
lines $models/knot.ply halo --azimuth 0 --elevation 30 --set lines.hidden=solid --set pen.halo=3 \
    --set pen.contour.width=1.2 --set pen.silhouette.width=1.2 --set pen.hidden.width=0.8
lines $models/knot.ply brush --azimuth 0 --elevation 30 --set pen.contour.width=4 --set pen.silhouette.width=6 \
    --set 'pen.brush={ path = "M0 5C30 -1 60 -1 100 5C60 9 30 9 0 5Z" }'

# docs/hatching.md and the README: one model in all styles
hatched() {
    "$ligne" draw $models/teapot.obj "$pictures/hatch-$1.png" --size 360x270 --azimuth 20 --quiet "${@:2}"
}
for style in ink pencil pencil-plain pen engraving stipple woodcut comic sketch patent blueprint toon toon-highlight noir gooch comic-flats rim flat technical suggestive; do
    hatched $style --style $style
done
hatched object --style pen --set 'hatching.layer=[{ direction = "object", angle = 30 }, { direction = "object", angle = -50 }]'
hatched dots --style stipple --set 'hatching.layer=[{ kind = "dots", lpi = 20 }]'
"$ligne" draw $models/castle.obj $pictures/castle-pen.png --style pen --size 800x590

# docs/stages.md
"$ligne" draw $models/bear.ply $pictures/stage-field.png --stage field --size 400x480 --azimuth 25 --elevation 12
"$ligne" draw $models/knot.ply $pictures/stage-zeros.svg --stage zeros --size 480x400 --precision 1
"$ligne" draw $models/pump.glb $pictures/stage-strengths.svg --stage strengths --size 560x400 --precision 1
"$ligne" draw $models/bear.ply $pictures/stage-removed.svg --stage removed --style suggestive --size 400x480 --azimuth 25 --elevation 12 --precision 1
