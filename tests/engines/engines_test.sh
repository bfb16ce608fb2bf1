#!/usr/bin/env bash
# The engines themselves, in headless Chromium, load what we bake, by the lines that sets.json gives to their users, and light three balls
# with it; every pixel is compared with what Welkin says (run.mjs).
#
# engines_test.sh WELKIN FOLDER [--all | NAME…]   the command; a folder of the build for the packages; --all: what engines filter
#                                                 themselves too; NAMEs of sets.json
set -euo pipefail

(($# >= 2)) && [[ -x $1 ]] || { printf 'usage: %s WELKIN FOLDER [--all | NAME…]\n' "$0" >&2; exit 2; }
welkin=$(realpath -- "$1")
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
mkdir -p -- "$2"
cd -- "$2"
shift 2

fail() {
  printf 'engines_test.sh: %s\n' "$*" >&2
  exit 1
}

for program in node npm chromium; do
  command -v "$program" >/dev/null || fail "$program is not installed (Debian's packages nodejs, npm and chromium; ./dev packages installs them)"
done

# Containers may forbid what a browser needs of the system; that is no fault of ours.
started=$(timeout 60 chromium --headless=new --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$PWD/probe" \
  --dump-dom 'data:text/html,<p>started</p>' 2>probe.log || true)
rm -rf probe
if [[ $started != *started* ]]; then
  printf 'engines_test.sh: skipped: Chromium does not start here: %s\n' "$(tail -n 2 probe.log)" >&2
  exit 77
fi

# The packages of the lock file, once for each version of it; maps to their sources and the like are left out.
if ! cmp -s -- "$here/package-lock.json" installed-lock.json; then
  cp -- "$here/package.json" "$here/package-lock.json" .
  npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1 ||
    fail "npm cannot install the engines, which needs the network once in a build folder: $(grep -im 2 "^npm err" npm.log)"
  rm -rf node_modules/@cesium node_modules/cesium/Source node_modules/cesium/Build/CesiumUnminified
  find node_modules -type f \( -name '*.map' -o -name '*.d.ts' -o -name '*.md' -o -path '*.dbg*' \) -delete
  cp -- package-lock.json installed-lock.json
fi

(($# > 0)) || node "$here/viewer.mjs" "$welkin" .
exec node "$here/run.mjs" "$welkin" . "$@"
