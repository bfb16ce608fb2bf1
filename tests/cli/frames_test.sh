#!/usr/bin/env bash
# bake of numbered frames: every frame, key frames with those between, chains, faces; gaps, other sizes, bad values, bad
# requests; going on after an interruption.
#
# frames_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# values KEY: the numbers in the array of that key in the output, on one line.
values() { tr -d '\n ' <"$work/out" | grep -oE "\"$1\":\[[^]]*\]" | head -n 1 | grep -oE '[0-9]+' | tr '\n' ' '; }

# is WHAT FOUND WANTED: two texts agree.
is() {
  checks=$((checks + 1))
  [[ $2 == "$3" ]] || fail "$1: '$2', not '$3'"
}

# A sky that turns: frames 1 to 21.
mkdir sky out
for frame in {1..21}; do
  "$welkin" synth sky "$(printf 'sky/f_%04d.hdr' "$frame")" --size 64 --samples 1 --azimuth $((4 * frame))
done
diffuse=(--lobe lambert --to latlong)

# ---- every frame is what bake makes of it alone
must bake sky/f_%04d.hdr out/d_%03d.exr "${diffuse[@]}"
is "files" "$(cd out && echo *)" "$(for f in {1..21}; do printf 'd_%03d.exr ' "$f"; done | sed 's/ $//')"
must bake sky/f_0007.hdr alone.exr "${diffuse[@]}"
same out/d_007.exr alone.exr 0
must bake 'sky/f_####.hdr' 'out/e_##.exr' "${diffuse[@]}" --frames 7-8
same out/e_07.exr alone.exr 0
is "frames of a range" "$(cd out && echo e_*)" "e_07.exr e_08.exr"

# ---- key frames, and those between
must bake sky/f_%04d.hdr out/k_%d.exr "${diffuse[@]}" --every 10 --json
is "baked" "$(values baked)" "1 11 21 "
is "interpolated" "$(values interpolated)" "2 3 4 5 6 7 8 9 10 12 13 14 15 16 17 18 19 20 "
is "held out" "$(grep -oE '"frame": [0-9]+' "$work/out" | tr '\n' ' ')" '"frame": 6 "frame": 16 '
worst=$(grep -oE '"relative_rmse": [^,]+' "$work/out" | sed 's/.*: //' | sort -g | tail -n 1)
checks=$((checks + 1))
awk -v e="$worst" 'BEGIN { exit !(e > 1e-4 && e < 0.2) }' || fail "the error of interpolating is $worst"
for key in read plan filter interpolate write all; do
  checks=$((checks + 1))
  grep -q "\"$key\": [0-9]" "$work/out" || fail "no $key among the seconds"
done
same out/k_11.exr out/d_011.exr 0
# The error that was told is the one that diff finds.
run diff out/d_006.exr out/k_6.exr --json
near "the error of frame 6" "$(number relative_rmse <"$work/out")" "$worst" 0.01
matches 'frames 1–21: 3 baked, 18 interpolated' bake sky/f_%04d.hdr out/k_%d.exr "${diffuse[@]}" --every 10
matches 'interpolating: rel. RMSE .* of frame (6|16) \(held out: 6, 16\)' bake sky/f_%04d.hdr out/k_%d.exr "${diffuse[@]}" --every 10
must bake sky/f_%04d.hdr out/o_%d.exr "${diffuse[@]}" --every 10 --keys-only --held-out 0
is "key frames alone" "$(cd out && echo o_*)" "o_1.exr o_11.exr o_21.exr"

# ---- chains in textures
must bake sky/f_%04d.hdr out/c_%04d.ktx2 --size 16 --every 4 --frames 1-9 --format rgba16f
must info out/c_0003.ktx2 --header
checks=$((checks + 1))
grep -q '5 levels' "$work/out" && grep -qE '^  welkin.frame +0.5\*1 \+ 0.5\*5 ' "$work/out" || fail "no chain: $(cat "$work/out")"

# ---- %s stays a face's name; a file that is really called so is one map
for frame in 1 2; do
  must convert sky/f_000$frame.hdr "faces_0${frame}_%s.png" --to cube:faces --size 16 --exposure -8 -q
done
must bake 'faces_%02d_%s.png' out/faces_%02d.ktx2 --size 8
is "faces" "$(cd out && echo faces_*)" "faces_01.ktx2 faces_02.ktx2"
cp sky/f_0001.hdr odd_%02d.hdr
must bake odd_%02d.hdr odd_%02d.exr "${diffuse[@]}"
same odd_%02d.exr out/d_001.exr 0

# ---- going on
must bake sky/f_%04d.hdr out/k_%d.exr "${diffuse[@]}" --every 10 --resume --json
is "complete" "$(values complete)" "$(echo {1..21}) "
rm out/k_11.exr out/k_12.exr
must bake sky/f_%04d.hdr out/k_%d.exr "${diffuse[@]}" --every 10 --resume --json
is "baked again" "$(values baked) and $(values interpolated)" "11  and 12 "
must bake sky/f_%04d.hdr out/k_%d.exr "${diffuse[@]}" --every 10 --resume --json --exposure 1
is "made again for another request" "$(values complete)" ""
must bake sky/f_%04d.hdr out/k_%d.exr "${diffuse[@]}" --every 10 --resume --json --exposure 1 -j 1
is "complete" "$(values complete)" "$(echo {1..21}) "
touch sky/f_0021.hdr
must bake sky/f_%04d.hdr out/k_%d.exr "${diffuse[@]}" --every 10 --resume --json --exposure 1
is "what depends on a newer frame" "$(values baked) and $(values interpolated)" "21  and $(echo {12..20}) "
refuses 1 'PFM holds no text' bake sky/f_%04d.hdr k_%d.pfm "${diffuse[@]}" --resume

