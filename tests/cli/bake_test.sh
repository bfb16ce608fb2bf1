#!/usr/bin/env bash
# bake: chains and single maps into every kind of file, compared with brute force; their orientation; odd sizes, hostile maps,
# bad requests.
#
# bake_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# bake ARGUMENT…: done, with nothing said on stderr.
bake() { must bake "$@"; }

# all KEY: every value of that key in the output, on one line.
all() { grep -oE "\"$1\": [^,]+" "$work/out" | sed -E 's/^[^:]*: //' | tr '\n' ' '; }

# each KEY LEAST MOST: the output has the key, and all its values that aren't null lie in the range.
each() {
  checks=$((checks + 1))
  awk -v values="$(all "$1")" -v least="$2" -v most="$3" 'BEGIN {
    n = split(values, v, " ")
    for (i = 1; i <= n; ++i) if (v[i] != "null") { if (!(v[i] >= least && v[i] <= most)) exit 1; found = 1 }
    exit !found }' || fail "$1 is not in $2…$3: $(all "$1")"
}

# chain KEY MIRROR MOST: the first value, a mirror's level, is in 0…MIRROR, and the others are in 0…MOST.
chain() {
  checks=$((checks + 1))
  awk -v values="$(all "$1")" -v mirror="$2" -v most="$3" 'BEGIN {
    n = split(values, v, " ")
    for (i = 1; i <= n; ++i) if (!(v[i] >= 0 && v[i] <= (i == 1 ? mirror : most))) exit 1
    exit n < 2 }' || fail "$1 is not in 0…$2 and 0…$3: $(all "$1")"
}

# says PATTERN ARGUMENT…: welkin does this and says one thing that matches.
says() {
  local pattern=$1
  shift
  checks=$((checks + 1))
  run "$@"
  if ((status != 0)) || [[ $(wc -l <"$work/messages") != 1 ]] || ! grep -qE -- "^welkin: .*$pattern" "$work/messages"; then
    fail "welkin $*: status $status, says: $(head -n 3 -- "$work/messages")"
  fi
}

must synth axes card.exr --size 1024 --samples 2
must synth studio studio.exr --size 256
must synth lamps lamps.exr --size 128 --samples 2
must synth constant one.exr --size 64

# ---- the default: a GGX chain in a cube texture
bake studio.exr chain.ktx2
checks=$((checks + 1))
[[ $(grep -cE '^ +[0-9]+ +[0-9]+×[0-9]+ ' "$work/out") == 9 ]] || fail "the table has not nine levels: $(cat "$work/out")"
grep -q '^chain.ktx2: ggx, cube:layers of 256×256, 9 levels$' "$work/out" || fail "no title: $(cat "$work/out")"
grep -qE '^    0 +256×256 +0 +resample *$' "$work/out" || fail "level 0 is not the source: $(cat "$work/out")"
must info chain.ktx2 --json --header
near "roughness" "$(all roughness)" "0 0.125 0.25 0.375 0.5 0.625 0.75 0.875 1 " 0
checks=$((checks + 1))
for wanted in '"lobe": "ggx"' '"roughness_curve": "linear"' '"normalisation": "radiance"' '"parameterization": "cube:layers"' '"faces": 6'; do
  grep -qF -- "$wanted" "$work/out" || fail "info lacks $wanted"
done

# ---- against brute force
for source in studio lamps; do
  bake $source.exr verified.ktx2 --size 64 --json --verify=32
  each relative_rmse 0 0.001
  # Of dark texels beside lamps.
  chain max_relative 0.2 0.02
  each furnace 0 2e-5
  near "energy of the filtered levels" "$(all energy | cut -d ' ' -f 2-)" "1 1 1 1 1 1 " 1e-4
  near "random texels" "$(all random_texels)" "32 32 32 32 32 24 6 " 0
  each hot_texels 1 100
  checks=$((checks + 1))
  for key in read plan compute verify write; do [[ -n $(all $key) ]] || fail "no $key among the seconds"; done
done
bake studio.exr verified.ktx2 --size 16 --verify
checks=$((checks + 1))
grep -qE '^level +size  roughness  method +rel. RMSE % +max % +energy +furnace$' "$work/out" || fail "no columns: $(cat "$work/out")"
grep -qE '^    0 +16×16 +0 +resample +[-+0-9.e]+ +[-+0-9.e]+ +[0-9.]+ +[-+0-9.e]+$' "$work/out" || fail "a mirror is not verified: $(cat "$work/out")"
# Tolerances in both ways of writing.
bake studio.exr loose.ktx2 --size 16 --tolerance "10 %"
bake studio.exr loose.ktx2 --size 16 --tolerance 0.05

