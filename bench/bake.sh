#!/usr/bin/env bash
# What `welkin bake` costs as a whole: reading, planning, filtering, writing.
#
# bake.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail

build=$(cd -- "$1" && pwd) work=$2
welkin=$build/welkin
threads=${WELKIN_BENCH_THREADS:-2}
cd -- "$work"

# met VALUE LIMIT: `yes` when VALUE ≤ LIMIT.
met() { awk -v value="$1" -v limit="$2" 'BEGIN { print value <= limit ? "yes" : "**no**" }'; }

# bake_row WORK RUNS JUDGED LIMIT TARGET ARGUMENT…: a row; JUDGED is cpu (seconds), peak (megabytes) or nothing.
bake_row() {
  local name=$1 runs=$2 judged=$3 limit=$4 target=$5 cpu wall peak reached=
  shift 5
  read -r cpu wall peak _ < <("$build/bench/process_cost" "$runs" "$welkin" bake "$@")
  if [[ -n $judged ]]; then reached=$(met "${!judged}" "$limit"); fi
  awk -v name="$name" -v cpu="$cpu" -v wall="$wall" -v peak="$peak" -v target="$target" -v met="$reached" \
    'BEGIN { printf "| %s | %.1f ms | %.1f ms | %.0f MB | %s | %s |\n", name, 1e3 * cpu, 1e3 * wall, peak, target, met }'
}

cat <<TEXT

## Pre-filtering: the command as a whole

\`welkin bake\`, the process from start to end: a cube of 6×256 and 8 smaller levels of GGX, written as KTX2 of \`rgba32f\`. Median of 15 runs, of 3
for the large maps, which are half-float EXR with ZIP compression. The input is in the page cache.

| input | CPU | wall | peak memory | target | met |
| --- | --- | --- | --- | --- | --- |
TEXT
"$build/bench/make_picture" small.pfm 1024
bake_row 'PFM, 1024×512, 1 thread' 15 cpu 0.080 '≤ 80 ms CPU' small.pfm small.ktx2 -j 1
if ((threads > 1)); then
  bake_row "the same, $threads threads" 15 cpu 0.080 '≤ 80 ms CPU' small.pfm small.ktx2 -j "$threads"
fi
for width in 4096 8192 16384; do
  "$build/bench/make_picture" large.exr "$width"
  judged=() name="EXR, ${width}×$((width / 2)), $threads threads"
  if ((width == 16384)); then judged=(peak 3000 '< 3000 MB'); else judged=('' '' ''); fi
  bake_row "$name" 3 "${judged[@]}" large.exr large.ktx2 -j "$threads"
done
rm -f small.* large.*
