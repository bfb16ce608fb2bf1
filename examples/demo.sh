#!/usr/bin/env bash
# Bakes a built-in HDR map and makes one web page of it: the source, every level of the chain as it is stored and as a ball shows
# it, its error against brute force, the time it took. The page holds its pictures and works offline.
#
# demo.sh WELKIN OUTPUT_FOLDER
set -euo pipefail
export LC_ALL=C.UTF-8

(($# == 2)) || { printf 'usage: demo.sh WELKIN OUTPUT_FOLDER\n' >&2; exit 2; }
welkin=$(cd -- "$(dirname -- "$1")" && pwd -P)/$(basename -- "$1")
[[ -x $welkin ]] || { printf 'demo: %s is not a program\n' "$1" >&2; exit 1; }
style=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)/demo_page.css
mkdir -p -- "$2"
cd -- "$2"
: >demo.log

page=index.html
exposure=-2.5
turn=20,0,0                       # so that the balls show the room's corner
mirrored=-1,0,0,0,1,0,0,0,1       # because a ball is seen from outside

say() { printf 'demo: %s\n' "$*" >&2; }
escaped() { sed -e 's/&/\&amp;/g' -e 's/</\&lt;/g' -e 's/>/\&gt;/g' -e 's/"/\&quot;/g' <<<"$1"; }

# --------------------------------------------------------------------------------------------------------------- commands

# welkin ARGUMENT…: runs it. Pictures of bright lights are clipped, and said to be; that is not news here.
welkin() { "$welkin" "$@" 2>>demo.log || { cat demo.log >&2; return 1; }; }

# bake NAME ARGUMENT…: `welkin bake ARGUMENT… --json`, its report in NAME.json.
bake() {
  local name=$1
  shift
  say "welkin bake $*"
  welkin bake "$@" --json >"$name.json"
}

# levels_of REPORT: a line a level of a bake's JSON, separated by tabs: level, size, roughness, method, rel. RMSE %, max %, energy,
# furnace; a dash for what the report doesn't say.
levels_of() {
  awk '
    function number(key, factor, format) { return value[key] ~ /^[-+0-9.]/ ? sprintf(format, value[key] * factor) : "–" }
    function percent(key) { return number(key, 100, value[key] + 0 < 1e-6 ? "< 0.0001" : "%.2g") }
    function print_level() {
      if (!("level" in value)) return
      printf "%s\t%s×%s\t%s\t%s%s\t", value["level"], value["width"], value["height"], number("roughness", 1, "%g"), value["method"],
        "degree" in value ? ", degree " value["degree"] : ""
      printf "%s\t%s\t%s\t%s\n", percent("relative_rmse"), percent("max_relative"), number("energy", 1, "%.6f"),
        number("furnace", 1, value["furnace"] + 0 ? "%.0e" : "%g")
      delete value
    }
    match($0, /^ *"[a-z_]+": /) {
      key = $1
      gsub(/[":]/, "", key)
      if (key == "level" || key == "seconds") print_level()
      text = substr($0, RLENGTH + 1)
      gsub(/[",]/, "", text)
      if (key in value || key == "level" || "level" in value) value[key] = text
    }' "$1.json"
}

# seconds_of REPORT STEP
seconds_of() { awk -v step="\"$2\":" '/"seconds"/ { inside = 1 } inside && $1 == step { sub(/,$/, "", $2); print $2 }' "$1.json"; }

milliseconds() { awk -v s="$1" 'BEGIN { printf s < 0.01 ? "%.1f" : "%.0f", 1000 * s }'; }

# worst REPORT COLUMN: the largest of a column of levels_of.
worst() { levels_of "$1" | awk -F '\t' -v column="$2" '$column != "–" && $column + 0 >= most { most = $column + 0 } END { print most }'; }

# --------------------------------------------------------------------------------------------------------------- pictures

# picture CLASS ALT FILE [ARGUMENT…]: FILE as an <img>, after `welkin convert ARGUMENT…` has made it.
picture() {
  local class=$1 alt=$2 file=$3
  shift 3
  welkin convert "$1" "$file" "${@:2}" --type uint8
  printf '<img class="%s" alt="%s" src="data:image/png;base64,' "$class" "$(escaped "$alt")"
  base64 <"$file" | tr -d '\n'
  printf '">'
}

# mirror_ball CHAIN LEVEL SIZE EXPOSURE: the ball that reflects a level: each pixel looks it up along the reflected ray.
mirror_ball() {
  picture ball "ball that reflects level $2" "${1%.*}-ball-$2.png" \
    "$1" --level "$2" --to sphere --size "$3" --rotate "$turn" --exposure "$4"
}

# diffuse_ball MAP SIZE: the ball whose pixels look the map up along the normal.
diffuse_ball() {
  picture ball 'diffuse ball' "${1%.*}-ball.png" "$1" --to fisheye-orthographic --size "$2" --rotate "$mirrored" --exposure "$exposure"
}

# cross CHAIN LEVEL TEXELS: a level's cube, its texels as they are stored where a face has at most 128 across, and distinct
# on the page where it has at most 32.
cross() {
  local class=cross
  (($3 > 32)) || class='cross texels'
  picture "$class" "cube of level $2" "${1%.*}-cube-$2.png" \
    "$1" --level "$2" --to cube:hcross --size "$(($3 < 128 ? $3 : 128))" --exposure "$exposure"
}

# ------------------------------------------------------------------------------------------------------------------- work

started=$SECONDS
say 'welkin synth room room.exr --size 1024'
welkin synth room room.exr --size 1024
welkin convert room.exr room.pfm
bake specular room.exr specular.ktx2 --verify
bake diffuse room.exr diffuse.ktx2 --lobe lambert --verify

# Three runs for the time; the one of middle length counts.
say 'welkin bake room.pfm timed.ktx2, three times'
TIMEFORMAT='%R %U %S'
for run in 1 2 3; do
  { time welkin bake room.pfm timed.ktx2 --json >"timed-$run.json"; } 2>"timed-$run.txt"
done
read -r wall user system run < <(for run in 1 2 3; do printf '%s %s\n' "$(cat "timed-$run.txt")" "$run"; done | sort -n | sed -n 2p)
cpu=$(awk -v a="$user" -v b="$system" 'BEGIN { print a + b }')
processors=$(nproc 2>/dev/null || echo '?')
model=$(sed -n 's/^model name[ \t]*: //p' /proc/cpuinfo 2>/dev/null | sed -n 1p)

others=(studio sky lamps)
for other in "${others[@]}"; do
  welkin synth "$other" "$other.exr" --size 1024
  bake "$other" "$other.exr" "$other.ktx2" --verify=24
done

# ------------------------------------------------------------------------------------------------------------------- page

# A bar a line of "class seconds label" on a logarithmic axis from 10 ms to 100 s.
chart() {
  awk '
    function across(seconds,  at) { at = 25 * log(seconds / 0.01) / log(10); return at < 0.5 ? 0.5 : at > 100 ? 100 : at }
    { class[NR] = $1; seconds[NR] = $2; $1 = $2 = ""; label[NR] = substr($0, 3) }
    END {
      row = 42
      height = NR * row
      printf "<svg width=\"100%%\" height=\"%d\" role=\"img\" aria-label=\"The times of the table below as bars\">\n", height + 24
      split("10 ms,100 ms,1 s,10 s,100 s", tick, ",")
      split("start,middle,middle,middle,end", anchor, ",")
      for (i = 0; i < 5; i++) {
        printf "<line x1=\"%d%%\" x2=\"%d%%\" y1=\"0\" y2=\"%d\"/>", 25 * i, 25 * i, height + 4
        printf "<text class=\"axis\" x=\"%d%%\" y=\"%d\" text-anchor=\"%s\">%s</text>\n", 25 * i, height + 20, anchor[i + 1], tick[i + 1]
      }
      for (i = 1; i <= NR; i++) {
        y = (i - 1) * row
        printf "<text x=\"6\" y=\"%d\">%s</text>", y + 14, label[i]
        printf "<rect class=\"%s\" y=\"%d\" width=\"%.2f%%\" height=\"14\" rx=\"3\"/>\n", class[i], y + 20, across(seconds[i])
      }
      print "</svg>"
    }'
}

# table_rows REPORT [NAME]: a row a level, which is called NAME, or by its number.
table_rows() {
  levels_of "$1" | awk -F '\t' -v name="${2:-}" '{
    gsub(/</, "\\&lt;")
    cell = "</td><td>"
    print "<tr><td>" (name == "" ? "level " $1 : name) cell $2 cell $3 cell $5 cell $6 cell $7 cell $8 cell $4 "</td></tr>"
  }'
}

levels=$(levels_of specular | wc -l)
((levels > 1)) || { say 'the report of welkin bake cannot be read'; exit 1; }

{
  printf '<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n<meta name="viewport" content="width=device-width, initial-scale=1">\n'
  printf '<title>Welkin: lighting from a map</title>\n<style>\n'
  cat "$style"
  cat <<'HTML'
</style>
<h1>Lighting from a map</h1>
<p>A rough surface reflects a blurred world. <code>welkin bake</code> blurs an environment map once for every roughness, so that a
renderer only looks it up; then it measures how far the result is from brute force. These commands made the maps below:</p>
<pre>welkin synth room room.exr --size 1024
welkin bake room.exr specular.ktx2 --verify
welkin bake room.exr diffuse.ktx2 --lobe lambert --verify</pre>
HTML

  printf '<div class="strip">\n'
  while IFS=$'\t' read -r level _ roughness _; do
    printf '<a href="#level-%s">' "$level"
    mirror_ball specular.ktx2 "$level" 256 "$exposure"
    printf '%s</a>\n' "$roughness"
  done < <(levels_of specular)
  printf '</div>\n<p class="faint">One ball, nine roughnesses. Each pixel looks up one level along the reflected ray.</p>\n'

  printf '<h2>The source</h2>\n<figure class="beside wider">\n'
  picture wide 'the room as a lat-long' room.png room.exr --size 1024x512 --exposure "$exposure"
  printf '<figcaption>A room lit exactly, 1024×512 texels, luminance %s. Radiance is linear in the files; pictures here are\n' \
    "$(welkin info room.exr | awk '/^  luminance/ { sub(/^ *luminance */, ""); sub(/,.*/, ""); printf "%.2g to %.2g\n", $1, $3 }')"
  printf 'darkened by %s stops, clipped and written in sRGB.</figcaption></figure>\n' "${exposure#-}"

  cat <<'HTML'
<h2>The chain</h2>
<p>A cube texture of nine levels for the GGX lobe, from a mirror to roughness 1, each level half as large as the one before. On the
left the ball that reflects the level, on the right its six faces. Of level 3, these commands made them:</p>
HTML
  printf '<pre>welkin convert specular.ktx2 ball.png --level 3 --to sphere --size 256 --rotate %s --exposure %s --type uint8\n' "$turn" "$exposure"
  printf 'welkin convert specular.ktx2 cube.png --level 3 --to cube:hcross --exposure %s --type uint8</pre>\n<div class="cards">\n' "$exposure"
  while IFS=$'\t' read -r level size roughness _; do
    printf '<div class="card" id="level-%s"><h3>Roughness %s <small>level %s, %s</small></h3><div class="pair">\n' \
      "$level" "$roughness" "$level" "$size"
    mirror_ball specular.ktx2 "$level" 256 "$exposure"
    cross specular.ktx2 "$level" "${size%%×*}"
    printf '</div></div>\n'
  done < <(levels_of specular)
  printf '</div>\n<p class="faint">The last levels have too few texels to hold their function: at 1×1 the ball shows six values and what\n'
  printf 'lies between them. <code>--levels</code> ends a chain sooner, <code>--to</code> and <code>--size</code> choose other shapes.</p>\n'

  cat <<'HTML'
<h2>The diffuse map</h2>
<div class="beside"><div class="card"><div class="pair">
HTML
  diffuse_ball diffuse.ktx2 256
  cross diffuse.ktx2 0 64
  cat <<'HTML'
</div></div>
<p class="faint">The same world for the Lambert lobe, the light that a diffuse surface receives: the ball looks the map up along its normal.
The map is a cube of 64×64.</p></div>

<h2>How far from brute force</h2>
<p><code>--verify</code> takes 64 random texels of every level and the brightest ones, and sums the lobe over all 524,288 texels of the
source in float64. What it found when this page was made:</p>
<div class="scroll"><table>
<tr><th>map</th><th>size</th><th>roughness</th><th>rel. RMSE %</th><th>max %</th><th>energy</th><th>furnace</th><th>method</th></tr>
HTML
  table_rows specular
  table_rows diffuse diffuse
  cat <<'HTML'
</table></div>
<p class="faint"><em>Rel. RMSE</em> is the root mean square error over the root mean square; <em>max</em> the largest error of a texel over
the reference there; <em>energy</em> the level's integral over the source's; <em>furnace</em> how much a constant map changes. Level 0 is the
source resampled, without a lobe.</p>
<div class="cards">
HTML
  for other in "${others[@]}"; do
    printf '<figure class="card">\n'
    picture wide "the $other as a lat-long" "$other.png" "$other.exr" --size 512 --exposure -1.5
    printf '<div class="trio">\n'
    for level in 0 2 4; do mirror_ball "$other.ktx2" "$level" 192 -1.5; done
    printf '</div>\n<figcaption><code>welkin synth %s</code>, baked alike, levels 0, 2 and 4, darkened by 1.5 stops. Worst level: rel. RMSE %s %%,\nmax %s %%.' \
      "$other" "$(worst "$other" 5)" "$(worst "$other" 6)"
    printf '</figcaption>\n</figure>\n'
  done

  printf '</div>\n\n<h2>How long it took</h2>\n'
  printf '<p>The chain above, from a PFM file to a KTX2 file of 32-bit floats, without <code>--verify</code>: read %s ms, plan %s ms, compute\n' \
    "$(milliseconds "$(seconds_of "timed-$run" read)")" "$(milliseconds "$(seconds_of "timed-$run" plan)")"
  printf '%s ms, write %s ms. The whole process, from start to end, took %s ms, and %s ms of processor time (%s processors%s).</p>\n' \
    "$(milliseconds "$(seconds_of "timed-$run" compute)")" "$(milliseconds "$(seconds_of "timed-$run" write)")" \
    "$(milliseconds "$wall")" "$(milliseconds "$cpu")" "$processors" "${model:+, $(escaped "$model")}"
  chart <<BARS
ours $wall welkin, here: $(milliseconds "$wall") ms
theirs 5.5 Filament cmgen: 5.5 s
theirs 7.5 cmft: 7–8 s
theirs 13 Khronos glTF-IBL-Sampler: 13 s
theirs 38 bimg texturec: 38 s
BARS
  cat <<HTML
<div class="scroll"><table>
<tr><th>program</th><th>lobe</th><th>levels</th><th>CPU s</th><th>wall s</th><th>rel. RMSE %</th><th>max %</th></tr>
<tr class="ours"><td>welkin bake, this page</td><td>GGX</td><td>$levels</td><td>$cpu</td><td>$wall</td>
  <td>≤ $(worst specular 5)</td><td>≤ $(worst specular 6)</td></tr>
<tr><td>Filament cmgen</td><td>GGX</td><td>5</td><td>10.2</td><td>5.5</td><td>4.0–6.5</td><td>15–57</td></tr>
<tr><td>cmft</td><td>Blinn BRDF</td><td>7</td><td>13–15</td><td>7–8</td><td>0.9–5.6</td><td>18–42</td></tr>
<tr><td>Khronos glTF-IBL-Sampler</td><td>GGX</td><td>9</td><td>23</td><td>13</td><td>1.2–4.7</td><td>13–50</td></tr>
<tr><td>bimg texturec</td><td>GGX</td><td>9</td><td>38</td><td>38</td><td>34–45</td><td>73–128</td></tr>
</table></div>
<p class="faint">The other programs were not run for this page. We measured them once, on an idle machine with 2 cores, with another HDR map of
the same size (1024×512 to a cube of 256); their errors are at roughnesses near 1/8, 1/4, 1/2 and 1, against the same kind of brute
force, cmft's against its own lobe. cmgen took 1024 to 8192 samples a texel, Khronos's sampler 1024 on a software Vulkan, texturec 512.
Errors depend on the map and times on the machine: only orders of magnitude compare. <code>./dev bench</code> measures anew those that
are installed.</p>

<h2>The files</h2>
HTML
  printf '<p><code>specular.ktx2</code> (%s bytes) and <code>diffuse.ktx2</code> (%s bytes) lie beside this page.</p>\n' \
    "$(wc -c <specular.ktx2)" "$(wc -c <diffuse.ktx2)"
  printf '<details><summary><code>welkin info --header specular.ktx2</code></summary><pre>%s</pre></details>\n\n' \
    "$(escaped "$(welkin info --header specular.ktx2)")"

  printf '<h2>Other parameterizations</h2>\n<p>A map is a function from direction to radiance; a parameterization says where a direction lies\n'
  printf 'in a picture. Welkin '
  printf 'knows %s, and reads, bakes and writes them all: <code>welkin convert room.exr out.png --to …</code></p>\n<div class="tiles">\n' \
    "$(welkin list parameterizations | wc -l)"
  for name in cube:3x2 octahedral octahedral-equal-area paraboloid:hstrip angular mercator; do
    tile=256
    [[ $name != cube:* ]] || tile=96
    printf '<figure>'
    picture '' "the room as $name" "room-${name//:/-}.png" room.exr --to "$name" --size "$tile" --exposure "$exposure"
    printf '<figcaption><code>%s</code></figcaption></figure>\n' "$name"
  done
  printf '</div>\n<p><small>%s</small></p>\n</html>\n' "$(escaped "$(welkin --version)")"
} >"$page.tmp"
mv -- "$page.tmp" "$page"
rm -f timed* room.pfm

say "$((SECONDS - started)) s"
printf 'The page is %s/%s: open it in a browser.\n' "$PWD" "$page"