# The same file from any number of threads, and with a bar.
bake studio.exr again.ktx2 -j 1
checks=$((checks + 1))
cmp -s chain.ktx2 again.ktx2 || fail "one thread makes another file"
run bake studio.exr again.ktx2 --size 32 --verify --progress always
checks=$((checks + 1))
((status == 0)) && grep -q 'bake \[=*\] 100 %' "$work/messages" && grep -q 'verify \[=*\] 100 %' "$work/messages" ||
  fail "no progress bars: $(cat "$work/messages")"

# ---- files
bake studio.exr chain.exr
same chain.ktx2 chain.exr 0
matches '^  level 3           charts 32×32, roughness 0.375,' info chain.exr
bake studio.exr packed.ktx2 --compression zstd
same chain.ktx2 packed.ktx2 0
bake studio.exr packed.exr --compression zip --to cube:hcross
same chain.ktx2 packed.exr 0
while read -r format tolerance; do
  bake studio.exr small.ktx2 --size 32
  bake studio.exr typed.ktx2 --size 32 --format "$format"
  same small.ktx2 typed.ktx2 "$tolerance"
done <<'END'
rgba32f 0
rgba16f 1e-3
rgb9e5 4e-3
r11g11b10 2e-2
END
for name in any.hdr any.pfm any.png any.tif any.ktx2 any.exr; do
  run bake studio.exr $name --lobe lambert --size 16
  checks=$((checks + 1))
  ((status == 0)) || fail "bake into $name: $(cat "$work/messages")"
done
same any.exr any.pfm 0 --from cube
same any.exr any.hdr 1e-2

