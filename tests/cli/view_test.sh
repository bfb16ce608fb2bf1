#!/usr/bin/env bash
# `view`: where a camera looks, what its lenses show, frames, pairs of eyes, and what it refuses.
#
# view_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes card.exr --size 512 --samples 2

# The colour in the middle of a picture is that of the side it looks at.
middle_is() {
  local direction=$1
  shift
  must view card.exr look.exr --size 64x36 --fov 20 "$@"
  near "view $*" "$(sample_along look.exr "$direction")" "${card_colour[$direction]}" 2e-3
}
middle_is 0,0,1
middle_is -1,0,0 --look 90
middle_is 1,0,0 --look -90,0,0
middle_is 1,0,0 --look ' -90, 0, 0'
middle_is 0,0,-1 --look 180
middle_is 0,1,0 --look 0,90
middle_is 0,-1,0 --look 0,-90,0

# By the pixels themselves, without what the file says of its camera: the light is on the right when it is right
# of where the camera looks, above when above, and the camera tilted to the right sees it turn to the left.
must synth sun sun.exr --size 1024 --angle 2 --elevation 0 --azimuth 0 --intensity 1000 --background 0
sun_at() {
  local wanted=$1
  shift
  must view sun.exr sun.pfm --size 200x100 "$@"
  near "the sun, view $*" "$(centre_of_light sun.pfm 200 100)" "$wanted" 0.3
}
sun_at "100 50"
# 100/tan 45° · tan 10° = 17.63 pixels.
sun_at "82.37 50" --look 10
sun_at "117.63 50" --look -10
sun_at "100 67.63" --look 0,10
sun_at "82.37 50" --look 10 --camera perspective
sun_at "100 32.37" --look 10,0,-90
sun_at "150 75" --shift -0.25,0.25
# 200/π · tan 30°
sun_at "100 86.75" --look 0,30 --camera cylindrical --fov 180

for camera in perspective pannini pannini,d=0.5,vertical=1 stereographic equidistant equisolid orthographic cylindrical dome \
  dome,tilt=30 little-planet fisheye-equisolid latlong vr180 mercator octahedral; do
  must view card.exr seen.exr --camera "$camera" --size 128x128
  # As a map it is what it shows: converted to another camera's shape, the middle is the card's.
  must view seen.exr again.exr --camera "$camera" --size 128x128
done

# A picture knows its camera: the world that it shows is the world. One that doesn't is told by --from.
must synth zoneplate smooth.exr --frequency 1 --size 512
must view smooth.exr photo.png --size 640x360 --fov 60 --look 30,10,5 --type uint16 --scale 0.9
must convert photo.png back.exr --to latlong --size 512
near "a picture read as a map" "$(sample_along back.exr -0.3,0.2,1)" "$(sample_along smooth.exr -0.3,0.2,1 | awk '{ print 0.9 * $1, 0.9 * $2, 0.9 * $3 }')" 2e-3
near "beside it" "$(sample_along back.exr 0,0,-1)" "0 0 0" 0
must view smooth.exr plain.pfm --size 640x360 --fov 60
must convert plain.pfm back.exr --from perspective,fov=60 --to latlong --size 512
near "a photograph" "$(sample_along back.exr 0.2,0.1,1)" "$(sample_along smooth.exr 0.2,0.1,1)" 2e-3

# Brightness.
must view smooth.exr bright.exr --size 64x64 --exposure 1 --scale 3
near "exposure" "$(sample_along bright.exr 0,0,1)" "$(sample_along smooth.exr 0,0,1 | awk '{ print 6 * $1, 6 * $2, 6 * $3 }')" 1e-2

# Frames: the same as one by one.
printf 'frame,yaw,fov\n1,0,60\n5,360,60\n' >keys.csv
must view smooth.exr pan_%02d.png --path keys.csv --size 64x36 --threads 1
must view smooth.exr one.png --size 64x36 --fov 60 --look 90
checks=$((checks + 2))
[[ $(ls pan_*.png | wc -l) == 5 ]] || fail "frames: $(ls pan_*)"
same pan_02.png one.png 1e-5
must view smooth.exr more_####.png --frames 2-3 --fov 60 --size 64x36
for frame in 1 2; do must synth zoneplate "in_$frame.exr" --frequency 1 --size 128; done
must view in_%d.exr out_%d.png --size 64x36
[[ -s out_1.png && -s out_2.png ]] || fail "numbered inputs"

# Both eyes: the left one sees the sun ahead, the right one to its left.
must view sun.exr eyes.pfm --camera latlong --size 256x128
must view sun.exr turned.pfm --camera latlong --size 256x128 --look 30
{ printf 'PF\n256 256\n-1\n'; tail -c $((256 * 128 * 12)) turned.pfm; tail -c $((256 * 128 * 12)) eyes.pfm; } >both.pfm
for eye in left right; do
  must view both.pfm "$eye.pfm" --stereo top-bottom --eye "$eye" --size 200x100
done
must view both.pfm pair.pfm --stereo top-bottom --pair left-right --size 200x100
must view both.pfm stack.pfm --stereo top-bottom --pair top-bottom --size 200x100
near "the left eye" "$(centre_of_light left.pfm 200 100)" "100 50" 0.5
# 100 − 100 tan 30°
near "the right eye" "$(centre_of_light right.pfm 200 100)" "42.26 50" 0.5
checks=$((checks + 1))
cmp -s <(tail -c $((200 * 200 * 12)) stack.pfm) <(tail -c $((200 * 100 * 12)) right.pfm; tail -c $((200 * 100 * 12)) left.pfm) ||
  fail "a pair is not the two views"

refuses 2 "is not a number in" view card.exr no.png --fov 0
refuses 2 "is not a number in" view card.exr no.png --fov 180
refuses 2 "is not a number in" view card.exr no.png --fov 360
refuses 2 "not a number" view card.exr no.png --fov nan
refuses 2 "is not a size" view card.exr no.png --size 0x10
refuses 2 "is not a size" view card.exr no.png --size 2000000x10
refuses 2 "WIDTHxHEIGHT" view card.exr no.png --size 100
refuses 2 "did you mean 'pannini'" view card.exr no.png --camera panini
refuses 2 "one chart" view card.exr no.png --camera cube
refuses 2 "YAW,PITCH,ROLL" view card.exr no.png --look 1,2,3,4
refuses 2 "not a number" view card.exr no.png --look 1,x
refuses 2 "needs a place" view card.exr no.png --frames 1-2
refuses 2 "needs a place" view card.exr no.png --path keys.csv
refuses 2 "which frames" view card.exr no_%d.png
refuses 1 "two eyes" view card.exr no.png --pair left-right
refuses 2 "did you mean" view card.exr no.png --pair left-rihgt
refuses 1 "no files of frames 3" view in_%d.exr no_%d.png --frames 1-3
refuses 1 "such file" view card.exr no_%d.png --path none.csv
printf 'frame,yaw\n5,0\n4,0\n' >wrong.csv
refuses 1 "frames ascend" view card.exr no_%d.png --path wrong.csv
printf 'frame,fov\n1,50\n4,200\n' >wide.csv
refuses 1 "frame [234]: .*is not a number in" view card.exr no_%d.png --path wide.csv
refuses 2 "over 1000000 frames" view card.exr no_%d.png --frames 0-999999999
refuses 2 "extension" view card.exr no.abc

finish
