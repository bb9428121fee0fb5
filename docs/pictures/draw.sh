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