# ---- which way the world lies: the middle of each side of the card, and each level's brightest side
wide=()
for to in cube octahedral latlong healpix paraboloid; do
  bake card.exr turned.ktx2 --to $to --levels 2 --size $([[ $to == latlong ]] && echo 512 || echo 128)
  for d in "${axes[@]}"; do
    near "card in $to along $d" "$(sample_along turned.ktx2 "$d")" "${card_colour[$d]}" 0.02
    filtered=$(sample_along turned.ktx2 "$d" --level 1)
    [[ $to == cube ]] && wide[${#wide[@]}]=$filtered
  done
done
# Roughness 1 is wide, yet +X stays the reddest side and +Z the bluest.
checks=$((checks + 1))
printf '%s\n' "${wide[@]}" | awk '{ r[NR] = $1 / $2; b[NR] = $3 / $1 } END {
  for (i = 1; i <= 6; ++i) { if (r[i] > r[1] || b[i] > b[5]) exit 1 } }' || fail "sides of the filtered card: ${wide[*]}"
for convention in unity unreal blender three.js; do
  bake card.exr baked.ktx2 --levels 1 --size 64 --convention $convention
  must convert card.exr converted.ktx2 --to cube --size 64 --convention $convention
  same converted.ktx2 baked.ktx2 0.02 --from-convention native
  near "card for $convention" "$(sample_along baked.ktx2 0,0,1)" "${card_colour[0,0,1]}" 0.02
done
bake card.exr baked.ktx2 --levels 1 --size 64 --convention unity --rotate 90,20,10
must convert card.exr converted.ktx2 --to cube --size 64 --convention unity --rotate 90,20,10
same converted.ktx2 baked.ktx2 0.02
bake card.exr baked.ktx2 --levels 3 --size 64 --rotate 90,0,0
near "--rotate" "$(sample_along baked.ktx2 1,0,0)" "${card_colour[0,0,1]}" 0.02
bake card.exr plain.ktx2 --levels 3 --size 64
near "--rotate at level 1" "$(sample_along baked.ktx2 1,0,0 --level 1)" "$(sample_along plain.ktx2 0,0,1 --level 1)" 1e-4
bake card.exr bright.ktx2 --levels 3 --size 64 --exposure 1
near "--exposure" "$("$welkin" diff plain.ktx2 bright.ktx2 --level 1 --json | number energy_ratio)" 2 1e-6

# ---- lobes
bake studio.exr diffuse.exr --lobe lambert
matches '^  parameterization  cube:hcross .*charts 6×64×64$' info diffuse.exr --header
matches '^  welkin.lobe +lambert$' info diffuse.exr --header
bake studio.exr diffuse.exr --lobe lambert --to latlong
matches '^  parameterization  latlong .*charts 1×40×20$' info diffuse.exr --header
bake studio.exr phong.exr --lobe phong,exponent=50 --verify --json
near "phong's roughness" "$(all roughness)" "0.02 " 1e-12
each relative_rmse 0 0.001
bake studio.exr phong.ktx2 --lobe phong --roughness 0.1,0.5 --json --verify
near "levels of a list" "$(all roughness)" "0.1 0.5 " 0
each relative_rmse 0 0.001
bake studio.exr rough.exr --lobe ggx,roughness=0.5
bake studio.exr list.ktx2 --size 64 --roughness 0.5
near "one lobe is a list of one" "$(sample_along rough.exr 1,2,3)" "$(sample_along list.ktx2 1,2,3)" 1e-4
bake studio.exr sheen.ktx2 --lobe charlie --size 64 --json
near "charlie has no mirror" "$(all roughness | cut -d ' ' -f 1)" 0.0833333 1e-6
for curve in filament unity unreal three.js three.js-r186 godot babylon playcanvas cesium bevy; do
  bake studio.exr curve.ktx2 --size 32 --roughness $curve
  matches "^  welkin.roughness-curve +$curve\$" info curve.ktx2 --header
done
bake studio.exr curve.ktx2 --size 32 --roughness unreal --level0 source --json
near "--level0 source" "$(all roughness | cut -d ' ' -f 1)" 0 0
printf '0 1\n40 1\n60 0\n' >hat.txt
bake studio.exr table.exr --lobe table,file=hat.txt --verify --json
each relative_rmse 0 0.001
# The integral of Lambert's lobe is π.
bake one.exr average.exr --lobe lambert
bake one.exr integral.exr --lobe lambert --normalisation integral --verify --json
each max_relative 0 0.001
near "irradiance" "$("$welkin" diff average.exr integral.exr --json | number energy_ratio)" 3.14159265 1e-4
matches '^  welkin.normalisation integral$' info integral.exr --header

# ---- a constant map stays constant
bake one.exr constant.ktx2 --size 32 --to octahedral
for level in 0 1 2 3 4 5; do
  near "a constant at level $level" "$(sample_along constant.ktx2 0.3,-0.5,0.8 --level $level)" "$(sample_along one.exr 0.3,-0.5,0.8)" 1e-5
done

# ---- odd sizes and shapes
# Of so few texels a mirror misses the tolerance, beside lights and at rims, and that is told.
must synth studio odd.exr --size 37x19
says 'odd.ktx2: level 0: the relative RMSE, [0-9.]+ %, is above the tolerance, 0.1 %$' bake odd.exr odd.ktx2 --size 33 --verify --json
chain relative_rmse 0.01 0.001
says 'odd.ktx2: level 0: the relative RMSE, [0-9.]+ %, is above the tolerance, 0.1 %$' bake odd.exr odd.ktx2 --to latlong --size 41x23 --verify --json
chain relative_rmse 0.01 0.001
# Where a map ends in a texel, a mirror's is found by points.
for to in octahedral cube equal-area mirror-ball cylinder,fov=170; do
  must synth studio source.exr --to $to --size 49
  run bake source.exr target.ktx2 --size 20 --levels 3 --verify=16 --json
  checks=$((checks + 1))
  ((status == 0)) || fail "bake from $to: $(cat "$work/messages")"
  chain relative_rmse 0.03 0.001
done
must synth studio part.exr --to fisheye-equidistant --size 64
says 'part.exr: shows 50.0 % of the sphere; the rest is black$' bake part.exr part.ktx2 --size 16
# Behind it there is nothing; Lambert's lobe toward the middle of a half sees nothing else.
near "behind a fisheye" "$(sample_along part.ktx2 0,0,-1 --level 1 | awk '{ print ($1 < 1e-3) }')" 1 0
must synth constant half.exr --to fisheye-equidistant --size 256
says 'half.exr' bake half.exr half-light.exr --lobe lambert
near "half a sphere of light" "$(sample_along half-light.exr 0,0,1 | cut -d ' ' -f 1) $(sample_along half-light.exr 1,0,0 | cut -d ' ' -f 1)" "1 0.5" 2e-3
must synth studio pixel.exr --size 1x1
bake pixel.exr pixel.ktx2 --size 4
bake pixel.exr pixel.hdr --lobe lambert --size 1
bake studio.exr single.ktx2 --size 1

# A level of a file with several.
bake chain.ktx2 again.exr --level 1 --lobe lambert
refuses 2 '--level: chain.ktx2: has levels 0…8, not 9' bake chain.ktx2 no.exr --level 9

# ---- hostile values
must synth sun sun.exr --size 128 --intensity 1e9 --angle 10
must convert sun.exr hot.exr --exposure 69.5
bake hot.exr hot.ktx2 --size 32 --verify --json
each relative_rmse 0 0.001
each energy 0.5 2
says 'hot.ktx2: [0-9]+ values were above what the file can hold, and clipped$' bake hot.exr hot.ktx2 --size 32 --format rgba16f
must convert sun.exr hotter.exr --exposure 71
refuses 1 'hotter.exr: [0-9]+ texels have values of over 1e\+30, too large to filter$' bake hotter.exr no.ktx2
must convert one.exr black.exr --scale 0
bake black.exr black.ktx2 --size 16 --verify --json
each relative_rmse 0 0
each max_relative 0 0
near "black stays black" "$(sample_along black.ktx2 1,2,3 --level 2)" "0 0 0" 0
must convert studio.exr negative.exr --scale -1
says 'negative.exr: [0-9]+ texels have negative values; they darken what is filtered, at most to 0$' bake negative.exr negative.ktx2 --size 16
near "negative light" "$(sample_along negative.ktx2 1,2,3 --level 3 | awk '{ print ($1 <= 0 && $2 <= 0 && $3 <= 0) }')" 1 0
run bake negative.exr no.ktx2 --size 16 --format rgb9e5
checks=$((checks + 1))
grep -q 'no.ktx2: [0-9]* values were negative, and are 0 in the file$' "$work/messages" || fail "lost negative values: $(cat "$work/messages")"
# A row of NaN, infinite and sane texels, bottom to top.
{
  printf 'PF\n4 2\n-1.0\n'
  for ((i = 0; i < 8; ++i)); do
    case $i in
      1) printf '\x00\x00\xc0\x7f\x00\x00\x80\x3f\x00\x00\x80\x3f' ;;
      6) printf '\x00\x00\x80\x3f\x00\x00\x80\x7f\x00\x00\x80\xff' ;;
      *) printf '\x00\x00\x80\x3f\x00\x00\x80\x3f\x00\x00\x80\x3f' ;;
    esac
  done
} >sick.pfm
refuses 1 'sick.pfm: 2 texels have NaN or infinite values; --sanitize repairs them$' bake sick.pfm no.ktx2
says 'sick.pfm: 2 texels with NaN or infinite values filled$' bake sick.pfm repaired.ktx2 --size 8 --sanitize
near "repaired" "$(sample_along repaired.ktx2 1,2,3 --level 1)" "1 1 1" 1e-5
# Alpha is not light: it is left out, unless it's named.
bake card.exr rgb.ktx2 --size 16
sed 's/welkin\.channels/welkin.channelz/' rgb.ktx2 >rgba.ktx2
matches 'channel A' info rgba.ktx2
bake rgba.ktx2 alpha.exr --lobe lambert
matches '^  picture +[0-9×]+, R G B of float' info alpha.exr --header
bake rgba.ktx2 alpha.exr --lobe lambert --channels R,G,B,A
matches '^  picture +[0-9×]+, R G B A of float' info alpha.exr --header

