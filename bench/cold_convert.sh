#!/usr/bin/env bash
# A conversion of uncompressed files as a whole process, beside what it cannot do without: the texels' look-up and
# the bytes read and written.
#
# cold_convert.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail

build=$1 work=$2
welkin=$build/welkin rounds=7 width=8192 face=2048

# median FILE COLUMN: of the rounds but the first.
median() {
  tail -n +2 "$1" | awk -v column="$2" '{ print $column }' | sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'
}

# row NAME LAYOUT EXTENSION OPTION…: all three in turn, ROUNDS times.
row() {
  local name=$1 layout=$2 out=$work/cold.$3 round bytes
  shift 3
  rm -f "$work"/cold.*.txt
  for ((round = 0; round < rounds; ++round)); do
    "$build/bench/process_cost" 1 "$welkin" convert -j "${WELKIN_BENCH_THREADS:-2}" "$work/cold_in.pfm" "$out" \
      --to "$layout" --size "$face" --filter bilinear "$@" >>"$work/cold.convert.txt"
    bytes=$(stat -c %s "$out")
    rm "$out"
    "$build/bench/resample_speed" gather "$width" "$face" >>"$work/cold.gather.txt"
    "$build/bench/process_cost" 1 "$build/bench/plain_copy" "$work/cold_in.pfm" "$out" "$bytes" >>"$work/cold.copy.txt"
    rm "$out"
  done
  awk -v name="$name" -v bytes="$bytes" -v cpu="$(median "$work/cold.convert.txt" 1)" -v wall="$(median "$work/cold.convert.txt" 2)" \
    -v peak="$(median "$work/cold.convert.txt" 3)" -v faults="$(median "$work/cold.convert.txt" 4)" \
    -v gather="$(median "$work/cold.gather.txt" 1)" -v copy="$(median "$work/cold.copy.txt" 1)" 'BEGIN {
      target = 1.5 * gather + copy
      printf "| %s | %.0f | %.2f s | %.2f s | %d | %.0f MB | %.2f s | %.2f s | %.2f | %s |\n", name, bytes * 1e-6, cpu, wall, faults,
        peak, gather, copy, cpu / target, cpu <= target ? "yes" : "**no**" }'
}

cat <<TEXT

## From file to file, uncompressed

\`welkin convert\` of an RGB float PFM of ${width}×$((width / 2)), which lies in the page cache, to a cube of 6×${face}, bilinear, as a
whole process. *Gather* is the floor of the look-up (above), in warm memory; *copy* is a process that reads the input and writes as many
bytes as the output has, with read() and write(). The target is 1.5 × the gather + the copy. Medians of $((rounds - 1)) rounds of the three.

| to | MB | CPU | wall | page faults | peak memory | gather, CPU | copy, CPU | CPU / target | met |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
TEXT
"$welkin" synth room "$work/cold_in.pfm" --size "$width" --samples 1
row 'EXR, a cross' cube:hcross exr --compression none
row 'EXR, parts' cube:layers exr --compression none
row 'PFM, a strip' cube:vstrip pfm
rm -f "$work"/cold.* "$work/cold_in.pfm"
