#!/usr/bin/env bash
# What `convert` does to a map besides placing it (parameterizations_test.sh): turning, exposing, choosing channels, filling, sizing,
# filtering, repairing; the same on any number of threads and any instruction set.
#
# convert_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes card.exr --size 512 --samples 3
must synth sky sky.exr --size 128 --samples 2

# --rotate turns the world: what was along d is along R·d afterwards. Yaw turns about +Y from +Z toward +X.
while IFS='|' read -r rotation from to; do
  must convert card.exr turned.exr --rotate "$rotation"
  near "$rotation takes $from to $to" "$(sample_along turned.exr "$to")" "${card_colour[$from]}" 0.02
done <<'END'
90,0,0|0,0,1|1,0,0
90,0,0|1,0,0|0,0,-1
90,0,0|0,1,0|0,1,0
-90,0,0|0,0,1|-1,0,0
0,0,0|1,0,0|1,0,0
0.7071067811865476,0,0.7071067811865476,0|0,0,1|1,0,0
2,0,2,0|0,0,1|1,0,0
0,0,1,1,0,0,0,1,0|1,0,0|0,1,0
0,0,1,1,0,0,0,1,0|0,1,0|0,0,1
0,0,1,1,0,0,0,1,0|0,0,1|1,0,0
END
# Pitch and roll turn about +X and +Z, each leaving its axis alone, and four quarter turns are none.
must convert card.exr turned.exr --rotate 0,90,0
near "pitch keeps +X" "$(sample_along turned.exr 1,0,0)" "${card_colour[1,0,0]}" 0.02
must convert card.exr turned.exr --rotate 0,0,90
near "roll keeps +Z" "$(sample_along turned.exr 0,0,1)" "${card_colour[0,0,1]}" 0.02
must convert card.exr turned.exr --rotate 360,-720,360
same card.exr turned.exr 1e-4
# Turned and turned back: yaw is the outermost of the three.
must synth zoneplate smooth.exr --frequency 2 --to cube --size 64
must convert smooth.exr turned.exr --rotate 30,20,10
must convert turned.exr back.exr --rotate -30,0,0
must convert back.exr turned.exr --rotate 0,-20,0
must convert turned.exr back.exr --rotate 0,0,-10
same smooth.exr back.exr 0.02

# A stop doubles; --scale multiplies; both do. Alpha is not scaled.
must convert sky.exr twice.exr --exposure 1
must convert sky.exr scaled.exr --scale 2
same twice.exr scaled.exr 0
must convert scaled.exr sky2.exr --exposure -1
same sky.exr sky2.exr 0
near "energy" "$("$welkin" diff sky.exr twice.exr --json | number energy_ratio)" 2 1e-9

# Channels, by name.
must convert card.exr green.exr --channels G
near "G alone" "$(sample_along green.exr 1,0,0)" 0.1912 1e-3
must convert card.exr swapped.exr --channels B,G,R
must convert swapped.exr same.exr --channels R,G,B
same card.exr same.exr 0

# --fill where the input shows nothing, and outside the output's discs.
must synth constant half.exr --to fisheye-equidistant --size 64
must convert half.exr filled.exr --to latlong --size 64 --fill 0.25,0.5,0.75
near "behind a hemisphere" "$(sample_along filled.exr 0,0,-1)" "0.25 0.5 0.75" 1e-6
near "before it" "$(sample_along filled.exr 0,0,1)" "1 1 1" 1e-6
must convert half.exr filled.exr --to latlong --size 64
near "nothing is black" "$(sample_along filled.exr 0,0,-1)" "0 0 0" 0
must convert sky.exr disc.exr --to angular --size 32 --fill 7,7,7
must convert disc.exr corner.exr --from octahedral --to octahedral --filter nearest
near "the corner of a disc" "$(sample_along corner.exr 0,-1,0 --filter nearest)" "7 7 7" 0

# Sizes: N across, WxH, odd ones; a format or a layout alone keeps every texel.
while IFS='|' read -r size to wanted; do
  must convert sky.exr sized.exr --to "$to" --size "$size"
  "$welkin" info sized.exr --header --json >"$work/json"
  near "--size $size of $to" "$(grep -A 2 '"chart"' "$work/json" | grep -oE '[0-9]+' | tr '\n' ' ')" "$wanted" 0
  must convert sized.exr copy.tif
  same sized.exr copy.tif 0
  matches "\"width\": ${wanted% *}," info copy.tif --header --json
