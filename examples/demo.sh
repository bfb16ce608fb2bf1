#!/usr/bin/env bash
# Makes one web page that shows built-in worlds in every parameterization, with the command that made each picture and how
# evenly its texels cover the sphere. The page holds its pictures and works offline.
#
# demo.sh WELKIN OUTPUT_FOLDER
set -euo pipefail

(($# == 2)) || { printf 'usage: demo.sh WELKIN OUTPUT_FOLDER\n' >&2; exit 2; }
welkin=$(cd -- "$(dirname -- "$1")" && pwd -P)/$(basename -- "$1")
[[ -x $welkin ]] || { printf 'demo: %s is not a program\n' "$1" >&2; exit 1; }
mkdir -p -- "$2"
cd -- "$2"
: >demo.log

worlds=(axes studio)
world_size=512
picture_size=192
page=index.html

escaped() { sed -e 's/&/\&amp;/g' -e 's/</\&lt;/g' -e 's/>/\&gt;/g' -e 's/"/\&quot;/g' <<<"$1"; }

# figure PICTURE ARGUMENT…: runs welkin with the arguments, which write PICTURE, and adds it to the page.
figure() {
  local picture=$1 command
  shift
  # Pictures of bright lights are clipped, and said to be; that is not news here.
  "$welkin" "$@" >/dev/null 2>>demo.log || { cat demo.log >&2; return 1; }
  command=$(escaped "welkin $*")
  printf '<figure><img alt="%s" src="data:image/png;base64,' "$(escaped "$picture")"
  base64 <"$picture" | tr -d '\n'
  printf '"><figcaption><code>%s</code></figcaption></figure>\n' "$command"
}

# From `welkin plot density --json`, the row of one parameterization as "min max ratio".
density_of() {
  awk -v wanted="$1" '
    function field(record, key,  at) {
      at = match(record, "\"" key "\"[ \t\n]*:[ \t\n]*")
      if (!at) return ""
      record = substr(record, RSTART + RLENGTH)
      sub(/^"/, "", record)
      match(record, /^[^",}\n]*/)
      return substr(record, 1, RLENGTH)
    }
    BEGIN { RS = "}" }
    field($0, "name") == wanted { print field($0, "min"), field($0, "max"), field($0, "ratio") }' density.json
}

short_number() { LC_ALL=C awk -v x="$1" 'BEGIN { if (x == "") print "–"; else if (x ~ /^[-+.0-9eE]+$/) printf "%.4g\n", x; else print x }'; }

for world in "${worlds[@]}"; do
  "$welkin" synth "$world" "$world.exr" --size "$world_size"
done
"$welkin" plot density --json >density.json
mapfile -t parameterizations < <("$welkin" list parameterizations)
((${#parameterizations[@]})) || { printf 'demo: welkin lists no parameterization\n' >&2; exit 1; }

{
  cat <<'HTML'
<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Welkin: one world, every parameterization</title>
<style>
  :root { color-scheme: light dark; --page: #f6f7f9; --card: #fff; --ink: #1c2430; --faint: #5b6675; --line: #dde2e8; }
  @media (prefers-color-scheme: dark) {
    :root { --page: #12161c; --card: #1a2029; --ink: #e4e9f0; --faint: #94a1b2; --line: #2b3441; }
  }
  body { margin: 0 auto; max-width: 76rem; padding: 2rem 1.2rem 4rem; background: var(--page); color: var(--ink);
         font: 16px/1.5 system-ui, sans-serif; }
  h1 { font-size: 1.7rem; margin: 0 0 .3rem; }
  h2 { font-size: 1.15rem; margin: 2.4rem 0 .2rem; padding-top: 1rem; border-top: 1px solid var(--line); }
  p { margin: .2rem 0 .8rem; color: var(--faint); max-width: 46rem; }
  .row { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 17rem), 1fr)); }
  figure { margin: 0; padding: .7rem; background: var(--card); border: 1px solid var(--line); border-radius: .5rem;
           display: flex; flex-direction: column; justify-content: space-between; gap: .6rem; }
  img { display: block; margin: auto; max-width: 100%; max-height: 24rem; height: auto; }
  code { font: .8rem/1.4 ui-monospace, monospace; color: var(--faint); overflow-wrap: anywhere; }
  table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
  th, td { padding: .25rem 1rem .25rem 0; text-align: right; border-bottom: 1px solid var(--line); }
  th:first-child, td:first-child { text-align: left; }
  a { color: inherit; }
</style>
<h1>One world, every parameterization</h1>
<p>A map is a function from direction to radiance; a parameterization says where a direction lies in a picture. Below are the
built-in worlds in each one that Welkin knows, and how evenly its texels
cover the sphere. The command under a picture made it.</p>
HTML
  printf '<p><code>%s</code></p>\n' "$(escaped "$("$welkin" --version)")"

  printf '<h2>Worlds</h2>\n<div class="row">\n'
  for world in "${worlds[@]}"; do
    figure "$world.png" synth "$world" "$world.png" --size "$world_size" --type uint8
  done
  printf '</div>\n<h2>Texel density</h2>\n'
  printf '<p>The solid angle of a texel over the average: least, greatest, and their ratio. 1 is even. <code>welkin plot density --json</code></p>\n'
  printf '<table><tr><th>parameterization</th><th>min</th><th>max</th><th>ratio</th></tr>\n'
  for name in "${parameterizations[@]}"; do
    read -r least greatest ratio < <(density_of "$name") || true
    printf '<tr><td><a href="#%s">%s</a></td><td>%s</td><td>%s</td><td>%s</td></tr>\n' "$(escaped "$name")" \
      "$(escaped "$name")" "$(short_number "${least:-}")" "$(short_number "${greatest:-}")" "$(short_number "${ratio:-}")"
  done
  printf '</table>\n'

  for name in "${parameterizations[@]}"; do
    printf 'demo: %s\n' "$name" >&2
    file=${name//[^A-Za-z0-9-]/-}
    printf '<h2 id="%s">%s</h2>\n<div class="row">\n' "$(escaped "$name")" "$(escaped "$name")"
    for world in "${worlds[@]}"; do
      figure "$world-$file.png" convert "$world.exr" "$world-$file.png" --to "$name" --size "$picture_size" --type uint8
    done
    figure "density-$file.png" plot density "density-$file.png" --of "$name"
    printf '</div>\n'
  done
  printf '</html>\n'
} >"$page.tmp"
mv -- "$page.tmp" "$page"

printf 'The page is %s/%s: open it in a browser.\n' "$PWD" "$page"
