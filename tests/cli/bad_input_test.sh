#!/usr/bin/env bash
# Files that are missing, empty, damaged, absurd or of the wrong shape: status 1 and one message, `welkin: FILE: cause`; never a crash, never
# a file left over.
#
# bad_input_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# 4 GB of address space is plenty for these maps, and exposes a reader that trusts the size in a header. (Sanitizers need far more.)
limited=false
if (ulimit -v 4000000 && "$welkin" list) >/dev/null 2>&1; then
  ulimit -v 4000000
  limited=true
fi

must synth axes map.exr --size 32
mkdir folder
: >empty.exr
head -c 3000 /dev/urandom >garbage.exr
printf '%03000d' 0 >zeros.hdr

for command in info convert sample diff "plot mips"; do
  case $command in
    convert | "plot mips") after="out.exr" ;;
    sample) after="--dir 0,0,1" ;;
    diff) after="map.exr" ;;
    *) after="" ;;
  esac
  # shellcheck disable=SC2086
  {
    refuses 1 "missing.exr: No such file or directory" $command missing.exr $after
    refuses 1 "folder: Is a directory" $command folder $after
    refuses 1 "map.exr/x: Not a directory" $command map.exr/x $after
    refuses 1 "empty.exr: the file is empty" $command empty.exr $after
    refuses 1 "/dev/null: the file is empty" $command /dev/null $after
    refuses 1 "garbage.exr: not an image of a known format" $command garbage.exr $after
    refuses 1 "zeros.hdr: a text .'0000" $command zeros.hdr $after
  }
done
refuses 1 "missing.exr: No such file" diff map.exr missing.exr

# Every format, cut at many lengths: never taken for whole, unless only metadata behind the pixels is gone.
files=()
for extension in exr hdr pfm png jpg tif webp; do
  must convert map.exr "whole.$extension"
  files+=("whole.$extension")
done
for compression in none rle zips piz pxr24 b44 dwaa; do
  must convert map.exr "$compression.exr" --compression "$compression" --type half
  files+=("$compression.exr")
done
for compression in none lzw; do
  must convert map.exr "$compression.tif" --compression "$compression"
  files+=("$compression.tif")
done
must convert map.exr layers.exr --to cube:layers --size 8
files+=(layers.exr)