done <<'END'
33|latlong|33 17
1|latlong|1 1
2|latlong|2 1
7x5|latlong|7 5
1x1|cube|1 1
17|cube|17 17
3|healpix|3 3
31|octahedral|31 31
9|paraboloid|9 9
5|openexr-latlong|5 3
64|sky-latlong|64 16
END
# By default a map gets as many texels per steradian as it had.
must convert sky.exr cube.exr --to cube
near "texels of a cube" "$("$welkin" info cube.exr --json | number texels)" $((128 * 64)) 1000

# Light stays light: no filter but one that is allowed to makes a negative value beside the sun, and none overshoots by more than
# half the range (docs/filtering.md).
must synth sun sun.exr --size 256 --background 0 --angle 3
for filter in auto nearest bilinear bicubic lanczos; do
  for size in 16 150; do
    checks=$((checks + 1))
    run convert sun.exr dim.exr --to cube --size $size --filter $filter
    ((status == 0)) || fail "--filter $filter: status $status: $(cat "$work/messages")"
    "$welkin" info dim.exr --json >"$work/json"
    checks=$((checks + 1))
    ! grep -qE '"min": -' "$work/json" || fail "--filter $filter at $size makes negative light"
    checks=$((checks + 1))
    awk "BEGIN { exit !($(number max <"$work/json") <= 1.5 * $("$welkin" info sun.exr --json | number max)) }" ||
      fail "--filter $filter at $size is far brighter than the sun"
  done
done
must convert sun.exr ringing.exr --to cube --size 150 --filter lanczos --allow-ringing
matches '"min": -' info ringing.exr --json
# Antialiased: a map made small keeps its energy.
for to in latlong cube octahedral healpix angular; do
  must convert sun.exr small.exr --to $to --size 16
  a=$("$welkin" info sun.exr --json | number mean) b=$("$welkin" info small.exr --json | number mean)
  near "mean of a small $to" "$(awk "BEGIN { print $b / $a }")" 1 0.05
done
# A constant stays one, through everything.
must synth constant one.exr --to cube --size 16
for to in $("$welkin" list); do
  for filter in auto bilinear bicubic lanczos; do
    must convert one.exr other.exr --to "$to" --size 24 --filter $filter --rotate 10,20,30
    near "a constant in $to by $filter" "$("$welkin" diff one.exr other.exr --json | number max)" 0 2e-6
  done
done

# NaN and infinity are counted, repaired on request, and reported.
bits() { printf "\\x${1:6:2}\\x${1:4:2}\\x${1:2:2}\\x${1:0:2}"; }
{
  printf 'PF\n8 4\n-1.0\n'
  for ((i = 0; i < 96; ++i)); do
    case $i in 30) bits 7fc00000 ;; 31) bits 7f800000 ;; 60) bits ff800000 ;; *) bits 3f800000 ;; esac
  done
} >wild.pfm
"$welkin" info wild.pfm --json >"$work/json"
near "NaN in R" "$(number nan <"$work/json")" 1 0
near "infinities" "$(grep -oE '"infinite": [0-9]+' "$work/json" | grep -oE '[0-9]+' | tr '\n' ' ')" "1 1 0" 0
checks=$((checks + 1))
run convert wild.pfm repaired.exr --sanitize
((status == 0)) && grep -qE '^welkin: wild.pfm: 2 texels with NaN or infinite values filled$' "$work/messages" || fail "--sanitize: $(cat "$work/messages")"
must synth constant white.exr --size 8
same white.exr repaired.exr 1e-6
# Infinite ones as the largest value of the output's type, or as a value; fireflies clamped.
says() {
  local pattern=$1
  shift
  checks=$((checks + 1))
  run "$@"
  ((status == 0)) && [[ $(wc -l <"$work/messages") == 1 ]] && grep -qE -- "$pattern" "$work/messages" ||
    fail "welkin $*: status $status: $(cat "$work/messages")"
}
range() { "$welkin" info "$1" --json | grep -m 2 -oE '"(min|max)": [^,]+' | sed -E 's/.*: //' | tr '\n' ' '; }
says '^welkin: wild.pfm: 1 texels with NaN values filled, 2 infinite values clamped to 65504$' convert wild.pfm half.exr --type half --sanitize=clamp
near "clamped to half's largest" "$(range half.exr)" "-65504 1" 0
says 'clamped to 65504$' convert wild.pfm float.exr --sanitize=clamp
says 'clamped to 65408$' convert wild.pfm shared.ktx2 --type rgb9e5 --sanitize=clamp
says 'clamped to 1$' convert wild.pfm wild8.png --sanitize=clamp
says 'clamped to 32752$' convert wild.pfm half.exr --type half --exposure 1 --sanitize=clamp
near "clamped before it is exposed" "$(range half.exr)" "-65504 2" 0
says '2 infinite values clamped to 100$' convert wild.pfm hundred.exr --sanitize=clamp:100
near "clamped to a value" "$(range hundred.exr)" "-100 1" 0
says '^welkin: wild.pfm: 1 values clamped to ,100$' convert wild.pfm most.exr --channels G --clamp ,100
says '2 texels with NaN or infinite values filled, 96 values clamped to 0.25,0.5$' convert wild.pfm both.exr --sanitize --clamp 0.25,0.5
near "clamped" "$(range both.exr)" "0.5 0.5" 0
must convert white.exr at-least.exr --size 4
says '96 values clamped to 2,$' convert white.exr at-least.exr --clamp 2,
near "clamped from below" "$(range at-least.exr)" "2 2" 0
refuses 2 "--sanitize: 'mend' is not fill, clamp or clamp:VALUE" convert wild.pfm no.exr --sanitize=mend
refuses 2 "--sanitize: 'x' is not a number" convert wild.pfm no.exr --sanitize=clamp:x
refuses 2 '--sanitize: infinite values become a value above 0' convert wild.pfm no.exr --sanitize=clamp:-1
refuses 2 "--clamp: '5' is not MIN,MAX" convert wild.pfm no.exr --clamp 5
refuses 2 "--clamp: ',' is not MIN,MAX" convert wild.pfm no.exr --clamp ,
refuses 2 "--clamp: 'nan' is not a number" convert wild.pfm no.exr --clamp nan,1
refuses 2 '--clamp: the minimum 2 is above the maximum 1' convert wild.pfm no.exr --clamp 2,1
# A hole of any size is filled from its rim: a sun of infinity in a sky of ½.
{
  printf 'Pf\n128 64\n-1.0\n'
  for ((y = 0; y < 64; ++y)); do
    for ((x = 0; x < 128; ++x)); do
      if (((x - 40) * (x - 40) + (y - 20) * (y - 20) <= 16)); then bits 7f800000; else bits 3f000000; fi
    done
  done
} >hole.pfm
says '^welkin: hole.pfm: 49 texels with NaN or infinite values filled$' convert hole.pfm filled.exr --sanitize
near "the sun became the sky" "$(range filled.exr)" "0.5 0.5" 0
says '49 texels with NaN or infinite values filled$' bake hole.pfm lambert.exr --lobe lambert --to latlong --sanitize
near "and lights as it" "$(range lambert.exr)" "0.5 0.5" 1e-5
says '0 texels with NaN values filled, 49 infinite values clamped to 65504$' bake hole.pfm lambert.exr --lobe lambert --to latlong --sanitize=clamp

