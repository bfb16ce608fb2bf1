#!/usr/bin/env bash
# `synth`: every built-in map is radiance, and the same one every time.
#
# synth_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

for name in $("$welkin" list maps | awk '{ print $1 }'); do
  must synth "$name" made.exr --size 64 --samples 2
  must info made.exr --json
  checks=$((checks + 1))
  ! grep -qE '"(nan|infinite|negative)": [1-9]' "$work/out" || fail "synth $name has values that are no radiance"
done
must synth lamps lamps1.exr --size 64 --seed 1
must synth lamps lamps2.exr --size 64 --seed 1
must synth lamps lamps3.exr --size 64 --seed 2
checks=$((checks + 2))
cmp -s lamps1.exr lamps2.exr || fail "one seed makes two maps"
! cmp -s lamps1.exr lamps3.exr || fail "two seeds make one map"
must -j 1 synth sky one.pfm --size 64
must -j 2 synth sky two.pfm --size 64
checks=$((checks + 1))
cmp -s one.pfm two.pfm || fail "synth on two threads differs from one"

finish
