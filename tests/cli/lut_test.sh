#!/usr/bin/env bash
# `lut`: tables for renderers; known integrals and reflectances; formats; what makes no table.
#
# lut_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# texel FILE X Y: the values of a PFM's texel, top left first.
texel() {
  local kind width height bytes
  { read -r kind && read -r width height; } <"$1"
  bytes=$([[ $kind == PF ]] && echo 12 || echo 4)
  tail -c $((width * height * bytes)) -- "$1" |
    od -A n -v -t f4 "-w$bytes" -j $((((height - 1 - $3) * width + $2) * bytes)) -N "$bytes"
}

# Closed forms: α = 1 seen from above reflects 1 − ln 2; a mirror (1 − n·v)⁵ by Fresnel's weight.
must lut ends.pfm --channels one,bias,scale --size 3 --texels ends
near "E of roughness 1 from above" "$(texel ends.pfm 2 2 | awk '{ print $1 }')" "$(awk 'BEGIN { print 1 - log(2) }')" 2e-6
near "a mirror at 60°" "$(texel ends.pfm 1 0)" "1 0.03125 0.96875" 1e-6
must lut down.pfm --channels one,bias,scale --size 3 --texels ends --cosine-down
near "the axes turned" "$(texel down.pfm 2 1)" "$(texel ends.pfm 1 2)" 1e-7
must lut root.pfm --channels one,bias,scale --size 3 --texels ends --cosine root --roughness alpha
near "√n·v and α" "$(texel root.pfm 1 0)" "1 $(awk 'BEGIN { print 0.75 ^ 5, 1 - 0.75 ^ 5 }')" 1e-6

# Fresnel: figure 8's indices facing, and gold.
for pair in "1.5 0.04" "5 0.4444444" "200 0.9801985"; do
  must lut fresnel.pfm --kind fresnel --eta "${pair% *}" --size 64
  near "glass of ${pair% *}" "$(texel fresnel.pfm 63 0 | awk '{ print $1 }')" "${pair#* }" 1e-6
  near "grazing ${pair% *}" "$(texel fresnel.pfm 0 0 | awk '{ print $1 }')" 1 1e-7
done
must lut gold.pfm --kind fresnel --n 0.14 --k 3.697 --size 16
near gold "$(texel gold.pfm 15 0 | awk '{ print $1 }')" 0.96258 1e-4
must lut water.pfm --kind fresnel --ior 0.75 --size 16
near "total reflection" "$(texel water.pfm 9 0 | awk '{ print $1 }')" 1 1e-7
must lut average.pfm --kind average --size 5
near "mean albedo of a mirror" "$(texel average.pfm 0 0 | awk '{ print $1 }')" 1 1e-7

# Every renderer's table, in every kind of file; two channels stay two in KTX2.
for engine in $("$welkin" list luts | cut -d ' ' -f 1); do
  must lut engine.ktx2 --for "$engine" --size 8
  must lut engine.exr --for "$engine" --size 8x4
done
must lut bevy.ktx2 --for bevy
checks=$((checks + 1))
[[ $(od -A n -t u4 -j 12 -N 4 bevy.ktx2 | tr -d ' ') == 83 ]] || fail "Bevy's table is not of VK_FORMAT_R16G16_SFLOAT"
matches '"R",$' info bevy.ktx2 --header --json
must lut float.ktx2 --for bevy --type float
checks=$((checks + 1))
[[ $(od -A n -t u4 -j 12 -N 4 float.ktx2 | tr -d ' ') == 103 ]] || fail "float is not VK_FORMAT_R32G32_SFLOAT"
checks=$((checks + 1))
"$welkin" lut - --format exr --size 8 >piped.exr 2>"$work/messages" && "$welkin" lut same.exr --size 8 >/dev/null && cmp -s piped.exr same.exr ||
  fail "a table on standard output is another: $(head -n 3 "$work/messages")"

# What rounding costs is told, and is no more than half a step.
for type in uint8 uint16; do
  must lut table.png --size 16 --type $type --json
  steps=$([[ $type == uint8 ]] && echo 255 || echo 65535)
  near "error of $type" "$(number rounding_error <"$work/out")" "$(awk -v n=$steps 'BEGIN { print 0.25 / n }')" "$(awk -v n=$steps 'BEGIN { print 0.26 / n }')"
done
must lut table.exr --size 16 --type float --json
near "error of float" "$(number rounding_error <"$work/out")" 0 0
matches 'values lie outside what uint16 holds, and are clipped' lut cloth.png --channels cloth --size 16

# C: what a compiler reads is the same table.
must lut my-table.h --size 4 --multiscatter
checks=$((checks + 1))
grep -q '^static const float my_table\[32\] = {$' my-table.h || fail "my-table.h doesn't define my_table"

# What makes no table.
refuses 2 "did you mean 'filament'" lut out.ktx2 --for filamnt
refuses 2 "unknown channel 'sacle'; did you mean 'scale'" lut out.ktx2 --channels sacle
refuses 2 "unknown channel ''" lut out.ktx2 --channels one,
refuses 2 "unknown channel ''" lut out.ktx2 --channels ""
refuses 2 "one to four channels" lut out.ktx2 --channels one,one,one,one,one
refuses 2 "give one of them" lut out.ktx2 --channels one --multiscatter
refuses 2 "masking 'smith'" lut out.ktx2 --masking smith
refuses 2 "size" lut out.ktx2 --size 0
refuses 2 "1 to 4096 texels" lut out.ktx2 --size 100000
refuses 2 "is one row" lut out.ktx2 --kind fresnel --size 16x16
refuses 2 "--for: says nothing of a table of kind fresnel" lut out.ktx2 --kind fresnel --for bevy
refuses 2 "--k: says nothing of a table of kind dfg" lut out.ktx2 --k 3
refuses 2 "not both" lut out.ktx2 --kind fresnel --eta 1.5 --n 2
for bad in 0 -1 1e30; do refuses 2 "the index's n is" lut out.ktx2 --kind fresnel --eta $bad; done
refuses 2 "the index's k is -1" lut out.ktx2 --kind fresnel --n 1 --k -1
refuses 2 "not a number" lut out.ktx2 --kind fresnel --eta nan
refuses 2 "kind" lut out.ktx2 --kind lambert
refuses 2 "holds no half" lut out.png --type half
refuses 2 "C header holds float" lut out.h --type half
refuses 2 "out.bmp" lut out.bmp
refuses 2 "OUT" lut
refuses 1 "No such file" lut missing/out.ktx2
refuses 1 "No such file" lut missing/out.h

finish
