#!/usr/bin/env bash
# Bakes the general set of a built-in HDR map: files for a renderer, with a page that shows them, their errors against brute force, and a
# ball lit by them in the browser. The page works offline.
#
# demo.sh WELKIN OUTPUT_FOLDER
set -euo pipefail

(($# == 2)) || { printf 'usage: demo.sh WELKIN OUTPUT_FOLDER\n' >&2; exit 2; }
welkin=$(cd -- "$(dirname -- "$1")" && pwd -P)/$(basename -- "$1")
[[ -x $welkin ]] || { printf 'demo: %s is not a program\n' "$1" >&2; exit 1; }
mkdir -p -- "$2"
cd -- "$2"

# step ARGUMENT…: welkin ARGUMENT…, told first.
step() {
  printf '\n$ welkin %s\n' "$*"
  "$welkin" "$@"
}

step synth room room.exr --size 1024
step bake room.exr room/ --verify

page=$PWD/room/index.html
printf '\nThe page is %s: open it in a browser.\n' "$page"
if [[ -t 1 && -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && command -v xdg-open >/dev/null; then xdg-open "$page" || true; fi