# ---- requests that make no sense
refuses 2 "--lobe: unknown lobe 'gx'; did you mean 'ggx'" bake card.exr no.ktx2 --lobe gx
refuses 2 '--lobe: ggx: roughness=2 is not a number in 0…1' bake card.exr no.ktx2 --lobe ggx,roughness=2
refuses 2 '--lobe: lambert takes no parameters' bake card.exr no.ktx2 --lobe lambert,x=1
refuses 2 '--lobe: missing.txt: ' bake card.exr no.ktx2 --lobe table,file=missing.txt
printf '0 0\n90 0\n' >dark.txt
refuses 2 '--lobe: dark.txt: ' bake card.exr no.ktx2 --lobe table,file=dark.txt
printf '0 1\n90 nan\n' >nan.txt
refuses 2 '--lobe: nan.txt' bake card.exr no.ktx2 --lobe table,file=nan.txt
refuses 2 "--roughness: the roughness '1.5' is not a number in 0…1" bake card.exr no.ktx2 --roughness 0,1.5
refuses 2 "--roughness: the roughness '-0.1' is not a number in 0…1" bake card.exr no.ktx2 --roughness=-0.1,1
refuses 2 "--roughness: the roughness 0.2 is below the one before" bake card.exr no.ktx2 --roughness 0.5,0.2
refuses 2 "--roughness: unknown roughness curve 'liner'; did you mean 'linear'" bake card.exr no.ktx2 --roughness liner
refuses 2 "--roughness: the list 0,0.5 has 2 roughnesses for 3 levels" bake card.exr no.ktx2 --roughness 0,0.5 --levels 3
refuses 2 '--roughness: charlie: roughness=0 is not a number in 0.01…1' bake card.exr no.ktx2 --lobe charlie --roughness 0,1
refuses 2 '--roughness: lambert is one lobe, and makes one map$' bake card.exr no.ktx2 --lobe lambert --roughness linear
refuses 2 '--levels: ggx,roughness=0.3 is one lobe, and makes one map; for a chain write --lobe ggx$' bake card.exr no.ktx2 --lobe ggx,roughness=0.3 --levels 3
refuses 2 '--level0: vmf is one lobe' bake card.exr no.ktx2 --lobe vmf --level0 source
refuses 2 'no.ktx2: charts of 64x64 have 7 levels, not 8$' bake card.exr no.ktx2 --size 64 --levels 8
refuses 2 '--levels: Value 0 not in range' bake card.exr no.ktx2 --levels 0
refuses 2 'no.hdr: holds one level, not 9: write EXR or KTX2$' bake card.exr no.hdr
refuses 2 'no.exr: cube:vstrip of charts of 33x33 can be halved to 1 levels only, not 6' bake card.exr no.exr --size 33
refuses 2 'no.ktx2: levels take no safety border$' bake card.exr no.ktx2 --border 2
refuses 2 "--to: unknown parameterization 'cub'" bake card.exr no.ktx2 --to cub
refuses 2 "--size: 'x' is not a size" bake card.exr no.ktx2 --size x
for tolerance in 0 5 -1 nan x 1e-7 0.00001% % "1 2%"; do
  refuses 2 "--tolerance: '$tolerance' is not in 1e-06…0.1: write 0.001 or 0.1%$" bake card.exr no.ktx2 --tolerance="$tolerance"
