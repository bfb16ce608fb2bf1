#!/usr/bin/env bash
# A map written for another program shows that program's world in the right place, and comes back as it was. The tables are those
# of docs/conventions.md, written by hand.
#
# conventions_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# turned DIRECTION "A B C": the components of x,y,z that A B C name, each x y z -x -y -z.
turned() {
  local x y z name list=
  IFS=, read -r x y z <<<"$1"
  for name in $2; do
    case $name in
      x) list+=,$x ;; y) list+=,$y ;; z) list+=,$z ;;
      -x) list+=,$((-x)) ;; -y) list+=,$((-y)) ;; -z) list+=,$((-z)) ;;
    esac
  done
  printf '%s' "${list#,}"
}
opposite() { turned "$1" "-x -y -z"; }

# shows MAP "WORLD=DIRECTION …" TOLERANCE [OPTION…]: along each DIRECTION of the map lies the card's colour of WORLD.
shows() {
  local map=$1 tolerance=$3 pair directions=() colours=
  for pair in $2; do
    directions+=("${pair#*=}")
    colours+="${card_colour[${pair%=*}]} "
  done
  shift 3
  near "$name: $map $*" "$("$welkin" sample "$map" --dir "${directions[@]}" "$@" | tr '\n' ' ')" "$colours" "$tolerance"
}
declare -A face_names=([1,0,0]=px [-1,0,0]=nx [0,1,0]=py [0,-1,0]=ny [0,0,1]=pz [0,0,-1]=nz)
declared=
for axis in "${axes[@]}"; do declared+="$axis=$axis "; done

must synth axes card.exr --size 1024 --samples 2

# name | lat-long: at the centre | to the right of it | cube look-up with our …
while IFS='|' read -r name centre right lookup; do
  # Read as if it were native, the picture's centre is +Z, right of it −X, its edge −Z and the left half's middle +X; up is up.
  must convert card.exr panorama.exr --to latlong --size 256 --convention "$name" -q
  shows panorama.exr "$centre=0,0,1 $right=-1,0,0 $(opposite "$centre")=0,0,-1 $(opposite "$right")=1,0,0 0,1,0=0,1,0 0,-1,0=0,-1,0" \
    0.02 --from-convention native
  shows panorama.exr "$declared" 0.02
  must synth axes drawn.exr --to latlong --size 256 --samples 3 --convention "$name" -q
  same drawn.exr panorama.exr 0.15
  # The same through a format that declares nothing.
  must convert card.exr bare.pfm --to latlong --size 256 --to-convention "$name" -q
  must convert bare.pfm native.exr --from-convention "$name" -q
  same card.exr native.exr 0.35

  # Cubes of programs whose look-up is the native one are native cubes.
  if [[ $name != native && $lookup == "x y z" ]]; then
    must convert card.exr native.exr --to cube --size 32
    must convert card.exr map.exr --to cube --size 32 --convention "$name" -q
    same native.exr map.exr 0 --from-convention native
    continue
  fi
  for shape in cube:layers eac:layers paraboloid octahedral octahedral-rect octahedral-equal-area healpix; do
    must convert card.exr map.exr --to "$shape" --size 128 --convention "$name" -q
    coordinates=
    for axis in "${axes[@]}"; do coordinates+="$axis=$(turned "$axis" "$lookup") "; done
    shows map.exr "$coordinates" 0.03 --from-convention native
    shows map.exr "$declared" 0.03
  done
  # Files of faces are named for what the program looks up, and are pictures seen from inside: a small sun 30° from +Z toward +X
  # and 10° up is left of +Z, whatever the program calls it.
  must convert card.exr face-%s.pfm --to cube:faces --size 64 --convention "$name" -q
  for axis in "${axes[@]}"; do
    face=${face_names[$(turned "$axis" "$lookup")]}
    near "$name: $axis in the middle of $face" "$(sample_along face-$face.pfm 0,1,0 --from octahedral)" "${card_colour[$axis]}" 0.03
  done
  if [[ $name != unreal ]]; then # whose faces of the horizon are turned
    must synth sun sun-%s.pfm --to cube:faces --size 64 --elevation 10 --azimuth 30 --angle 3 --background 0 --convention "$name"
    near "$name: the sun" "$(centre_of_light "sun-${face_names[$(turned 0,0,1 "$lookup")]}.pfm" 64 64)" "13.52 25.48" 0.2
  fi

  # In every layout, and back to a native cube.
  must convert card.exr plain.exr --to cube --size 32
  for layout in hcross vcross flat hstrip vstrip 3x2 bands openexr layers; do
    must convert plain.exr turned.exr --to "cube:$layout" --convention "$name" -q
    must convert turned.exr again.exr --to cube -q
    same plain.exr again.exr 0.01
    must convert turned.exr again.exr -q
    same plain.exr again.exr 0.01
  done
