#!/usr/bin/env bash
# What `info`, `sample`, `diff`, `synth`, `plot`, `list` and `help` print: numbers that can be known beforehand, and JSON's fields.
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
near "direction of the sun" "$(grep -A 4 '"direction"' "$work/json" | grep -oE -- '-?[0-9]+\.[0-9e-]+' | tr '\n' ' ')" "$wanted" 2e-3
near "share of the sun" "$(number share <"$work/json")" 1 0.06
near "peak of the sun" "$(number peak <"$work/json")" 1000 1
near "light of the sun" "$(number integral <"$work/json")" "$(awk "BEGIN { print 1000 * 2 * $pi * (1 - cos(2 * $pi / 180)) }")" 0.05
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

# sample: directions of any length, several at once, on standard input; levels; filters.
must synth axes card.exr --size 256 --samples 2
near "a long direction" "$(sample_along card.exr 0,1e30,0)" "${card_colour[0,1,0]}" 2e-3
near "a short direction" "$(sample_along card.exr 0,-1e-30,0)" "${card_colour[0,-1,0]}" 2e-3
"$welkin" sample card.exr --dir "${axes[@]}" >together
printf '%s\n' "${axes[@]}" | tr ',' ' ' | "$welkin" sample card.exr >lines
printf '\r\n%s\r\n\n' "1 0 0" | "$welkin" sample card.exr >dos
checks=$((checks + 2))
cmp -s together lines || fail "standard input and --dir differ"
cmp -s <(head -n 1 together) dos || fail "empty lines or carriage returns count"
near "the mean is the last level" "$(sample_along card.exr 0,0,1 --level 8)" \
  "$("$welkin" info card.exr --json | grep -oE '"mean": [^,]+' | head -n 3 | sed 's/.*: //' | tr '\n' ' ')" 1e-3
must synth zoneplate smooth.exr --frequency 1 --size 256
for filter in nearest bilinear bicubic lanczos auto; do
  near "sample --filter $filter" "$(sample_along smooth.exr 0.3,0.2,0.5 --filter $filter)" "$(sample_along smooth.exr 0.3,0.2,0.5)" 0.02
done

# diff: a map and twice itself; a peak; a heat map; between parameterizations.
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

# synth: every map, finite and not negative; what is asked for.
for name in $("$welkin" list maps | awk '{ print $1 }'); do
  must synth "$name" made.exr --size 64 --samples 2
  must info made.exr --json
  checks=$((checks + 1))
  ! grep -qE '"(nan|infinite|negative)": [1-9]' "$work/out" || fail "synth $name has values that are no radiance"
done
must synth lamps lamps1.exr --size 64 --seed 1
must synth lamps lamps2.exr --size 64 --seed 1
must synth lamps lamps3.exr --size 64 --seed 2
checks=$((checks + 2))
cmp -s lamps1.exr lamps2.exr || fail "one seed makes two maps"
! cmp -s lamps1.exr lamps3.exr || fail "two seeds make one map"
must -j 1 synth sky one.pfm --size 64
must -j 2 synth sky two.pfm --size 64
checks=$((checks + 1))
cmp -s one.pfm two.pfm || fail "synth on two threads differs from one"

# plot: the known ratios of the texels' solid angles, and pictures.
while read -r name ratio; do
  near "density of $name" "$("$welkin" plot density --of "$name" --json | number limit_ratio)" "$ratio" 1e-3
done <<END
cube $(awk 'BEGIN { print 3 * sqrt(3) }')
paraboloid 4
equal-area 1
octahedral-equal-area 1
healpix 1
END
checks=$((checks + 1))
[[ $("$welkin" plot density --of latlong --json | number limit_ratio) == null ]] || fail "a lat-long's density is bounded"
must plot density --json
checks=$((checks + 1))
[[ $(grep -c '"name"' "$work/out") == $("$welkin" list | wc -l) ]] || fail "plot density leaves some out"
must plot density picture.png --of eac --size 64
matches '"format": "png"' info picture.png --header --json
must plot mips card.exr mips.png
matches '"format": "png"' info mips.png --header --json

# list and help know every command and name.
for what in conventions filters formats layouts maps parameterizations parameters; do matches . list $what; done
for command in info convert sample diff synth plot list help; do
  matches "^Usage: welkin $command" help $command
  matches "^Usage: welkin $command" $command --help
  matches "^  $command " --help
done
matches '^Usage: welkin plot density' help plot density
matches '^welkin [0-9]+\.[0-9]+\.[0-9]+$' --version
for format in $("$welkin" list formats); do must convert card.exr "listed.$format"; done

finish
