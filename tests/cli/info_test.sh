#!/usr/bin/env bash
# What `info` says of maps whose numbers are known beforehand, and the fields of its JSON.
#
# info_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

pi=3.14159265358979

# info: a constant map of radiance 2.
must synth constant two.exr --intensity 2 --to cube --size 16
"$welkin" info two.exr --json >"$work/json"
for key in file format bytes parts name width height channels type compression colour notes attributes parameterization reason chart statistics \
  texels solid_angle min max mean integral nan infinite negative luminance percentile_1 percentile_50 percentile_99 percentile_99_9 stops; do
  checks=$((checks + 1))
  grep -q "\"$key\":" "$work/json" || fail "info --json has no '$key'"
done
near "texels" "$(number texels <"$work/json")" 1536 0
near "solid angle" "$(number solid_angle <"$work/json")" "$(awk "BEGIN { print 4 * $pi }")" 1e-4
near "mean" "$(number mean <"$work/json")" 2 1e-6
near "integral" "$(number integral <"$work/json")" "$(awk "BEGIN { print 8 * $pi }")" 1e-4
near "stops of a constant" "$(number stops <"$work/json")" 0 1e-6
near "bytes" "$(number bytes <"$work/json")" "$(stat -c %s two.exr)" 0
matches '"parameterization": "cube:hcross"' info two.exr --json
matches '^  parameterization  cube:hcross \(declared by the file\), charts 6×16×16$' info two.exr
must info two.exr --header --json
checks=$((checks + 1))
! grep -q statistics "$work/out" || fail "--header reads pixels"
# Several files: an array.
must info two.exr two.exr --json
checks=$((checks + 1))
[[ $(head -c 1 "$work/out") == "[" && $(grep -c '"file"' "$work/out") == 2 ]] || fail "info of two files is no array of two"
if command -v jq >/dev/null; then
  for arguments in "info two.exr" "info two.exr two.exr" "diff two.exr two.exr" "plot density" "plot density --of sphere"; do
    # shellcheck disable=SC2086
    must $arguments --json
    checks=$((checks + 1))
    jq -e . "$work/out" >/dev/null || fail "welkin $arguments --json is not JSON"
  done
fi
# The brightest light: where the sun was put, its power and its size.
must synth sun sun.exr --size 1024 --azimuth 60 --elevation 30 --angle 4 --intensity 1000 --background 0
"$welkin" info sun.exr --json >"$work/json"
wanted=$(awk "BEGIN { d = $pi / 180; print cos(30 * d) * sin(60 * d), sin(30 * d), cos(30 * d) * cos(60 * d) }")
near "direction of the sun" "$(grep -m 1 -A 3 '"direction"' "$work/json" | grep -oE -- '-?[0-9]+\.[0-9e-]+' | tr '\n' ' ')" "$wanted" 2e-3
near "share of the sun" "$(number share <"$work/json")" 1 0.06
near "peak of the sun" "$(number peak <"$work/json")" 1000 1
near "light of the sun" "$(number integral <"$work/json")" "$(awk "BEGIN { print 1000 * 2 * $pi * (1 - cos(2 * $pi / 180)) }")" 0.05
# The edges of every cube's faces, and of nothing else.
matches '^  edges of faces    steps of 0 stops across them, 0 beside them: they join$' info two.exr
must synth studio cube.exr --to cube:hstrip --size 64
matches '^  edges of faces    steps of 0\.[0-9]+ stops across them, 0\.[0-9]+ beside them: they join$' info cube.exr
must convert cube.exr mixed.pfm --to-faces px,nx,py:90,nz,pz,ny
matches '^  edges of faces    steps of [0-9.]+ stops across them, 0\.[0-9]+ beside them: they do not join$' info mixed.pfm --from-convention native
matches '^  edges of faces    .*: they join$' info mixed.pfm
"$welkin" info cube.exr --json >"$work/json"
checks=$((checks + 1))
grep -A 4 '"face_edges"' "$work/json" | grep -q '"join": true' || fail "info --json tells no edges"
must info sun.exr
checks=$((checks + 1))
! grep -q 'edges of faces' "$work/out" || fail "a lat-long has edges of faces"
# Attributes of a file can't write to the terminal.
must synth constant plain.exr --size 4
sed 's/latlong/\x1b[31mq/' plain.exr >coloured.exr
run info coloured.exr --from latlong
checks=$((checks + 1))
! grep -q $'\x1b' "$work/out" "$work/messages" || fail "an escape character of a file reaches the terminal"
run info coloured.exr
checks=$((checks + 1))
((status == 1)) || fail "a damaged declaration is believed"
! grep -q $'\x1b' "$work/out" "$work/messages" || fail "an escape character of a file reaches the terminal in a message"

finish
