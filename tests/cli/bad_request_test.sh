#!/usr/bin/env bash
# Requests that make no sense: status 2, one message that names the option and, for a name, the nearest known one. No file is touched.
#
# bad_request_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes map.exr --size 16
must synth axes cube.exr --to cube --size 4

# Names, and the nearest.
refuses 2 "unknown command 'conver'; did you mean 'convert'\?" conver map.exr out.exr
refuses 2 "unknown command 'densty'; did you mean 'density'\?" plot densty
refuses 2 "unknown command 'fnord'" help fnord
refuses 2 "unknown command 'mip'; did you mean 'mips'\?" help plot mip
refuses 2 "unknown option '--siz'; did you mean '--size'\?" convert map.exr out.exr --siz 8
refuses 2 "unknown option '--siz'; did you mean '--size'\?" convert map.exr out.exr --siz=8
refuses 2 "unknown option '--thread'; did you mean '--threads'\?" convert map.exr out.exr --thread 2
refuses 2 "unknown option '-x'" info map.exr -x
refuses 2 "unknown option '--json'" --json
refuses 2 "unknown list 'map'" list map
refuses 2 "unknown built-in map 'axis'; did you mean 'axes'\?" synth axis out.exr
for command in "convert map.exr" "synth axes"; do
  # shellcheck disable=SC2086
  {
    refuses 2 "--to: unknown parameterization 'cub'; did you mean 'cube'\?" $command out.exr --to cub
    refuses 2 "--to: unknown layout of cube 'hcros'; did you mean 'hcross'\?" $command out.exr --to cube:hcros
    refuses 2 "--to: latlong is a single picture" $command out.exr --to latlong:hcross
    refuses 2 "--to: unknown parameter of fisheye-equidistant 'fv'; did you mean 'fov'\?" $command out.exr --to fisheye-equidistant,fv=90
    refuses 2 "--to: fisheye-equidistant: fov=400" $command out.exr --to fisheye-equidistant,fov=400
    refuses 2 "--to: fisheye-equidistant: fov=nan" $command out.exr --to fisheye-equidistant,fov=nan
    refuses 2 "--to: " $command out.exr --to fisheye-equidistant,fov
    refuses 2 "--to: " $command out.exr --to ,
    refuses 2 "unknown convention 'bleder'; did you mean 'blender'\?" $command out.exr --convention bleder
    refuses 2 "--type: unknown pixel type 'flot'; did you mean 'float'\?" $command out.exr --type flot
    refuses 2 "--to-colour: unknown transfer function 'srbg'; did you mean 'srgb'\?" $command out.exr --to-colour srbg
    refuses 2 "out.exe: unknown extension 'exe'; did you mean 'exr'\?" $command out.exe
    refuses 2 "out: the name has no extension" $command out
    refuses 2 "--to-faces: unknown face 'mz'" $command out.exr --to cube --to-faces px,nx,py,ny,pz,mz
    refuses 2 "--to-faces: names 2 faces, but cube has 6" $command out.exr --to cube --to-faces px,nx
    refuses 2 "--to-faces: names 'px' twice" $command out.exr --to cube --to-faces px,nx,py,ny,pz,px
    refuses 2 "--to-faces: 'nz:45'" $command out.exr --to cube --to-faces px,nx,py,ny,pz,nz:45
    refuses 2 "--to-faces: only square" $command out.exr --to latlong --to-faces 0:90
    refuses 2 "out.exr: .*put %s in the name" $command out.exr --to cube:faces
    refuses 2 "out%s.exr: %s stands for a face's name" $command out%s.exr --to cube
    for size in 0 -1 1e3 0x10 5x x5 5x5x5 99999999999 nan "" "8 " 8.0; do
      refuses 2 "--size: " $command out.exr --to latlong "--size=$size"
    done
    refuses 2 "--quality: " $command out.jpg --quality 0
    refuses 2 "--quality: " $command out.jpg --quality 101
    refuses 2 "--threads: " -j -1 $command out.exr
    refuses 2 "--threads: " -j abc $command out.exr
    refuses 2 "--progress: " --progress maybe $command out.exr
  }
done
for layout in flat bands; do refuses 2 "--size: faces of 8×4 cannot be turned" convert cube.exr out.exr --to cube:$layout --size 8x4; done
refuses 2 "--size: faces of 8×4 cannot be turned" synth axes out.exr --to cube --size 8x4 --to-faces px:90,nx,py,ny,pz,nz
refuses 2 "--filter: unknown filter 'bilinar'; did you mean 'bilinear'\?" convert map.exr out.exr --filter bilinar
refuses 2 "--from: unknown parameterization 'latlon'; did you mean 'latlong'\?" info map.exr --from latlon
refuses 2 "--from-convention: unknown convention 'unty'; did you mean 'unity'\?" info map.exr --from-convention unty
refuses 2 "--colour: unknown transfer function" info map.exr --colour sRGB
refuses 2 "--from-faces: unknown face 'zz'" convert cube.exr out.exr --from-faces px,nx,py,ny,pz,zz
refuses 2 "--from-b: unknown parameterization" diff map.exr map.exr --from-b latlon

