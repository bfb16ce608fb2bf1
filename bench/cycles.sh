#!/usr/bin/env bash
# Balls by paths of light here and by Blender's Cycles, where `blender` is installed: root mean square difference.
#
# cycles.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail

build=$(cd -- "$1" && pwd) work=$2
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
cd -- "$work"
printf '\n## Paths of light, and Cycles\n\n'
if ! command -v blender >/dev/null; then
  printf 'Blender is not installed.\n'
  exit
fi
size=64 samples=${WELKIN_CYCLES_SAMPLES:-1024}
"$build/welkin" synth studio studio.exr --size 1024
"$build/welkin" convert studio.exr studio-blender.exr --to latlong --convention blender
printf '%s: a ball under `studio`, %s×%s pixels, %s paths each. Each program renders twice, with other random numbers: half the\n' \
  "$(blender --version | head -n 1)" "$size" "$size" "$samples"
printf 'variance between its two pictures is its noise; what remains of the difference when the noise of both is taken out is the last column.\n\n'
printf '| ball | rel. RMSE | noise of Cycles | noise of Welkin | the rest | ratio of the means |\n|---|---|---|---|---|---|\n'

# difference A B: relative RMSE, and the ratio of the means.
difference() {
  "$build/welkin" diff "$1" "$2" --from perspective,fov=29 --json >diff.json 2>diff.log
  awk -F'[:,]' '/"all"/ { all = 1 } all && /"relative_rmse"/ { e = $2 } all && /"mean_a"/ { a = $2 } all && /"mean_b"/ { print e, $2 / a; exit }' diff.json
}

# compare NAME CYCLES_MATERIAL WELKIN_MATERIAL
compare() {
  local name=$1 theirs=$2 ours=$3 seed between of_theirs of_ours
  for seed in 0 1; do
    blender -b --factory-startup -noaudio -P "$here/cycles.py" -- "$PWD/studio-blender.exr" "$PWD/theirs$seed.exr" "$theirs" "$size" "$samples" "$seed" \
      >blender.log 2>&1
    "$build/welkin" render sphere "ours$seed.exr" --env studio.exr --integrator path --paths "$samples" --seed "$seed" --no-background --size "${size}x$size" \
      --triangles 262144 --position 0,0,-4 --look 0 --fov 29 --material "$ours" 2>render.log
  done
  between=$(difference theirs0.exr ours0.exr) of_theirs=$(difference theirs0.exr theirs1.exr) of_ours=$(difference ours0.exr ours1.exr)
  awk -v name="$name" -v between="$between" -v theirs="$of_theirs" -v ours="$of_ours" 'BEGIN {
    split(between, b, " "); t = theirs / sqrt(2); o = ours / sqrt(2); rest = b[1]^2 - t^2 - o^2
    printf "| %s | %.2f %% | %.2f %% | %.2f %% | %.2f %% | %.4f |\n", name, 100 * b[1], 100 * t, 100 * o, 100 * sqrt(rest > 0 ? rest : 0), b[2] }'
}

compare diffuse diffuse metallic=0,ior=1,color=0.8
compare mirror mirror metallic=1,roughness=0,color=1
compare "metal, roughness 0.25" metal:0.25 metallic=1,roughness=0.25,color=1
compare "metal, roughness 0.5" metal:0.5 metallic=1,roughness=0.5,color=1
compare glass glass metallic=0,transmission=1,roughness=0,ior=1.5,color=1
