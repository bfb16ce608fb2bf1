#!/usr/bin/env bash
# `render`: what surfaces show of their world, cameras, worlds of objects' own, and what it refuses.
#
# render_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes card.exr --size 256 --samples 2
must synth constant grey.exr --size 64

# A mirror ball seen along +Z shows in its middle what is behind the camera, −Z, and a diffuse one the light from there; the world is smooth.
must bake card.exr light.exr --lobe lambert
from_front=(--size 65x65 --samples 1 --position 0,0,-4 --look 0 --fov 40 --material color=1)
must render sphere ball.pfm --env light.exr --shading mirror "${from_front[@]}"
near "the middle of a mirror ball" "$(sample_along ball.pfm 0,0,1 --from perspective,fov=40)" "$(sample_along light.exr 0,0,-1)" 2e-3
must render sphere flat.pfm --env card.exr --shading diffuse "${from_front[@]}"
near "diffuse light along the normal" "$(sample_along flat.pfm 0,0,1 --from perspective,fov=40)" "$(sample_along light.exr 0,0,-1)" 2e-3

# The picture's alpha is what the scene covers, and a format without alpha says so.
must render sphere alpha.exr --shading normals --size 32x32 --no-background
tells_text "no alpha" render sphere alpha.jpg --shading normals --size 32x32 --no-background

# Every shading makes a picture.
for shading in material mirror glossy refraction diffuse globe phong stack warped chrome matcap window cool-warm outline hatching normals; do
  extra=()
  [[ $shading == matcap ]] && extra=(--picture ball.pfm)
  must render torus "$shading.exr" --env card.exr --shading "$shading" --size 24x16 --samples 1 --triangles 500 "${extra[@]}"
done

# One radiance from everywhere stays what it is, with a body in view or not.
for shading in mirror glossy refraction diffuse globe phong; do
  must render sphere constant.pfm --env grey.exr --shading "$shading" --size 16x16 --samples 2 --position 0,0,-4 --look 0 --fov 40 \
    --material color=1
  near "$shading in a grey world" "$(sample_along constant.pfm 0,0,1 --from perspective,fov=40)" "$(sample_along grey.exr 0,0,1)" 1e-4
done

# A chain that was baked before shows what one of its own does, to the difference of their levels; a map without roughness is none.
must bake light.exr chain.ktx2 --lobe ggx --size 64
rough=(--size 24x24 --samples 2 --position 0,0,-4 --look 0 --fov 40 --material color=1,metallic=1,roughness=0.5)
must render sphere by-chain.pfm --env light.exr --chain chain.ktx2 "${rough[@]}"
must render sphere by-own.pfm --env light.exr "${rough[@]}"
same by-chain.pfm by-own.pfm 0.01 --from perspective,fov=40
refuses 1 "light.exr: .*roughness" render sphere out.png --env card.exr --chain light.exr "${rough[@]}"

# Photographs of a ball in place of baked views.
must render sphere photographed.exr --env card.exr --shading warped --ball ball.pfm@0,0,-1 --ball ball.pfm@1,0,-1 --ball ball.pfm@0,1,-1 --size 24x16
refuses 2 "three views at least" render sphere out.png --env card.exr --shading warped --ball ball.pfm@0,0,-1 --size 24x16
refuses 2 "is not PICTURE@X,Y,Z" render sphere out.png --env card.exr --shading warped --ball ball.pfm

# Objects with a world of their own, and worlds that are near.
must render floor own.exr --env card.exr --own sphere=grey.exr@0,1,0 --proxy ground:1,20 --size 24x16
must render floor box.exr --env card.exr --proxy box:-5,-1,-5,5,5,5@0,1,0 --size 24x16

# Animations: a turntable goes round once; what is complete stays; a moving object sees its scene.
must render teapot 'turn_%d.exr' --env card.exr --frames 0-4 --turntable 4 --size 24x16 --samples 1 --resume
same turn_0.exr turn_4.exr 1e-5
checks=$((checks + 1))
cmp -s turn_0.exr turn_2.exr && fail "a teapot looks the same from the other side"
rm turn_3.exr
tells_text "4 of 5 frames were complete" render teapot 'turn_%d.exr' --env card.exr --frames 0-4 --turntable 4 --size 24x16 --samples 1 --resume
[[ -e turn_3.exr ]] || fail "the missing frame was not made"
must render floor 'move_%d.exr' --env card.exr --frames 1-3 --move sphere=-1,1,0:1,1,0 --every 2 --shading diffuse --size 24x16 --samples 1
refuses 2 "has no place for the frame's number" render floor still.exr --env card.exr --frames 1-3
refuses 2 "is for --frames" render floor still.exr --env card.exr --turntable 3
refuses 2 "is not NAME=X,Y,Z" render floor 'm_%d.exr' --env card.exr --frames 1-2 --move sphere
refuses 2 "unknown object" render floor 'm_%d.exr' --env card.exr --frames 1-2 --move spere=0,0,0:1,1,1

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

# A roughness map's levels are as rough as the bumps that they lose; a plane's stay as they are.
must roughness flat.pfm 0.4 rough.ktx2 --levels 4
refuses 2 "the format has no levels" roughness flat.pfm 0.4 rough.png
refuses 1 "outside 0" roughness flat.pfm 1.4 rough.ktx2
refuses 1 "texels and the normal map" roughness flat.pfm constant.pfm rough.ktx2
finish