done
refuses 2 '--verify: Value 0 not in range' bake card.exr no.ktx2 --verify=0
refuses 2 '--verify' bake card.exr no.ktx2 --verify=many
refuses 2 '--format: rgba8 not in' bake card.exr no.ktx2 --format rgba8
refuses 2 '--format: --type says the same' bake card.exr no.ktx2 --format rgba16f --type half
refuses 2 "--filter: unknown filter 'cubic'" bake card.exr no.ktx2 --filter cubic
refuses 2 "--convention: unknown convention 'unty'; did you mean 'unity'" bake card.exr no.ktx2 --convention unty
refuses 2 "unknown option '--levls'; did you mean '--level" bake card.exr no.ktx2 --levls 3
refuses 2 "OUT is required" bake card.exr
refuses 2 "no.abc: " bake card.exr no.abc
refuses 1 "missing.exr: No such file or directory" bake missing.exr no.ktx2
refuses 1 "none/no.ktx2: No such file or directory" bake card.exr none/no.ktx2
refuses 1 "no.hdr: .*holds no" bake card.exr no.hdr --lobe lambert --size 8 --type uint8
ln -sf /dev/full full.ktx2
refuses 1 "full.ktx2: No space left on device" bake card.exr full.ktx2 --size 32

# ---- Ctrl-C while computing leaves nothing, and an older file as it was
cp chain.ktx2 old.ktx2
for when in "--verify=1000000 --size 64" "--lobe lambert --size 2048"; do
  checks=$((checks + 1))
  before=$(inventory) status=0
  set -m # else the shell has its background processes ignore SIGINT
  # shellcheck disable=SC2086
  "$welkin" bake studio.exr old.ktx2 $when -j 1 >"$work/out" 2>"$work/messages" &
  process=$!
  set +m
  sleep 0.2
  if kill -INT $process 2>/dev/null; then
    begin=$(date +%s%N)
    wait $process 2>/dev/null || status=$?
    took=$((($(date +%s%N) - begin) / 1000000))
    ((status == 130)) || fail "Ctrl-C: status $status, $(cat "$work/messages")"
    ((took < 1000)) || fail "Ctrl-C: took $took ms"
    [[ $before == "$(inventory)" ]] || fail "Ctrl-C leaves or changes files: $(ls -A)"
  else
    fail "bake $when had ended before Ctrl-C"
  fi
done

finish
