#!/usr/bin/env bash
# `diff`: errors known beforehand, between maps of one shape and of several.
#
# diff_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes card.exr --size 256 --samples 2
must convert card.exr double.exr --scale 2
"$welkin" diff card.exr double.exr --json >"$work/json"
near "relative RMSE" "$(number relative_rmse <"$work/json")" 1 1e-6
near "energy" "$(number energy_ratio <"$work/json")" 2 1e-6
near "texels" "$(number texels <"$work/json")" $((256 * 128)) 0
rmse=$(number rmse <"$work/json")
near "PSNR" "$("$welkin" diff card.exr double.exr --peak 4 --json | number psnr)" "$(awk "BEGIN { print 20 * log(4 / $rmse) / log(10) }")" 1e-3
checks=$((checks + 2))
[[ $(number texel_by_texel <"$work/json") == true ]] || fail "maps of one shape are not compared texel by texel"
[[ $("$welkin" diff card.exr card.exr --json | number psnr) == null ]] || fail "an infinite PSNR is not null"
must diff card.exr double.exr --heat heat.png
matches '"width": 1024' info heat.png --header --json
checks=$((checks + 1))
run diff card.exr double.exr --fail-above 0.999
((status == 1)) && grep -q '^welkin: card.exr and double.exr differ: relative RMSE 1 is above 0.999$' "$work/messages" || fail "--fail-above: $(cat "$work/messages")"
must diff card.exr double.exr --fail-above 1.001
must convert card.exr cube.exr --to cube --size 128
must diff card.exr cube.exr --fail-above 0.3
must convert cube.exr cube.pfm
must diff card.exr cube.pfm --from latlong --from-b cube --fail-above 0.3

finish
