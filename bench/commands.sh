#!/usr/bin/env bash
# What the command costs as a whole: starting, and one large conversion.
#
# commands.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail

build=$1 work=$2
welkin=$build/welkin
cost() { "$build/bench/process_cost" "$@"; }

# met VALUE LIMIT: `yes` when VALUE ≤ LIMIT.
met() { awk -v value="$1" -v limit="$2" 'BEGIN { print value <= limit ? "yes" : "**no**" }'; }

# start_row WORK ARGUMENT…: a row for a start of the command, in milliseconds.
start_row() {
  local name=$1 cpu wall peak
  shift
  read -r cpu wall peak _ < <(cost 20 "$welkin" "$@")
  awk -v name="$name" -v cpu="$cpu" -v wall="$wall" -v peak="$peak" -v met="$(met "$cpu" 0.015)" \
    'BEGIN { printf "| %s | %.1f ms | %.1f ms | %.0f MB | ≤ 15 ms CPU | %s |\n", name, 1e3 * cpu, 1e3 * wall, peak, met }'
}

# large_row WORK ARGUMENT…: a row for a conversion, which may take 3 GB.
large_row() {
  local name=$1 cpu wall peak
  shift
  read -r cpu wall peak _ < <(cost 3 "$welkin" convert -j "${WELKIN_BENCH_THREADS:-2}" "$@")
  awk -v name="$name" -v cpu="$cpu" -v wall="$wall" -v peak="$peak" -v met="$(met "$peak" 3000)" \
    'BEGIN { printf "| %s | %.2f s | %.2f s | %.0f MB | < 3000 MB | %s |\n", name, cpu, wall, peak, met }'
}

cat <<'TEXT'

## The command as a whole

Median of 20 runs of the process for `info`, of 3 for the conversions. The large map is a half-float EXR with ZIP compression; its six faces are
written as float EXR, ZIP compressed.

| work | CPU | wall | peak memory | target | met |
| --- | --- | --- | --- | --- | --- |
TEXT
"$welkin" synth studio "$work/small.hdr" --size 64x32
start_row '`welkin info --header small.hdr`, 64×32' info --header "$work/small.hdr"
start_row '`welkin info small.hdr`, 64×32' info "$work/small.hdr"
"$build/bench/make_picture" "$work/large.exr" 16384
large_row '`welkin convert`, 16384×8192 → cube 6×2048, auto' "$work/large.exr" "$work/cube.exr" --to cube:layers --size 2048
large_row 'the same, bilinear' "$work/large.exr" "$work/cube.exr" --to cube:layers --size 2048 --filter bilinear
rm -f "$work/large.exr" "$work/cube.exr" "$work/small.hdr"
