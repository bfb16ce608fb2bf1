#!/usr/bin/env bash
# Babylon.js's .env, radiance in 8 bits, and PlayCanvas's atlas.
#
# env_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth room room.exr --size 256

# ---- .env
tells 'room.env: its values are rounded to 8 bits .* relative RMS error of 0\.[0-9]+ %' \
  bake room.exr room.env --size 32 --convention babylon --roughness babylon
must bake room.exr room.ktx2 --size 32 --convention babylon --roughness babylon
same room.ktx2 room.env 0.01
matches '^  welkin.convention +babylon$' info room.env --header
matches '^  welkin.roughness-curve +babylon$' info room.env --header
matches '^  level 5 +charts 1×1' info room.env --header
checks=$((checks + 1))
[[ $(head -c 8 room.env | od -A n -t x1 | tr -d ' ') == 86168796f6d69636 ]] || fail "room.env does not begin as .env does"
checks=$((checks + 1))
head -c 4000 room.env | tr '\0' '\n' | grep -aq '"irradiance":{"x":\[.*"lodGenerationScale":0.8' || fail "room.env has another manifest"
tells 'in the native world, which no scene of Babylon.js is' bake room.exr native.env --size 8
must convert room.ktx2 again.env -q
same room.env again.env 1e-6
# A file that says nothing of itself is as Babylon's default scene shows it.
sed 's/"welkin":/"others":/' room.env >foreign.env
matches '^  welkin.convention +babylon$' info foreign.env --header
same room.env foreign.env 1e-6
refuses 1 'all 6 levels of faces of 32, not 4' bake room.exr no.env --size 32 --levels 4 --convention babylon -q
refuses 1 'faces of a power of two' bake room.exr no.env --size 24 --convention babylon -q
refuses 1 'all 5 levels of faces of 16, not 1' convert room.exr no.env --to cube --size 16 --convention babylon -q
head -c 300 room.env >cut.env
refuses 1 'cut.env: its manifest has no end' info cut.env

# ---- encodings
must synth room plain.exr --size 128
for encoding in rgbm,range=64 rgbd rgbp rgbe; do
  tells 'rounded to 8 bits with a common factor, with a relative RMS error of 0\.' convert plain.exr "$encoding.png" --encoding "$encoding"
  same plain.exr "$encoding.png" 0.01
  matches "^  welkin.encoding +$encoding\$" info "$encoding.png" --header
  same "$encoding.png" "$encoding.png" 0 --from-encoding "$encoding"
done
tells 'values were above what the file can hold, and clipped' convert plain.exr low.png --encoding rgbm,range=1
refuses 2 "encoding: unknown encoding 'rgbx'; did you mean" convert plain.exr no.png --encoding rgbx
refuses 2 "rgbd takes no parameters, but 'range' was given" convert plain.exr no.png --encoding rgbd,range=3
refuses 1 'PNG is' convert plain.exr no.exr --encoding rgbd
run convert plain.exr colours.png
refuses 1 'is no picture of R, G, B and A of 8 bits each' convert colours.png no.exr --from-encoding rgbm

# ---- PlayCanvas
tells 'rounded to 8 bits' bake room.exr atlas.png --atlas playcanvas
matches '^  picture +512×512, R G B of uint8, compression deflate rgbp$' info atlas.png --header
refuses 2 '--atlas: has levels of its own' bake room.exr no.png --atlas playcanvas --size 64
refuses 2 'written as rgbp: PNG is' bake room.exr no.exr --atlas playcanvas

finish
