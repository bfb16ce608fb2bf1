#!/usr/bin/env bash
# Holds the tree to its layout (docs/architecture.md):
#   - a room of src/welkin includes only itself and the rooms that src/welkin/rooms.txt lets it use, all of which stand before it;
#     its tests (*_test.cpp, *_cases.h) may use any room before it;
#   - the table of rooms in docs/architecture.md names the same ones in the same order;
#   - a public header (src/welkin/public_headers.txt) is there once, and includes only public ones and the standard library; welkin.h
#     includes all of them; its functions are exported;
#   - no library header includes the command line's libraries, which cost every includer seconds of compile time;
#   - a room's tests are in its CMakeLists.txt, so that they are built;
#   - the library's messages name no options of the command (`tool --option` of other programs stands between backticks);
#   - a source file of over 400 lines says why in its first ten.
#
# rooms_test.sh [ROOT]     prints each breach as FILE:LINE: what; fails if there is one.
set -euo pipefail

longest_file=400

cd -- "${1:-$(dirname -- "${BASH_SOURCE[0]}")/..}"
[[ -d src/welkin ]] || { printf '%s has no src/welkin\n' "$PWD" >&2; exit 2; }

mapfile -t lines < <(grep -E '^[a-z_]+:' src/welkin/rooms.txt)
mapfile -t rooms < <(printf '%s\n' "${lines[@]}" | cut -d: -f1)
declare -A uses
for line in "${lines[@]}"; do uses[${line%%:*}]=" ${line#*:} "; done

breaches=0
breach() {
  printf '%s\n' "$*"
  breaches=$((breaches + 1))
}

# Prints the position of a room in the order, or nothing.
place_of() {
  local i
  for i in "${!rooms[@]}"; do
    if [[ ${rooms[i]} == "$1" ]]; then printf '%s' "$i"; fi
  done
}

for room in "${rooms[@]}"; do
  for used in ${uses[$room]}; do
    used_place=$(place_of "$used")
    [[ -n $used_place ]] && ((used_place < $(place_of "$room"))) || breach "rooms.txt: $room cannot use '$used', which is not above it"
  done
  [[ -f src/welkin/$room/CMakeLists.txt ]] || breach "rooms.txt: there is no room src/welkin/$room"
done

