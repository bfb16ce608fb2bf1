#!/usr/bin/env bash
# Every layout of every parameterization, every order and turn of faces: what is written reads back as the same map, to the last bit.
#
# layouts_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# Reads back as declared by the file, and as named where the format declares nothing.
"$welkin" list layouts >layouts
[[ $(wc -l <layouts) -ge 40 ]] || fail "only $(wc -l <layouts) layouts are listed"
previous=
while read -r shape; do
  name=${shape%%:*} layout=${shape#*:}
  if [[ $name != "$previous" ]]; then
    must synth axes reference.exr --to "$name" --size 32 --samples 2
    previous=$name
  fi
  file=map place=
  if [[ $layout == faces ]]; then place=-%s; fi
  must convert reference.exr "$file$place.exr" --to "$shape" -q
  same reference.exr "$file$place.exr" 0
  if [[ $name != openexr-cube ]]; then
    matches "\"parameterization\": \"$shape\"" info "$file$place.exr" --header --json
  fi
  if [[ $layout == layers ]]; then
    must convert reference.exr map.tif --to "$shape"
    same reference.exr map.tif 0 --from-b "$shape"
  else
    must convert reference.exr "$file$place.pfm" --to "$shape" -q
    same reference.exr "$file$place.pfm" 0 --from-b "$shape"
  fi
  # A safety border around every chart is written and left out again: declared by the file, or named.
  must convert reference.exr "$file$place.exr" --to "$shape" --border 3 -q
  same reference.exr "$file$place.exr" 0
  if [[ $layout != layers ]]; then
    must convert reference.exr "$file$place.pfm" --to "$shape" --border 1 -q
    must convert "$file$place.pfm" bare.exr --from "$shape" --from-border 1 --to "$name:layers"
    same reference.exr bare.exr 0
  fi
  rm -f map*
done <layouts

# Files of faces are named for them.
must synth axes face-%s.exr --to cube:faces --size 8 -q
must synth axes tile-%s.exr --to healpix:faces --size 8
for file in face-{px,nx,py,ny,pz,nz}.exr tile-{0,1,2,3,4,5,6,7,8,9,10,11}.exr; do
  checks=$((checks + 1))
  [[ -f $file ]] || fail "no $file"
done

# An order and turns of faces: written and declared, or given when read.
must synth axes cube.exr --to cube --size 32 --samples 2
orders=(px,nx,py,ny,pz,nz nz,pz,ny,py,nx,px pz,px,nz,nx,py,ny px:90,nx:180,py:270,ny:mirror,pz:90:mirror,nz:mirror:270
  +Z:180:mirror,-x,+Y,-y:270,+x:mirror,-Z:90)
for layout in hcross vcross flat hstrip vstrip 3x2 bands openexr layers; do
  for order in "${orders[@]}"; do
    must convert cube.exr turned.exr --to "cube:$layout" --to-faces "$order"
    same cube.exr turned.exr 0
    case $layout in layers) bare=turned.tif ;; *) bare=turned.pfm ;; esac
    must convert cube.exr "$bare" --to "cube:$layout" --to-faces "$order"
    must convert "$bare" straight.exr --from "cube:$layout" --from-faces "$order"
    same cube.exr straight.exr 0
  done
done
# The order has an effect.
must convert cube.exr straight.exr --from cube:hcross --from-faces nz,pz,ny,py,nx,px
run diff cube.exr straight.exr --fail-above 0.1
checks=$((checks + 1))
((status == 1)) || fail "another order of faces makes the same map"

# Crosses, strips and files are pictures seen from inside: where +Z is in front and +Y above, +X is on the left. Native faces
# and layers are mirrored. A small sun toward +Z, 30° to the side of +X and 10° up, shows it.
sun=(synth sun --elevation 10 --azimuth 30 --angle 3 --background 0)
left=13.52 right=50.48 down=25.48 # of a face of 64: 32 (1 ∓ tan 30°), 32 (1 − tan 10° / cos 30°)
while read -r shape width height x y; do
  must "${sun[@]}" sun.pfm --to "$shape" --size 64
  near "the sun in $shape" "$(centre_of_light sun.pfm "$width" "$height")" "$x $y" 0.2
done <<END
cube:hcross 256 192 $(awk "BEGIN { print 64 + $left, 64 + $down }")
cube:vcross 192 256 $(awk "BEGIN { print 64 + $left, 64 + $down }")
cube:hstrip 384 64 $(awk "BEGIN { print 256 + $left, $down }")
cube:vstrip 64 384 $(awk "BEGIN { print $left, 256 + $down }")
cube:3x2 192 128 $(awk "BEGIN { print 64 + $left, 64 + $down }")
END
must "${sun[@]}" sun.pfm --to latlong --size 360
near "the sun in a lat-long" "$(centre_of_light sun.pfm 360 180)" "150 80" 0.2
must "${sun[@]}" sun-%s.pfm --to cube:faces --size 64 -q
near "the sun in a face" "$(centre_of_light sun-pz.pfm 64 64)" "$left $down" 0.2
must "${sun[@]}" sun.tif --to cube:layers --size 64
must convert sun.tif layer.pfm --from octahedral --to octahedral --part 4
near "the sun in a layer" "$(centre_of_light layer.pfm 64 64)" "$right $down" 0.2

# A picture without a declaration is known by its aspect.
for guess in latlong:latlong cube:hcross:hcross cube:vcross:vcross cube:hstrip:hstrip cube:vstrip:vstrip cube:3x2:3x2; do
  shape=${guess%:*}
  [[ $shape == latlong ]] || shape=cube:${guess##*:}
  must synth axes bare.pfm --to "$shape" --size 32
  matches "\"parameterization\": \"$shape\"" info bare.pfm --header --json
  matches '"reason": "guessed from the aspect' info bare.pfm --header --json
done

# Single pictures take no layout, but can be turned and mirrored.
must synth axes flat.exr --to octahedral --size 32
for turn in 0 0:90 0:180:mirror 0:mirror:270; do
  must convert flat.exr turned.pfm --to octahedral --to-faces $turn
  must convert turned.pfm straight.exr --from octahedral --from-faces $turn
  same flat.exr straight.exr 0
done

finish
