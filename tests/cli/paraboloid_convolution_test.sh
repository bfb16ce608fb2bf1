#!/usr/bin/env bash
# `bake --method paraboloid-convolution` and `plot distortion`: what they make, report and refuse.
#
# paraboloid_convolution_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth zoneplate smooth.exr --frequency 1 --size 128
matches "convolution" bake smooth.exr made.exr --to paraboloid --size 64 --lobe phong,exponent=50 --method paraboloid-convolution
must bake smooth.exr exact.exr --to paraboloid --size 64 --lobe phong,exponent=50
same made.exr exact.exr 0.1
run diff made.exr exact.exr --fail-above 0.0001
checks=$((checks + 1))
((status == 1)) || fail "the approximation has no error"

matches '"method": "convolution"' bake smooth.exr chain.ktx2 --to paraboloid --size 32 --levels 3 --lobe phong \
  --method paraboloid-convolution --verify=4 --json
near "no furnace is told" "$(grep -c '"furnace": null' "$work/out")" 3 0
matches "level 2  " info chain.ktx2

must plot distortion picture.png
[[ -s picture.png ]] || fail "no picture"
matches " 23\.95$" plot distortion

refuses 2 "--method: .*makes paraboloid maps, not cube: give --to paraboloid" bake smooth.exr out.exr --lobe phong,exponent=9 \
  --method paraboloid-convolution
refuses 2 "--method: unknown method 'paraboloid-convoluton'; did you mean" bake smooth.exr out.exr --method paraboloid-convoluton
refuses 2 "square" bake smooth.exr out.exr --to paraboloid --size 8x4 --method paraboloid-convolution

finish
