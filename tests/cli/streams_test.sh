#!/usr/bin/env bash
# `-` is standard input and standard output: the same bytes as of files, and nothing else among them.
#
# streams_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# streams STDIN ARGUMENT…: welkin writes standard output, kept in $work/stream, and has nothing to say about it.
streams() {
  local from=$1
  shift
  checks=$((checks + 1)) status=0
  timeout 60 "$welkin" "$@" <"$from" >"$work/stream" 2>"$work/messages" || status=$?
  ((status == 0)) || fail "welkin $* <$from: status $status: $(head -n 3 -- "$work/messages")"
  # What else a command prints goes to standard error; messages don't come.
  ! grep -q '^welkin: ' "$work/messages" || fail "welkin $* <$from: $(head -n 3 -- "$work/messages")"
}
# equals FILE: what was streamed has the file's bytes.
equals() {
  checks=$((checks + 1))
  cmp -s -- "$1" "$work/stream" || fail "standard output is another file than $1"
}

must synth axes map.exr --size 64
for format in exr hdr png pfm tif ktx2 webp; do
  must synth axes file.$format --size 32
  streams /dev/null synth axes - --size 32 --format $format
  equals file.$format
  # `welkin synth … | welkin convert - -`, and the converted file.
  must convert file.$format converted.pfm --to cube
  cat "$work/stream" >streamed
  streams streamed convert - - --to cube --format pfm
  equals converted.pfm
  checks=$((checks + 1))
  "$welkin" synth axes - --size 32 --format $format | "$welkin" info - >"$work/out" 2>"$work/messages" || fail "welkin synth … | welkin info -: $(cat "$work/messages")"
  [[ $(head -n 1 "$work/out") == "standard input" ]] && diff <(tail -n +2 "$work/out") <("$welkin" info file.$format | tail -n +2) >/dev/null || fail "info of $format differs: $(cat "$work/out")"
done

must bake map.exr baked.ktx2 --size 16 --type half
streams map.exr bake - - --size 16 --format ktx2 --type half
equals baked.ktx2
grep -q '^standard output.ktx2: ggx' "$work/messages" || fail "the report of bake is lost: $(cat "$work/messages")"
must plot mips map.exr mips.png
streams map.exr plot mips - - --format png
equals mips.png
must plot density density.png --of cube
streams /dev/null plot density - --of cube --format png
equals density.png
must plot lobe lobe.png --lobe ggx
streams /dev/null plot lobe - --lobe ggx --format png
equals lobe.png
must convert map.exr other.exr --exposure 1
must diff map.exr other.exr --heat heat.png
streams other.exr diff map.exr - --heat - --format png
equals heat.png

# Maps to measure, from a pipe too, and from where a file stands.
checks=$((checks + 3))
"$welkin" diff - map.exr --fail-above 0 <map.exr >/dev/null || fail "diff - map.exr"
[[ $("$welkin" sample - --dir 0,0,1 <map.exr) == "$(sample_along map.exr 0,0,1)" ]] || fail "sample -"
{ printf 'line\n'; cat map.exr; } >behind
{ read -r _; "$welkin" diff - map.exr --fail-above 0 >/dev/null; } <behind || fail "a file that was read from already"
# What is damaged is so by this name.
checks=$((checks + 2))
"$welkin" info - </dev/null >"$work/out" 2>"$work/messages" && fail "nothing is a map"
grep -q '^welkin: standard input: the file is empty$' "$work/messages" || fail "an empty input: $(cat "$work/messages")"
"$welkin" info - <&- >"$work/out" 2>"$work/messages" && fail "a closed input is a map"
grep -q '^welkin: standard input: ' "$work/messages" || fail "a closed input: $(cat "$work/messages")"

# A file may be called so.
must synth axes ./-.exr --size 8
cp ./-.exr ./-
matches '^\./-$' info ./-

refuses 2 '-: name the format to write to standard output with --format' convert map.exr -
refuses 2 '-: name the format' synth axes -
refuses 2 '-: name the format' bake map.exr -
refuses 2 '-: name the format' bake map.exr - --format rgba16f
refuses 2 '-: name the format' plot density - --of cube
refuses 2 '-: name the format' diff map.exr other.exr --heat -
refuses 2 "--format: unknown extension 'pngg'; did you mean 'png'" convert map.exr - --format pngg
refuses 2 '--format: .* is only read' convert map.exr - --format jxl
refuses 2 '--format: is for standard output' convert map.exr out.exr --format exr
refuses 2 '-: standard input holds one file' diff - -
refuses 2 '-: standard input holds one file' info - map.exr -
refuses 2 '-: standard input holds the map, not the directions' sample -
refuses 2 '--verify: reads what was written' convert map.exr - --format exr --verify
refuses 2 'put %s in the name' convert map.exr - --format exr --to cube:faces

# Nothing comes where nothing can be made; what doesn't fit or has left is told.
checks=$((checks + 2)) status=0
printf 'no picture' | "$welkin" convert - - --format exr >"$work/out" 2>"$work/messages" || status=$?
((status == 1)) && [[ ! -s $work/out ]] && grep -q '^welkin: standard input: not an image' "$work/messages" || fail "a wrong input: status $status, $(cat "$work/messages")"
status=0
"$welkin" convert map.exr - --format exr >/dev/full 2>"$work/messages" || status=$?
((status == 1)) && grep -q '^welkin: standard output.exr: No space left on device$' "$work/messages" || fail "a full disk: status $status, $(cat "$work/messages")"
checks=$((checks + 1)) status=0
"$welkin" convert map.exr - --format exr >&- 2>"$work/messages" || status=$?
((status == 1)) && grep -q '^welkin: standard output.exr: ' "$work/messages" || fail "a closed output: status $status, $(cat "$work/messages")"
if command -v script >/dev/null; then
  checks=$((checks + 1))
  script -qec "'$welkin' convert map.exr - --format exr" /dev/null </dev/null >"$work/out" 2>&1 || true
  grep -q 'standard output is a terminal' "$work/out" || fail "a terminal gets $(head -c 200 "$work/out")"
fi

finish
