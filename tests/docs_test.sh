#!/usr/bin/env bash
# Holds the documentation to the program:
#   - what a ```console block shows is what the program prints (numbers nearly);
#   - relative links lead somewhere, and every picture of docs/images is shown, small, and made by a command shown;
#   - README's ```cpp block is examples/convert_map.cpp;
#   - commands and options named elsewhere exist.
#
# docs_test.sh WELKIN            checks; prints each difference; fails if there is one
# docs_test.sh WELKIN --update   writes what the commands print and the pictures they make into the documentation
#
# In a ```console block `$ ` begins a command, a line that ends in \ goes on, and what follows is its output, of both kinds. The
# commands of one file run one after the other in an empty folder.
set -euo pipefail
export LC_ALL=C.UTF-8

(($# == 1)) || { (($# == 2)) && [[ $2 == --update ]]; } || { printf 'usage: docs_test.sh WELKIN [--update]\n' >&2; exit 2; }
[[ -x $1 ]] || { printf 'docs: %s is not a program\n' "$1" >&2; exit 2; }
welkin=$(cd -- "$(dirname -- "$1")" && pwd -P)/$(basename -- "$1")
update=${2:-}
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
mkdir "$work/bin"
ln -s "$welkin" "$work/bin/welkin"
export PATH=$work/bin:$PATH

breaches=0
breach() {
  printf '%s\n' "$*"
  breaches=$((breaches + 1))
}

mapfile -t pages < <(find . \( -path ./build -o -path ./.git -o -path ./node_modules \) -prune -o -name '*.md' -print | sort)
((${#pages[@]} > 5)) || { printf 'docs: only %d pages found\n' "${#pages[@]}"; exit 1; }

# ----------------------------------------------------------------------------------------------- what commands print

# perform PAGE FOLDER: the page, its commands run in the folder and their output put in place of what it shows.
perform() {
  local line command='' inside=''
  while IFS= read -r line || [[ -n $line ]]; do
    if [[ $line == '```console' ]]; then
      inside=yes
      printf '%s\n' "$line"
    elif [[ -n $inside && $line == '```' ]]; then
      inside=''
      printf '%s\n' "$line"
    elif [[ -z $inside ]]; then
      printf '%s\n' "$line"
    elif [[ $line == '$ '* || -n $command ]]; then
      printf '%s\n' "$line"
      command+=${line#'$ '}$'\n'
      [[ $line == *\\ ]] && continue
      (cd "$2" && bash -c "$command" </dev/null 2>&1) | sed 's/[ \t]*$//' || true
      command=''
    fi
  done <"$1"
}

# Numbers may differ by a hundredth, sizes in bytes and counts of clipped values by a fifth, and of equal maxima another may be found:
# other instruction sets round otherwise, and that packs otherwise.
same_output() {
  awk -v page="$1" '
    function number(s) { return s ~ /^[-+]?[0-9.]+(e[-+]?[0-9]+)?$/ }
    function near(a, b,  d) { d = a - b; if (d < 0) d = -d; a = a < 0 ? -a : a; return d <= tolerance * a || d < 1e-6 }
    function same(a, b,  i, n, m, x, y) {
      if (a == b) return 1
      tolerance = a ~ /byte|values were/ ? 0.2 : 0.01
      gsub(/along [-0-9.]+,[-0-9.]+,[-0-9.]+/, "along", a); gsub(/along [-0-9.]+,[-0-9.]+,[-0-9.]+/, "along", b)
      gsub(/[,:×()]/, " & ", a); gsub(/[,:×()]/, " & ", b)
      n = split(a, x); m = split(b, y)
      if (n != m) return 0
      for (i = 1; i <= n; i++) if (x[i] != y[i] && !(number(x[i]) && number(y[i]) && near(x[i] + 0, y[i] + 0))) return 0
      return 1
    }
    FNR == NR { shown[FNR] = $0; lines = FNR; next }
    { if (FNR > lines || !same(shown[FNR], $0)) {
        printf "%s:%d: shows:  %s\n%s:%d: is now: %s\n", page, FNR, shown[FNR], page, FNR, $0; differs = 1; exit } count = FNR }
    END { if (!differs && count != lines) { printf "%s: %d lines, not %d\n", page, count, lines; differs = 1 }; exit differs }' "$2" "$3"
}

mkdir "$work/made"
for page in "${pages[@]}"; do
  grep -q '^```console$' "$page" || continue
  folder=$work/run
  mkdir "$folder"
  perform "$page" "$folder" >"$work/page.md"
  if [[ -n $update ]]; then
    cmp -s "$page" "$work/page.md" || { cp "$work/page.md" "$page"; printf 'docs: %s updated\n' "$page"; }
  else
    same_output "$page" "$page" "$work/page.md" || breaches=$((breaches + 1))
  fi
  find "$folder" -name '*.png' -exec cp {} "$work/made" \;
  rm -rf "$folder"
done

# ----------------------------------------------------------------------------------------------------------- pictures
shopt -s nullglob
if [[ -n $update ]]; then
  mkdir -p docs/images
  for picture in "$work"/made/*.png; do
    name=$(basename "$picture")
    grep -q "images/$name)" "${pages[@]}" && ! cmp -s "$picture" "docs/images/$name" || continue
    cp "$picture" "docs/images/$name"
    printf 'docs: docs/images/%s updated\n' "$name"
  done
fi
for picture in docs/images/*.png; do
  name=$(basename "$picture")
  [[ -f $work/made/$name ]] || breach "$picture: no command shown makes it"
  grep -q "images/$name)" "${pages[@]}" || breach "$picture: no page shows it"
  (($(wc -c <"$picture") < 150000)) || breach "$picture: over 150 kB"
done

# -------------------------------------------------------------------------------------------------------------- links
links=0
for page in "${pages[@]}"; do
  while IFS= read -r target; do
    target=${target%%#*}
    [[ -n $target && $target != *://* && $target != mailto:* ]] || continue
    links=$((links + 1))
    [[ -e $(dirname "$page")/$target ]] || breach "$page: links to $target, which is not there"
  done < <(grep -oE '\]\([^) ]+\)' "$page" | sed -E 's/^\]\((.*)\)$/\1/')
done
((links > 0)) || breach 'no link was found to check'

# ------------------------------------------------------------------------------------------------------------ example
awk '/^```cpp$/ { inside = 1; next } /^```$/ { if (inside) exit } inside' README.md >"$work/example.cpp"
diff -u examples/convert_map.cpp "$work/example.cpp" || breach 'README.md: its example is not examples/convert_map.cpp'

# ----------------------------------------------------------------------------------------------- commands and options
help_of() {
  local file="$work/help-${*// /-}"
  [[ -f $file ]] || { welkin "$@" --help >"$file" 2>&1 || true; }
  cat "$file"
}
welkin --help | awk '/^Subcommands:/ { inside = 1; next } inside && /^  [a-z]/ { print $1 }' >"$work/commands"
[[ -s $work/commands ]] || breach 'welkin --help lists no subcommand'
named=0
for page in "${pages[@]}"; do
  # `welkin X…` in the text, and lines of code that begin with it.
  while IFS= read -r use; do
    read -ra words <<<"$use"
    command=${words[1]:-}
    [[ $command =~ ^[a-z]+$ ]] || continue
    named=$((named + 1))
    grep -qx "$command" "$work/commands" || { breach "$page: '$use': there is no command '$command'"; continue; }
    help=$(help_of "$command"; if [[ $command == plot && ${words[2]:-} =~ ^[a-z]+$ ]]; then help_of plot "${words[2]}"; fi; help_of)
    for word in "${words[@]:2}"; do
      [[ $word =~ ^--[a-z-]+ ]] || continue
      grep -qE -- "(^|[ ,])${BASH_REMATCH[0]}([ ,=:{]|$)" <<<"$help" || breach "$page: '$use': welkin $command has no ${BASH_REMATCH[0]}"
    done
  done < <(grep -oE '`welkin [^`]*`|^ {4}welkin .*' "$page" | sed -E 's/^[` ]*//; s/`$//')
done
((named > 0)) || breach 'no command was found to check'

if ((breaches > 0)); then
  printf '%d breaches; tests/docs_test.sh WELKIN --update writes what the program prints\n' "$breaches"
  exit 1
fi
printf '%d pages, %d links, %d commands named in the text\n' "${#pages[@]}" "$links" "$named"
