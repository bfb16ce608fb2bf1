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

# Look-ups over cones: a tile for each filter that the map takes, or those that are asked for.
must plot cones card.exr cones.png --size 32
matches '"width": 158' info cones.png --header --json
must plot cones card.exr two.png --size 32 --filter hybrid --filter probes --to fisheye-equidistant
matches '"width": 120' info two.png --header --json
refuses 2 "did you mean 'hybrid'" plot cones card.exr out.png --filter hybird
refuses 2 "has several charts" plot cones card.exr out.png --to cube
refuses 1 "mirrored cell is for octahedral" plot cones card.exr out.png --filter mirrored
refuses 1 "No such file" plot cones missing.exr out.png

# Lobes: closed forms (docs/lobes.md).
lobe_number() { "$welkin" plot lobe --lobe "$1" --json | number "$2"; }
near "integral of lambert" "$(lobe_number lambert integral)" 3.14159265 1e-7
near "integral of a cosine power" "$(lobe_number phong,exponent=49 integral)" 0.12566371 1e-7
near "roughness of phong" "$(lobe_number phong,roughness=0.02 integral)" "$(lobe_number phong,exponent=50 integral)" 1e-12
near "half of lambert's energy" "$(lobe_number lambert degrees_holding_50_percent)" 45 1e-6
near "width of lambert" "$(lobe_number lambert width_degrees)" 60 1e-6
near "zonal coefficients of lambert" "$("$welkin" plot lobe --lobe lambert --json | grep -A 3 zonal | tr -dc '0-9.\n' | tr '\n' ' ')" \
  "1 0.6666666667 0.25" 1e-9
checks=$((checks + 1))
[[ $(lobe_number ggx,roughness=0 integral) == null ]] || fail "a mirror has an integral"
printf '0 1\n30 1 # a cone\n30.000001 0\n' >a,b.txt
near "integral of a cone" "$(lobe_number table,file=a,b.txt integral)" "$(awk 'BEGIN { print 8 * atan2(1, 1) * (1 - sqrt(0.75)) }')" 1e-5
must plot lobe
checks=$((checks + 1))
[[ $(wc -l <"$work/out") == $(($("$welkin" list lobes | wc -l))) ]] || fail "plot lobe leaves some out"
must plot lobe lobes.png --size 300 --axis log --lobe ggx --lobe table,file=a,b.txt --lobe ggx,roughness=0
matches '"format": "png"' info lobes.png --header --json
refuses 2 "did you mean 'ggx'" plot lobe --lobe gxg
refuses 2 "roughness=2 is not a number in 0…1" plot lobe --lobe ggx,roughness=2
refuses 2 "a,c.txt: cannot be opened" plot lobe --lobe table,file=a,c.txt
printf '0 1\n-1 2\n' >wrong.txt
refuses 2 "wrong.txt: line 2: the angle -1° is not in 0…180°" plot lobe --lobe table,file=wrong.txt
refuses 2 angle plot lobe --angle 0
refuses 2 axis plot lobe --axis cubic

# Reflectances: closed forms at 0°, and the pictures.
near "f0 of glass" "$("$welkin" plot fresnel --eta 1.5 --json | number f0)" 0.04 1e-12
near "f0 of a metal" "$("$welkin" plot fresnel --eta 0.5,2 --json | number f0)" "$(awk 'BEGIN { print (0.25 + 4) / (2.25 + 4) }')" 1e-5
must plot fresnel fresnel.png --size 300
matches '"format": "png"' info fresnel.png --header --json
refuses 2 "the index's n is 0" plot fresnel --eta 0
refuses 2 "is not N or N,K" plot fresnel --eta 1,2,3
refuses 2 "is not a number" plot fresnel --eta glass

finish
