#!/usr/bin/env bash
# The same conversions by other programs, where these are installed: ffmpeg, nona (Debian: hugin-tools), exrenvmap
# (openexr), and cmft when WELKIN_BENCH_CMFT names it.
#
# peers.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail

build=$(cd -- "$1" && pwd) work=$2
welkin=$build/welkin
threads=${WELKIN_BENCH_THREADS:-2}
face=1024
cd -- "$work"

convert() { "$welkin" convert -j "$threads" "$@"; }
cost() { "$build/bench/process_cost" 5 "$@"; }

# The upstream version of a Debian package.
version() { dpkg-query -W -f='${Version}' "$1" 2>/dev/null | sed 's/^[0-9]*://; s/[+-].*//'; }

# psnr REFERENCE MAP: dB, peak 1; a dash without a reference.
psnr() {
  if [[ $1 == - ]]; then echo —; return; fi
  "$welkin" diff "$1" "$2" --peak 1 | sed -n 's/^all .*PSNR \([0-9.]*\) dB.*/\1/p'
}

# peer_row JOB PEER_FILE SHAPE WELKIN_FILE SHAPE REFERENCE
# Compares what $peer and $ours (arrays: the commands) make, once both are unpacked into faces.
peer_row() {
  local job=$1 reference=$6 cpu wall peer_cpu peer_wall peer_db welkin_db
  read -r peer_cpu peer_wall _ < <(cost "${peer[@]}")
  read -r cpu wall _ < <(cost "${ours[@]}")
  convert "$2" peer.exr --from "$3" --colour linear --channels R,G,B --to "${faces[@]}"
  convert "$4" ours.exr --from "$5" --colour linear --channels R,G,B --to "${faces[@]}"
  peer_db=$(psnr "$reference" peer.exr)
  welkin_db=$(psnr "$reference" ours.exr)
  awk -v job="$job" -v a="$peer_cpu" -v b="$peer_wall" -v c="$cpu" -v d="$wall" -v e="$peer_db" -v f="$welkin_db" \
    'BEGIN { printf "| %s | %.2f | %.2f | %.2f | %.2f | %.1f | %.1f | %s | %s |\n", job, a, b, c, d, a / c, b / d, e, f }'
}

cat <<TEXT

## Other programs: 4096×2048 to cube 6×$face, from file to file

Whole processes, $threads threads where the program has them, median of 5 runs; the input is in the page cache. Both programs read the same file
and write the same format. PSNR (peak 1, weighted by solid angle) is against the same resampling in float64: bilinear interpolation, or for
area filters the mean over 32×32 points of every texel. A program whose filter is defined otherwise shows that here, not an error. *Faster* is
the peer's time over Welkin's. Values end at ¾, because v360 wraps around when 16-bit values come close to their largest.

| job | peer, CPU s | wall s | Welkin, CPU s | wall s | faster, CPU | wall | peer, dB | Welkin, dB |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
TEXT

"$build/bench/make_picture" source.tif 4096
convert source.tif source.exr --colour linear
"$build/bench/reference" source.exr bilinear.exr "$face" bilinear
faces=(cube:layers)
missing=()

if command -v ffmpeg >/dev/null; then
  for kernel in bilinear lanczos; do
    interpolation=${kernel/bilinear/line}
    peer=(ffmpeg -y -v error -threads "$threads" -filter_threads "$threads" -i source.tif
      -vf "v360=e:c6x1:interp=$interpolation:w=$((6 * face)):h=$face:out_forder=lrudfb" -pix_fmt rgb48le -compression_algo raw peer.tif)
    ours=("$welkin" convert -j "$threads" source.tif ours.tif --colour linear --to-colour linear --to cube:hstrip --size "$face"
      --filter "$kernel" --type uint16 --compression none)
    reference=bilinear.exr
    if [[ $kernel == lanczos ]]; then reference=-; fi
    peer_row "ffmpeg $(version ffmpeg), v360, $kernel, 16-bit TIFF" \
      peer.tif cube:hstrip ours.tif cube:hstrip $reference
  done
else
  missing+=(ffmpeg)
fi

if command -v nona >/dev/null; then
  # A picture for each face: yaw and pitch turn the source the other way.
  for turn in px:90:0 nx:-90:0 py:0:-90 ny:0:90 pz:0:0 nz:180:0; do
    IFS=: read -r name yaw pitch <<<"$turn"
    printf 'p f0 w%d h%d v90 n"TIFF_m c:NONE"\nm i5\ni w4096 h2048 f4 v360 r0 p%d y%d n"%s/source.tif"\n' \
      "$face" "$face" "$pitch" "$yaw" "$PWD" >"$name.pto"
  done
  export OMP_NUM_THREADS=$threads
  peer=(sh -c 'for face in px nx py ny pz nz; do nona -o nona_$face $face.pto >/dev/null || exit 1; done')
  ours=("$welkin" convert -j "$threads" source.tif 'ours_%s.tif' --colour linear --to-colour linear --to cube:faces --size "$face"
    --filter bilinear --type uint16 --compression none)
  peer_row "nona $(version hugin-tools), six runs, bilinear, 16-bit TIFF" 'nona_%s0000.tif' cube:faces 'ours_%s.tif' cube:faces bilinear.exr
else
  missing+=('nona (hugin-tools)')
fi

if command -v exrenvmap >/dev/null; then
  faces=(openexr-cube:layers)
  openexr=$(version openexr)
  convert source.exr half.exr --from openexr-latlong --to openexr-latlong --type half --compression none
  "$build/bench/reference" half.exr bilinear.exr "$face" bilinear openexr
  "$build/bench/reference" half.exr area.exr 256 32 openexr
  ours=("$welkin" convert -j "$threads" half.exr ours_openexr.exr --from openexr-latlong --to openexr-cube --type half --compression none)
  files=(peer_openexr.exr openexr-cube ours_openexr.exr openexr-cube)
  plain=("${ours[@]}")
  peer=(exrenvmap -li -c -f 0 1 -w "$face" half.exr peer_openexr.exr)
  ours=("${plain[@]}" --size "$face" --filter bilinear)
  peer_row "exrenvmap $openexr, one sample per texel, half EXR" "${files[@]}" bilinear.exr
  peer=(exrenvmap -li -c -w 256 half.exr peer_openexr.exr)
  ours=("${plain[@]}" --size 256)
  peer_row "exrenvmap $openexr, 5×5 samples (its default), and \`auto\`, half EXR, to 6×256" "${files[@]}" area.exr
else
  missing+=('exrenvmap (openexr)')
fi

if [[ -n ${WELKIN_BENCH_CMFT:-} ]]; then
  faces=(cube:layers)
  convert source.exr source.hdr
  "$build/bench/reference" source.hdr bilinear.exr "$face" bilinear
  peer=("$WELKIN_BENCH_CMFT" --silent --input source.hdr --filter none --outputNum 1 --output0 cmft --output0params hdr,rgbe,hcross)
  ours=("$welkin" convert -j "$threads" source.hdr ours.hdr --to cube:hcross --size "$face" --filter bilinear)
  peer_row 'cmft, bilinear, .hdr' cmft.hdr cube:hcross ours.hdr cube:hcross bilinear.exr
else
  missing+=('cmft (WELKIN_BENCH_CMFT=its path)')
fi

if ((${#missing[@]})); then
  printf '\nNot here, so not compared: %s.\n' "$(printf '%s, ' "${missing[@]}" | sed 's/, $//')"
fi
rm -f ./*.tif ./*.exr ./*.hdr ./*.pto
