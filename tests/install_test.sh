#!/usr/bin/env bash
# Installs a build to a temporary folder, moves it, and uses it from a project outside the source tree:
#   - the installed headers are those of public_headers.txt, each compiles alone, and none needs more than the standard library;
#   - examples/ builds with find_package(welkin) against the static library and against the shared one, and every example runs;
#   - with pkg-config too;
#   - what examples write agrees with `welkin convert`;
#   - the shared library shows the symbols that exported_symbols.txt names, and no others (but for the standard library's
#     templates of our types, which the compiler decides on).
#
# install_test.sh BUILD_FOLDER             checks
# install_test.sh BUILD_FOLDER --update    writes src/welkin/exported_symbols.txt
set -euo pipefail

(($# == 1)) || { (($# == 2)) && [[ $2 == --update ]]; } || { printf 'usage: install_test.sh BUILD_FOLDER [--update]\n' >&2; exit 2; }
build=$(cd -- "$1" && pwd -P)
update=${2:-}
source=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

fail() {
  printf 'install: %s\n' "$*"
  exit 1
}

from_cache() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
cmake=$(from_cache CMAKE_COMMAND)
generator=$(from_cache CMAKE_GENERATOR)
read -ra compiler < <(printf '%s %s\n' "$(from_cache CMAKE_CXX_COMPILER)" "$(from_cache CMAKE_CXX_FLAGS)")

# ---------------------------------------------------------------------------------------------------- the tree
"$cmake" --install "$build" --prefix "$work/first" >"$work/install.log" || { cat "$work/install.log"; fail 'cmake --install failed'; }
mv "$work/first" "$work/prefix"  # nothing installed may hold the place where it was
prefix=$work/prefix
if hits=$(grep -rlIF "$work/first" "$prefix"); then fail "the place of installation is written in $hits"; fi
if hits=$(grep -rlIF "$source" "$prefix"); then fail "the place of the source is written in $hits"; fi
pc=$(find "$prefix" -name welkin.pc)
config=$(find "$prefix" -name welkin-config.cmake)
[[ -n $pc && -n $config && -x $prefix/bin/welkin ]] || { find "$prefix"; fail 'welkin.pc, welkin-config.cmake or bin/welkin is missing'; }

PKG_CONFIG_PATH=$(dirname "$pc")
export PKG_CONFIG_PATH
flags() { pkg-config "$@" welkin; }
read -ra compile_flags < <(flags --cflags)
read -ra link_flags < <(flags --libs)
read -ra static_link_flags < <(flags --static --libs)

# ----------------------------------------------------------------------------------------------------- headers
mapfile -t headers < <(cd "$prefix/include/welkin" && find . -name '*.h' | sed 's|^\./||' | LC_ALL=C sort)
mapfile -t listed < <(grep '^[a-z]' "$source/src/welkin/public_headers.txt" | LC_ALL=C sort)
[[ ${headers[*]} == "${listed[*]}" ]] || fail "other headers are installed than public_headers.txt lists: ${headers[*]}"
# Two at a time: nothing else of this test takes as long.
alone() {
  local name=$work/alone/${1//\//.}
  printf '#include <welkin/%s>\n' "$1" >"$name.cpp"
  "${compiler[@]}" -std=c++20 -Wall -Wextra -Wconversion -Werror -fsyntax-only "${compile_flags[@]}" -MD -MF "$name.d" "$name.cpp" ||
    fail "welkin/$1 does not compile alone"
  if grep -oE '[^ ]*/(xsimd|gtest|CLI|fmt|nlohmann|OpenEXR|Imath|tbb|oneapi)/[^ ]*' "$name.d"; then
    fail "welkin/$1 includes these"
  fi
}
mkdir "$work/alone"
half=$((${#headers[@]} / 2))
(for header in "${headers[@]:half}"; do alone "$header"; done) &
second=$!
for header in "${headers[@]:0:half}"; do alone "$header"; done
wait "$second" || exit 1

# ------------------------------------------------------------------------------------------- the shared library's face
shared=$(find "$prefix" -name 'libwelkin.so' | head -n 1)
if [[ -n $shared ]]; then
  nm -D --defined-only -C "$shared" | sed -E 's/^[0-9a-f]* [A-Za-z] //' | grep -v '^WELKIN' | grep -vE '^[^(]* std::' | LC_ALL=C sort -u >"$work/symbols"
  expected=$source/src/welkin/exported_symbols.txt
  if [[ -n $update ]]; then
    { printf '# What the shared library shows: tests/install_test.sh BUILD_FOLDER --update writes this.\n'; cat "$work/symbols"; } >"$expected"
  fi
  if ! diff <(grep -v '^#' "$expected") "$work/symbols"; then
    fail 'the shared library shows other symbols than exported_symbols.txt (< expected, > found); --update writes them'
  fi
fi

# ---------------------------------------------------------------------------------------------------- examples
kinds=(welkin)
if find "$prefix" -name 'libwelkin.a' | grep -q . && [[ -n $shared ]]; then kinds=(static shared); fi
libraries=$(dirname "$(find "$prefix" -name 'libwelkin.*' | head -n 1)")
export LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
ctest=$(dirname "$cmake")/ctest
for kind in "${kinds[@]}"; do
  build_examples() {
    "$cmake" -G "$generator" -S "$source/examples" -B "$work/$kind" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release \
      -DWELKIN_KIND="$kind" -DCMAKE_CXX_COMPILER="${compiler[0]}" -DCMAKE_CXX_FLAGS="${compiler[*]:1}" &&
      "$cmake" --build "$work/$kind" --target "${targets[@]}" &&
      "$ctest" --test-dir "$work/$kind" --output-on-failure "${tests[@]}"
  }
  # Of the second kind those that call most of the library: the others' objects would be the same.
  targets=(all) tests=() least=20
  if [[ $kind == shared ]]; then
    targets=(make_room bake_map convert_map sample_direction render own_lobe)
    tests=(--tests-regex "^example\.($(IFS='|'; printf '%s' "${targets[*]}"))\$") least=${#targets[@]}
  fi
  build_examples >"$work/$kind.log" 2>&1 || { cat "$work/$kind.log"; fail "examples/ fails with find_package(welkin), $kind"; }
  mapfile -t built < <(find "$work/$kind" -maxdepth 1 -type f -perm -u+x -printf '%f\n')
  ((${#built[@]} >= least)) || fail "only ${#built[@]} examples were built"
  [[ $kind == shared ]] || programs=("${built[@]}")
done
if [[ ${kinds[0]} == static ]]; then
  if nm -u "$work/static/bake_map" | grep -q 'welkin'; then fail 'the static examples lean on a shared library'; fi
  nm -u -C "$work/shared/bake_map" | grep -q 'welkin::bake' || fail 'the shared examples lean on no shared library'
fi

build_by_pkg_config() {
  "${compiler[@]}" -std=c++20 -O2 "${compile_flags[@]}" "$source/examples/convert_map.cpp" -o "$work/$1" "${@:2}" ||
    fail "examples/convert_map.cpp does not build with pkg-config ($1)"
}
build_by_pkg_config by-libs "${link_flags[@]}"
build_by_pkg_config by-static-libs "${static_link_flags[@]}"

welkin=$prefix/bin/welkin
"$welkin" synth axes "$work/axes.exr" --size 512
"$welkin" convert "$work/axes.exr" "$work/expected.exr" --to cube --size 256
for program in "${kinds[@]/%//convert_map}" by-libs by-static-libs; do
  rm -f "$work/cube.exr"
  "$work/$program" "$work/axes.exr" "$work/cube.exr" || fail "$program failed"
  "$welkin" diff "$work/expected.exr" "$work/cube.exr" --fail-above 1e-6 >"$work/diff.log" ||
    { cat "$work/diff.log"; fail "$program writes another map than welkin convert"; }
done
from_example=$("$work/${kinds[0]}/sample_direction" "$work/cube.exr" 1 2 3 | tr '\n' ' ')
from_command=$("$welkin" sample "$work/cube.exr" --dir 1,2,3 --filter bicubic | tr '\n' ' ')
[[ $from_example == "$from_command" ]] || fail "sample_direction says $from_example, welkin sample $from_command"
if "$work/by-libs" "$work/missing.exr" "$work/cube.exr" 2>"$work/error"; then fail 'a missing file is no error'; fi
grep -q missing.exr "$work/error" || fail "the error does not name the file: $(cat "$work/error")"

printf '%d headers; %d examples, built and run %s; 1 with pkg-config\n' "${#headers[@]}" "${#programs[@]}" "${kinds[*]}"
