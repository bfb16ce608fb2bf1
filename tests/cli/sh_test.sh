#!/usr/bin/env bash
# `sh`: coefficients of maps and maps of coefficients, bases, formats, deringing, what it refuses.
#
# sh_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# does ARGUMENT…: welkin does this; what it reports is in $work/messages.
does() {
  checks=$((checks + 1))
  run "$@"
  ((status == 0)) || fail "welkin $*: status $status: $(head -n 3 -- "$work/messages")"
}
# coefficients <JSON: all numbers of the coefficients.
coefficients() { sed -n '/"coefficients"/,/^  \]/p' | tail -n +2 | tr -d '[],\n' | tr -s ' '; }

must synth constant white.exr --intensity 2 --size 64
must synth sun sun.exr --size 256 --elevation 90 --background 0 --angle 20 --intensity 10
must synth room room.exr --size 128

# A constant has one coefficient, 2·√4π, and irradiance 2π.
does sh white.exr
near "a constant" "$(coefficients <"$work/out" | cut -d' ' -f2-4)" "7.0898154 7.0898154 7.0898154" 1e-5
near "of a constant nothing else" "$(coefficients <"$work/out" | cut -d' ' -f5-7)" "0 0 0" 1e-5
grep -q '"order": 2' "$work/out" && grep -q '"basis": "orthonormal"' "$work/out" || fail "the JSON lacks its head"
does sh white.exr --of irradiance --order 0
near "its irradiance" "$(coefficients <"$work/out" | cut -d' ' -f2)" "22.273311" 1e-4
does sh white.exr --basis filament --format filament
cp "$work/out" white.txt
does sh white.exr --format filament
checks=$((checks + 1))
cmp -s "$work/out" white.txt || fail "Filament's text has another basis by default"
near "Filament's text" "$(head -n 1 "$work/out" | grep -oE '[0-9.]+' | head -n 1)" 2 1e-5
[[ $(wc -l <"$work/out") == 9 ]] || fail "Filament's text has not nine lines"

# A sun overhead is Y_1,−1: +y; in unreal's world z, in unity's the same.
does sh sun.exr --basis unreal
near "unreal's V2 is up" "$(coefficients <"$work/out" | awk '{ print ($7 > 0.1), ($4 * $4 < 1e-8) }')" "1 1" 0
does sh sun.exr --basis unity --convention native
does sh sun.exr --rotate 0,90,0
near "turned to +z" "$(coefficients <"$work/out" | awk '{ print ($8 > 0.1), ($5 * $5 < 1e-8) }')" "1 1" 0

# Deringing.
does sh sun.exr --json
[[ ! -s $work/messages ]] || fail "--json reports on stderr too"
ringing=$(number minimum <"$work/out" || true)
grep -qE '"minimum":-' "$work/out" || fail "a sun's irradiance doesn't ring: $ringing"
does sh sun.exr --json --deringing minimal deringed.json
grep -qE '"minimum": (0|[0-9])' "$work/out" || fail "--deringing leaves it negative: $(number minimum <"$work/out")"
does sh sun.exr --deringing together
grep -q 'deringing changes it by' "$work/messages" || fail "deringing isn't told"
does sh sun.exr --window lanczos

# There and back, through every format that is read, and through maps.
for each in orthonormal filament three.js unity unreal babylon playcanvas gltf; do
  does sh room.exr "$each.json" --basis "$each"
  must sh "$each.json" "$each.exr" --size 64
  same orthonormal.exr "$each.exr" 1e-6
done
for each in csv txt; do
  does sh room.exr "room.$each" --basis filament
  must sh "room.$each" "room-$each.exr" --size 64
  same orthonormal.exr "room-$each.exr" 1e-6
done
does sh room.exr high.json --order 16
must sh high.json high.exr --to cube --size 64
does sh high.exr again.json --order 16
near "order 16 → map → order 16" "$(coefficients <again.json | cut -d' ' -f2-100)" "$(coefficients <high.json | cut -d' ' -f2-100)" 1e-5
# `convert` makes the same map of coefficients, turned and brightened too.
must convert high.json converted.exr --to cube --size 64
same high.exr converted.exr 1e-7
must convert room.txt converted.exr --size 64
same filament.exr converted.exr 1e-6
must convert high.json turned.exr --rotate 90,20,0 --exposure 1 --size 64
must sh high.json twice.exr --rotate 90,20,0 --size 64
must convert twice.exr doubled.exr --scale 2
same doubled.exr turned.exr 1e-6
refuses 2 "--filter: is about texels" convert high.json out.exr --filter bilinear
refuses 2 "--from: is about texels" convert high.json out.exr --from latlong
refuses 2 "become other coefficients by" convert high.json out.csv
refuses 2 "too coarse for harmonics of degree 16" convert high.json out.exr --size 16
refuses 1 "missing.json: cannot be opened" convert missing.json out.exr
does sh room.exr irradiance.exr --of irradiance --size 64
must bake room.exr lambert.exr --lobe lambert --to latlong --size 64 --levels 1
does sh room.exr averaged.exr --of lambert --order 16 --size 64
same lambert.exr averaged.exr 2e-3
does sh room.exr sh.h --basis unity
grep -q 'kShPacked\[7\]\[4\]' sh.h || fail "the header lacks the shader's constants"
must sh orthonormal.json - --format csv
checks=$((checks + 1))
"$welkin" -q sh - <room.exr >piped.json && "$welkin" -q sh room.exr | cmp -s - piped.json || fail "standard input isn't read"

