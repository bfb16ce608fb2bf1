#!/usr/bin/env bash
# `sample`: directions of any length, several at once or on standard input; levels; filters.
#
# sample_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes card.exr --size 256 --samples 2
near "a long direction" "$(sample_along card.exr 0,1e30,0)" "${card_colour[0,1,0]}" 2e-3
near "a short direction" "$(sample_along card.exr 0,-1e-30,0)" "${card_colour[0,-1,0]}" 2e-3
"$welkin" sample card.exr --dir "${axes[@]}" >together
printf '%s\n' "${axes[@]}" | tr ',' ' ' | "$welkin" sample card.exr >lines
printf '\r\n%s\r\n\n' "1 0 0" | "$welkin" sample card.exr >dos
checks=$((checks + 2))
cmp -s together lines || fail "standard input and --dir differ"
cmp -s <(head -n 1 together) dos || fail "empty lines or carriage returns count"
near "the mean is the last level" "$(sample_along card.exr 0,0,1 --level 8)" \
  "$("$welkin" info card.exr --json | grep -oE '"mean": [^,]+' | head -n 3 | sed 's/.*: //' | tr '\n' ' ')" 1e-3
must synth zoneplate smooth.exr --frequency 1 --size 256
for filter in nearest bilinear bicubic lanczos auto; do
  near "sample --filter $filter" "$(sample_along smooth.exr 0.3,0.2,0.5 --filter $filter)" "$(sample_along smooth.exr 0.3,0.2,0.5)" 0.02
done

finish
