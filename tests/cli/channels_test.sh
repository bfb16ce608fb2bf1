#!/usr/bin/env bash
# Which picture of a file is read, layers, parts and views of EXR, and which channels go into which format.
source "$(dirname -- "$0")/lib.sh"

# le32 N: four bytes, as printf takes them.
le32() { printf '\\x%02x' $(($1 & 255)) $(($1 >> 8 & 255)) $(($1 >> 16 & 255)) $(($1 >> 24 & 255)); }
# attribute NAME TYPE SIZE VALUE: the last as printf takes it.
attribute() { printf '%s\\0%s\\0%s%s' "$1" "$2" "$(le32 "$3")" "$4"; }

# exr FILE CHANNEL=HALF…: 8×4 texels, all alike; channels by name, halves as four hexadecimal digits. $extra goes into the header.
extra=
exr() {
  local file=$1 list= bytes=1 rows= y x channel row
  shift
  for channel in "$@"; do
    list+="${channel%=*}\\0$(le32 1)\\0\\0\\0\\0$(le32 1)$(le32 1)"
    bytes=$((bytes + ${#channel} - 5 + 17))
  done
  local box
  box=$(le32 0)$(le32 0)$(le32 7)$(le32 3)
  local head="\\x76\\x2f\\x31\\x01$(le32 2)"
  head+=$(attribute channels chlist "$bytes" "$list\\0")$(attribute compression compression 1 '\0')
  head+=$(attribute dataWindow box2i 16 "$box")$(attribute displayWindow box2i 16 "$box")$(attribute lineOrder lineOrder 1 '\0')
  head+=$(attribute pixelAspectRatio float 4 '\0\0\x80\x3f')$(attribute screenWindowCenter v2f 8 '\0\0\0\0\0\0\0\0')
  head+=$(attribute screenWindowWidth float 4 '\0\0\x80\x3f')$extra'\0'
  local start row_bytes=$((16 * $#))
  start=$(($(printf "$head" | wc -c) + 4 * 8))
  for y in 0 1 2 3; do
    head+=$(le32 $((start + y * (8 + row_bytes))))$(le32 0)
    row=
    for channel in "$@"; do
      for x in 0 1 2 3 4 5 6 7; do row+="\\x${channel: -2}\\x${channel: -4:2}"; done
    done
    rows+=$(le32 "$y")$(le32 "$row_bytes")$row
  done
  printf "$head$rows" >"$file"
}

# tells PATTERN ARGUMENT…: welkin does this, and one of its messages matches.
tells() {
  local pattern=$1
  shift
  checks=$((checks + 1))
  run "$@"
  ((status == 0)) || fail "welkin $*: status $status: $(head -n 3 -- "$work/messages")"
  grep -qE -- "$pattern" "$work/messages" || fail "welkin $*: doesn't tell '$pattern': $(head -n 3 -- "$work/messages")"
}

# shows VALUES ARGUMENT…: what sample prints.
shows() {
  local wanted=$1
  shift
  near "sample $*" "$("$welkin" sample "$@" --dir 0,0,1 2>/dev/null)" "$wanted" 0
}

# 0.25 0.5 1 and 0.75; 2 4 8; 7.
red=3400 green=3800 blue=3c00 alpha=3a00 two=4000 four=4400 eight=4800 seven=4700

# ---- layers, as Blender and others name them

exr blender.exr V.Combined.A=$alpha V.Combined.B=$blue V.Combined.G=$green V.Combined.R=$red V.Depth.Z=$seven
shows "0.25 0.5 1 0.75" blender.exr
must convert blender.exr blender.png --exposure -1
must convert blender.exr blender.exr.exr
matches '^  picture +8×4, R G B A of float' info blender.exr.exr --header
matches '^  layer +V.Combined: A B G R$' info blender.exr --header
matches '^  layer +V.Depth: Z$' info blender.exr --header
matches '^  read +part 0, channels V.Combined.R V.Combined.G V.Combined.B V.Combined.A$' info blender.exr --header
matches '"name": "V.Depth"' info blender.exr --header --json
shows 7 blender.exr --layer Depth
shows 7 blender.exr --channels V.Depth.Z
refuses 1 "blender.exr: unknown layer 'Dept' \(did you mean 'V.Depth'|blender.exr: unknown layer 'Dept'" info blender.exr --layer Dept
refuses 2 "--layer: " info blender.exr --layer ''
for format in hdr pfm jpg; do
  tells "o.$format: .* holds no alpha: A is left out" convert blender.exr "o.$format"
  must convert blender.exr "o.$format" --channels V.Combined.R,V.Combined.G,V.Combined.B
done
shows "0.25 0.5 1" o.pfm
must convert blender.exr o.ktx2
shows "0.25 0.5 1 0.75" o.ktx2
must bake blender.exr bake.ktx2 --size 4 --levels 2 --channels V.Combined.R,V.Combined.G,V.Combined.B
near 'bake of a layer' "$(sample_along bake.ktx2 0,0,1)" "0.25 0.5 1" 1e-4
tells "bake.hdr: .* holds no alpha" bake blender.exr bake.hdr --lobe lambert --size 4 --channels V.Combined.R,V.Combined.G,V.Combined.B,V.Combined.A

exr two.exr a.B=$eight a.G=$four a.R=$two beauty.B=$blue beauty.G=$green beauty.R=$red
shows "0.25 0.5 1" two.exr
tells "two.exr: holds several pictures, and 'beauty' is read; another layer can be named \(--layer\): 'a'" sample two.exr --dir 0,0,1
must sample two.exr --dir 0,0,1 --quiet
shows "2 4 8" two.exr --layer a
must convert two.exr a.hdr --layer a
shows "2 4 8" a.hdr

# ---- other names

exr small.exr b=$blue g=$green r=$red
shows "0.25 0.5 1" small.exr
exr words.exr blue=$blue green=$green red=$red
shows "0.25 0.5 1" words.exr
exr xyz.exr X=$red Y=$green Z=$blue
shows "0.25 0.5 1" xyz.exr
tells "xyz.exr: no channels are called R G B: X Y Z are read" convert xyz.exr xyz.hdr
tells "xyz.hdr: channels X Y Z are written as R G B" convert xyz.exr xyz.hdr
shows "0.25 0.5 1" xyz.hdr
exr depth.exr Z=$seven
shows 7 depth.exr
tells "depth.exr: holds no colour: Z, a depth, is read" convert depth.exr depth.pfm
tells "depth.pfm: channel Z is written as Y" convert depth.exr depth.pfm
exr many.exr a=$red b=$green c=$blue d=$alpha
tells "o.png: channels a c d are written as R G B" convert many.exr o.png --channels a,c,d
tells "o.hdr: channels d c a are written as R G B" convert many.exr o.hdr --channels d,c,a
shows "0.75 1 0.25" o.hdr
tells "o.ktx2: channels a b c d are written as R G B A" convert many.exr o.ktx2 --channels a,b,c,d
refuses 1 "o.hdr: HDR holds Y or R G B, not a b: read one channel or three \(--channels\), or write EXR" convert many.exr o.hdr --channels a,b

# ---- views in the channels' names

extra=$(attribute multiView stringvector 17 "$(le32 4)left$(le32 5)right")
exr stereo.exr B=$blue G=$green R=$red right.B=$eight right.G=$four right.R=$two
extra=
shows "0.25 0.5 1" stereo.exr
shows "0.25 0.5 1" stereo.exr --layer left
shows "2 4 8" stereo.exr --layer right
matches '^  views +left right$' info stereo.exr --header

# ---- parts

exr rgb.exr B=$blue G=$green R=$red
exr other.exr B=$eight G=$four R=$two
if command -v exrmultipart >"$work/found"; then
  exrmultipart -combine -i depth.exr::depth rgb.exr::main other.exr::aov -o parts.exr >"$work/made" 2>&1
  shows "0.25 0.5 1" parts.exr
  tells "parts.exr: holds several pictures, and 'main' is read; another layer can be named \(--layer\): 'aov'" sample parts.exr --dir 0,0,1
  shows "2 4 8" parts.exr --layer aov
  shows "2 4 8" parts.exr --part 2
  shows 7 parts.exr --part 0
  shows 7 parts.exr --channels Z
  matches '^  read +part 1, channels R G B$' info parts.exr --header
  refuses 1 "parts.exr: has no part 3 \(parts are 0 to 2\)" info parts.exr --part 3
  exrmultipart -combine -i depth.exr::depth rgb.exr::beauty -o beauty.exr >"$work/made" 2>&1
  must sample beauty.exr --dir 0,0,1
  shows "0.25 0.5 1" beauty.exr
else
  skip "parts: there is no exrmultipart"
fi

finish
