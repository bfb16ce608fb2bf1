#!/usr/bin/env bash
# `view` of animations: streams of frames through pipes, blurred motion, near pictures over far worlds, going on after
# an interruption.
#
# view_stream_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

camera=(--size 96x54 --fov 70 --look 20,-10,5)
for frame in 0 1 2 3; do
  must synth zoneplate "turn.exr" --frequency 4 --size 256
  # By a format that says nothing of where it looks.
  must view turn.exr plain.pfm --camera latlong --size 256x128 --look $((30 * frame)) --scale 0.5
  must convert plain.pfm "world_$frame.png"
  must view "world_$frame.png" "wanted_$frame.png" "${camera[@]}"
  must view "world_$frame.png" "wanted_$frame.pfm" "${camera[@]}"  # which says nothing of its camera, as streams
done
must view world_%d.png files_%d.png "${camera[@]}" --from latlong
checks=$((checks + 1))
cmp -s files_3.png wanted_3.png || same files_3.png wanted_3.png 1e-6

# Streams, by the program that everyone has.
if command -v ffmpeg >/dev/null; then
  quiet=(-hide_banner -loglevel error -nostdin)
  piped() { # KIND TOLERANCE INPUT-OPTIONS… : ffmpeg's frames through welkin to ffmpeg's
    local kind=$1 tolerance=$2
    shift 2
    checks=$((checks + 1))
    rm -f seen_*.png
    ffmpeg "${quiet[@]}" -framerate 12 -i world_%d.png "$@" - |
      "$welkin" view - - --stream "$kind" "${camera[@]}" 2>messages |
      ffmpeg -hide_banner -loglevel error -y $( [[ $kind == y4m ]] && echo -f yuv4mpegpipe || echo -f image2pipe -c:v "$kind") -i - -start_number 0 seen_%d.png ||
      fail "$kind: $(cat messages)"
    [[ $(ls seen_*.png | wc -l) == 4 ]] || fail "$kind: $(ls seen_*); $(cat messages)"
    for frame in 0 3; do same "seen_$frame.png" "wanted_$frame.pfm" "$tolerance" --from perspective,fov=70; done
  }
  # Rounded to 8 bits twice, by ffmpeg's integers; chroma of half the size twice.
  piped ppm 0.012 -f image2pipe -c:v ppm -pix_fmt rgb24
  piped y4m 0.02 -f yuv4mpegpipe -pix_fmt yuv444p
  piped y4m 0.06 -f yuv4mpegpipe -pix_fmt yuv420p
  ffmpeg "${quiet[@]}" -framerate 30000/1001 -i world_%d.png -f yuv4mpegpipe -pix_fmt yuv420p -y world.y4m
  "$welkin" view - - --stream y4m "${camera[@]}" <world.y4m 2>/dev/null >seen.y4m
  checks=$((checks + 2))
  head -n 1 seen.y4m | grep -q "W96 H54 F30000:1001 .*C420jpeg" || fail "y4m: $(head -n 1 seen.y4m)"
  "$welkin" view - - --stream y4m --rate 25 --frames 0-1 "${camera[@]}" <world.y4m 2>messages >rate.y4m
  head -n 1 rate.y4m | grep -q "F25:1" || fail "--rate: $(head -n 1 rate.y4m; cat messages)"
  # Out of a stream into files.
  rm -f seen_*.png
  checks=$((checks + 1))
  "$welkin" view - seen_%02d.png --stream y4m --frames 5-9 "${camera[@]}" <world.y4m >/dev/null 2>messages || fail "to files: $(cat messages)"
  [[ $(echo seen_*.png) == "seen_05.png seen_06.png seen_07.png seen_08.png" ]] || fail "to files: $(ls seen_*)"
  # A stream that ends early keeps its finished frames; a pipe that closes ends the work.
  head -c $(($(stat -c %s world.y4m) - 1000)) world.y4m >short.y4m
  rm -f seen_*.png
  checks=$((checks + 2))
  if "$welkin" view - seen_%d.png --stream y4m "${camera[@]}" <short.y4m >/dev/null 2>messages; then fail "a short stream passes"; fi
  grep -q "standard input: frame 3 ends after .*; 3 frames were finished before" messages || fail "short stream: $(cat messages)"
  [[ $(ls seen_*.png | wc -l) == 3 ]] || fail "short stream: $(ls seen_*)"
  checks=$((checks + 1))
  { "$welkin" view world_0.png - --stream ppm --frames 0-500 "${camera[@]}" 2>messages || echo "status $?" >>messages; } | head -c 1000 >/dev/null
  grep -q "has closed it" messages && grep -q "status 1" messages || fail "a closed pipe: $(cat messages)"
