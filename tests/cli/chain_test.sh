#!/usr/bin/env bash
# Files with levels: what `info`, `sample`, `diff` and `convert` make of them, in KTX2 and EXR, and what they say when there is no such
# level.
#
# chain_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# number_at FILE OFFSET BYTES: a little-endian number.
number_at() { od -A n -v -t "u$3" -j "$2" -N "$3" -- "$1" | tr -d ' '; }
# little_endian NUMBER BYTES
little_endian() {
  local i
  for ((i = 0; i < $2; ++i)); do printf "\\x$(printf %02x $((($1 >> (8 * i)) & 255)))"; done
}
# bytes FILE OFFSET LENGTH
bytes() { tail -c +$(($2 + 1)) -- "$1" | head -c "$3" || true; }

# keys_of FILE NAME VALUE: the metadata of a KTX2 with one entry more, whose name comes last.
keys_of() {
  bytes "$1" "$(number_at "$1" 56 4)" "$(number_at "$1" 60 4)"
  [[ -n $2 ]] || return 0
  little_endian $((${#2} + ${#3} + 2)) 4
  printf '%s\0%s\0' "$2" "$3"
  little_endian 0 $(((2 - ${#2} - ${#3}) & 3))
}

# stitch OUT NAME VALUE LEVEL…: one KTX2 of the levels, each of which is a KTX2 of one level with 16 bytes a texel, and NAME=VALUE in
# its metadata.
stitch() {
  local out=$1 first=$4 descriptor keys index count end i level lengths=() offsets=()
  keys_of "$4" "$2" "$3" >"$work/keys"
  shift 3
  count=$#
  descriptor=$(number_at "$first" 52 4) keys=$(stat -c %s "$work/keys") index=$((80 + 24 * count))
  end=$(((index + descriptor + keys + 15) / 16 * 16))
  local padding=$((end - index - descriptor - keys))
  for ((i = count; i > 0; --i)); do
    lengths[i]=$(number_at "${!i}" 88 8) offsets[i]=$end
    end=$((end + lengths[i]))
  done
  {
    bytes "$first" 0 40
    little_endian "$count" 4
    little_endian 0 4
    little_endian "$index" 4
    little_endian "$descriptor" 4
    little_endian $((index + descriptor)) 4
    little_endian "$keys" 4
    little_endian 0 16
    for ((i = 1; i <= count; ++i)); do
      little_endian "${offsets[i]}" 8
      little_endian "${lengths[i]}" 8
      little_endian "${lengths[i]}" 8
    done
    bytes "$first" "$(number_at "$first" 48 4)" "$descriptor"
    cat "$work/keys"
    little_endian 0 "$padding"
    for ((i = count; i > 0; --i)); do
      level=${!i}
      bytes "$level" "$(number_at "$level" 80 8)" "${lengths[i]}"
    done
  } >"$out"
}

# Levels that differ in more than their size: level k is 2^k times as bright.
must synth axes card.exr --size 256 --samples 2
names=()
for level in 0 1 2 3 4 5; do
  must convert card.exr level$level.ktx2 --to cube --size $((32 >> level)) --exposure $level
  must convert level$level.ktx2 level$level.exr
  names+=("level$level.ktx2")
done
stitch chain.ktx2 welkin.roughness 0,0.125,0.25,0.5,0.75,1 "${names[@]}"
stitch mips.ktx2 '' '' "${names[@]}"

# info
matches '^  texture           cube, 6 levels$' info chain.ktx2 --header
matches '^  picture           32×32, R G B A of float, compression none$' info chain.ktx2 --header
matches '^  parameterization  cube:layers \(declared by the file\), charts 6×32×32$' info chain.ktx2
matches '^  level 3           charts 4×4, roughness 0.5, mean luminance [0-9.]+$' info chain.ktx2
matches '^  level 5           charts 1×1, roughness 1$' info chain.ktx2 --header
matches '"levels": 6' info chain.ktx2 --json
matches '"roughness": 0.125' info chain.ktx2 --json --header
matches '"mean_luminance": ' info chain.ktx2 --json
checks=$((checks + 1))
[[ $("$welkin" info chain.ktx2 | grep -c '^  picture') == 1 ]] || fail "info lists every picture of a texture"
for level in 0 3; do
  near "mean of level $level" "$("$welkin" info chain.ktx2 --level $level --json | number mean)" \
    "$("$welkin" info level$level.exr --json | number mean)" 1e-6
done
near "size of level 3" "$("$welkin" info chain.ktx2 --level 3 --json | number texels)" 96 0

# sample: each level; between levels their mixture; on a file of one level, its pyramid.
for level in 0 2 5; do
  near "sample --level $level" "$(sample_along chain.ktx2 0.3,0.5,-0.7 --level $level)" "$(sample_along level$level.exr 0.3,0.5,-0.7)" 1e-6
done
a=$(sample_along level1.exr 0.3,0.5,-0.7) b=$(sample_along level2.exr 0.3,0.5,-0.7)
near "sample --level 1.25" "$(sample_along chain.ktx2 0.3,0.5,-0.7 --level 1.25)" \
  "$(paste -d ' ' <(tr ' ' '\n' <<<"$a") <(tr ' ' '\n' <<<"$b") | awk '{ print 0.75 * $1 + 0.25 * $2 }' | tr '\n' ' ')" 1e-5
a=$(sample_along card.exr 0,1,0 --level 3) b=$(sample_along card.exr 0,1,0 --level 4)
near "a pyramid between levels" "$(sample_along card.exr 0,1,0 --level 3.5)" \
  "$(paste -d ' ' <(tr ' ' '\n' <<<"$a") <(tr ' ' '\n' <<<"$b") | awk '{ print ($1 + $2) / 2 }' | tr '\n' ' ')" 1e-5
refuses 2 '--level: chain.ktx2 has levels 0 to 5$' sample chain.ktx2 --dir 0,1,0 --level 5.5
refuses 2 '--level: card.exr has levels 0 to 8$' sample card.exr --dir 0,1,0 --level 1e300
refuses 2 "--level: 'x' is not a number" sample chain.ktx2 --dir 0,1,0 --level x
refuses 2 '--level: -1 is below 0' sample chain.ktx2 --dir 0,1,0 --level=-1

# convert: all levels, from format to format and back to the last bit.
must convert chain.ktx2 chain.exr
matches '"parameterization": "cube:vstrip"' info chain.exr --header --json
same chain.ktx2 chain.exr 0
must convert chain.exr back.ktx2
matches '^  texture           cube, 6 levels$' info back.ktx2 --header
same chain.ktx2 back.ktx2 0
must convert chain.ktx2 packed.ktx2 --compression zstd
same chain.ktx2 packed.ktx2 0
must convert chain.exr cross.exr --to cube:hcross
same chain.ktx2 cross.exr 0
checks=$((checks + 1))
cmp -s chain.ktx2 back.ktx2 || fail "through EXR and back, the file is another"
while read -r type tolerance; do
  must convert chain.ktx2 typed.ktx2 --type "$type"
  matches " of $type," info typed.ktx2 --header
  same chain.ktx2 typed.ktx2 "$tolerance"
done <<'END'
half 1e-3
rgb9e5 4e-3
r11g11b10 2e-2
END
# What is done to a map is done to every level.
must convert chain.ktx2 bright.ktx2 --exposure 1
for level in 0 4; do
  near "--exposure at level $level" "$("$welkin" diff level$level.exr bright.ktx2 --level $level --json | number energy_ratio)" 2 1e-5
done
must convert chain.ktx2 turned.exr --rotate 90,0,0
near "--rotate at level 1" "$(sample_along turned.exr 1,0,0 --level 1)" "$(sample_along chain.ktx2 0,0,1 --level 1)" 1e-3
must convert chain.ktx2 folded.ktx2 --to octahedral --size 64
matches '^  texture           2-D, 6 levels$' info folded.ktx2 --header
matches '^  level 5           charts 2×2, roughness 1$' info folded.ktx2 --header
must convert chain.ktx2 array.ktx2 --to healpix --size 32
matches '^  texture           2-D, 12 layers, 6 levels$' info array.ktx2 --header
matches '"parameterization": "healpix:layers"' info array.ktx2 --header --json
# Levels that no file says are filtered are made again for another shape.
must convert mips.ktx2 mips.exr
same chain.ktx2 mips.exr 0
run convert mips.ktx2 flat.exr --to latlong
checks=$((checks + 1))
((status == 0)) && grep -q '^welkin: flat.exr: holds level 0 of the 6 of mips.ktx2; --level takes another$' "$work/messages" ||
  fail "mere levels in another shape: $(cat "$work/messages")"
# One level, into any format, with what is known of it.
must convert chain.ktx2 one.exr --level 3
matches '^  welkin.roughness  0.5$' info one.exr --header
for level in 0 3; do
  for name in one.exr one.ktx2 one.pfm; do
    must convert chain.ktx2 $name --level $level
    same level$level.exr $name 0 --from-b "$(case $name in one.ktx2) printf cube:layers ;; *) printf cube ;; esac)" --from cube
  done
done
run convert chain.ktx2 one.pfm
checks=$((checks + 1))
((status == 0)) && grep -q '^welkin: one.pfm: holds level 0 of the 6 of chain.ktx2; --level takes another$' "$work/messages" ||
  fail "a format without levels takes level 0 and says nothing: $(cat "$work/messages")"
same level0.exr one.pfm 0 --from-b cube

# diff: level by level; one level; a level with a plain map.
matches '^level 5  ' diff chain.ktx2 bright.ktx2
matches '"levels_b": 6' diff chain.ktx2 bright.ktx2 --json
refuses_prints() { # as refuses, of a command that prints before it fails
  local pattern=$1
  shift
  checks=$((checks + 1))
  run "$@"
  if ((status != 1)) || ! grep -qE -- "$pattern" "$work/messages"; then fail "welkin $*: status $status: $(cat "$work/messages")"; fi
}
refuses_prints 'differ at level 0: relative RMSE 1 is above 0.5$' diff chain.ktx2 bright.ktx2 --fail-above 0.5
same chain.ktx2 chain.exr 0 --level 4
same level4.exr chain.exr 0 --level 4
refuses_prints 'differ: relative' diff level4.exr chain.exr --level 3 --fail-above 0.1
must convert chain.ktx2 --level 0 level0.png
must diff chain.ktx2 chain.exr --level 1 --heat heat.png
refuses 2 '--heat: .*--level' diff chain.ktx2 chain.exr --heat other.png
stitch short.ktx2 '' '' "${names[@]:0:3}"
matches '^chain.ktx2 has 6 levels, short.ktx2 has 3' diff chain.ktx2 short.ktx2

# Levels that aren't there.
for command in "info" "convert" "diff"; do
  case $command in
    info) arguments=(info chain.ktx2) ;;
    convert) arguments=(convert chain.ktx2 no.exr) ;;
    diff) arguments=(diff chain.ktx2 chain.exr) ;;
  esac
  refuses 2 '--level: chain.ktx2: has levels 0…5, not 6$' "${arguments[@]}" --level 6
  refuses 2 '--level' "${arguments[@]}" --level=-1
done
refuses 2 '--level: card.exr: has one level, not level 1$' convert card.exr no.exr --level 1
refuses 2 '--level: card.exr: has one level, not level 2$' diff card.exr level0.exr --level 2
must convert card.exr same.exr --level 0

# What has no room for the levels.
refuses 2 'no.ktx2: charts of 8x8 have 4 levels, not 6$' convert chain.ktx2 no.ktx2 --size 8
refuses 2 'no.exr: cube:vstrip of charts of 33x33 can be halved to 1 levels only, not 6' convert chain.ktx2 no.exr --size 33
must convert chain.ktx2 odd.ktx2 --size 33
refuses 2 'no.exr: an EXR of several parts holds no levels' convert chain.ktx2 no.exr --to cube:layers
refuses 2 'no-%s.exr: 6 levels go into one file' convert chain.ktx2 no-%s.exr --to cube:faces -q
refuses 2 'no.ktx2: levels take no safety border$' convert chain.ktx2 no.ktx2 --border 2

# A plain map in a texture: cubes are cube textures, whatever layout the input had; a picture when it's asked for.
must synth axes cross.exr --to cube:hcross --size 32 --samples 2
must convert cross.exr cube.ktx2
matches '^  texture           cube, 1 level$' info cube.ktx2 --header
same cross.exr cube.ktx2 0
must convert cube.ktx2 cross.png --type uint8
matches '"parameterization": "cube:hcross"' info cross.png --header --json
must convert cross.exr picture.ktx2 --to cube:hcross
matches '^  texture           2-D, 1 level$' info picture.ktx2 --header
matches 'picture           128×96,' info picture.ktx2 --header
same cross.exr picture.ktx2 0
# Looked up as conventions say: native faces, in the program's axes. Texels in other places of their charts are made in other ways.
must convert card.exr cube.ktx2 --to cube --size 128
must convert card.exr unity.ktx2 --to cube --size 128 --convention unity
same cube.ktx2 unity.ktx2 5e-3
near "the native world" "$(sample_along cube.ktx2 1,0,0)" "${card_colour[1,0,0]}" 0.02
near "reflected worlds" "$(sample_along unity.ktx2 1,0,0 --from-convention native)" "${card_colour[-1,0,0]}" 0.02

# Another curve without a new bake: interpolated, which is told.
must synth room room.exr --size 256
must bake room.exr linear.ktx2 --size 64 --levels 5
run convert linear.ktx2 three.ktx2 --roughness-curve three.js --levels 4
checks=$((checks + 1))
((status == 0)) && grep -q "interpolated between those of linear.ktx2, by roughness, .* about 0 [0-9.]* [0-9.]* [0-9.]* %" "$work/messages" ||
  fail "--roughness-curve says: $(cat "$work/messages")"
matches '^  welkin.roughness-curve +three.js$' info three.ktx2 --header
matches '^  welkin.roughness +0,0.1835034[0-9]*,0.4226497[0-9]*,1$' info three.ktx2 --header
must bake room.exr fresh.ktx2 --size 64 --levels 4 --roughness three.js
near "the last level" "$(sample_along three.ktx2 0,1,0 --level 3)" "$(sample_along fresh.ktx2 0,1,0 --level 3)" 0.1
must convert linear.ktx2 padded.exr --roughness-curve 0,0.5,1,1 -q
matches '^  level 3 +charts 8×8, roughness 1' info padded.exr
refuses 2 '--level: --roughness-curve makes all levels' convert linear.ktx2 no.ktx2 --roughness-curve godot --level 1
refuses 2 '--roughness-curve: no.hdr: the format holds one level' convert linear.ktx2 no.hdr --roughness-curve godot
refuses 2 '--levels: counts those of --roughness-curve' convert linear.ktx2 no.ktx2 --levels 3
refuses 2 '--roughness-curve: charts of 64x64 have 7 levels, not 9' convert linear.ktx2 no.ktx2 --roughness-curve godot --levels 9
must convert linear.ktx2 plain.ktx2 --to cube --size 16 --level 0
must synth room mips.ktx2 --to cube --size 16
refuses 1 "mips.ktx2: doesn't say which roughness its levels have" convert mips.ktx2 no.ktx2 --roughness-curve godot

finish
