#!/usr/bin/env bash
# `welkin assemble`: worlds from flat pictures, from discs, over backgrounds; and what it refuses.
. "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes axes.exr --size 512
must convert axes.exr face_%s.exr --to cube:faces --size 192 -q

# The faces of a cube, as pictures with a direction each, are the world again.
faces=(--panel face_pz.exr,fov=90 --panel face_nx.exr,fov=90,yaw=90 --panel face_nz.exr,fov=90,yaw=180
  --panel face_px.exr,fov=90,yaw=-90 --panel face_py.exr,fov=90,pitch=90 --panel face_ny.exr,fov=90,pitch=-90)
matches '^together +(99\.9|100\.0). %; 0\.0. % no picture shows$' assemble world.exr "${faces[@]}" --size 512
same axes.exr world.exr 0.06
for axis in "${axes[@]}"; do near "$axis" "$(sample_along world.exr "$axis")" "${card_colour[$axis]}" 0.002; done

# The same from a list, whose files are beside it.
mkdir list
for face in face_??.exr; do mv "$face" list; done
cat >list/faces.json <<'JSON'
{"panels": [{"file": "face_pz.exr", "fov": 90}, {"file": "face_nx.exr", "fov": 90, "yaw": 90},
  {"file": "face_nz.exr", "fov": 90, "yaw": 180}, {"file": "face_px.exr", "fov": 90, "yaw": -90},
  {"file": "face_py.exr", "fov": 90, "pitch": 90}, {"file": "face_ny.exr", "fov": 90, "pitch": -90}]}
JSON
must assemble listed.exr --list list/faces.json --size 512
same world.exr listed.exr 0

# Gaps are told, and filled.
matches '^together +16\.6. %; 83\.3. % no picture shows$' assemble one.exr --panel list/face_pz.exr,fov=90
near 'a gap' "$(sample_along one.exr 0,0,-1)" "0 0 0" 0
matches 'are of the background$' assemble one.exr --panel list/face_pz.exr,fov=90 --background 1,2,3
near 'a colour' "$(sample_along one.exr 0,0,-1)" "1 2 3" 0
matches 'are of the background$' assemble one.exr --panel list/face_pz.exr,fov=90,exposure=1 --background axes.exr
near 'a map' "$(sample_along one.exr 0,0,-1)" "${card_colour[0,0,-1]}" 0.002
near 'brighter' "$(sample_along one.exr 0,0,1)" "0.4244 0.8466 1.4462" 0.004
must assemble alpha.exr --panel list/face_pz.exr,fov=90 --alpha
near 'alpha' "$(sample_along alpha.exr 0,0,1 0,0,-1 | cut -d' ' -f4 | tr '\n' ' ')" "1 0" 1e-5

# A higher layer lies over a lower one; a fish-eye is a picture too.
must convert axes.exr fish.exr --to fisheye-equidistant,fov=120 --size 256
must assemble layers.exr --panel list/face_pz.exr,fov=90,layer=1 --panel fish.exr,as=fisheye-equidistant,fov=120,yaw=180
near 'over' "$(sample_along layers.exr 0,0,1)" "${card_colour[0,0,1]}" 0.002
near 'the fish-eye' "$(sample_along layers.exr 0,0,-1)" "${card_colour[0,0,1]}" 0.002

# Any output, any thread count.
must assemble half.exr --list list/faces.json --to half-cube
must -j 1 assemble half1.exr --list list/faces.json --to half-cube
same half.exr half1.exr 0

refuses 2 'give at least one picture' assemble x.exr
must convert axes.exr undeclared.pfm --size 64x64
refuses 2 'say its horizontal field of view' assemble x.exr --panel undeclared.pfm
# A file that declares what it shows needs no setting, and lies where it says.
must convert axes.exr window.exr --to latlong,left=-40,right=60,top=30,bottom=-20 --size 200
must assemble window_world.exr --panel window.exr,feather=2 --size 256
near 'a window' "$(sample_along window_world.exr 0,0,1)" "${card_colour[0,0,1]}" 0.002
near 'beside it' "$(sample_along window_world.exr -1,0,0)" "0 0 0" 0
for fov in 0 180 -5 nan; do refuses 2 'fov: ' assemble x.exr --panel "list/face_pz.exr,fov=$fov"; done
refuses 2 "unknown setting 'yav'; did you mean 'yaw'" assemble x.exr --panel list/face_pz.exr,fov=60,yav=3
refuses 2 'feather: is 0 to 90' assemble x.exr --panel list/face_pz.exr,fov=60,feather=91
refuses 2 "'fov' is given twice" assemble x.exr --panel list/face_pz.exr,fov=60,fov=61
refuses 2 "unknown parameterization 'fishy'" assemble x.exr --panel list/face_pz.exr,as=fishy
refuses 1 'nope.png: No such file' assemble x.exr --panel nope.png,fov=60
refuses 2 '--alpha: ' assemble x.exr --panel list/face_pz.exr,fov=60 --alpha --background 0,0,0
for colour in 1,2 1,2,3,4 1,1e60,1; do
  refuses 2 'is not R,G,B' assemble x.exr --panel list/face_pz.exr,fov=60 --background "$colour"