documented=$(sed -nE 's/^\| `([a-z_]+)\/` \|.*/\1/p' docs/architecture.md | head -n ${#rooms[@]} | tr '\n' ' ')
[[ $documented == "${rooms[*]} " ]] || breach "docs/architecture.md: its table of rooms has $documented, rooms.txt ${rooms[*]}"

includes() { grep -rnE --include='*.h' --include='*.cpp' "$1" "$2" || true; }

# Every include of a room's files leads to itself or upward.
checked=0
for folder in src/welkin/*/; do
  room=$(basename "$folder")
  place=$(place_of "$room")
  if [[ -z $place ]]; then
    breach "$folder: not in src/welkin/rooms.txt"
    continue
  fi
  while IFS= read -r hit; do
    [[ -n $hit ]] || continue
    checked=$((checked + 1))
    where=$(cut -d: -f1,2 <<<"$hit")
    header=$(sed -E 's/^[^"<]*["<]([^">]*)[">].*$/\1/' <<<"$hit")
    if [[ $header == *..* || $header != welkin/*/* ]]; then
      breach "$where: \"$header\": name a header of ours as welkin/ROOM/FILE"
      continue
    fi
    used=${header#welkin/}
    used=${used%%/*}
    used_place=$(place_of "$used")
    if [[ -z $used_place ]]; then
      breach "$where: \"$header\": there is no room '$used'"
    elif ((used_place > place)); then
      breach "$where: \"$header\": $room comes before $used and cannot include it"
    elif [[ $used != "$room" && ${uses[$room]} != *" $used "* && ! ${where%%:*} =~ _(test\.cpp|cases\.h)$ ]]; then
      breach "$where: \"$header\": rooms.txt does not let $room use $used"
    fi
  done < <(includes '^[[:space:]]*#[[:space:]]*include[[:space:]]*("|<welkin/)' "$folder")
done
((checked > 0)) || breach "no include was found to check"

while IFS= read -r test; do
  room=$(cut -d/ -f3 <<<"$test")
  grep -qF -- "${test#src/welkin/"$room"/}" "src/welkin/$room/CMakeLists.txt" || breach "$test: not in the room's CMakeLists.txt, so never built"
done < <(find src/welkin -mindepth 2 -name '*_test.cpp')

# Public headers: what is installed compiles without the rest. The standard library's names have no folder and no ending.
public=src/welkin/public_headers.txt
mapfile -t headers < <(grep -E '^[a-z]' "$public")
((${#headers[@]} > 0)) || breach "$public names no header"
declare -A is_public
for header in "${headers[@]}"; do
  [[ -z ${is_public[$header]-} ]] || breach "$public: $header is named twice"
  is_public[$header]=yes
done
for header in "${headers[@]}"; do
  [[ -f src/welkin/$header ]] || { breach "$public: there is no src/welkin/$header"; continue; }
  while IFS=: read -r line text; do
    included=$(sed -E 's/^[^"<]*["<]([^">]*)[">].*$/\1/' <<<"$text")
    where=src/welkin/$header:$line
    if [[ $included == "welkin/$header" ]]; then
      breach "$where: includes itself"
    elif [[ $included == welkin/* ]]; then
      [[ -n ${is_public[${included#welkin/}]-} ]] || breach "$where: \"$included\" is not public ($public)"
    elif [[ ! $text =~ '<'[a-z_]+'>' ]]; then
      breach "$where: a public header includes \"$included\", which is not of the standard library"
    fi
  done < <(grep -nE '^[[:space:]]*#[[:space:]]*include' "src/welkin/$header" || true)
done
# A function that a shared library hides links in tests alone, which are linked with the static one.
while IFS= read -r hidden; do breach "$hidden: a public function without WELKIN_API"; done < <(
  cd src/welkin && awk '
    /@cond INTERNAL/ { internal = 1 }
    /@endcond/ { internal = 0 }
    !internal && !templated && /^[A-Za-z][A-Za-z0-9_:<>, ]*[ &*](operator[^ ]+|[a-z_0-9]+)\(/ &&
      !/^(WELKIN_API|inline|constexpr|template|using|static|namespace|concept) / { print "src/welkin/" FILENAME ":" FNR }
    { templated = /^template / }' "${headers[@]}")
for header in "${headers[@]}"; do
  [[ $header == welkin.h ]] || grep -qxF "#include \"welkin/$header\"" src/welkin/welkin.h || breach "welkin.h lacks $header"
done

while IFS= read -r hit; do
  [[ -n $hit ]] || continue
  [[ ${hit%%:*} == *.h ]] && breach "$(cut -d: -f1,2 <<<"$hit"): belongs in a source file: ${hit#*:*:}"
done < <(includes '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"](CLI11|CLI/|nlohmann/|fmt/)' src/welkin)
while IFS=: read -r file line _; do
  [[ $file == cli/options.cpp || $file == cli/main.cpp ]] || breach "$file:$line: includes CLI11, ten seconds to compile; cli/options.h is for it"
done < <(includes '^[[:space:]]*#[[:space:]]*include[[:space:]]*<CLI' cli)

while IFS= read -r hit; do
  breach "$(cut -d: -f1,2 <<<"$hit"): a message names an option of the command"
done < <(grep -rnE --include='*.h' --include='*.cpp' --exclude='*_test.cpp' '"[^"]*--[a-z]' src/welkin | sed -E 's/`[^`]*`//g' | grep -E '"[^"]*--[a-z]')

# Two types of one name in a namespace become one for the linker, which then mixes up their functions.
while IFS= read -r twice; do breach "$twice"; done < <(
  find src cli examples bench \( -name '*.h' -o -name '*.cpp' \) -print0 | xargs -0 awk '
    FNR == 1 { hidden = 0; space = "" }
    /^namespace \{/ { hidden = 1 }
    /^namespace [a-z]/ { space = $2 }
    /^\}  \/\/ namespace$/ { hidden = 0 }
    !hidden && /^(struct|class) (WELKIN_API )?[A-Za-z0-9_]+( final)?( : .*)? \{/ {
      type = $2 == "WELKIN_API" ? $3 : $2
      if ((space, type) in first) print FILENAME ":" FNR ": " space "::" type " is in " first[space, type] " too"
      first[space, type] = FILENAME
    }')

while IFS= read -r -d '' file; do
  lines=$(wc -l <"$file")
  if ((lines > longest_file)) && ! head -n 10 "$file" | grep -qi "over $longest_file lines because"; then
    breach "$file:1: $lines lines, and no comment at the top says \"over $longest_file lines because …\""
  fi
done < <(find . \( -path ./build -o -path ./.git -o -path ./node_modules \) -prune -o -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.comp' -o -name '*.glsl' -o -name '*.py' -o -name '*.sh' -o -name dev \) -print0)

if ((breaches > 0)); then
  printf '%d breaches of the layout\n' "$breaches"
  exit 1
fi
printf '%d includes checked\n' "$checked"
