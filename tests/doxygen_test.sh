#!/usr/bin/env bash
# The manual is complete: doxygen makes it of the public headers and docs/library.md without a warning, every header has its page, and
# the table of docs/library.md names every header. A member without a contract, and a name that isn't there, would be found.
#
# doxygen_test.sh
set -euo pipefail
export LC_ALL=C.UTF-8

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
command -v doxygen >/dev/null || { printf 'doxygen is not here\n'; exit 77; }
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

failures=0
fail() {
  printf '%s\n' "$*"
  failures=$((failures + 1))
}

# ------------------------------------------------------------------------------------------------------ it is made
bash docs/make_manual.sh "$work/manual" >"$work/warnings" 2>&1 || fail "$(cat "$work/warnings")"
[[ ! -s $work/warnings ]] || fail "doxygen warns: $(head -n 20 "$work/warnings")"
html=$work/manual/html
mapfile -t headers < <(grep -E '^[a-z]' src/welkin/public_headers.txt)
for header in "${headers[@]}"; do
  # Doxygen's name of a file's page: `_` doubled, `.` and `/` written out.
  page=$(sed 's/_/__/g; s/\./_8/g; s,/,_2,g' <<<"$(basename "$header")")
  compgen -G "$html/*$page.html" >/dev/null || fail "$header has no page in the manual"
  grep -q "\`${header//./\\.}\`" docs/library.md || fail "docs/library.md: its table lacks $header"
done
grep -q 'The library' "$html/index.html" || fail 'docs/library.md is not the main page'
grep -rqF 'Σ' "$html" || fail 'characters beyond ASCII are lost'

# What the page calls a header is one. The last table's are `room/file.h`.
while IFS= read -r named; do
  grep -qxF "$named" src/welkin/public_headers.txt || fail "docs/library.md: '$named' is no public header"
done < <(grep -oE '`[a-z_]+/[a-z_]+\.h`' docs/library.md | tr -d '`' | sort -u)

# --------------------------------------------------------------------------------------------- what is amiss is found
# edited SED-SCRIPT: whether the manual is made of a copy of the tree in which base/version.h is so changed.
mkdir -p "$work/tree/src"
cp -r docs "$work/tree/"
cp -r src/welkin "$work/tree/src/"
edited() {
  sed "$1" src/welkin/base/version.h >"$work/tree/src/welkin/base/version.h"
  bash "$work/tree/docs/make_manual.sh" "$work/edited" >"$work/said" 2>&1
}
edited '' || fail "a copy of the tree doesn't pass: $(head -n 5 "$work/said")"
if edited 's,^}.*,int undocumented();\n&,'; then fail 'not found: a function without a comment'; fi
if edited 's,/// The version of the library that,/// As @ref fnord: what,'; then fail 'not found: a link to what there is not'; fi

((failures == 0)) || exit 1
printf '%d headers in the manual\n' "${#headers[@]}"