# What it refuses.
refuses 2 "unknown basis 'unty'; did you mean 'unity'" sh room.exr --basis unty
refuses 2 "unknown window" sh room.exr --window hamming
refuses 2 "--order" sh room.exr --order 4 --basis unity
refuses 2 "--of: basis unity" sh room.exr --of irradiance --basis unity
refuses 2 "unknown convention" sh room.exr --convention mars
refuses 2 "unknown lobe" sh room.exr --of ggxx
refuses 2 "too coarse for harmonics of degree 16.*up to" sh high.json coarse.exr --size 16
refuses 2 "has order 2" sh orthonormal.json out.json --order 3
refuses 2 "basis filament" sh room.exr out.txt --basis unity
refuses 1 "No such file|cannot be opened" sh missing.exr
refuses 1 "cannot be opened" sh missing.json
printf '{"order": 2, "coefficients": [[1,2,3],[4,5,6]]}' >few.json
refuses 1 "few.json: it has 2 coefficients; order 2 has 9" sh few.json out.exr
printf '{"order": 2, "coeff' >cut.json
refuses 1 "cut.json: is not JSON" sh cut.json out.exr
does sh room.exr held.json --of irradiance
refuses 2 "holds irradiance already" sh held.json out.json --of lambert
refuses 2 "is of radiance" sh held.json out.json --basis unity

# Black, one texel, parts, NaN.
must synth constant black.exr --intensity 0 --size 16
does sh black.exr --deringing minimal
near "black" "$(coefficients <"$work/out" | cut -d" " -f2-4)" "0 0 0" 1e-12
printf 'PF\n1 1\n-1.0\n\0\0\200\77\0\0\0\100\0\0\100\100' >one.pfm
does sh one.pfm --from latlong
near "one texel" "$(coefficients <"$work/out" | cut -d' ' -f2-4)" "3.5449077 7.0898154 10.634723" 1e-5
must convert room.exr half.exr --to hemi-octahedral --size 64
does sh half.exr
grep -q 'shows 50 % of the sphere' "$work/messages" || fail "a part of the sphere isn't told"
printf 'PF\n2 1\n-1.0\n\0\0\300\177\0\0\0\100\0\0\100\100\0\0\200\77\0\0\0\100\0\0\100\100' >nan.pfm
refuses 1 "nan.pfm: 1 of 2 texels is NaN or infinite, the first in column 0, row 0; --sanitize" sh nan.pfm --from latlong
does sh nan.pfm --from latlong --sanitize
does sh one.pfm --from latlong --order 24
grep -q 'finer than its texels' "$work/messages" || fail "an order too high for the map isn't told"

# three.js itself, where npm brings it.
if command -v node >/dev/null && command -v npm >/dev/null && (cd "$work" && npm pack three@0.187 >/dev/null 2>&1 && tar xf three-*.tgz); then
  does sh room.exr three.json --basis three.js
  does sh room.exr exact.json --of irradiance
  must sh exact.json exact.exr --to latlong --size 256
  cat >"$work/probe.mjs" <<'JS'
import { readFileSync } from 'node:fs';
import { SphericalHarmonics3 } from './package/src/math/SphericalHarmonics3.js';
import { Vector3 } from './package/src/math/Vector3.js';
const probe = new SphericalHarmonics3();
probe.fromArray(JSON.parse(readFileSync(process.argv[2])).coefficients.flat());
const n = new Vector3(...process.argv[3].split(',').map(Number)).normalize();
const e = probe.getIrradianceAt(n, new Vector3());
console.log(e.x, e.y, e.z);
JS
  for direction in 1,0,0 0,1,0 0,0,1 0.3,-0.5,0.8 -0.7,0.2,-0.4; do
    near "three.js along $direction" "$(node "$work/probe.mjs" three.json "$direction")" "$(sample_along exact.exr "$direction")" 2e-3
  done
else
  skip "three.js: no node, npm or network"
fi

finish
