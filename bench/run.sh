#!/usr/bin/env bash
# Runs the benchmarks and prints their tables as Markdown; all of them together become docs/benchmarks.md.
#
# run.sh BUILD_FOLDER [WHAT…]
#   WHAT               resample_speed look_up view_speed motion_blur lookup_errors filter_quality round_trip every_parameterization read_speed texture_speed commands cold_convert
#                      peers prefilter_speed prefilter_quality prefilter_narrow view_lobe_errors view_stack_speed gaussian_look_up render_speed render_truth harmonics_speed light_speed importance_speed dfg_speed bc6h set_speed bake cold bake_peers frames assemble_speed probe_grid;
#                      some of these are only printed
#
#   WELKIN_BENCH_THREADS=N   threads (2)
#   WELKIN_BENCH_HDRI=FILE   a lat-long to measure round trips, files and pre-filtering on, instead of a built-in one
#   WELKIN_BENCH_CMFT=FILE   programs for the comparison with others: cmft,
#   WELKIN_BENCH_CMGEN=FILE  Filament's cmgen,
#   WELKIN_BENCH_IBL_SAMPLER=FILE   the command of Khronos' glTF-IBL-Sampler
set -euo pipefail

everything=(resample_speed look_up view_speed motion_blur lookup_errors filter_quality round_trip every_parameterization read_speed texture_speed commands cold_convert peers
  prefilter_speed prefilter_quality prefilter_narrow view_lobe_errors view_stack_speed gaussian_look_up render_speed render_truth harmonics_speed light_speed importance_speed dfg_speed bc6h set_speed bake cold bake_peers frames assemble_speed probe_grid)
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
build=$(cd -- "${1:?run.sh BUILD_FOLDER [WHAT…]}" && pwd)
shift
chosen=("$@")
((${#chosen[@]})) || chosen=("${everything[@]}")
for each in "${chosen[@]}"; do
  if [[ " ${everything[*]} " != *" $each "* ]]; then
    printf 'run.sh: no benchmark is called %s; there are: %s\n' "$each" "${everything[*]}" >&2
    exit 2
  fi
done

work=$build/bench/work
rm -rf "$work"
mkdir -p "$work"
trap 'rm -rf "$work"' EXIT

machine() {
  local model cores compiler
  model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | sort -u | head -n 1)
  cores=$(nproc)
  compiler=$("$(sed -n 's/^CMAKE_CXX_COMPILER:[^=]*=//p' "$build/CMakeCache.txt")" --version | head -n 1)
  printf 'Machine: %s, family %s model %s, %s cores, %s; %s, `%s` build, %s threads; load average before the run %s.\n' \
    "$model" "$(sed -n 's/^cpu family[^:]*: *//p' /proc/cpuinfo | head -n 1)" \
    "$(sed -n 's/^model[^:n]*: *//p' /proc/cpuinfo | head -n 1)" "$cores" \
    "$(awk '/MemTotal/ { printf "%.0f GB", $2 * 1024e-9 }' /proc/meminfo)" "$compiler" \
    "$(sed -n 's/^CMAKE_BUILD_TYPE:[^=]*=//p' "$build/CMakeCache.txt")" "${WELKIN_BENCH_THREADS:-2}" "$(cut -d' ' -f1 /proc/loadavg)"
}

run_one() {
  case $1 in
    commands | cold_convert | peers | bake | cold | bake_peers) bash "$here/$1.sh" "$build" "$work" ;;
    read_speed | texture_speed | frames) "$build/bench/$1" "$work" ;;
    *) "$build/bench/$1" ;;
  esac
}

run_chosen() {
  machine
  local each
  for each in "${chosen[@]}"; do run_one "$each"; done
}

if [[ ${chosen[*]} == "${everything[*]}" ]]; then
  run_chosen | tee "$work/tables.md"
  cat "$here/introduction.md" "$work/tables.md" >"$here/../docs/benchmarks.md"
  printf '\nWritten to docs/benchmarks.md.\n' >&2
else
  run_chosen
fi
