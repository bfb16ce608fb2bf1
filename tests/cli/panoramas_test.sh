#!/usr/bin/env bash
# Pictures of cameras and stitchers: parts of lat-longs, two eyes in one picture, texels that aren't square.
#
# panoramas_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# warns PATTERN ARGUMENT…: welkin does this, with one warning that matches.
warns() {
  checks=$((checks + 1))
  run "${@:2}"
  if ((status != 0)) || [[ $(wc -l <"$work/messages") != 1 ]] || ! grep -qE -- "^welkin: .*$1" "$work/messages"; then
    fail "welkin ${*:2}: status $status, the warning doesn't match '$1': $(head -n 3 -- "$work/messages")"
  fi
}

must synth axes card.exr --size 512

# A window shows what the whole shows there, and nothing else; it is kept by the file, and drawn as it is converted.
must convert card.exr crop.exr --to latlong,left=-100,right=80,top=50,bottom=-40 --size 180
matches '"parameterization": "latlong,left=-100,right=80,top=50,bottom=-40"' info crop.exr --header --json
matches '"width": 180' info crop.exr --header --json
matches '"height": 90' info crop.exr --header --json
for axis in 0,0,1 1,0,0 1,0.1,0; do
  near "the window along $axis" "$(sample_along crop.exr "$axis")" "$(sample_along card.exr "$axis")" 0.02
done
near "outside the window" "$(sample_along crop.exr 0,1,0)" "0 0 0" 0
near "behind the window" "$(sample_along crop.exr 0,0,-1)" "0 0 0" 0
must convert card.exr seam.exr --to latlong,left=90,right=270 --size 256
near "across the seam" "$(sample_along seam.exr 0,0,-1)" "$(sample_along card.exr 0,0,-1)" 0.02
must convert seam.exr half.exr --to latlong,left=90,right=270,top=90,bottom=0 --size 256
near "the upper half of it" "$(sample_along half.exr -0.1,0.3,-1)" "$(sample_along card.exr -0.1,0.3,-1)" 0.02

refuses 2 'right must be 0.1° to 360° beyond left' convert card.exr x.exr --to latlong,left=30,right=-60
refuses 2 'top must be at least' convert card.exr x.exr --to latlong,top=0,bottom=10
refuses 2 "did you mean 'bottom'" convert card.exr x.exr --to latlong,botom=10
refuses 2 'is not a number in -90…90' info crop.exr --from latlong,top=100

# A part of the world stays that part where nothing else is asked for, also where it is turned.
must convert card.exr turned.exr --to latlong,left=-45,right=45 --size 64 --convention blender
warns 'copy.exr: is in the convention blender, as turned.exr is' convert turned.exr copy.exr
matches '"orientation"' info copy.exr --header --json
must diff turned.exr copy.exr --fail-above 1e-5
near "the copy along its middle" "$(sample_along copy.exr 1,0,0)" "$(sample_along card.exr 1,0,0)" 0.02
warns 'is in the convention blender, as turned.exr is, which the file cannot say' convert turned.exr copy.pfm

# VR180 is the middle half of a lat-long.
must convert card.exr vr180.exr --to vr180 --size 256
must convert card.exr middle.exr --to latlong,left=-90,right=90 --size 256
must diff vr180.exr middle.exr --fail-above 1e-5

# What was written is read with any aspect, and told where the file doesn't say so itself.
for extension in pfm webp; do
  must convert card.exr square.$extension --size 256x256
  warns "256×256 is read as latlong.*its texels are not square.*two eyes" convert square.$extension back.exr --from latlong \
    --to latlong --size 512
  same card.exr back.exr 0.2
done
for extension in png ktx2 hdr exr tif; do
  must convert card.exr square.$extension --size 256x256
  must info square.$extension --from latlong
  must info square.$extension
done
must convert card.exr faces.pfm --to cube:hcross --size 64x32
refuses 1 'does not fit cube:hcross' info faces.pfm --from cube:hcross

# Two eyes: the rows of a PFM run upward, so the upper picture comes last.
pixels() { tail -c $((12 * 128 * 64)) -- "$1"; }
must synth axes left.pfm --size 128
must synth studio right.pfm --size 128
{ printf 'PF\n128 128\n-1.0\n' && pixels right.pfm && pixels left.pfm; } >both.pfm
for eye in left right; do
  must convert both.pfm $eye.exr --from latlong --eye $eye
  run convert $eye.pfm alone.exr --from latlong
  must diff $eye.exr alone.exr --fail-above 1e-6
  must convert both.pfm $eye.exr --stereo top-bottom --eye $eye
  must diff $eye.exr alone.exr --fail-above 1e-6
done
run convert left.pfm alone.exr --from latlong
warns "two eyes' pictures one above the other, as asked: the left eye's is read" convert both.pfm x.exr --stereo top-bottom
must diff x.exr alone.exr --fail-above 1e-6
refuses 2 "did you mean 'right'" info both.pfm --from latlong --eye rihgt
refuses 2 'unknown arrangement' info both.pfm --from latlong --stereo beside
refuses 1 'cannot tell how two eyes' info left.pfm --from latlong --eye left
refuses 1 'holds one picture for both eyes' info both.pfm --from latlong --stereo none --eye left
matches '"eye": "right"' info both.pfm --from latlong --eye right --header --json
matches '"stereo": "top-bottom"' info both.pfm --from latlong --eye right --header --json
# Two VR180 pictures beside each other are a picture of 2:1.
must info left.pfm --from vr180 --eye right
matches '"parameterization": "vr180"' info left.pfm --from vr180 --eye right --header --json

finish
