#!/usr/bin/env bash
# `plot`: the known ratios of the texels' solid angles, and pictures.
#
# plot_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes card.exr --size 64
while read -r name ratio; do
  near "density of $name" "$("$welkin" plot density --of "$name" --json | number limit_ratio)" "$ratio" 1e-3
done <<END
cube $(awk 'BEGIN { print 3 * sqrt(3) }')
paraboloid 4
equal-area 1
octahedral-equal-area 1
healpix 1
END
checks=$((checks + 1))
[[ $("$welkin" plot density --of latlong --json | number limit_ratio) == null ]] || fail "a lat-long's density is bounded"
must plot density --json
checks=$((checks + 1))
[[ $(grep -c '"name"' "$work/out") == $("$welkin" list | wc -l) ]] || fail "plot density leaves some out"
must plot density picture.png --of eac --size 64
matches '"format": "png"' info picture.png --header --json
must plot mips card.exr mips.png
matches '"format": "png"' info mips.png --header --json

finish
