#!/usr/bin/env bash
# Every format, stored type and compression holds a map to the precision of its type; the file says what it holds; metadata brings the
# parameterization back; other programs read the files and we read theirs.
#
# formats_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes map.exr --size 64

# format | types | compressions | relative RMSE: rounding to the type; what a lossy code may cost on hard edges
while IFS='|' read -r extension types compressions tolerance; do
  for type in $types; do
    for compression in $compressions; do
      must convert map.exr "copy.$extension" --type "$type" --compression "$compression"
      same map.exr "copy.$extension" "$tolerance"
      matches "\"type\": \"$type\"" info "copy.$extension" --header --json
    done
  done
done <<'END'
exr|float|none rle zips zip piz b44 b44a|0
exr|float|pxr24|2e-5
exr|half|none rle zips zip piz pxr24|5e-4
exr|half|b44 b44a|0.03
exr|half float|dwaa dwab|0.02
hdr|float|rle none|4e-3
ktx2|float|none zstd|0
ktx2|half|none zstd|5e-4
ktx2|rgb9e5|none zstd|2e-3
ktx2|r11g11b10|none zstd|2e-2
pfm|float|none|0
png|uint8|zip none|5e-3
png|uint16|zip none|3e-5
tif|uint8|zip none lzw|5e-3
tiff|uint16|zip none lzw|3e-5
tif|uint32|zip none lzw|1e-7
tif|half|zip none lzw|5e-4
tif|float|zip none lzw|0
webp|uint8|lossless|5e-3
webp|uint8|lossy|0.25
jpg|uint8|jpeg|0.08
jpeg|uint8|jpeg|0.08
END

# The extension's case doesn't matter, nor the input's name.
must convert map.exr COPY.PNG
mv COPY.PNG picture.exr
matches '"format": "png"' info picture.exr --header --json

# Formats that are only read are refused as outputs, and listed as such.
for extension in jxl avif heif heic; do
  refuses 2 "copy.$extension: .* is only read here, not written \(can be written: exr, hdr, ktx2" convert map.exr "copy.$extension"
  refuses 2 "copy.$extension: .* is only read here" synth axes "copy.$extension"
  matches "^$extension  read only$" list formats
done

# libheif and libjxl are loaded when such a file is opened, and not before: starting a process costs half as much without them.
# Where one can't be, the message says which.
checks=$((checks + 1))
if LD_TRACE_LOADED_OBJECTS=1 "$welkin" --version | grep -E 'lib(heif|jxl|x265|de265|aom)'; then
  fail "welkin is linked with these"
fi
mkdir no_libraries
for library in libheif.so.1 libjxl.so.0.7; do : >"no_libraries/$library"; done
printf '\0\0\0\24ftypavif\0\0\0\0mif1\0\0\0\14meta\0\0\0\0' >tiny.avif
printf '\377\n\372\177' >tiny.jxl
refuses 1 'tiny.avif: libheif cannot read it' info tiny.avif
refuses 1 'tiny.jxl: ' info tiny.jxl
export LD_LIBRARY_PATH=$PWD/no_libraries
refuses 1 'tiny.avif: the library libheif.so.1, .*cannot be loaded.* Debian .* libheif1$' info tiny.avif
refuses 1 'tiny.jxl: the library libjxl.so.0.7, .*cannot be loaded.* Debian .* libjxl0.7$' info tiny.jxl
must info map.exr
unset LD_LIBRARY_PATH

# Quality counts.
must convert map.exr fine.jpg --quality 98
must convert map.exr rough.jpg --quality 10
fine=$("$welkin" diff map.exr fine.jpg --json | number relative_rmse)
rough=$("$welkin" diff map.exr rough.jpg --json | number relative_rmse)
checks=$((checks + 1))
awk "BEGIN { exit !(4 * $fine < $rough) }" || fail "quality 98 errs by $fine, quality 10 by $rough"

# One and four channels. Alpha is linear, and goes where a format has it.
must convert map.exr red.exr --channels R
for extension in exr hdr ktx2 pfm png tif jpg webp; do
  run convert red.exr "one.$extension"
  checks=$((checks + 1))
  if ((status == 0)); then
    near "one channel in $extension" "$(sample_along "one.$extension" 1,0,0 | cut -d ' ' -f 1)" "$(sample_along map.exr 1,0,0 | cut -d ' ' -f 1)" 0.05
  else
    grep -q "^welkin: one.$extension: " "$work/messages" || fail "one channel in $extension: $(cat "$work/messages")"
  fi
done