# Numbers.
for value in nan inf -inf 1e999 abc 1x; do
  refuses 2 "--exposure: '$value' is not a number" convert map.exr out.exr "--exposure=$value"
  refuses 2 "--scale: '$value' is not a number" convert map.exr out.exr "--scale=$value"
  refuses 2 "--fill: '$value' is not a number" convert map.exr out.exr --fill "0,$value"
  refuses 2 "--rotate: '$value' is not a number" convert map.exr out.exr --rotate "0,0,$value"
  refuses 2 "--dir: '$value' is not a number" sample map.exr --dir "0,0,$value"
  refuses 2 "--peak: '$value' is not a number" diff map.exr map.exr "--peak=$value"
  refuses 2 "--fail-above: '$value' is not a number" diff map.exr map.exr "--fail-above=$value"
done
refuses 2 "--peak: -1 is below 0" diff map.exr map.exr --peak -1
refuses 2 "--fail-above: -1 is below 0" diff map.exr map.exr --fail-above -1
refuses 2 "--rotate: give yaw,pitch,roll" convert map.exr out.exr --rotate 1,2
refuses 2 "--rotate: the quaternion 0,0,0,0 has no length" convert map.exr out.exr --rotate 0,0,0,0
refuses 2 "--rotate: the matrix is no rotation" convert map.exr out.exr --rotate 1,0,0,0,1,0,0,0,2
refuses 2 "--fill: 4 values, but map.exr has 3 channels" convert map.exr out.exr --fill 1,2,3,4
refuses 2 "--channels: 'R' is named twice" convert map.exr out.exr --channels R,R
refuses 2 "--channels: 'R,' has an empty name" convert map.exr out.exr --channels R,
refuses 2 "--part: " info map.exr --part -1
refuses 2 "--part: " info map.exr --part 99999999999999999999
refuses 2 "--level: map.exr has levels 0 to 4" sample map.exr --level 5 --dir 0,0,1
refuses 2 "--level: " sample map.exr --level -1 --dir 0,0,1
refuses 2 "--dir: '0,0,0' is not a direction" sample map.exr --dir 0,0,0
refuses 2 "--dir: '1,2' is not x,y,z" sample map.exr --dir 1,2
refuses 2 "--dir: '1,2,3,4' is not x,y,z" sample map.exr --dir 1,2,3,4
refuses 2 "elevation must be" synth sky out.exr --elevation -10
refuses 2 "turbidity must be" synth sky out.exr --turbidity 100
refuses 2 "intensity must be" synth sky out.exr --intensity nan
refuses 2 "--seed: " synth lamps out.exr --seed -1
refuses 2 "--samples: " synth axes out.exr --samples 0

# Too little and too much.
refuses 2 "IN is required" convert
refuses 2 "OUT is required" convert map.exr
refuses 2 "B is required" diff map.exr
refuses 2 "FILE is required" info
refuses 2 "MAP is required" sample
refuses 2 "not expected: more" convert map.exr out.exr more
refuses 2 "--size: " convert map.exr out.exr --size
refuses 2 "name the parameterization to draw with --of" plot density out.png
checks=$((checks + 1))
run
((status == 2)) && grep -q '^Usage: welkin' "$work/out" || fail "welkin alone doesn't tell how it is used"

refuses 2 "--border: 9 texels are more than a chart of 8×4 has" convert map.exr out.exr --size 8x4 --border 9
refuses 2 "--border: " convert map.exr out.exr --border -1
refuses 2 "--from-border: " convert map.exr out.exr --from-border -1

# Any file name will do, even one that is not UTF-8, begins with a dash or has spaces.
for name in $'\xff.exr' "-x.exr" "a b.exr" "ä.exr" "new
line.exr"; do
  must convert map.exr -- "$name"
  must diff -- map.exr "$name"
  must diff --json -- map.exr "$name"
  must info --json -- "$name"
done

# What comes on standard input is not echoed raw.
while IFS= read -r line; do
  checks=$((checks + 1))
  status=0
  printf '1 0 0\n%b\n' "$line" | "$welkin" sample map.exr >"$work/out" 2>"$work/messages" || status=$?
  ((status == 2)) && grep -qE '^welkin: standard input, line 2: ' "$work/messages" || fail "'$line' on standard input: status $status, $(cat "$work/messages")"
  [[ $(wc -l <"$work/out") == 1 ]] || fail "the line before '$line' gets no answer"
  ! grep -q $'\x1b' "$work/messages" || fail "an escape character is echoed"
done <<'END'
a b c
1 2
1 2 3 4
1,2,3
nan 0 0
inf 0 0
0 0 0
\033[31m 0 0
# comment
END

finish
