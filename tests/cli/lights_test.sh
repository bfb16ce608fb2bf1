#!/usr/bin/env bash
# `lights`, and `bake --extract-sun`: what is found, what is left, what is written, what is refused.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# A sun of 3° and 1000 on 0.1: Ω = 2π(1 − cos 1.5°) = 0.0021530 sr.
must synth sun sun.exr --size 512 --angle 3 --intensity 1000 --elevation 30 --azimuth 90 --background 0.1 --samples 16
must lights sun.exr -q --json
cp -- "$work/out" sun.json
near 'the sun: direction' "$(tr -d '\n ' <sun.json | sed -E 's/.*"direction":\[([^]]*)\].*/\1/; s/,/ /g')" '0.866025 0.5 0' 0.0005
near 'the sun: irradiance' "$(tr -d '\n ' <sun.json | sed -E 's/.*"irradiance":\[([^,]*),.*/\1/')" 2.1528 0.01
near 'the sun: solid angle' "$(number solid_angle <sun.json)" 0.002153 0.00005
grep -q '"shape": "disc"' sun.json || fail 'the sun is no disc'

# The table has a line for the light, and what is left.
matches '^    1  0\.866' lights sun.exr -q
grep -qE '^energy R: 2\.15[0-9]* of 3\.[0-9]* in lights, 1\.25[0-9]* left$' "$work/out" || fail "energy: $(cat "$work/out")"

# What is left has no sun, and its energy; the peak is gone.
must lights sun.exr -q sun.gltf --residual rest.exr
must info rest.exr --json
near 'the residual: peak' "$(tr -d '\n ' <"$work/out" | sed -E 's/.*"luminance":\{[^}]*"max":([^,]*),.*/\1/')" 0.1 0.0001
grep -q KHR_lights_punctual sun.gltf || fail 'no light in the glTF'
must lights rest.exr
grep -q '^no light is 10 times as bright as the mean' "$work/out" || fail "something is found in the residual: $(cat "$work/out")"

must lights sun.exr --most 0
grep -q '^no light was asked for$' "$work/out" || fail "--most 0: $(cat "$work/out")"

# Every format, by the extension and by name.
for extension in json js gltf rs py pbrt xml usda; do must lights sun.exr -q "sun.$extension"; done
for name in json three.js gltf bevy blender pbrt mitsuba usd; do must lights sun.exr -q --for "$name"; done
must lights sun.exr -q lights.txt --for blender
cmp -s lights.txt sun.py || fail '--for blender differs from .py'
matches '"point3 from" \[0\.866[0-9]* [-0-9.e]* 0\.[45][0-9]*\]' lights sun.exr -q --for pbrt
must lights sun.exr -q --json --convention blender
near 'Blender: Z is up' "$(tr -d '\n ' <"$work/out" | sed -E 's/.*"direction":\[([^]]*)\].*/\1/; s/,/ /g')" '0.866025 0 0.5' 0.0005

# As stated, and in units of the program.
must lights sun.exr -q --json --sun-irradiance 50
near 'restored' "$(number luminance <"$work/out")" 50 0.0001
must lights sun.exr -q --for gltf --unit 1000
near 'in lux' "$(grep -o '"intensity": [0-9.]*' "$work/out" | sed 's/.*: //')" 2152.8 10

# N lights of all of the map.
for method in median-cut variance; do
  must lights sun.exr -q --method "$method" --most 12 --json
  [[ $(grep -c '"solid_angle"' "$work/out") == 12 ]] || fail "$method: not 12 lights"
  sum=$(tr -d '\n ' <"$work/out" | grep -oE '"irradiance":\[[^,]*' | sed 's/.*\[//' | awk '{ s += $1 } END { print s }')
  near "$method: all light" "$sum" 3.40920 0.01
done

# Black: nothing, and no failure. Half a world: told.
must synth constant black.exr --size 32 --intensity 0
must lights black.exr
must convert sun.exr half.exr --to hemi-octahedral --size 128
run lights half.exr
((status == 0)) && grep -q 'shows 50.0 % of the sphere' "$work/messages" || fail "half a world: $(cat "$work/messages")"

# A baked chain of what is left.
must bake sun.exr chain.ktx2 --size 32 --extract-sun -q --json
near 'bake: the sun' "$(tr -d '\n ' <"$work/out" | sed -E 's/.*"sun":\{"direction":\[([^]]*)\].*/\1/; s/,/ /g')" '0.866025 0.5 0' 0.0005
must info chain.ktx2 --json
near 'bake: no sun in it' "$(tr -d '\n ' <"$work/out" | sed -E 's/.*"luminance":\{[^}]*"max":([^,]*),.*/\1/')" 0.1 0.001
must bake sun.exr turned.ktx2 --size 32 --extract-sun -q --json --rotate 90,0,0 --exposure 1
near 'bake: turned' "$(tr -d '\n ' <"$work/out" | sed -E 's/.*"sun":\{"direction":\[([^]]*)\].*/\1/; s/,/ /g')" '0 0.5 -0.866025' 0.0005
near 'bake: brightened' "$(number luminance <"$work/out")" 4.3056 0.02
matches '^no sun' bake rest.exr plain.ktx2 --size 32 --extract-sun -q

# Requests that make no sense.
refuses 2 'name the format with --for' lights sun.exr lights.abc
refuses 2 '--residual: is for --method sources' lights sun.exr --method variance --residual rest2.exr
refuses 2 '--above: is for' lights sun.exr --method median-cut --above 3
refuses 2 '--sun-irradiance: is for' lights sun.exr --method median-cut --sun-irradiance 3
refuses 2 '--above' lights sun.exr --above 0.5
refuses 2 '--most' lights sun.exr --method variance --most 0
refuses 2 '--json: is for standard output' lights sun.exr sun2.gltf --json
refuses 2 'unknown convention' lights sun.exr --convention blendr
refuses 1 'No such file' lights nothing.exr
refuses 1 'nowhere' lights sun.exr nowhere/sun.gltf
refuses 2 'rest.abc' lights sun.exr --residual rest.abc

# Values that aren't light.
printf 'PF\n2 1\n-1.0\n\x00\x00\xc0\x7f\x00\x00\x80\x3f\x00\x00\x80\x3f\x00\x00\x80\x3f\x00\x00\x80\x3f\x00\x00\x80\x3f' >nan.pfm
refuses 1 'nan.pfm: 1 texels have NaN' lights nan.pfm --from latlong
run lights nan.pfm --from latlong --sanitize
((status == 0)) || fail "repaired: status $status"

finish
