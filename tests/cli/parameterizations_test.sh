#!/usr/bin/env bash
# Every parameterization shows the world the same way: the test card has its colours along the axes, a conversion agrees with
# drawing the map directly, and there and back again nothing moves.
#
# parameterizations_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes card.exr --size 1024 --samples 3

# Where a parameterization is singular or shows nothing, the card's colour can't be asked for.
declare -A not_shown=(
  [equal-area]="0,1,0 0,-1,0" [sphere]="0,0,-1" [mirror-ball]="0,0,-1" [cylinder]="0,1,0 0,-1,0" [mercator]="0,1,0 0,-1,0"
  [fisheye-equidistant]="0,0,-1" [fisheye-equisolid]="0,0,-1" [fisheye-stereographic]="0,0,-1"
  [fisheye-orthographic]="1,0,0 -1,0,0 0,0,-1" [half-cube]="0,-1,0" [hemi-octahedral]="0,-1,0"
  [vr180]="1,0,0 -1,0,0 0,0,-1"
  [sky-latlong]="1,0,0 -1,0,0 0,0,1 0,0,-1 0,-1,0")
# What cameras see by default ends before the other axes, or on them.
lenses=(perspective pannini cylindrical stereographic equidistant equisolid orthographic)
for name in "${lenses[@]}"; do not_shown[$name]="1,0,0 -1,0,0 0,1,0 0,-1,0 0,0,-1"; done

# Relative RMSE of a round trip of a smooth map over a lat-long of 512: interpolation alone, but for the singular edge of a
# disc, the unbounded stretch at the poles of equal-area, and rims, where nothing is beyond to interpolate with.
declare -A round_trip=([equal-area]=0.025 [sphere]=0.06 [mirror-ball]=0.06 [fisheye-equidistant]=0.025 [fisheye-equisolid]=0.025
  [fisheye-orthographic]=0.045 [fisheye-stereographic]=0.03 [half-cube]=0.025 [hemi-octahedral]=0.025 [vr180]=0.025
  [sky-latlong]=0.025 [cylinder]=0.025 [mercator]=0.025)
for name in "${lenses[@]}"; do round_trip[$name]=0.025; done

"$welkin" list parameterizations >names
[[ $(wc -l <names) -ge 25 ]] || fail "only $(wc -l <names) parameterizations are listed"
while read -r name; do
  size=256
  case $name in cube | eac | healpix | openexr-cube | octahedral-perspective) size=64 ;; esac

  must synth axes direct.exr --to "$name" --size "$size" --samples 3
  matches "\"parameterization\": \"$name[:,\"].*" info direct.exr --header --json
  for axis in "${axes[@]}"; do
    [[ " ${not_shown[$name]-} " != *" $axis "* ]] || continue
    near "$name along $axis" "$(sample_along direct.exr "$axis")" "${card_colour[$axis]}" 0.003
  done

  # Hard edges: an exact mean of each texel here, a mean of interpolated texels there.
  must convert card.exr converted.exr --to "$name" --size "$size"
  tolerance=0.12
  same direct.exr converted.exr $tolerance

  must synth zoneplate smooth.exr --frequency 2 --to "$name" --size "$size" --samples 4
  must convert smooth.exr there.exr --to latlong --size 512
  must convert there.exr back.exr --to "$name" --size "$size"
  same smooth.exr back.exr "${round_trip[$name]-0.006}"
done <names

# A field of view is a parameter, kept by the file.
must synth axes wide.exr --to fisheye-equidistant,fov=360 --size 256
matches '"parameterization": "fisheye-equidistant,fov=360"' info wide.exr --header --json
near "fov=360 sees behind" "$(sample_along wide.exr 0.3,0.1,-1)" "$(sample_along card.exr 0.3,0.1,-1)" 0.02
must synth axes ball.exr --to mirror-ball,distance=5 --size 256
matches '"parameterization": "mirror-ball,distance=5"' info ball.exr --header --json

# Texel centres on the edges, as EXR's envmap declares: the size is a parameter, whatever the size.
must convert card.exr declared.exr --to openexr-latlong --size 200
matches '"parameterization": "openexr-latlong,width=200,height=100"' info declared.exr --header --json
must convert declared.exr smaller.exr --size 100
matches '"parameterization": "openexr-latlong,width=100,height=50"' info smaller.exr --header --json

finish
