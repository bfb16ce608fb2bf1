# Shared by the end-to-end tests of the command line. Each test is `NAME_test.sh WELKIN`: it sources this file, which takes
# the path of the welkin binary and moves into a temporary folder, runs its checks, and ends with `finish`.
#
# A failed check prints what was run, what came of it and the line of the test, and the test goes on.
set -euo pipefail
export LC_ALL=C
unset WELKIN_INSTRUCTION_SET

(($# == 1)) && [[ -x $1 ]] || { printf 'usage: %s WELKIN\n' "$0" >&2; exit 2; }
welkin=$(realpath -- "$1")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
mkdir -- "$work/files"
cd -- "$work/files"

checks=0 failures=0

fail() {
  failures=$((failures + 1))
  local depth=0
  while [[ ${BASH_SOURCE[depth]} == */lib.sh ]]; do depth=$((depth + 1)); done
  printf '%s:%s: %s\n' "$(basename -- "${BASH_SOURCE[depth]}")" "${BASH_LINENO[depth - 1]}" "$*" | cut -c1-600 >&2
}

skip() { printf 'skipped: %s\n' "$*"; }

finish() {
  printf '%d checks, %d failures\n' "$checks" "$failures"
  ((checks > 0 && failures == 0)) || exit 1
}

# Runs welkin; its output is in $work/out, its messages in $work/messages, its status in $status.
run() {
  status=0
  timeout 60 "$welkin" "$@" >"$work/out" 2>"$work/messages" </dev/null || status=$?
}

# must ARGUMENT…: welkin does this, and has nothing to say about it.
must() {
  checks=$((checks + 1))
  run "$@"
  if ((status != 0)) || [[ -s $work/messages ]]; then
    fail "welkin $*: status $status: $(head -n 3 -- "$work/messages")"
  fi
}

# tells PATTERN ARGUMENT…: welkin does this, and a message matches the regular expression; tells_text: a message has this text.
tells() { tells_by -E "$@"; }
tells_text() { tells_by -F "$@"; }
tells_by() {
  local kind=$1 pattern=$2
  shift 2
  checks=$((checks + 1))
  run "$@"
  ((status == 0)) && grep -q "$kind" -- "$pattern" "$work/messages" || fail "welkin $*: status $status: $(head -n 3 -- "$work/messages")"
}

# refuses STATUS PATTERN ARGUMENT…: welkin ends with STATUS and one message, `welkin: …`, that matches the regular
# expression PATTERN; nothing is on standard output, and no file appears, disappears or changes.
refuses() {
  local wanted=$1 pattern=$2 before after
  shift 2
  checks=$((checks + 1))
  before=$(inventory)
  run "$@"
  after=$(inventory)
  ((status == wanted)) || fail "welkin $*: status $status, not $wanted: $(head -n 3 -- "$work/messages")"
  if [[ $(wc -l <"$work/messages") != 1 ]] || ! grep -qE -- "^welkin: .*$pattern" "$work/messages"; then
    fail "welkin $*: the message doesn't match '$pattern': $(head -n 3 -- "$work/messages")"
  fi
  [[ ! -s $work/out ]] || fail "welkin $*: prints a result though it fails: $(head -n 3 -- "$work/out")"
  [[ $before == "$after" ]] || fail "welkin $*: leaves or changes files: $(comm -3 <(echo "$before") <(echo "$after"))"
}

# Name, size and time of change of every file.
inventory() { find . -mindepth 1 -printf '%p %s %T@ %y\n' | sort; }

# matches PATTERN ARGUMENT…: welkin prints something that matches the regular expression.
matches() {
  local pattern=$1
  shift
  must "$@"
  grep -qE -- "$pattern" "$work/out" || fail "welkin $*: prints nothing that matches '$pattern': $(head -n 20 -- "$work/out")"
}

# same A B TOLERANCE [OPTION…]: the maps differ by a relative RMSE of at most TOLERANCE.
same() {
  local a=$1 b=$2 tolerance=$3
  shift 3
  must diff "$a" "$b" --fail-above "$tolerance" "$@"
}

# number KEY <JSON: the first value of that key, at any depth. Reads all: who writes to a closed pipe fails.
number() { { grep -oE "\"$1\": [^,]+" || true; } | sed -nE '1s/^[^:]*: //p'; }

# near WHAT FOUND WANTED TOLERANCE: two lists of numbers agree, each within TOLERANCE.
near() {
  checks=$((checks + 1))
  awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN {
    n = split(a, x, " "); m = split(b, y, " ")
    if (n == 0 || n != m) exit 1
    for (i = 1; i <= n; ++i) {
      if (x[i] !~ /^[-+]?[0-9]/) exit 1
      d = x[i] - y[i]; if (d < 0) d = -d
      if (!(d <= t)) exit 1
    } }' || fail "$1: $2, not $3 within $4"
}

# sample_along MAP DIRECTION [OPTION…]: the radiance, on one line.
sample_along() { "$welkin" sample "$1" --dir "${@:2}"; }

# The test card in the middle of each side (docs/conventions.md, Checking it), and those sides.
axes=(1,0,0 -1,0,0 0,1,0 0,-1,0 0,0,1 0,0,-1)
declare -A card_colour=(
  [1,0,0]="0.8070 0.1912 0.1470" [-1,0,0]="0.2542 0.0284 0.0284" [0,1,0]="0.3325 0.5520 0.1441"
  [0,-1,0]="0.0497 0.1329 0.0319" [0,0,1]="0.2122 0.4233 0.7231" [0,0,-1]="0.0252 0.0723 0.2232")

# centre_of_light FILE.pfm WIDTH HEIGHT: where the light of a picture is, texels from the top left.
centre_of_light() {
  tail -c $(($2 * $3 * 12)) -- "$1" | od -A n -v -t f4 -w12 | awk -v w="$2" -v h="$3" '
    { x = (NR - 1) % w + 0.5; y = h - int((NR - 1) / w) - 0.5; sum += $1; sx += $1 * x; sy += $1 * y }
    END { printf "%.2f %.2f\n", sx / sum, sy / sum }'
}
