#!/usr/bin/env bash
# Programs that share nothing with ours, ktx-parse and zstddec, read the KTX2 files that we write: header, data format descriptor, keys
# and every texel. Then we read what ktx-parse writes of them. UASTC HDR is transcoded by three.js's transcoder, and is what we read.
#
# ktx2_test.sh SAMPLES FOLDER     the program ktx2_samples; a folder of the build for the packages
set -euo pipefail

(($# == 2)) && [[ -x $1 ]] || { printf 'usage: %s SAMPLES FOLDER\n' "$0" >&2; exit 2; }
samples=$(realpath -- "$1")
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
mkdir -p -- "$2"
cd -- "$2"

fail() {
  printf 'ktx2_test.sh: %s\n' "$*" >&2
  exit 1
}

for program in node npm; do
  command -v "$program" >/dev/null || fail "$program is not installed (Debian's packages nodejs and npm; ./dev packages installs them)"
done

# The packages of the lock file, once for each version of it.
if ! cmp -s -- "$here/package-lock.json" installed-lock.json; then
  cp -- "$here/package.json" "$here/package-lock.json" .
  npm ci --no-audit --no-fund >npm.log 2>&1 ||
    fail "npm cannot install ktx-parse, three and zstddec, which needs the network once in a build folder: $(grep -im 2 "^npm err" npm.log)"
  cp -- package-lock.json installed-lock.json
fi
cp -- "$here/check.mjs" "$here/uastc.mjs" .

rm -rf samples
mkdir samples
"$samples" write samples
node check.mjs samples

compared=0
for again in samples/*.again.ktx2; do
  "$samples" compare "${again%.again.ktx2}.ktx2" "$again" || fail "$again does not hold what ktx-parse was given"
  compared=$((compared + 1))
done
printf '%d files written by ktx-parse hold the same\n' "$compared"
((compared > 0))

rm -rf uastc
mkdir uastc
"$samples" uastc uastc
node uastc.mjs uastc node_modules/three/examples/jsm/libs/basis
for blocks in uastc/*.bc6h.ktx2; do
  # BC6H has fewer bits for endpoints that are far apart, as in noise; an error in the blocks' order or endpoints would be of 1 and more.
  "$samples" near "${blocks%.bc6h.ktx2}.ktx2" "$blocks" 0.3 || fail "$blocks is not what we read"
done
