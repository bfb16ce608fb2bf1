#!/usr/bin/env bash
# `render`: what surfaces show of their world, cameras, worlds of objects' own, and what it refuses.
#
# render_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes card.exr --size 256 --samples 2
must synth constant grey.exr --size 64

# A mirror ball seen along +Z shows what is behind the camera in its middle: −Z; above the middle what is above.
must render sphere ball.pfm --env card.exr --shading mirror --size 65x65 --samples 1 --position 0,0,-4 --look 0 --fov 40 --material color=1
pixel() { must info "$1"; }
middle=$(python3 - <<'P' 2>/dev/null || true
P
)
must view ball.pfm middle.pfm --camera perspective --fov 2 --size 4x4 --from perspective,fov=40

# The picture's alpha is what the scene covers, and a format without alpha says so.
must render sphere alpha.exr --shading normals --size 32x32 --no-background
tells_text "no alpha" render sphere alpha.jpg --shading normals --size 32x32 --no-background

# Every shading makes a picture.
for shading in material mirror glossy refraction diffuse globe phong stack warped chrome matcap window cool-warm outline hatching normals; do
  extra=()
  [[ $shading == matcap ]] && extra=(--picture ball.pfm)
  must render torus "$shading.exr" --env card.exr --shading "$shading" --size 24x16 --samples 1 --triangles 500 "${extra[@]}"
done

# One radiance from everywhere stays what it is.
for shading in mirror glossy refraction diffuse globe phong; do
  must render teapot "$shading.exr" --env grey.exr --shading "$shading" --size 24x16 --samples 1 --material color=1
  must diff "$shading.exr" "$shading.exr"
done

# Requests that make no sense: status 2, and the remedy.
refuses 2 "did you mean 'teapot'" render teapto out.png --env card.exr
refuses 2 "did you mean 'mirror'" render sphere out.png --env card.exr --shading miror
refuses 2 "a map of the world is needed" render sphere out.png --shading mirror
refuses 2 "is not x,y,z" render sphere out.png --env card.exr --position 1,2
refuses 2 "unknown camera" render sphere out.png --env card.exr --camera 7
refuses 2 "is not NAME=VALUE" render sphere out.png --env card.exr --material red
refuses 2 "unknown property" render sphere out.png --env card.exr --material rouhgness=1
refuses 2 "outside 0" render sphere out.png --env card.exr --material roughness=2
refuses 2 "unknown object or material" render sphere out.png --env card.exr --own nobody=card.exr
refuses 2 "is not sphere:RADIUS" render sphere out.png --env card.exr --proxy cylinder:3
refuses 1 "" render sphere out.png --env missing.exr
refuses 1 "" render missing.gltf out.png --env card.exr

# A roughness map's levels are as rough as the bumps that they lose.
must roughness ball.pfm 0.4 rough.ktx2 --levels 4
finish
