#!/usr/bin/env bash
# How much light there is, as `info`, `diff` and `convert --verify` tell it: of a sun as large as life, through filters that keep its
# energy and filters that don't.
#
# energy_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# A lit texel of known solid angle: 2π/64·(cos θ₀ − cos θ₁) sr, of radiance 1000.
{
  printf 'PF\n64 32\n-1.0\n'
  for ((y = 31; y >= 0; --y)); do
    for ((x = 0; x < 64; ++x)); do
      if ((x == 20 && y == 12)); then printf '\x00\x00\x7a\x44\x00\x00\x7a\x44\x00\x00\xfa\x43'; else printf '\0\0\0\0\0\0\0\0\0\0\0\0'; fi
    done
  done
} >texel.pfm
energy=$(awk 'BEGIN { p = atan2(0, -1); print 1000 * 2 * p / 64 * (cos(12 * p / 32) - cos(13 * p / 32)) }')
"$welkin" info texel.pfm --json >"$work/json"
grep -A 100 '"energy": {' "$work/json" >"$work/energy"
near "energy of a texel" "$(number luminance <"$work/energy")" "$(awk "BEGIN { print $energy * (0.2126 + 0.7152 + 0.0722 / 2) }")" 1e-3
near "its channels" "$(for c in R G B; do number $c <"$work/energy"; done | tr '\n' ' ')" "$energy $energy $(awk "BEGIN { print $energy / 2 }")" 1e-3
near "all of it is one light" "$(number share <"$work/energy")" 1 1e-4
matches 'light 1 .*peak 963.9, energy 8.74.*, 100.0 % of all' info texel.pfm

must synth sun sun.exr --size 512 --angle 0.53 --elevation 37 --azimuth 20 --intensity 60000 --background 0.3

# What keeps the energy says so, in all shapes, turned and scaled.
for to in cube octahedral healpix angular fisheye-equidistant; do
  must convert sun.exr kept.exr --to $to --rotate 10,20,30 --exposure 1 --verify --json
  near "the whole in a $to" "$(number ratio <"$work/out")" 1 1e-3
  near "the sun in a $to" "$(sed -n '/"lights"/,$p' "$work/out" | number ratio)" 1 2e-3
  near "clipped" "$(number clipped_values <"$work/out")" 0 0
done
matches '^light 1 .* along 0\.2[0-9]*,0\.60[0-9]*,0\.75[0-9]*, [0-9.]+ % of all$' convert sun.exr kept.exr --to cube --verify
for option in "--border 4" "--to-faces nz,pz:90,px,nx,py:180:mirror,ny" "--convention three.js"; do
  # shellcheck disable=SC2086
  must convert sun.exr kept.exr --to cube --verify $option
done
must convert sun.exr 'face_%s.exr' --to cube:faces --verify -q
must convert sun.exr kept.hdr --to cube --verify

# What doesn't is told, and what would.
for filter in nearest bicubic lanczos; do
  checks=$((checks + 1))
  run convert sun.exr lost.exr --to cube --filter $filter
  ((status == 0)) && grep -qE "^welkin: lost.exr: $filter changed the energy: of the whole by [-+][0-9.]+ %, of the light along 0\.2.* by [-+][0-9.]+ %; --filter auto keeps it$" "$work/messages" ||
    fail "--filter $filter: $(cat "$work/messages")"
  told=$(sed -E 's/.*whole by ([-+][0-9.]+) %.*/\1/' "$work/messages")
  near "what $filter changed" "$told" "$("$welkin" diff sun.exr lost.exr --json | number energy_ratio | awk '{ print 100 * ($1 - 1) }')" 0.1
done
# The same where a map is made first, of cells that are turned.
checks=$((checks + 1))
run convert sun.exr turned.exr --to cube:vcross --filter lanczos
grep -q 'lanczos changed the energy: ' "$work/messages" || fail "turned cells: $(cat "$work/messages")"
[[ $(sed 's/.*changed/changed/' "$work/messages") == *"by $told %"* ]] || fail "turned cells are measured otherwise: $(cat "$work/messages")"
# A smooth world has nothing to tell.
must synth sky sky.exr --size 128 --samples 2
must synth zoneplate smooth.exr --frequency 2 --size 256
must convert smooth.exr smooth2.exr --to cube --filter bilinear
must convert sun.exr copy.exr --filter nearest

# --verify fails where light is lost, and says why.
checks=$((checks + 2))
run convert sun.exr dim.png --to cube --verify
((status == 1)) && grep -qE '^welkin: dim.png: the energy differs from that of sun.exr by [0-9.]+ %, more than 0.1 %; [0-9]+ values were clipped$' "$work/messages" || fail "a clipped sun: $(cat "$work/messages")"
grep -qE '^[1-9][0-9]* values clipped$' "$work/out" || fail "clipped values: $(cat "$work/out")"
checks=$((checks + 1))
run convert sun.exr lost.exr --to cube --filter lanczos --verify
((status == 1)) || fail "--verify of lanczos: status $status"
refuses 2 '--json: is the report of --verify' convert sun.exr no.exr --json

# Levels, each by itself.
must bake sky.exr chain.exr --size 32 --levels 3
matches '^level 2$' convert chain.exr copy.ktx2 --verify
near "levels" "$("$welkin" convert chain.exr copy.ktx2 --verify --json | grep -c '"ratio"')" 3 9

# diff: of the whole, and of the lights of A, in the world.
must convert sun.exr cube.exr --to cube --convention three.js
"$welkin" diff sun.exr cube.exr --json >"$work/json"
near "energy of the whole" "$(number energy_ratio <"$work/json")" 1 1e-4
near "energy of the sun" "$(sed -n '/"lights"/,$p' "$work/json" | number ratio)" 1 1e-3
must convert sun.exr gain.exr --to cube --scale 1.25
near "a sun that gained a quarter" "$("$welkin" diff sun.exr gain.exr --json | sed -n '/"lights"/,$p' | number ratio)" 1.25 1e-3
matches '^light 1 .* 1\.2[45][0-9]+ ' diff sun.exr gain.exr

finish
