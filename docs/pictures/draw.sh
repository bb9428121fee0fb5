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

# docs/stages.md
"$ligne" draw $models/bear.ply $pictures/stage-field.png --stage field --size 400x480 --azimuth 25 --elevation 12
"$ligne" draw $models/knot.ply $pictures/stage-zeros.svg --stage zeros --size 480x400 --precision 1
"$ligne" draw $models/pump.glb $pictures/stage-strengths.svg --stage strengths --size 560x400 --precision 1
"$ligne" draw $models/bear.ply $pictures/stage-removed.svg --stage removed --style suggestive --size 400x480 --azimuth 25 --elevation 12 --precision 1