# survives WHAT FILE: welkin reads the file or refuses it with a message that names it, and does neither crash nor hang.
survives() {
  checks=$((checks + 1))
  run info "$2" --json
  case $status in
    0) ;;
    1)
      if [[ $(wc -l <"$work/messages") != 1 ]] || ! grep -q "^welkin: $2: ." "$work/messages"; then
        fail "$1: $(head -n 3 -- "$work/messages")"
      fi
      ;;
    *) fail "$1: status $status: $(head -n 3 -- "$work/messages")" ;;
  esac
}
for file in "${files[@]}"; do
  length=$(stat -c %s "$file")
  extension=${file##*.}
  for keep in 1 2 3 4 8 11 16 31 64 100 $((length / 4)) $((length / 2)) $((length * 3 / 4)); do
    head -c "$keep" "$file" >"cut.$extension"
    survives "$file cut to $keep bytes" "cut.$extension"
    ((status == 1)) || [[ $extension == jpg && $keep -gt 1000 ]] || fail "$file cut to $keep of $length bytes is read"
  done
  for less in 1 2 7 20; do
    head -c $((length - less)) "$file" >"cut.$extension"
    survives "$file without its last $less bytes" "cut.$extension"
  done
  # Bytes overwritten, the same ones at every run.
  for place in 4 9 17 24 40 77 150 $((length / 3)) $((length / 2)) $((length - 9)); do
    ((place + 4 < length)) || continue
    for bytes in '\xff\xff\xff\xff' '\x00\x00\x00\x00' '\x80\x00\x00\x01'; do
      cp -- "$file" "broken.$extension"
      printf '%b' "$bytes" | dd of="broken.$extension" bs=1 seek="$place" conv=notrunc status=none
      survives "$file with $bytes at $place" "broken.$extension"
    done
  done
done
rm -f cut.* broken.*

# Headers with absurd sizes.
printf 'PF\n999999999 999999999\n-1\n' >huge.pfm
printf 'PF\n1048576 1048576\n-1\n' >large.pfm
printf 'PF\n100000 50000\n-1\n' >missing.pfm
printf 'PF\n-4 4\n-1\n' >negative.pfm
printf 'PF\n0 4\n-1\n' >nothing.pfm
printf 'PF\n4 2\n0\n%0200d' 0 >scaleless.pfm
printf 'PF\n4 2\nnan\n%0200d' 0 >nan.pfm
printf 'PF\n4' >short.pfm
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999999 +X 99999999\n' >huge.hdr
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 500000 +X 1000000\n' >large.hdr
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n' >nothing.hdr
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y x +X y\n' >words.hdr
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n' >endless.hdr
printf '\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x08\x02\0\0\0\0\0\0\0' >huge.png
printf '\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\0\0\0\0\0\x08\x02\0\0\0\0\0\0\0' >nothing.png
printf '\x89PNG\r\n\x1a\n\xff\xff\xff\xffIHDR' >chunk.png
printf 'II*\0\xff\xff\xff\xff' >far.tif
printf 'II*\0\x08\0\0\0\0\0' >nothing.tif
printf '\xff\xd8\xff\xe0\xff\xff' >short.jpg
printf 'RIFF\xff\xff\xff\xffWEBPVP8 \xff\xff\xff\xff' >huge.webp
for file in huge.* large.* missing.pfm negative.pfm nothing.* scaleless.pfm nan.pfm short.* words.hdr endless.hdr chunk.png far.tif; do
  refuses 1 "$file: ." info "$file"
  refuses 1 "$file: ." convert "$file" out.exr
done
# An EXR whose data window is 2^31 wide: the window's last column, 31, overwritten after the attribute's name, type and length.
offset=$(grep -abo 'dataWindow' whole.exr | head -n 1 | cut -d: -f1)
cp whole.exr wide.exr
printf '\xff\xff\xff\x7f' | dd of=wide.exr bs=1 seek=$((offset + 11 + 6 + 4 + 8)) conv=notrunc status=none
refuses 1 "wide.exr: ." info wide.exr
cp whole.exr inside-out.exr
printf '\xf0\xff\xff\xff' | dd of=inside-out.exr bs=1 seek=$((offset + 11 + 6 + 4 + 8)) conv=notrunc status=none
refuses 1 "inside-out.exr: ." info inside-out.exr

# The wrong shape.
must synth axes square.pfm --to octahedral --size 16
refuses 1 "square.pfm: cannot tell which parameterization 16×16 is; name it with --from" convert square.pfm out.exr
matches "unknown: .*name it with --from" info square.pfm
refuses 1 "square.pfm: 16×16 does not fit cube:vcross" convert square.pfm out.exr --from cube:vcross
refuses 1 "map.exr: 32×16 does not fit cube:hcross" info map.exr --from cube:hcross
refuses 1 "map.exr: cube:faces is in several files: put %s in the name" info map.exr --from cube:faces
refuses 1 "map.exr: cube:layers needs 6 parts, the file has 1" info map.exr --from cube:layers
refuses 1 "map.exr: has no part 1 \(parts are 0 to 0\)" info map.exr --part 1
refuses 1 "map.exr: unknown channel 'Q'" convert map.exr out.exr --channels Q
refuses 1 "unknown channel 'Z'" convert map.exr out.exr --channels R,G,Z

# Faces that are nearly square fit a grid, but not turned by 90°.
for layout in hcross:192:147 flat:192:147 bands:192:130; do
  IFS=: read -r layout width height <<<"$layout"
  {
    printf 'PF\n%d %d\n-1\n' "$width" "$height"
    head -c $((width * height * 12)) /dev/zero
  } >oblong.pfm
  if [[ $layout == hcross ]]; then must info oblong.pfm --from cube:$layout; else refuses 1 "oblong.pfm: faces of .* cannot be turned" info oblong.pfm --from cube:$layout; fi
done

# Files of faces: too few, of two sizes, of none.
must synth axes face-%s.exr --to cube:faces --size 8 -q
refuses 1 "none-%s.exr: none of none-px.exr, none-posx.exr, .* exists" info none-%s.exr
rm face-ny.exr
refuses 1 "face-ny.exr: No such file" convert face-%s.exr out.exr
must synth axes face-ny.exr --to octahedral --size 4
refuses 1 "face-ny.exr: is 4×4, but the first face is 8×8" convert face-%s.exr out.exr

# Maps that can't be compared.
{
  printf 'Pf\n32 16\n-1\n'
  head -c 2048 /dev/zero
} >grey.pfm
refuses 1 "no channels? in common" diff map.exr grey.pfm

# Asked for a format that can't hold it.
must convert map.exr two.exr --channels R,G
refuses 1 "out.png: " convert two.exr out.png
refuses 1 "out.hdr: " convert map.exr out.hdr --type uint8
refuses 1 "out.exr: unknown EXR compression 'zop'; did you mean 'zip'\?" convert map.exr out.exr --compression zop
refuses 1 "out.png: PNG holds one picture, not 6" convert map.exr out.png --to cube:layers --size 4

# One bad file among several.
checks=$((checks + 1))
run info map.exr missing.exr
((status == 1)) && grep -q '^map.exr$' "$work/out" && grep -q '^welkin: missing.exr: ' "$work/messages" || fail "info of a good file and a bad one"

# More than memory holds.
if $limited; then refuses 1 "out of memory" synth axes out.exr --size 1048576; fi

finish
