#!/usr/bin/env bash
# bake --brdf: stacks of angles of view and tables of lobes, what they hold, and what is refused.
#
# bake_views_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# has PATTERN: the output has a line that matches.
has() {
  checks=$((checks + 1))
  grep -qE -- "$1" "$work/out" || fail "no line matches '$1': $(head -n 5 -- "$work/out")"
}

must synth sky sky.hdr --size 128
must synth constant one.exr --size 64

# ---- a stack: layers of a cube array, a constant map unchanged in each
must bake one.exr one.ktx2 --brdf ggx --views 3 --size 16
has '^one.ktx2: ggx from 3 angles, axis fitted, 5 levels$'
for view in 0 1 2; do
  must sample one.ktx2 --part "$view" --dir 0.3,0.2,-0.9 --level 2.5
  checks=$((checks + 1))
  awk '{ for (i = 1; i <= NF; ++i) if ($i < 0.9999 || $i > 1.0001) exit 1 }' "$work/out" || fail "view $view is $(cat -- "$work/out")"
done
must info one.ktx2 --json
has '"layers": 3'
must bake sky.hdr reflected.ktx2 --brdf ward --views 4 --size 16 --levels 3 --axis reflected --json
has '"axis": "reflected"'
has '"brdf": "ward"'
checks=$((checks + 1))
lifts=$(sed -n '/"lift"/,/"albedo"/p' "$work/out" | grep -oE '[0-9.]+' | sort -u | tr '\n' ' ')
[[ $lifts == '0.0 ' ]] || fail "about the reflected direction nothing is lifted: $lifts"

# ---- one roughness: EXR, a part for each angle
must bake sky.hdr rough.exr --brdf ggx,roughness=0.5 --views 2 --to latlong --size 32
must info rough.exr
has 'latlong'
must sample rough.exr --part 1 --dir 0,1,0

# ---- lobes to add: an ordinary chain
must bake sky.hdr sums.ktx2 --brdf ggx --lobes 2 --views 3 --size 16 --levels 3
must info --header sums.ktx2
has 'welkin.lobes-weight'
must bake sky.hdr chain.ktx2 --size 16 --levels 3
must diff sums.ktx2 chain.ktx2 --fail-above 0

# ---- a table, complete and with a gap
for light in 0 45 90; do for view in 0 45 90; do for between in 0 90 180; do
  echo "$light,$view,$between,0.2"
done; done; done >table.csv
must bake sky.hdr table.ktx2 --brdf table,file=table.csv --views 2 --size 16
has '1 level$'
sed -i 5d table.csv
refuses 2 'table.csv: has a gap: no value for θi 0°, θr 45°, Δφ 90°' bake sky.hdr no.ktx2 --brdf table,file=table.csv
printf '0,0,0,5\n' >bright.csv
checks=$((checks + 1))
run bake sky.hdr bright.ktx2 --brdf table,file=bright.csv --views 1 --size 4
{ ((status == 0)) && grep -q 'reflects 1570.8 % of the light' "$work/messages"; } || fail "energy: $(cat -- "$work/messages")"
printf '0,0,0,-1\n' >negative.csv
refuses 2 'line 1: the value -1 is negative' bake sky.hdr no.ktx2 --brdf table,file=negative.csv
head -c 1000 /dev/zero >merl.binary
refuses 2 'is not of the MERL database' bake sky.hdr no.ktx2 --brdf merl,file=merl.binary
printf '\132\0\0\0\132\0\0\0\264\0\0\0short' >merl.binary
refuses 2 'ends early: 17 bytes' bake sky.hdr no.ktx2 --brdf merl,file=merl.binary

# ---- bad requests
refuses 2 "did you mean 'ggx'" bake sky.hdr no.ktx2 --brdf gxx
refuses 2 'is not a number in 0…1' bake sky.hdr no.ktx2 --brdf ggx,roughness=3
refuses 2 'is a mirror' bake sky.hdr no.ktx2 --brdf ggx,roughness=0
refuses 2 'name it with --brdf' bake sky.hdr no.ktx2 --views 4
refuses 2 'name it with --brdf' bake sky.hdr no.ktx2 --lobes 4
refuses 2 '--views' bake sky.hdr no.ktx2 --brdf ggx --views 0
refuses 2 'says what to filter with' bake sky.hdr no.ktx2 --brdf ggx --lobe phong
refuses 2 'from a chain' bake sky.hdr no.ktx2 --brdf ggx --lobes 3 --lobe lambert
refuses 2 'each has its own' bake sky.hdr no.ktx2 --brdf ggx --lobes 3 --axis reflected
refuses 2 'goes into a KTX2' bake sky.hdr no.exr --brdf ggx
refuses 2 'holds one picture' bake sky.hdr no.png --brdf ggx,roughness=0.5
refuses 2 'compares with a lobe' bake sky.hdr no.ktx2 --brdf ggx --verify
refuses 2 'averages' bake sky.hdr no.ktx2 --brdf ggx --normalisation integral

finish