done <<'END'
native|0,0,1|-1,0,0|x y z
openexr|0,0,1|-1,0,0|x y z
usd|0,0,1|-1,0,0|x y z
mitsuba|0,0,1|-1,0,0|x y z
godot|0,0,1|-1,0,0|x y z
filament|0,0,1|-1,0,0|x y z
three.js|1,0,0|0,0,1|-x y z
blender|1,0,0|0,0,1|x y z
unity|-1,0,0|0,0,-1|-x y z
unreal|0,0,-1|1,0,0|x z y
pbrt|-1,0,0|0,0,-1|x y z
debevec|0,0,-1|1,0,0|x y z
left-handed|0,0,-1|1,0,0|x y -z
babylon|0,0,1|-1,0,0|-x y z
babylon-right-handed|0,0,-1|1,0,0|x y -z
playcanvas|0,0,1|-1,0,0|-x y z
cesium|0,0,1|-1,0,0|z y -x
bevy|0,0,1|-1,0,0|x y -z
END

"$welkin" list conventions | awk '{ print $1 }' >names
checks=$((checks + 1))
[[ $(wc -l <names) == 18 ]] || fail "a convention is missing in this test: $(tr '\n' ' ' <names)"

# debevec turns angular maps, too; no preset turns the photograph of a ball.
name=debevec
must convert card.exr probe.exr --to angular --size 256 --convention debevec
shows probe.exr "0,0,-1=0,0,1 -1,0,0=1,0,0 0,1,0=0,1,0" 0.03 --from-convention native
must convert card.exr ball.exr --to sphere --size 256 --convention debevec
shows ball.exr "0,0,1=0,0,1 1,0,0=1,0,0 0,1,0=0,1,0" 0.03 --from-convention native

# A convention that a file declares is kept, and told; a format that can't say so shows it all the same.
name=kept
must convert card.exr cube.ktx2 --to cube --size 32 --convention three.js
tells_text "is in the convention three.js, as cube.ktx2 is; --convention native turns it" convert cube.ktx2 again.ktx2
matches '^  welkin.convention +three.js$' info again.ktx2 --header
same cube.ktx2 again.ktx2 0 --from-convention native
tells_text "which the file cannot say" convert cube.ktx2 six-%s.pfm --to cube:faces
must convert card.exr told-%s.pfm --to cube:faces --size 32 --convention three.js
tells_text "its faces are those of the native world, in which +X is to the left of +Z; engines expect it to the right: --convention three.js" \
  convert card.exr plain-%s.pfm --to cube:faces --size 32
must convert card.exr plain-%s.pfm --to cube:faces --size 32 --convention native
same told-%s.pfm six-%s.pfm 1e-3
must convert cube.ktx2 panorama.exr --to latlong --size 128 -q
shows panorama.exr "1,0,0=0,0,1 0,0,1=-1,0,0" 0.08 --from-convention native
must convert cube.ktx2 native.ktx2 --convention native
shows native.ktx2 "$declared" 0.1 --from-convention native

# Mitsuba's rows lie on the poles.
name=mitsuba
tells_text "is mitsuba-latlong, as mitsuba reads a latlong" convert card.exr rows.exr --to latlong --size 64 --convention mitsuba
matches '^  parameterization  mitsuba-latlong' info rows.exr --header
shows rows.exr "0,1,0=0,1,0 0,-1,0=0,-1,0" 0.02
must convert card.exr rows.pfm --to latlong --size 64 --convention mitsuba -q
same rows.exr rows.pfm 1e-6 --from mitsuba-latlong
must synth axes drawn.exr --size 64 --samples 4 --convention mitsuba -q
same rows.exr drawn.exr 0.15

finish
