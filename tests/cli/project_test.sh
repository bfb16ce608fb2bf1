#!/usr/bin/env bash
# `project`: what a place in a scene sees, in any parameterization, with distances; grids of places; what it refuses.
#
# project_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes card.exr --size 256 --samples 2
must synth constant grey.exr --size 64
place=0.3,1.2,0.4

# A cube and an octahedron of one place are one world, to the antialiasing of edges.
must project room cube.exr --at $place --env grey.exr --size 48 --samples 8
must project room octahedral.exr --at $place --env grey.exr --to octahedral --size 512 --samples 2
must convert octahedral.exr converted.exr --to cube --size 48
same cube.exr converted.exr 0.03
must project room cube2.exr --at $place --env grey.exr --size 48 --samples 8 -j 1
checks=$((checks + 1))
cmp -s cube.exr cube2.exr || fail "a projection made twice differs"

# Far above a ball the sky is the map itself.
must project sphere sky.exr --at 0,1000,0 --env card.exr --to latlong --size 256
near "the sky" "$(sample_along sky.exr 0,1,0)" "${card_colour[0,1,0]}" 2e-3
near "beside it" "$(sample_along sky.exr 1,0,0)" "${card_colour[1,0,0]}" 2e-3

# From 4 away a ball of radius 1 begins at 3, and what isn't met counts as the farthest.
must project sphere depth.exr --at 0,0,4 --env grey.exr --to octahedral --size 64 --depth moments --coverage --farthest 50
near "the distance" "$(sample_along depth.exr 0,0,-1 --channels Z)" 3 0.02
near "its square" "$(sample_along depth.exr 0,0,-1 --channels Z2)" 9 0.1
near "the sky's" "$(sample_along depth.exr 0,1,0 --channels Z)" 50 1e-3
near "coverage" "$(sample_along depth.exr 0,0,-1 --channels A) $(sample_along depth.exr 0,0,1 --channels A)" "1 0" 1e-3

# Without a world, surfaces show what they give off.
must project sphere lamp.exr --at 0,0,4 --size 16 --material emission=2/1/0.5,color=0
near "what it gives off" "$(sample_along lamp.exr 0,0,-1)" "2 1 0.5" 1e-4
near "the dark" "$(sample_along lamp.exr 0,1,0)" "0 0 0" 0

# A grid: its atlases, and their sizes.
tells_text 'of 12 probes see the backs' project room probes.exr --grid 3,2,2 --env grey.exr --size 16 --samples 1 --roughness 0.5
for name in radiance diffuse specular-0.5 depth; do
  checks=$((checks + 1))
  [[ -s probes_$name.exr ]] || fail "no atlas of $name"
done
matches 'picture +54.+72' info probes_radiance.exr
checks=$((checks + 1))
grep -q '"counts": \[3, 2, 2\]' probes.json && grep -q '"file": "probes_depth.exr"' probes.json || fail "$(cat probes.json)"
# Slices of a texture array where the format has them, else one below the other.
tells_text 'of 12 probes' project room rtx.ktx2 --grid 3,2,2 --env grey.exr --layout rtxgi --samples 1
matches 'layers +2|2 layers' info rtx_irradiance.ktx2
tells_text 'of 12 probes' project room rtx.exr --grid 3,2,2 --env grey.exr --layout rtxgi --samples 1
matches 'picture +24.+32' info rtx_irradiance.exr
matches 'picture +48.+64' info rtx_distance.exr
checks=$((checks + 1))
grep -q '"probeNumDistanceInteriorTexels": 14' rtx.json || fail "$(cat rtx.json)"
# Probes inside bodies are told.
tells "1 of 1 probes see the backs" project sphere inside.exr --grid 1,1,1 --box -0.1,-0.1,-0.1,0.1,0.1,0.1 --env grey.exr --samples 1

# A square over a floor, lit from above it: its shadow is that of rays, but at the border.
cat >lit.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 30}]}},
 "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0}, {"translation": [0.4, 2.5, 0.2], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "buffers": [{"byteLength": 120, "uri": "data:application/octet-stream;base64,AABAwAAAAAAAAEDAAABAwAAAAAAAAEBAAABAQAAAAAAAAEBAAABAQAAAAAAAAEDAAAAAvwAAgD8AAAC/AAAAvwAAgD8AAAA/AAAAPwAAgD8AAAA/AAAAPwAAgD8AAAC/AAABAAIAAAACAAMABAAFAAYABAAGAAcA"}],
 "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 24}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-3, 0, -3], "max": [3, 1, 3]},
  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}]}
GLTF
for shadows in map traced none off; do
  must project lit.gltf "lit_$shadows.exr" --at 1.5,1.6,1.5 --to octahedral --size 64 --shadows "$shadows"
done
same lit_traced.exr lit_map.exr 0.02
checks=$((checks + 2))
"$welkin" diff lit_none.exr lit_map.exr --fail-above 0.05 >/dev/null 2>&1 && fail "the square throws no shadow"
"$welkin" diff lit_off.exr lit_map.exr --fail-above 0.5 >/dev/null 2>&1 && fail "the light lights nothing"

# Six images of another program are a cube.
must convert cube.exr face_%s.exr --to cube:faces -q
must convert face_%s.exr again.exr --from cube:faces --to octahedral --size 64
must convert cube.exr straight.exr --to octahedral --size 64
same straight.exr again.exr 1e-6

# Requests that make no sense: status 2, and the remedy.
refuses 2 "say from where" project room out.exr --env grey.exr
refuses 2 "doesn't go with --grid" project room out.exr --at 0,0,0 --grid 1,1,1
refuses 2 "goes with --grid" project room out.exr --at 0,0,0 --layout rtxgi
refuses 2 "doesn't go with --grid" project room out.exr --grid 1,1,1 --to cube
refuses 2 "channels|R, G, B|Y or" project room out.png --grid 1,1,1
refuses 2 "over 0, and at most" project room out.exr --grid 1,1,1 --farthest 0
refuses 2 "4 to 1024 texels" project room out.exr --grid 1,1,1 --size 2
refuses 2 "is not x,y,z" project room out.exr --at 1,2
refuses 2 "did you mean 'rtxgi'" project room out.exr --grid 1,1,1 --layout rtxg
refuses 2 "not a whole number" project room out.exr --grid 0,1,1
refuses 2 "not a whole number" project room out.exr --grid 1.5,1,1
refuses 2 "2²⁴|2²⁰|8 GiB" project room out.exr --grid 100000,100000,100000
refuses 2 "over 2²⁰ texels" project room out.exr --grid 1,1000,1000
refuses 2 "did you mean 'mean'" project room out.exr --at 0,0,0 --depth meen
refuses 2 "did you mean 'material'" project room out.exr --at 0,0,0 --shading materiel
refuses 2 "did you mean 'map'" project room out.exr --at 0,0,0 --shadows mop
refuses 2 "did you mean 'room'" project rom out.exr --at 0,0,0
refuses 2 "unknown" project room out.exr --at 0,0,0 --to cub
refuses 2 "at most 1e30" project room out.exr --at 1e31,0,0
refuses 2 "no size along an axis" project room out.exr --grid 2,1,1 --box 0,0,0,0,1,1
refuses 1 "No such file" project room out.exr --at 0,0,0 --env none.exr

finish
