#!/usr/bin/env bash
# What is cold costs more: a whole process of `welkin bake`, and the first chain in a process, against the tenth.
#
# cold.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail

build=$(cd -- "$1" && pwd) work=$2
welkin=$build/welkin rounds=15
cd -- "$work"

median() { sort -g | awk '{ value[NR] = $1 } END { print NR % 2 ? value[(NR + 1) / 2] : (value[NR / 2] + value[NR / 2 + 1]) / 2 }'; }
# column N: the median of the N-th number of each line of measured.txt.
column() { awk -v n="$1" '{ print $n }' measured.txt | median; }
# row NAME VALUE TARGET LIMIT: a row, met when the value's number is at most LIMIT.
row() {
  awk -v name="$1" -v text="$2" -v value="$3" -v target="$4" -v limit="$5" \
    'BEGIN { printf "| %s | %s | %s | %s |\n", name, text, target, target == "" ? "" : value <= limit ? "yes" : "**no**" }'
}
times() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", a / b }'; }
milliseconds() { awk -v seconds="$1" 'BEGIN { printf "%.1f ms CPU", 1e3 * seconds }'; }

"$build/bench/make_picture" cold.pfm 1024
: >measured.txt
for ((i = 0; i < rounds; ++i)); do
  read -r cpu _ _ faults < <("$build/bench/process_cost" 1 "$welkin" bake cold.pfm cold.ktx2 --format rgba32f)
  read -r _ _ _ idle < <("$build/bench/process_cost" 1 "$welkin" --version)
  read -r first tenth first_faults tenth_faults < <("$build/bench/first_run" cold.pfm)
  printf '%s %s %s %s %s %s %s %s %s\n' "$cpu" "$faults" "$idle" "$first" "$tenth" "$first_faults" "$tenth_faults" \
    "$(times "$cpu" "$tenth")" "$(times "$first" "$tenth")" >>measured.txt
done

cat <<TEXT

## Pre-filtering: cold

\`welkin bake\` of a 1024×512 RGB PFM into KTX2 of \`rgba32f\`, a cube of 6×256 and 8 smaller levels, and the same chain in memory, planned and
filtered ten times in one process. Medians of $rounds processes, one after the other in turn; quotients are of the same round. Huge pages:
\`$(cat /sys/kernel/mm/transparent_hugepage/enabled 2>/dev/null || echo unknown)\`.

| cold | measured | target | met |
| --- | --- | --- | --- |
TEXT
row 'whole process, page faults' "$(column 2)" "$(column 2)" '≤ 4000' 4000
row 'of which `welkin --version` has too' "$(column 3)" 0 '' 0
row 'whole process' "$(milliseconds "$(column 1)")" 0 '' 0
row 'whole process / tenth chain' "$(column 8) ×" "$(column 8)" '≤ 3 ×' 3
row 'first chain' "$(milliseconds "$(column 4)")" 0 '' 0
row 'tenth chain' "$(milliseconds "$(column 5)")" 0 '' 0
row 'first chain / tenth' "$(column 9) ×" "$(column 9)" '≤ 1.5 ×' 1.5
row 'page faults, first chain' "$(column 6)" 0 '' 0
row 'page faults, tenth chain' "$(column 7)" 0 '' 0
rm -f cold.pfm cold.ktx2 measured.txt
