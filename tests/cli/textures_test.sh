#!/usr/bin/env bash
# Textures: DDS, KTX 1, BC6H in all that hold it, and UASTC HDR. Chains and cubes come back; what can't be said or stored is refused.
#
# textures_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# error A B [OPTION…]: relative RMSE.
error() { "$welkin" diff "$@" --json | number relative_rmse; }
# below NAME VALUE LIMIT
below() {
  checks=$((checks + 1))
  awk -v value="$2" -v limit="$3" 'BEGIN { exit !(value <= limit) }' || fail "$1: $2 is above $3"
}

must synth room room.exr --size 256
must bake room.exr chain.ktx2 --size 32
for name in chain.dds chain.ktx; do
  must bake room.exr $name --size 32
  for level in 0 2 5; do below "$name, level $level" "$(error chain.ktx2 $name --level $level)" 0; done
  must bake room.exr half.$name --size 32 --format rgba16f
  below "half $name" "$(error chain.ktx2 half.$name)" 1e-3
  for format in rgb9e5 r11g11b10; do
    must bake room.exr $format.$name --size 32 --format $format
    below "$format $name" "$(error chain.ktx2 $format.$name)" 0.02
  done
done
# The metadata of KTX are those of KTX2; DDS has none.
matches '^  welkin.lobe +ggx$' info chain.ktx --header
matches '^  parameterization +cube:layers \(a cube texture\)' info chain.dds --header
matches 'Direct3D 9' info half.chain.dds --header

# Compressed: more search is never worse, and all containers hold the same blocks.
for quality in fast normal best; do must bake room.exr $quality.ktx2 --size 32 --format bc6h --quality $quality; done
below "fast" "$(error chain.ktx2 fast.ktx2)" 0.08
below "best against fast" "$(error chain.ktx2 best.ktx2)" "$(error chain.ktx2 fast.ktx2 | awk '{ print $1 * 1.02 }')"
for name in blocks.dds blocks.ktx zstd.ktx2; do
  [[ $name == zstd.ktx2 ]] && more=(--compression zstd) || more=()
  must bake room.exr $name --size 32 --format bc6h "${more[@]}"
  below "$name" "$(error normal.ktx2 $name)" 0
  below "$name, level 4" "$(error normal.ktx2 $name --level 4)" 0
done
matches 'R G B of bc6h' info blocks.dds --header
must convert room.exr odd.ktx2 --type bc6h --size 37x19
must info odd.ktx2

# OpenImageIO decodes the same texels, of pictures and of cubes, whose faces it puts one under the other. Of DDS it reads BC6H alone among
# all that is HDR.
must convert room.exr flat.dds --type bc6h
must convert room.exr cube.dds --to cube --size 32 --type bc6h
checks=$((checks + 1))
oiiotool flat.dds -o flat.exr && oiiotool cube.dds --fullsize 32x192+0+0 -o strip.exr || fail 'oiiotool cannot read our DDS'
below 'OpenImageIO and a picture' "$(error flat.dds flat.exr)" 0
faces=px:mirror,nx:mirror,py:mirror,ny:mirror,pz:mirror,nz:mirror
must convert strip.exr faces.ktx2 --from cube:vstrip --from-faces "$faces" --to cube
below 'OpenImageIO and a cube' "$(error cube.dds faces.ktx2)" 0

# What storing lost is told, and is what diff finds.
matches '^level 5 as it is stored: rel. RMSE ' bake room.exr told.dds --size 32 --format bc6h
must bake room.exr told.ktx2 --size 32 --format bc6h --json
below 'the error told' "$(jq '.levels[0].stored.relative_rmse' "$work/out")" "$(error chain.ktx2 told.ktx2 | awk '{ print $1 * 1.2 }')"
below 'the error found' "$(error chain.ktx2 told.ktx2)" "$(jq '.levels[0].stored.relative_rmse * 1.2' "$work/out")"

# UASTC HDR: packed unless that is declined, in KTX2 alone; blocks don't depend on it, nor much on the search.
for quality in fast normal best; do must bake room.exr uastc-$quality.ktx2 --size 32 --format uastc-hdr --quality $quality; done
matches 'R G B of uastc-hdr' info uastc-normal.ktx2 --header
matches 'zstd' info uastc-normal.ktx2 --header
below "uastc fast" "$(error chain.ktx2 uastc-fast.ktx2)" 0.1
below "uastc best against fast" "$(error chain.ktx2 uastc-best.ktx2)" "$(error chain.ktx2 uastc-fast.ktx2 | awk '{ print $1 * 1.1 }')"
must bake room.exr uastc-plain.ktx2 --size 32 --format uastc-hdr --compression none
for level in 0 4; do below "uastc, level $level" "$(error uastc-normal.ktx2 uastc-plain.ktx2 --level $level)" 0; done
must convert room.exr odd-uastc.ktx2 --type uastc-hdr --size 37x19
below "uastc of odd sizes" "$(error odd.ktx2 odd-uastc.ktx2)" 0.1
refuses 1 'DDS holds no uastc-hdr pixels' convert room.exr a.dds --type uastc-hdr
refuses 1 'KTX2 holds no astc-hdr pixels' convert room.exr a.ktx2 --type astc-hdr

# Values that BC6H can't hold are clipped and counted.
must synth sun sun.exr --size 256 --intensity 1e7
run convert sun.exr sun.dds --type bc6h
checks=$((checks + 1))
{ ((status == 0)) && grep -q 'above what the file can hold' "$work/messages"; } || fail "clipping is not told: $(cat "$work/messages")"

refuses 2 "--quality: 'silly' is neither" convert room.exr a.ktx2 --type bc6h --quality silly
refuses 2 "--quality: '101' is neither" convert room.exr a.jpg --quality 101
refuses 1 'DDS holds no uint8 pixels' convert room.exr a.dds --type uint8
refuses 1 'EXR has no pixel type bc6h' convert room.exr a.exr --type bc6h
head -c 5000 blocks.dds >cut.dds
refuses 1 'cut.dds: ends early \(byte 5000\)' info cut.dds
head -c 5000 chain.ktx >cut.ktx
refuses 1 'cut.ktx: ends early \(byte 5000\)' info cut.ktx
finish
