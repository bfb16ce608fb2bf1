#!/usr/bin/env bash
# Sets for engines: `bake IN FOLDER/` and `--for`. Files, manifest and page; what engines can't load; folders that hold something else.
#
# sets_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# equal NAME FOUND WANTED
equal() {
  checks=$((checks + 1))
  [[ $2 == "$3" ]] || fail "$1: $2, not $3"
}

must synth room room.exr --size 128
matches '^three.js +three.js r187: ' list engines

# Without an engine: the general set.
must bake room.exr out/ --size 32
equal 'the general set' "$(ls out | tr '\n' ' ')" 'dfg.ktx2 diffuse.ktx2 harmonics.json index.html manifest.json specular.ktx2 '
equal 'its command' "$(jq -r .command out/manifest.json)" 'welkin bake room.exr out/ --size 32'
equal 'its bytes' "$(jq -r '.files[] | [.file, .bytes] | @tsv' out/manifest.json | sort)" \
  "$(cd out && for f in dfg.ktx2 diffuse.ktx2 harmonics.json specular.ktx2; do printf '%s\t%s\n' "$f" "$(wc -c <"$f")"; done)"
matches '^  parameterization +cube:layers' info out/specular.ktx2 --header
matches 'bc6h' info out/specular.ktx2 --header
equal 'levels' "$(jq '.files[0].levels | length' out/manifest.json)" 6
equal 'formats' "$(jq -r '[.formats[].type] | sort | join(" ")' out/manifest.json)" 'bc6h half rgb9e5 uastc-hdr'
checks=$((checks + 1))
grep -q '<canvas' out/index.html && ! grep -qE '(src|href)="?(http|/)' out/index.html || fail 'the page needs other files'

# Again into the same folder; a smaller set tells what is left, and deletes nothing.
must bake room.exr out --size 16 --json
equal 'JSON' "$(jq -r '.files[0].levels[0].width' "$work/out")" 16
run bake room.exr out/ --for filament
checks=$((checks + 1))
{ ((status == 0)) && [[ -e out/dfg.ktx2 ]] && grep -q 'out/dfg.ktx2: is left of an earlier set' "$work/messages"; } ||
  fail "what is left is not told: $status $(cat "$work/messages")"
matches '^  welkin.roughness_curve +filament|filament' info out/environment_ibl.ktx --header

# A sun taken out, verification.
must synth sun wide.exr --size 256 --angle 8
run bake wide.exr sunny/ --size 16 --extract-sun --verify=4 --exposure 1
checks=$((checks + 1))
((status == 0)) || fail "--extract-sun: $(cat "$work/messages")"
grep -qE "^ +1 .* disc 7.98" "$work/out" || fail "a set doesn't tell its sun: $(head -n 2 "$work/out")"
equal 'the sun' "$(jq -r '.sun.direction | map(. * 1000 | round) | join(" ")' sunny/manifest.json)" \
  "$("$welkin" lights wide.exr --most 1 --json | jq -r '.lights[0].direction | map(. * 1000 | round) | join(" ")')"
equal 'verified levels' "$(jq '[.files[0].levels[].verification.random_texels] | length' sunny/manifest.json)" 5

# The chain's file is made to fit.
run bake room.exr small/ --size 64 --max-bytes 4000
checks=$((checks + 1))
{ ((status == 0)) && (($(wc -c <small/specular.ktx2) <= 4000)) && grep -q 'made with faces of' "$work/messages"; } ||
  fail "--max-bytes: $status $(cat "$work/messages")"
refuses 1 'faces can.t be smaller' bake room.exr tiny/ --max-bytes 10

# What an engine can't load.
refuses 2 '--for: .*filament' bake room.exr x/ --for filamint
refuses 2 '--for: Filament .* its shader reads five levels' bake room.exr x/ --for filament --levels 9
refuses 2 '--for: Filament .* takes half and float' bake room.exr x/ --for filament --type bc6h
refuses 2 '--for: Bevy .* texels of float: .* graphics cards' bake room.exr x/ --for bevy --format rgba32f
refuses 2 '--for: Godot .* filters a panorama itself' bake room.exr x/ --for godot --size 64
refuses 2 '--lobe: a set is made' bake room.exr x/ --lobe phong
refuses 2 '--max-bytes: is for a set' bake room.exr x.ktx2 --max-bytes 1000
refuses 2 "--convention: unknown convention 'nowhere'" bake room.exr x/ --convention nowhere

# Folders.
refuses 1 'no/such/: the folder can.t be made' bake room.exr no/such/
mkdir mine
echo mine >mine/index.html
refuses 1 'mine/index.html: is there already' bake room.exr mine/
refuses 1 'room.exr: is a file' bake room.exr room.exr --for bevy

# A full disk: nothing appears under its name.
if [[ -w /dev/shm ]] && command -v mount >/dev/null && mkdir full && mount -t tmpfs -o size=64k tmpfs full 2>/dev/null; then
  run bake room.exr full/set/
  checks=$((checks + 1))
  { ((status == 1)) && [[ ! -e full/set ]]; } || fail "a full disk: $status $(ls full full/set)"
  umount full
fi
finish