# What a file cannot hold is clipped and reported.
loses() { # loses PATTERN ARGUMENT…
  local pattern=$1
  shift
  checks=$((checks + 1))
  run "$@"
  ((status == 0)) || fail "welkin $*: status $status: $(cat "$work/messages")"
  grep -qE "^welkin: .*$pattern" "$work/messages" || fail "welkin $*: doesn't say '$pattern': $(cat "$work/messages")"
}
must synth sun sun.exr --size 64 --angle 20
for extension in png jpg webp; do loses "copy.$extension: [0-9]+ values were above" convert sun.exr "copy.$extension"; done
loses "copy.exr: [0-9]+ values were above" convert sun.exr copy.exr --type half
for type in half rgb9e5 r11g11b10; do loses "copy.ktx2: [0-9]+ values were above" convert sun.exr copy.ktx2 --type $type; done
must convert map.exr negative.exr --scale -1
for extension in hdr png jpg webp; do loses "copy.$extension: 6144 values were negative" convert negative.exr "copy.$extension"; done
for type in rgb9e5 r11g11b10; do loses "copy.ktx2: 6144 values were negative" convert negative.exr copy.ktx2 --type $type; done
for extension in exr ktx2 pfm tif; do must convert negative.exr "copy.$extension"; done

# Values survive exactly where the type can: large, small and negative ones.
must convert sun.exr bright.exr --scale 1e30
for extension in exr ktx2 pfm tif; do
  must convert bright.exr "copy.$extension"
  same bright.exr "copy.$extension" 0
done

# Metadata restores parameterization, parameters, layout, faces and convention.
for extension in exr ktx2 png tif hdr jpg; do
  must synth axes "kept.$extension" --to fisheye-equidistant,fov=220 --size 32
  matches '"parameterization": "fisheye-equidistant,fov=220"' info "kept.$extension" --header --json
  matches '"reason": "declared' info "kept.$extension" --header --json
  must synth axes "kept.$extension" --to cube:3x2 --size 16 --to-faces nz,px:90,py,ny:180:mirror,pz,nx --convention unreal
  matches '"parameterization": "cube:3x2"' info "kept.$extension" --header --json
  matches '"orientation"' info "kept.$extension" --header --json
  must synth axes cube.exr --to cube --size 16
  must convert "kept.$extension" native.exr --convention native
  same cube.exr native.exr 0.2
  must synth axes "kept.$extension" --to latlong --size 21x17
  matches '"width": 21' info "kept.$extension" --header --json
done

# A declaration that is damaged names the file; one that another program copied to a picture it doesn't fit is not believed in silence.
must synth axes square.exr --to octahedral --size 16
sed 's/octahedral/octahedrax/' square.exr >damaged.exr
refuses 1 "damaged.exr: unknown parameterization 'octahedrax'" info damaged.exr
sed 's/octahedral/mercator,f/' square.exr >damaged.exr
refuses 1 "damaged.exr: unknown parameter of mercator" info damaged.exr
sed 's/octahedral/sky-latlon/' square.exr >damaged.exr
refuses 1 "damaged.exr: unknown parameterization 'sky-latlon'; did you mean 'sky-latlong'" info damaged.exr
must info damaged.exr --from octahedral

# OpenEXR's own tools read our files, and write envmap attributes that we read.
if command -v exrenvmap >/dev/null && command -v exrheader >/dev/null; then
  must synth axes panorama.exr --to openexr-latlong --size 256 --type half --samples 3
  checks=$((checks + 1))
  exrheader panorama.exr | grep -q 'envmap.*latitude-longitude' || fail "no envmap attribute: $(exrheader panorama.exr)"
  checks=$((checks + 1))
  exrenvmap -c -w 64 panorama.exr cube.exr || fail "exrenvmap cannot read a lat-long"
  matches '"parameterization": "openexr-cube:openexr,width=64,height=64"' info cube.exr --header --json
  for axis in "${axes[@]}"; do
    near "exrenvmap's cube along $axis" "$(sample_along cube.exr "$axis")" "${card_colour[$axis]}" 0.06
  done
  must synth axes drawn.exr --to openexr-cube --size 64 --type half --samples 3
  same drawn.exr cube.exr 0.25
  checks=$((checks + 1))
  exrenvmap -l -w 128 drawn.exr panorama2.exr || fail "exrenvmap cannot read a cube"
  matches '"parameterization": "openexr-latlong,width=128,height=64"' info panorama2.exr --header --json
  for axis in "${axes[@]}"; do
    near "exrenvmap's lat-long along $axis" "$(sample_along panorama2.exr "$axis")" "${card_colour[$axis]}" 0.06
  done
  if command -v exrmaketiled >/dev/null; then
    checks=$((checks + 1))
    exrmaketiled -m map.exr mipmapped.exr || fail "exrmaketiled cannot read our file"
    same map.exr mipmapped.exr 0
  fi
else
  skip "OpenEXR's exrenvmap, exrheader and exrmaketiled are not installed"
fi

# A reader that shares nothing with ours.
if command -v oiiotool >/dev/null; then
  for pair in exr:tif hdr:exr png:tif tif:exr; do
    from=copy.${pair%:*} to=other.${pair#*:}
    must convert map.exr "$from"
    checks=$((checks + 1))
    oiiotool "$from" -o "$to" >/dev/null || fail "oiiotool cannot read $from"
    same "$from" "$to" 1e-6 --from latlong
  done
else
  skip "oiiotool is not installed"
fi

finish
