#!/usr/bin/env bash
# The ```cpp blocks of docs/library.md compile: each as the body of a function, its structs before it. What they take for granted is
# declared here.
#
# snippets_test.sh [C++ COMPILER]
set -euo pipefail
export LC_ALL=C.UTF-8

compiler=${1:-c++}
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
page=docs/library.md

{
  cat <<'CPP'
#include <welkin/welkin.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

void write(const welkin::Chain& chain);
CPP
  awk -v page="$page" '
    function flush_block(  i) {
      ++blocks
      printf "namespace block_%d {\n", blocks
      for (i = 1; i <= lines; i++) if (is_struct[i]) printf "#line %d \"%s\"\n%s\n", number[i], page, line[i]
      printf "welkin::Map block(welkin::Map& source, const std::vector<welkin::Map>& frames,\n"
      printf "                  const std::vector<std::uint16_t>& halves, const std::filesystem::path& path) {\n"
      printf "(void)source, (void)frames, (void)halves, (void)path;\n"
      for (i = 1; i <= lines; i++) if (!is_struct[i]) printf "#line %d \"%s\"\n%s\n", number[i], page, line[i]
      printf "throw 0;\n}\n}\n"
    }
    /^```cpp$/ { inside = 1; lines = 0; next }
    /^```$/ { if (inside) flush_block(); inside = 0; next }
    inside {
      number[++lines] = NR
      line[lines] = $0
      if ($0 ~ /^struct /) structs = 1
      is_struct[lines] = structs + 0
      if ($0 == "};") structs = 0
    }
    END { if (blocks < 8) { print "#error only " blocks " blocks found" } }' "$page"
} >"$work/snippets.cpp"

"$compiler" -std=c++20 -fsyntax-only -Isrc -Wall -Wextra -Werror -Wno-unused-variable -Wno-unused-but-set-variable "$work/snippets.cpp"
printf '%d snippets of %s compile\n' "$(grep -c '^namespace block_' "$work/snippets.cpp")" "$page"
