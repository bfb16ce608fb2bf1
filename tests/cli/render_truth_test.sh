#!/usr/bin/env bash
# `render --integrator`: paths of light, mirrors that trace, and look-ups compared with paths.
#
# render_truth_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth sky sky.exr --size 256
must synth constant grey.exr --size 64
small=(--size 32x18 --triangles 2000)

# Paths, their standard error, the same bits again, and others by another seed.
must render sphere path.pfm --env sky.exr --integrator path --paths 16 --standard-error error.pfm "${small[@]}"
must render sphere again.pfm --env sky.exr --integrator path --paths 16 "${small[@]}"
must render sphere other.pfm --env sky.exr --integrator path --paths 16 --seed 1 "${small[@]}"
checks=$((checks + 3))
cmp -s path.pfm again.pfm || fail "the same paths give another picture"
! cmp -s path.pfm other.pfm || fail "another seed gives the same picture"
[[ -s error.pfm ]] || fail "no standard error"

# Every sampling, and mirrors that trace.
for sampling in mis bsdf light; do
  must render floor "$sampling.exr" --env sky.exr --integrator path --sampling "$sampling" --paths 4 --depth 3 "${small[@]}"
done
must render floor hybrid.exr --env sky.exr --integrator hybrid --samples 2 "${small[@]}"

# A room with a lamp needs no map.
must render room room.exr --integrator path --paths 4 "${small[@]}"

# Approximation and truth side by side, with numbers: a diffuse ball is what its look-up says.
compared=(--env sky.exr --shading material --paths 64 --samples 2 "${small[@]}")
matches 'rel. RMSE [0-9.e-]+ \(of which [0-9.e-]+ is the noise of 64 paths\)' render sphere look-up.exr "${compared[@]}" --compare sides.exr --material roughness=0.5
matches '"relative_rmse": 0\.0[0-9]+' render sphere look-up.exr "${compared[@]}" --compare sides.exr --json --material metallic=0,roughness=1,ior=1
matches '100×18' info sides.exr
must render floor hybrid.exr "${compared[@]}" --integrator hybrid --compare sides.exr --no-background

# Requests that make no sense.
refuses 2 "did you mean 'path'" render sphere out.png --env sky.exr --integrator paths
refuses 2 "did you mean 'mis'" render sphere out.png --env sky.exr --integrator path --sampling miss
refuses 2 "compares look-up or hybrid" render sphere out.png --env sky.exr --integrator path --compare c.png
refuses 2 "add --integrator path" render sphere out.png --env sky.exr --standard-error e.pfm
refuses 2 "where OUT can't be" render sphere - --format exr --env sky.exr --compare c.exr
refuses 2 "is what --compare finds" render sphere out.png --env sky.exr --json
refuses 2 "nothing in the scene shines" render sphere out.png --integrator path
refuses 2 "infinitely far" render sphere out.png --env sky.exr --proxy sphere:5 --integrator path --sampling light
finish