done
refuses 1 'list: is a directory' assemble x.exr --list list
printf "[" >bad.json
refuses 1 "bad.json: is not a JSON object" assemble x.exr --list bad.json
printf '{"panels": [{"fov": 60}]}' >bad.json
refuses 1 'entry 1 of "panels" has no "file"' assemble x.exr --list bad.json
printf '{"panes": []}' >bad.json
refuses 1 "unknown list 'panes'; did you mean 'panels'" assemble x.exr --list bad.json
printf '{"panels": [{"file": "a.png", "fov": [1]}]}' >bad.json
refuses 1 '"fov" of entry 1 is neither a number nor a text' assemble x.exr --list bad.json

# Photographs of a mirror ball from three sides are the world again, and as bright as the first.
must synth sky sky.exr --size 512
for k in 0 1 2; do
  must convert sky.exr ball$k.exr --to mirror-ball,distance=12 --size 300 --rotate $((k * 120)),0,0 --exposure 0.$k
done
balls=(--ball ball0.exr,distance=12,yaw=180,camera=8 --ball ball1.exr,distance=12,yaw=300,camera=8
  --ball ball2.exr,distance=12,yaw=60,camera=8)
matches '^together +(99\.9|100\.0). %' assemble balls.exr "${balls[@]}" --match --size 512
grep -qE 'behind the ball that is hidden 4\.78°' "$work/out" || fail "no blind cone: $(cat "$work/out")"
near 'gains' "$(sed -nE 's/.*times ([0-9.]+)/\1/p' "$work/out" | tr '\n' ' ')" "0.9330 0.8706" 0.004
for direction in 1,0.2,0 -1,0.3,0.2 0,0.5,1 0,0.3,-1 0.1,-1,0; do
  near "along $direction" "$(sample_along balls.exr "$direction")" "$(sample_along sky.exr "$direction")" 0.03
done
# The same by a field of view, and the ball as a part of the photograph.
must assemble fov.exr --ball ball0.exr,fov=9.5604,yaw=180 --size 256
must assemble distance.exr --ball ball0.exr,distance=12,yaw=180,x=150,y=150,radius=150 --size 256
same distance.exr fov.exr 1e-3
printf '{"balls": [{"file": "ball0.exr", "distance": 12, "yaw": 180}]}' >one_ball.json
must assemble listed_ball.exr --list one_ball.json --size 256
same distance.exr listed_ball.exr 1e-6
refuses 2 'distance: follows from fov' assemble x.exr --ball ball0.exr,fov=9,distance=12
refuses 2 'give all three' assemble x.exr --ball ball0.exr,x=150
refuses 1 'is not inside the picture' assemble x.exr --ball ball0.exr,x=10,y=10,radius=100
refuses 1 'has to be outside the ball' assemble x.exr --ball ball0.exr,distance=1
refuses 1 'half angle that the camera hides' assemble x.exr --ball ball0.exr,camera=90

# A fish-eye photograph of the sky, taken straight up, becomes a half cube; and a world, with a ground of each kind.
must convert sky.exr up.exr --to fisheye-equidistant,fov=180 --size 400 --rotate 0,90,0
must assemble halfcube.exr --panel up.exr,as=fisheye-equidistant,fov=180,pitch=90 --to half-cube --size 256
must convert sky.exr wanted.exr --to half-cube --size 256
same wanted.exr halfcube.exr 0.1
for ground in mirror stretch; do
  must assemble $ground.exr --panel up.exr,as=fisheye-equidistant,fov=180,pitch=90 --ground $ground --size 512
done
near mirrored "$(sample_along mirror.exr 0.5,-0.4,1)" "$(sample_along sky.exr 0.5,0.4,1)" 0.02
near stretched "$(sample_along stretch.exr 0.5,-0.4,1)" "$(sample_along stretch.exr 0.5,0.005,1)" 0.02
must assemble declared.exr --panel wanted.exr,as=auto --ground mirror --size 512
near declared "$(sample_along declared.exr 0.5,-0.4,1)" "$(sample_along sky.exr 0.5,0.4,1)" 0.02
refuses 1 'all of the horizon' assemble x.exr --panel list/face_pz.exr,fov=90 --ground stretch

finish
