#!/usr/bin/env bash
# The same pre-filtering by other programs, where these are named: see run.sh.
#
# bake_peers.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail

build=$(cd -- "$1" && pwd) work=$2
threads=${WELKIN_BENCH_THREADS:-2}
cd -- "$work"

cost() { "$build/bench/process_cost" 3 "$@"; }
bake() { ours=("$build/welkin" bake -j "$threads" source.hdr ours.ktx2 --size 256 "$@"); }

# worst: of lines `RMSE MAXIMUM`, the largest of each.
worst() { awk '{ if ($1 > a) a = $1; if ($2 > b) b = $2 } END { printf "%.3g / %.3g", a, b }'; }

# peer_row JOB PEER_ERRORS WELKIN_ERRORS: times $peer and $ours (arrays: the commands), then runs the commands
# that print errors, a line a level; a dash for none.
peer_row() {
  local job=$1 cpu wall peer_cpu peer_wall peer_error=— welkin_error=—
  read -r peer_cpu peer_wall _ < <(cost "${peer[@]}")
  read -r cpu wall _ < <(cost "${ours[@]}")
  if [[ $2 != - ]]; then peer_error=$("$2" | worst); fi
  if [[ $3 != - ]]; then welkin_error=$("$3" | worst); fi
  awk -v job="$job" -v a="$peer_cpu" -v b="$peer_wall" -v c="$cpu" -v d="$wall" -v e="$peer_error" -v f="$welkin_error" \
    'BEGIN { printf "| %s | %.2f | %.2f | %.3f | %.3f | %.0f | %.0f | %s | %s |\n", job, a, b, c, d, a / c, b / d, e, f }'
}

# Of the 9 levels that Welkin baked along the linear curve.
ggx_errors() {
  local level
  for level in {1..8}; do
    "$build/bench/level_errors" source.hdr "ggx,roughness=$(awk -v k="$level" 'BEGIN { print k / 8 }')" ours.ktx2 "$level"
  done
}

# -------------------------------------------------------------------------------------------------- cmft: Phong

# Exponent of cmft's level k of 7, with a scale of 10 and a bias of 1.
phong_levels=7
phong_exponent() { awk -v k="$1" 'BEGIN { printf "%.9g", 2 ^ (10 * (1 - k / 6) + 1) }'; }

cmft=("${WELKIN_BENCH_CMFT:-}" --silent --input source.hdr --filter radiance --srcFaceSize 256 --dstFaceSize 256 --excludeBase true
  --mipCount "$phong_levels" --glossScale 10 --glossBias 1 --lightingModel phong --edgeFixup none
  --numCpuProcessingThreads "$threads" --useOpenCL false --outputNum 1 --output0 cmft)

# Its +X is to the right of +Z, ours to the left.
cmft_errors() {
  local level pair
  "${cmft[@]}" --output0params hdr,rgbe,facelist >&2
  for ((level = 1; level < phong_levels; ++level)); do
    for pair in px:negx nx:posx py:posy ny:negy pz:posz nz:negz; do
      mv cmft_"${pair#*:}_${level}"_*.hdr "cmft_${pair%:*}.hdr"
    done
    "$build/bench/level_errors" source.hdr "phong,exponent=$(phong_exponent "$level")" cmft_%s.hdr 0 cube:faces
  done
  rm -f cmft_*
}

phong_errors() {
  local level
  for ((level = 1; level < phong_levels; ++level)); do
    "$build/bench/level_errors" source.hdr "phong,exponent=$(phong_exponent "$level")" ours.ktx2 "$level"
  done
}

# -------------------------------------------------------------------------------------------------------- table

cat <<TEXT

## Other programs: pre-filtering 1024×512 for a cube of 6×256

Whole processes, $threads threads where the program has them, median of 3 runs. Both programs read the same \`.hdr\` file and write as many
levels of the same lobes; Welkin's are KTX2 of \`rgba32f\`. *Faster* is the peer's time over Welkin's. Errors are as above, relative RMSE % / maximum %
of the worst level but the first, which is not filtered: cmft's against the lobe that it documents, and through its \`.hdr\` files, which round
to 0.4 %. Errors of the others are not given: where their texels lie and which roughness a level has are conventions of their own.

| job | peer, CPU s | wall s | Welkin, CPU s | wall s | faster, CPU | wall | peer, error | Welkin, error |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
TEXT

"$build/bench/make_picture" source.pfm 1024
"$build/welkin" convert source.pfm source.hdr
missing=()

if [[ -n ${WELKIN_BENCH_CMFT:-} ]]; then
  roughness=0
  for ((level = 1; level < phong_levels; ++level)); do
    roughness+=,$(awk -v exponent="$(phong_exponent "$level")" 'BEGIN { printf "%.9g", 1 / exponent }')
  done
  bake --lobe phong --levels "$phong_levels" --roughness "$roughness"
  peer=("${cmft[@]}" --output0params ktx,rgba32f,cubemap)
  peer_row 'cmft, Phong of exponents 645 … 2, 7 levels' cmft_errors phong_errors
else
  missing+=('cmft (WELKIN_BENCH_CMFT=its path)')
fi

if [[ -n ${WELKIN_BENCH_CMGEN:-} ]]; then
  bake --lobe ggx --levels 5 --roughness filament
  peer=("$WELKIN_BENCH_CMGEN" --quiet --size=256 --format=hdr --ibl-samples=1024 --ibl-ld=cmgen source.hdr)
  peer_row 'cmgen, GGX, 1024 samples, 5 levels' - -
else
  missing+=('cmgen (WELKIN_BENCH_CMGEN=its path)')
fi

if [[ -n ${WELKIN_BENCH_IBL_SAMPLER:-} ]]; then
  bake --lobe ggx --levels 9
  peer=("$WELKIN_BENCH_IBL_SAMPLER" -inputPath source.hdr -outCubeMap sampler.ktx2 -outLUT sampler.png -distribution GGX
    -sampleCount 1024 -mipLevelCount 9 -cubeMapResolution 256 -targetFormat R32G32B32A32_SFLOAT)
  peer_row 'glTF-IBL-Sampler, GGX, 1024 samples, 9 levels' - ggx_errors
else
  missing+=('glTF-IBL-Sampler (WELKIN_BENCH_IBL_SAMPLER=its path)')
fi

if ((${#missing[@]})); then
  printf '\nNot here, so not compared: %s.\n' "$(printf '%s, ' "${missing[@]}" | sed 's/, $//')"
fi
rm -rf source.* ours.ktx2 cmft* cmgen sampler.*
