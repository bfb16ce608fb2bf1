#!/usr/bin/env bash
# Outputs appear whole or not at all: unwritable places, full disks, signals, closed streams; an older file of that name survives every
# failure.
#
# output_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes map.exr --size 32
must synth axes card.exr --size 64
must convert map.exr old.exr
mkdir folder folder.exr

for command in "convert map.exr" "synth axes" "plot mips map.exr" "plot density --of cube" "diff map.exr card.exr --heat"; do
  # shellcheck disable=SC2086
  {
    refuses 1 "none/out.exr: No such file or directory" $command none/out.exr
    refuses 1 "folder.exr: Is a directory" $command folder.exr
    refuses 1 "map.exr/out.exr: Not a directory" $command map.exr/out.exr
    refuses 1 "File name too long" $command "$(printf 'x%.0s' {1..300}).exr"
    ln -sf /dev/full full.exr
    refuses 1 "full.exr: No space left on device" $command full.exr
  }
done
refuses 1 "none/out-px.exr: No such file or directory" convert map.exr none/out-%s.exr --to cube:faces
mkdir out-pz.exr
refuses 1 "out-pz.exr: Is a directory" convert map.exr out-%s.exr --to cube:faces
ln -s loop.exr loop.exr
refuses 1 "loop.exr: Too many levels of symbolic links" convert map.exr loop.exr

# A file over the size limit of the shell, as on a full disk: nothing is left and the older file is whole.
limited() (
  ulimit -f 4
  "$welkin" "$@"
)
checks=$((checks + 1))
before=$(inventory) status=0
limited convert card.exr old.exr --compression none --size 256 2>"$work/messages" || status=$?
((status == 1)) && grep -q '^welkin: old.exr: File too large$' "$work/messages" || fail "a full disk: status $status, $(cat "$work/messages")"
[[ $before == "$(inventory)" ]] || fail "a full disk leaves or changes files: $(ls -la)"

# Where only other users may write. Root may write anywhere, so this takes another user.
runner=()
if ((EUID == 0)) && command -v setpriv >/dev/null; then runner=(setpriv --reuid 65534 --regid 65534 --clear-groups); fi
cp map.exr folder/kept.exr
chmod 444 folder/kept.exr
chmod 777 folder
chmod 755 "$work" "$work/files"
if ((EUID != 0)) || "${runner[@]}" "$welkin" list >/dev/null 2>&1; then
  checks=$((checks + 2))
  before=$(inventory) status=0
  "${runner[@]}" "$welkin" convert map.exr folder/kept.exr --size 8 2>"$work/messages" || status=$?
  ((status == 1)) && grep -q '^welkin: folder/kept.exr: Permission denied$' "$work/messages" || fail "a read-only file: status $status, $(cat "$work/messages")"
  chmod 555 folder
  status=0
  "${runner[@]}" "$welkin" convert map.exr folder/new.exr --size 8 2>"$work/messages" || status=$?
  ((status == 1)) && grep -q '^welkin: folder/new.exr: Permission denied$' "$work/messages" || fail "a read-only folder: status $status, $(cat "$work/messages")"
  chmod 777 folder
  [[ $before == "$(inventory)" ]] || fail "a read-only file is replaced"
  chmod 000 folder/kept.exr
  checks=$((checks + 1)) status=0
  "${runner[@]}" "$welkin" info folder/kept.exr 2>"$work/messages" || status=$?
  ((status == 1)) && grep -q '^welkin: folder/kept.exr: Permission denied$' "$work/messages" || fail "an unreadable file: status $status, $(cat "$work/messages")"
else
  skip "cannot become another user to try read-only files"
fi

# Signals while working and while writing: the process ends with 128 + signal, nothing is left, the older file stays.
interrupted() { # SIGNAL NUMBER working|writing ARGUMENT…
  local signal=$1 number=$2 when=$3 before
  shift 3
  checks=$((checks + 1))
  before=$(inventory) status=0
  set -m # else the shell has its background processes ignore SIGINT
  "$welkin" "$@" >"$work/out" 2>"$work/messages" &
  local process=$!
  set +m
  if [[ $when == writing ]]; then
    # The unfinished file is there, and has grown beyond the trial at the start.
    while kill -0 $process 2>/dev/null && [[ -z $(find . -newer "$work/messages" -name '*tmp*' -size +8k) ]]; do sleep 0.005; done
  else
    sleep 0.4
  fi
  kill -"$signal" $process 2>/dev/null || fail "welkin $* had ended before SIG$signal"
  wait $process 2>/dev/null || status=$?
  ((status == 128 + number)) || fail "SIG$signal while $when: status $status, $(cat "$work/messages")"
  [[ $before == "$(inventory)" ]] || fail "SIG$signal while $when leaves or changes files: $(ls -A)"
}
for signal in INT:2 TERM:15 HUP:1; do
  interrupted ${signal%:*} ${signal#*:} working synth axes old.exr --size 4096 --samples 64
  interrupted ${signal%:*} ${signal#*:} writing convert map.exr old.png --size 4096 --filter nearest
  interrupted ${signal%:*} ${signal#*:} writing convert map.exr old.exr --size 4096 --compression piz --filter nearest -j 1
done

# Standard streams that are full, closed or cut off.
for command in "info map.exr" "info map.exr --json" "sample map.exr --dir 0,0,1" "diff map.exr map.exr" "plot density" "list" "help"; do
  checks=$((checks + 2)) status=0
  # shellcheck disable=SC2086
  "$welkin" $command >/dev/full 2>"$work/messages" || status=$?
  ((status == 1)) && grep -q '^welkin: standard output: cannot be written$' "$work/messages" || fail "welkin $command >/dev/full: status $status, $(cat "$work/messages")"
  status=0
  # shellcheck disable=SC2086
  "$welkin" $command >&- 2>"$work/messages" || status=$?
  ((status == 1)) && grep -q '^welkin: standard output: cannot be written$' "$work/messages" || fail "welkin $command >&-: status $status, $(cat "$work/messages")"
done
checks=$((checks + 1)) status=0
for ((i = 0; i < 20000; ++i)); do echo 1 2 3; done >many
{ "$welkin" sample map.exr <many 2>"$work/messages" || echo $? >"$work/status"; } | head -n 1 >/dev/null
[[ $(cat "$work/status") == 141 && ! -s $work/messages ]] || fail "a reader that leaves: $(cat "$work/status" "$work/messages")"
# Messages and the progress bar never end up in a file that took a closed stream's number.
must convert map.exr wanted.exr --size 256
checks=$((checks + 1))
"$welkin" convert map.exr closed.exr --size 256 --progress always <&- >&- 2>&- || fail "closed streams stop a conversion"
cmp -s wanted.exr closed.exr || fail "closed streams change a file"
# The bar shows itself only on request here, and ends its line.
checks=$((checks + 1))
run convert map.exr bar.exr --size 256 --progress always
((status == 0)) && grep -q 'convert \[=*\] 100 %' "$work/messages" && [[ -z $(tail -c 1 "$work/messages") ]] || fail "no progress bar: $(cat "$work/messages")"

# Devices and pipes are written through.
checks=$((checks + 1))
mkfifo pipe.pfm
cat pipe.pfm >from-pipe.pfm &
"$welkin" convert map.exr pipe.pfm || fail "cannot write a pipe"
wait
must convert map.exr file.pfm
cmp -s file.pfm from-pipe.pfm || fail "a pipe gets another file"
[[ -p pipe.pfm ]] || fail "the pipe is gone"

finish
