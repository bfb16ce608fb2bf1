#!/usr/bin/env bash
# Installs a build to a temporary folder, moves it, and uses it from a project outside the source tree:
#   - every installed header compiles, and none needs more than the standard library and TBB;
#   - examples/ builds with find_package(welkin), and with pkg-config, and converts a map;
#   - what it wrote agrees with `welkin convert`.
#
# install_test.sh BUILD_FOLDER
set -euo pipefail

(($# == 1)) || { printf 'usage: install_test.sh BUILD_FOLDER\n' >&2; exit 2; }
build=$(cd -- "$1" && pwd -P)
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
mapfile -t headers < <(cd "$prefix/include" && find welkin -name '*.h' | sort)
((${#headers[@]} > 20)) || fail "only ${#headers[@]} headers are installed"
for wanted in map_file/map_file.h filter/resample.h filter/sample.h io/image_file.h sphere/registry.h synth/synth.h; do
  [[ -f $prefix/include/welkin/$wanted ]] || fail "welkin/$wanted is not installed"
done
printf '#include <%s>\n' "${headers[@]}" >"$work/all.cpp"
printf '%s\n' "${headers[@]}" | tac | sed 's/.*/#include <&>/' >"$work/reversed.cpp"
for file in all reversed; do
  "${compiler[@]}" -std=c++20 -Wall -Wextra -Werror -fsyntax-only "${compile_flags[@]}" -MD -MF "$work/$file.d" "$work/$file.cpp" ||
    fail 'the installed headers do not compile'
done
if grep -oE '[^ ]*/(xsimd|gtest|CLI|fmt|nlohmann|OpenEXR|Imath)/[^ ]*' "$work/all.d"; then fail 'the installed headers include these'; fi

# ---------------------------------------------------------------------------------------------------- examples
build_by_find_package() {
  "$cmake" -G "$generator" -S "$source/examples" -B "$work/examples" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="${compiler[0]}" -DCMAKE_CXX_FLAGS="${compiler[*]:1}" && "$cmake" --build "$work/examples"
}
build_by_find_package >"$work/cmake.log" 2>&1 || { cat "$work/cmake.log"; fail 'examples/ does not build with find_package(welkin)'; }
build_by_pkg_config() {
  "${compiler[@]}" -std=c++20 -O2 "${compile_flags[@]}" "$source/examples/convert_map.cpp" -o "$work/$1" "${@:2}" ||
    fail "examples/convert_map.cpp does not build with pkg-config ($1)"
}
build_by_pkg_config by-libs "${link_flags[@]}"
build_by_pkg_config by-static-libs "${static_link_flags[@]}"

# A shared library is found by the examples where it lies; a static one needs nothing.
libraries=$(dirname "$(find "$prefix" -name 'libwelkin.*' | head -n 1)")
export LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
welkin=$prefix/bin/welkin
"$welkin" synth axes "$work/axes.exr" --size 512
"$welkin" convert "$work/axes.exr" "$work/expected.exr" --to cube --size 256
for program in "$work/examples/convert_map" "$work/by-libs" "$work/by-static-libs"; do
  rm -f "$work/cube.exr"
  "$program" "$work/axes.exr" "$work/cube.exr" || fail "$(basename "$program") failed"
  "$welkin" diff "$work/expected.exr" "$work/cube.exr" --fail-above 1e-6 >"$work/diff.log" ||
    { cat "$work/diff.log"; fail "$(basename "$program") writes another map than welkin convert"; }
done
from_example=$("$work/examples/sample_direction" "$work/cube.exr" 1 2 3 | tr '\n' ' ')
from_command=$("$welkin" sample "$work/cube.exr" --dir 1,2,3 --filter bicubic | tr '\n' ' ')
[[ $from_example == "$from_command" ]] || fail "sample_direction says $from_example, welkin sample $from_command"
if "$work/examples/convert_map" "$work/missing.exr" "$work/cube.exr" 2>"$work/error"; then fail 'a missing file is no error'; fi
grep -q missing.exr "$work/error" || fail "the error does not name the file: $(cat "$work/error")"

printf '%d headers, 2 examples with find_package, 1 with pkg-config\n' "${#headers[@]}"
