#!/usr/bin/env bash
# Checks that objects compiled for AVX2 offer the linker nothing that baseline code could take. An inline function or a
# template leaves a weak symbol in every object that uses it, and the linker keeps any one of them: if that is the AVX2 copy,
# the program stops with an illegal instruction on an older processor. A symbol is safe when the instruction set is
# part of its name, as a template argument or a namespace, or when it is read-only data, the same in every object.
#
# kernels_test.sh OBJECT…     prints each unsafe symbol; fails if there is one, or an object without any symbol.
# Meant for optimised builds: without optimisation every small inline function becomes a symbol.
set -euo pipefail
export LC_ALL=C

(($# > 0)) || { printf 'usage: kernels_test.sh OBJECT…\n' >&2; exit 2; }

unsafe=0
for object in "$@"; do
  # Columns: name|value|class|type|size|line|section. Class W and V are weak, u is unique in the program. DW.ref.… is the
  # pointer to the exception personality that position-independent code shares.
  nm -C --defined-only --format=sysv "$object" | awk -F'|' -v object="$object" '
    NF < 7 { next }
    { class = $(NF - 4); section = $NF; gsub(/[ \t]/, "", class); gsub(/[ \t]/, "", section)
      name = $1; for (i = 2; i <= NF - 6; i++) name = name "|" $i
      sub(/ +$/, "", name); symbols++ }
    class !~ /^[WVu]$/ || name ~ /fma3<xsimd|avx2|Avx2/ || name == "DW.ref.__gxx_personality_v0" { next }
    section ~ /^\.(rodata|data\.rel\.ro)/ { next }
    { print object ": weak symbol without its instruction set: " name; unsafe = 1 }
    END { if (!symbols) { print object ": defines no symbol"; unsafe = 1 }; exit unsafe }' || unsafe=1
done
exit "$unsafe"
