#!/usr/bin/env bash
# ./dev and .ci/run, as far as they go without building: help, lists of packages, what each command would run, wrong words. And the PATH
# that tests of scripts have (programs.sh): no program but those of packages is on it.
#
# dev_test.sh [PROGRAMS]     the folder that is the whole PATH, where there is one
set -euo pipefail
export LC_ALL=C

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
programs=${1:-}
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

checks=0 failures=0
fail() {
  printf 'dev_test.sh: %s\n' "$*"
  failures=$((failures + 1))
}
# ends STATUS COMMAND…: its output is in $work/out, its messages in $work/messages.
ends() {
  local wanted=$1 status=0
  shift
  checks=$((checks + 1))
  "$@" >"$work/out" 2>"$work/messages" </dev/null || status=$?
  ((status == wanted)) || fail "$*: status $status, not $wanted: $(tail -n 3 "$work/messages")"
}

ends 0 ./dev help
mapfile -t commands < <(sed -nE 's/^  ([a-z]+) .*/\1/p' "$work/out")
((${#commands[@]} > 8)) || fail "./dev help lists ${#commands[@]} commands"

# Every package is named as Debian names packages, once, and `./dev packages` installs what any command needs.
ends 0 ./dev packages --list
cp "$work/out" "$work/all"
for command in "${commands[@]}"; do
  ends 0 ./dev packages --list "$command"
  odd=$(grep -vxE '[a-z0-9][a-z0-9+.-]+' "$work/out" || true; sort "$work/out" | uniq -d; grep -vxFf "$work/all" "$work/out" || true)
  [[ -z $odd ]] || fail "packages --list $command: $odd"
done

# What each command would run is there, except what only other packages bring.
export WELKIN_DRY_RUN=1
for command in "${commands[@]}"; do
  ends 0 ./dev "$command"
  case $command in help | packages | docs | format) continue ;; esac
  grep -q '^+ cmake --build ' "$work/out" || fail "./dev $command builds nothing: $(cat "$work/out")"
  for program in $(awk '$1 == "+" && $2 !~ /\// && $2 != "sudo" { print $2 }' "$work/out" | sort -u); do
    command -v "$program" >/dev/null || fail "./dev $command runs $program, which is in no package that it installs"
  done
done
# More than nine groups are more than ctest's patterns may hold: it would run every test.
for command in sanitize tsan; do
  ends 0 ./dev "$command"
  groups=$(grep '^+ ctest ' "$work/out" | tr -cd '(' | wc -c)
  ((groups >= 1 && groups <= 9)) || fail "./dev $command: $groups groups in a pattern of ctest"
done
ends 0 .ci/run
grep -q '^+ ctest ' "$work/out" || fail ".ci/run runs no test: $(tail -n 3 "$work/out")"
unset WELKIN_DRY_RUN

ends 2 ./dev tset
grep -q 'did you mean test?' "$work/messages" || fail "./dev tset: $(cat "$work/messages")"
ends 2 ./dev packages --list fnord
ends 2 ./dev packages --lisp
ends 2 ./dev format --chekc

if [[ -n $programs ]]; then
  checks=$((checks + 1))
  [[ $PATH == "$programs" ]] || fail "PATH is $PATH, not $programs"
  # A program that is on the PATH, but in no package, isn't taken along.
  mkdir "$work/bin"
  printf '#!/bin/sh\n' >"$work/bin/stranger"
  chmod +x "$work/bin/stranger"
  PATH=$work/bin:$PATH ends 0 stranger
  PATH=$work/bin:$PATH ends 0 bash tests/programs.sh "$work/programs"
  PATH=$work/programs ends 127 bash -c 'stranger'
  grep -q 'stranger: command not found' "$work/messages" || fail "a program that is not there: $(cat "$work/messages")"
  for program in awk bash c++ cmake ctest doxygen ninja nm node npm pkg-config sed; do
    checks=$((checks + 1))
    [[ -x $work/programs/$program ]] || fail "programs.sh leaves out $program"
  done
fi

printf '%d checks, %d failures\n' "$checks" "$failures"
((failures == 0))