checks=$((checks + 1))
run convert wild.pfm wild.png
((status == 0)) && grep -qE '^welkin: wild.png: [0-9]+ values were not finite' "$work/messages" || fail "NaN to PNG: $(cat "$work/messages")"
must convert wild.pfm wild.exr
near "NaN is kept" "$("$welkin" info wild.exr --json | number nan)" 1 0

# The number of threads changes nothing, the instruction set only rounding, and with it by which of its ways `auto` makes a texel.
for to in latlong cube octahedral healpix angular; do
  for options in "" "--rotate 10,20,30" "--filter lanczos" "--size 12"; do
    # shellcheck disable=SC2086
    must -j 1 convert sky.exr one.pfm --to $to $options
    # shellcheck disable=SC2086
    must -j 2 convert sky.exr two.pfm --to $to $options
    checks=$((checks + 1))
    cmp -s one.pfm two.pfm || fail "convert --to $to $options: two threads differ from one"
    export WELKIN_INSTRUCTION_SET=baseline
    # shellcheck disable=SC2086
    must convert sky.exr baseline.pfm --to $to $options
    unset WELKIN_INSTRUCTION_SET
    tolerance=5e-4
    [[ $options == *lanczos* ]] && tolerance=1e-5
    same one.pfm baseline.pfm $tolerance --from $to
  done
done

# Onto itself, and through a link: the map is replaced whole, the link stays.
must convert card.exr self.exr --size 64
must convert self.exr self.exr --to cube --size 32
matches '"parameterization": "cube' info self.exr --header --json
ln -s self.exr link.exr
must convert card.exr link.exr --size 48
checks=$((checks + 1))
[[ -L link.exr && ! -L self.exr ]] || fail "the link is gone"
matches '"width": 48' info self.exr --header --json
# An older file keeps its permissions.
chmod 640 self.exr
must convert card.exr self.exr --size 32
checks=$((checks + 1))
[[ $(stat -c %a self.exr) == 640 ]] || fail "permissions became $(stat -c %a self.exr)"
# From a pipe and into one.
checks=$((checks + 1))
"$welkin" convert /dev/stdin piped.exr <card.exr || fail "cannot read a pipe"
same card.exr piped.exr 0

finish
