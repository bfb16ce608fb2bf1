#!/usr/bin/env bash
# `importance`: tables of every method and format, their header, what there is nothing to draw by.
#
# importance_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

has() { [[ -s $1 ]] || fail "$1 is missing"; }

must synth sky sky.exr --size 64x32
matches "sky.exr: latlong 64×32, tables of cdf" importance sky.exr tables.exr
has tables.exr; has tables_rows.exr; has tables.json
matches '"channels": \["cdf", "density"\]' importance sky.exr tables.exr --json
checks=$((checks + 2))
cmp -s "$work/out" tables.json || fail "--json prints another header than the file's"
# The last cumulative value of the rows is 1.
near "the last row" "$("$welkin" -q sample tables_rows.exr --from latlong --filter nearest --dir 0,-1,0)" 1 0
must convert sky.exr cube.exr --to cube --size 16
matches "cube 16×16, tables of alias" importance cube.exr cube_tables.ktx2 --method alias
has cube_tables.ktx2; has cube_tables.json
matches '"parameterization": "cube"' importance cube.exr cube_tables.ktx2 --method alias --json
[[ ! -e cube_tables_rows.ktx2 ]] || fail "an alias table has no table of rows"
matches "16 × 96|16×96" info cube_tables.ktx2 --from latlong
matches "compensated" importance sky.exr mis.exr --compensate --look-up bilinear

# Nothing to draw by, and what isn't light.
must convert sky.exr black.exr --exposure -400
run importance black.exr black_tables.exr
checks=$((checks + 1))
grep -q "there is no light: the tables are uniform" "$work/messages" || fail "a black map: $(cat "$work/messages")"
grep -q '"uniform": true' black_tables.json || fail "the header of a black map"
must synth constant grey.exr --size 16x8
run importance grey.exr grey_tables.exr --compensate
checks=$((checks + 1))
grep -q "nothing is brighter than the mean" "$work/messages" || fail "a grey map: $(cat "$work/messages")"
must convert sky.exr half.exr --to half-cube --size 16
run importance half.exr half_tables.exr
checks=$((checks + 1))
grep -q "shows 50.0 % of the sphere" "$work/messages" || fail "half a map: $(cat "$work/messages")"

{ printf 'PF\n2 1\n-1.0\n'; printf '\000\000\300\177%.0s' 1 2 3; printf '\000\000\200\077%.0s' 1 2 3; } >nan.pfm
refuses 1 "nan.pfm: .*1 texels have luminance that is NaN or infinite.*--sanitize" importance nan.pfm out.exr --from latlong
run importance nan.pfm out.exr --from latlong --sanitize
checks=$((checks + 1))
((status == 0)) || fail "a sanitized map: $(cat "$work/messages")"
{ printf 'PF\n2 1\n-1.0\n'; printf '\000\000\200\277%.0s' 1 2 3; printf '\000\000\200\077%.0s' 1 2 3; } >negative.pfm
run importance negative.pfm out.exr --from latlong
checks=$((checks + 1))
grep -q "1 texels have negative luminance" "$work/messages" || fail "a negative texel: $(cat "$work/messages")"

refuses 2 "unknown method 'alais'; did you mean 'alias'\?" importance sky.exr out.exr --method alais
refuses 2 "out.png: tables are written as .exr or .ktx2" importance sky.exr out.png
refuses 2 "out.exe: unknown extension" importance sky.exr out.exe
refuses 2 "--look-up: " importance sky.exr out.exr --look-up lanczos
refuses 1 "none.exr" importance none.exr out.exr
refuses 1 "no/out.exr" importance sky.exr no/out.exr
head -c 300 sky.exr >short.exr
refuses 1 "short.exr" importance short.exr out.exr

finish