else
  skip "streams: ffmpeg is not installed"
fi

# Floats through a pipe are what files hold.
"$welkin" view world_1.png - --stream pfm --frames 1 "${camera[@]}" >one.pfm 2>/dev/null
must view world_1.png file.pfm "${camera[@]}"
checks=$((checks + 1))
cmp -s one.pfm file.pfm || fail "a stream of one PFM is not the file"

# Positions are kept while the camera stands still, found anew for a world of another shape: the same as one by one.
must synth zoneplate world_4.png --frequency 4 --size 100
must view world_%d.png kept_%d.pfm "${camera[@]}" --from latlong --filter bilinear
for frame in 0 3 4; do
  must view "world_$frame.png" alone.pfm "${camera[@]}" --from latlong --filter bilinear
  checks=$((checks + 1))
  cmp -s "kept_$frame.pfm" alone.pfm || fail "frame $frame is another when positions are kept"
done

# What a stream's frames are is found by their size alone.
{ printf 'P6\n32 32\n255\n'; head -c 3072 /dev/zero; } >square.ppm
checks=$((checks + 2))
"$welkin" view - - --stream ppm --size 16x9 <square.ppm >/dev/null 2>messages && fail "a square is a map"
grep -q "cannot tell which parameterization 32×32 is" messages || fail "a square: $(cat messages)"
"$welkin" view - - --stream ppm --size 16x9 --from octahedral <square.ppm 2>messages | head -c 2 | grep -q P6 || fail "--from: $(cat messages)"

# Blurred motion: between the sharp frames, and as bright.
printf 'frame,yaw\n0,0\n10,100\n' >keys.csv
must view world_0.png sharp_%d.exr --path keys.csv --frames 0-1 --size 96x54
must view world_0.png blurred_%d.exr --path keys.csv --frames 0-1 --size 96x54 --shutter 0,1
must view world_0.png middle_%d.exr --path keys.csv --frames 0-1 --size 96x54 --shutter -0.5,0.5 --samples 64
checks=$((checks + 1))
"$welkin" diff sharp_0.exr middle_0.exr --fail-above 0.02 >/dev/null 2>&1 && fail "nothing is blurred"
refuses 2 "stands still" view world_0.png no_%d.exr --shutter 0,1 --frames 0-1
refuses 2 "OPEN,CLOSE" view world_0.png no_%d.exr --path keys.csv --shutter 1,0
refuses 2 "OPEN,CLOSE" view world_0.png no_%d.exr --path keys.csv --shutter 1
refuses 2 "for --shutter" view world_0.png no_%d.exr --path keys.csv --samples 8

# Near over far: half of white over the left half of the picture.
must synth sun white.exr --size 64 --angle 1 --intensity 1 --background 1
must view white.exr near.exr --size 96x54
must assemble near_world.exr --panel near.exr,fov=40 --size 128 --alpha
must view near_world.exr near_1.exr --size 96x54 --fov 70
must view world_1.png over_%d.exr --frames 1 "${camera[@]}" --over near_%d.exr
must view world_1.png plain_%d.exr --frames 1 "${camera[@]}"
refuses 1 "lacks A" view world_1.png no_%d.exr --frames 1 "${camera[@]}" --over plain_%d.exr
refuses 1 "no files of frames 2" view world_1.png no_%d.exr --frames 1-2 "${camera[@]}" --over near_%d.exr

# Going on.
must view world_0.png go_%d.png --path keys.csv --frames 0-3 --size 32x18 --resume
touch -d '2 seconds ago' world_0.png keys.csv
before=$(stat -c %Y.%i go_0.png)
rm go_2.png
must view world_0.png go_%d.png --path keys.csv --frames 0-3 --size 32x18 --resume
checks=$((checks + 1))
[[ -s go_2.png && $(stat -c %Y.%i go_0.png) == "$before" ]] || fail "--resume made a complete frame again"
printf 'frame,yaw\n0,0\n10,50\n' >keys.csv
must view world_0.png go_%d.png --path keys.csv --frames 0-3 --size 32x18 --resume
checks=$((checks + 1))
[[ $(stat -c %Y.%i go_0.png) != "$before" ]] || fail "--resume kept frames of another path"

refuses 2 "did you mean" view - - --stream ymm
refuses 2 "name one of IN and OUT -" view world_0.png out.png --stream y4m
refuses 2 "one level" view - - --stream y4m --level 1
refuses 2 "frames a second" view - - --stream y4m --rate 0
refuses 2 "is for --stream" view world_0.png out.png --rate 25
refuses 2 "needs a place" view - out.png --stream y4m
refuses 2 "not for streams" view - - --stream y4m --resume
refuses 1 "no stream of frames" view - - --stream y4m

finish
