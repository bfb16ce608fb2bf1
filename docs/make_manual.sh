#!/usr/bin/env bash
# Makes the manual of the library, as HTML, of the headers in src/welkin/public_headers.txt and docs/library.md. Fails on any warning of
# doxygen, and prints it: what is public has its contract.
#
# make_manual.sh OUT      OUT/html/index.html
set -euo pipefail
export LC_ALL=C.UTF-8

(($# == 1)) || { printf 'usage: make_manual.sh OUT\n' >&2; exit 2; }
mkdir -p -- "$1"
out=$(cd -- "$1" && pwd -P)
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

{
  cat docs/Doxyfile
  printf 'OUTPUT_DIRECTORY = "%s"\n' "$out"
  printf 'INPUT = docs/library.md'
  sed -nE 's,^[a-z].*,src/welkin/&,p' src/welkin/public_headers.txt | while IFS= read -r header; do printf ' "%s"' "$header"; done
  printf '\n'
} | doxygen -