# An interruption leaves whole frames and nothing else.
mkdir cut
status=0
set -m # else the shell has its background processes ignore SIGINT
"$welkin" bake sky/f_%04d.hdr cut/c_%d.ktx2 --size 512 >/dev/null 2>"$work/messages" &
pid=$!
for ((i = 0; i < 1000; ++i)); do
  [[ -e cut/c_1.ktx2 ]] && break
  sleep 0.02
done
kill -INT "$pid"
wait "$pid" || status=$?
set +m
is "status of an interruption" "$status" 130
is "unfinished files" "$(find cut -name '.*' -type f)" ""
for file in cut/*; do must info "$file"; done

# A bar with all frames.
run bake sky/f_%04d.hdr out/d_%03d.exr "${diffuse[@]}" --progress always
checks=$((checks + 1))
((status == 0)) && grep -q 'bake \[=*\] 100 %' "$work/messages" || fail "no progress bar: $(cat "$work/messages")"

# ---- what can't be done is told before any work
rm sky/f_0003.hdr sky/f_0005.hdr sky/f_0006.hdr
refuses 1 'f_%04d.hdr: frames 3, 5–6 are missing of 1–21: ask for a range without gaps$' \
  bake sky/f_%04d.hdr n_%d.exr "${diffuse[@]}"
refuses 1 'frame 3 is missing of 1–4:' bake sky/f_%04d.hdr n_%d.exr "${diffuse[@]}" --frames 1-4
refuses 1 'frame 5 is missing of key frames 1, 5, 9,' bake sky/f_%04d.hdr n_%d.exr "${diffuse[@]}" --every 4
must bake sky/f_%04d.hdr n_%d.exr "${diffuse[@]}" --every 3 --frames 1-21
refuses 1 'none_%04d.hdr: no file is called so, with a number for %04d' bake none_%04d.hdr n_%d.exr "${diffuse[@]}"
refuses 1 'No such file or directory' bake gone/f_%04d.hdr n_%d.exr "${diffuse[@]}"
refuses 1 'No such file or directory' bake sky/f_%04d.hdr gone/n_%d.exr "${diffuse[@]}" --frames 7-9
cp sky/f_0007.hdr g_0007.hdr
refuses 1 'g_0007.hdr: would be written over a source' bake g_%04d.hdr ./g_%04d.hdr "${diffuse[@]}"
refuses 1 'g_0007.hdr: would be written over a source' bake g_%04d.hdr 'g_####.hdr' "${diffuse[@]}"
"$welkin" synth sky sky/f_0009.hdr --size 32 --samples 1
refuses 1 'f_0009.hdr: is 32×16, but f_0007.hdr is 64×32' bake sky/f_%04d.hdr m_%d.exr "${diffuse[@]}" --frames 7-12
head -c 100 sky/f_0010.hdr >cut.hdr
cp cut.hdr sky/f_0009.hdr
refuses 1 'f_0009.hdr: ' bake sky/f_%04d.hdr m_%d.exr "${diffuse[@]}" --frames 7-12
refuses 2 'OUT: one.exr: has no place' bake sky/f_%04d.hdr one.exr "${diffuse[@]}"
refuses 2 'has a place for a frame.s number, %d, but alone.exr is one map' bake alone.exr one_%d.exr "${diffuse[@]}"
refuses 2 '--every: is for numbered frames' bake alone.exr one.exr "${diffuse[@]}" --every 2
refuses 2 '--resume: is for numbered frames' bake alone.exr one.exr "${diffuse[@]}" --resume
refuses 2 '--verify: is for one map' bake sky/f_%04d.hdr m_%d.exr "${diffuse[@]}" --verify
refuses 2 "--frames: '9-7' goes down" bake sky/f_%04d.hdr m_%d.exr "${diffuse[@]}" --frames 9-7
refuses 2 "--frames: 'all' is no range" bake sky/f_%04d.hdr m_%d.exr "${diffuse[@]}" --frames all
refuses 2 'two places' bake sky/f_%04d.hdr %d_%d.exr "${diffuse[@]}"
refuses 2 'holds one level, not' bake sky/f_%04d.hdr m_%d.hdr

# ---- a frame that can't be filtered: those before it are kept
mkdir bad
for frame in 1 2 3 4; do "$welkin" synth constant bad/f_$frame.exr --size 8; done
# One value becomes a NaN: the file is uncompressed, and ends with the last texel's.
"$welkin" convert bad/f_1.exr bad/plain.pfm
head -c -4 bad/plain.pfm >bad/nan.pfm
printf '\377\377\377\177' >>bad/nan.pfm
"$welkin" convert bad/nan.pfm bad/f_3.exr --filter nearest
run bake bad/f_%d.exr bad/d_%d.exr "${diffuse[@]}"
checks=$((checks + 1))
((status == 1)) && grep -qE 'bad/f_3.exr: [0-9]+ texels have NaN or infinite values; [23] of 4 frames are finished; --sanitize' \
  "$work/messages" || fail "status $status: $(cat "$work/messages")"
must info bad/d_1.exr
must info bad/d_2.exr
checks=$((checks + 1))
[[ ! -e bad/d_3.exr ]] || fail "a frame with NaN was written"
run bake bad/f_%d.exr bad/d_%d.exr "${diffuse[@]}" --sanitize
checks=$((checks + 1))
((status == 0)) && grep -q 'bad/f_%d.exr: 1 texels with NaN or infinite values filled' "$work/messages" ||
  fail "status $status: $(cat "$work/messages")"

finish
