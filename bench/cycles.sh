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
printf '%s: a ball under `studio`, %s×%s pixels, %s paths each.\n\n' "$(blender --version | head -n 1)" "$size" "$size" "$samples"
printf '| ball | rel. RMSE | ratio of the means |\n|---|---|---|\n'

# compare NAME CYCLES_MATERIAL WELKIN_MATERIAL
compare() {
  local name=$1 theirs=$2
  shift 2
  blender -b --factory-startup -noaudio -P "$here/cycles.py" -- "$PWD/studio-blender.exr" "$PWD/theirs.exr" "$theirs" "$size" "$samples" >blender.log 2>&1
  "$build/welkin" render sphere ours.exr --env studio.exr --integrator path --paths "$samples" --no-background --size "${size}x$size" \
    --triangles 262144 --position 0,0,-4 --look 0 --fov 29 --material "$1" 2>render.log
  "$build/welkin" diff theirs.exr ours.exr --from perspective,fov=29 --json >diff.json 2>diff.log
  awk -F'[:,]' -v name="$name" '/"all"/ { all = 1 } all && /"relative_rmse"/ { e = $2 } all && /"mean_a"/ { a = $2 } all && /"mean_b"/ { b = $2; exit }
    END { printf "| %s | %.2f %% | %.4f |\n", name, 100 * e, b / a }' diff.json
}

compare diffuse diffuse metallic=0,ior=1,color=0.8
compare mirror mirror metallic=1,roughness=0,color=1
compare "metal, roughness 0.25" metal:0.25 metallic=1,roughness=0.25,color=1
compare "metal, roughness 0.5" metal:0.5 metallic=1,roughness=0.5,color=1
compare glass glass metallic=0,transmission=1,roughness=0,ior=1.5,color=1
