#!/usr/bin/env bash
# Makes a folder of links to the programs that a fresh Debian has after `./dev test`: those of the minimal system, of the packages of
# `./dev packages --list test`, and of what these depend on. It is the whole PATH of the tests of scripts (CMakeLists.txt): a script that
# calls a program of no such package fails wherever it is tested, not on a fresh machine alone.
#
# programs.sh FOLDER
set -euo pipefail
export LC_ALL=C

(($# == 1)) || { printf 'usage: programs.sh FOLDER\n' >&2; exit 2; }
folder=$1
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
mkdir -p -- "$(dirname -- "$folder")"
work=$(mktemp -d -- "$folder.XXXXXX")
trap 'rm -rf -- "$work"' EXIT

# ---------------------------------------------------------------------------------------------------------- packages
# Of alternatives the one counts that is in the set already, else the first that is installed, itself or by a package that provides
# it: where gawk is installed too, `awk` remains mawk, which the minimal system has.
"$here/../dev" packages --list test >"$work/listed"
dpkg-query -W -f='${Package}\t${binary:Package}\t${Architecture}\t${db:Status-Status}\t${Priority}\t${Essential}\t${Pre-Depends}, ${Depends}\t${Provides}\n' |
  awk -F '\t' -v native="$(dpkg --print-architecture)" '
    # The packages that a field of Provides names, in names[1…].
    function split_provides(field, names,  count, i) {
      count = split(field, names, ",")
      for (i = 1; i <= count; i++) { sub(/\(.*/, "", names[i]); gsub(/ /, "", names[i]) }
      return count
    }
    function add(package,  names, count, i) {
      if (package in queued) return
      queued[package]; chosen[package]
      queue[++last] = package
      count = split_provides(provides[package], names)
      for (i = 1; i <= count; i++) chosen[names[i]]
    }
    # choose(CLAUSE): takes one of `a (>= 1) | b:any`, unless one is there.
    function choose(clause,  names, count, i) {
      gsub(/\([^)]*\)|:[a-z0-9]+|[ \t]/, "", clause)
      count = split(clause, names, "|")
      for (i = 1; i <= count; i++) if (names[i] in chosen) return
      for (i = 1; i <= count; i++) if (names[i] in full) { add(names[i]); return }
      for (i = 1; i <= count; i++) if (names[i] in provider) { add(provider[names[i]]); return }
    }
    function add_dependencies(  clauses, count, i) {
      while (done < last) {
        count = split(depends[queue[++done]], clauses, ",")
        for (i = 1; i <= count; i++) choose(clauses[i])
      }
    }
    NR == FNR { listed[++wanted] = $1; next }
    $4 != "installed" || ($3 != native && $3 != "all") { next }
    {
      full[$1] = $2; depends[$1] = $7; provides[$1] = $8
      count = split_provides($8, names)
      for (i = 1; i <= count; i++) if (!(names[i] in provider)) provider[names[i]] = $1
      if ($5 == "required" || $6 == "yes" || $1 == "apt") add($1)
    }
    END {
      add_dependencies()
      for (i = 1; i <= wanted; i++) {
        if (listed[i] in full) add(listed[i])
        else { print "programs.sh: " listed[i] " is not installed; ./dev packages installs it" >"/dev/stderr"; failed = 1 }
      }
      add_dependencies()
      for (i = 1; i <= last; i++) print full[queue[i]]
      exit failed
    }' "$work/listed" - >"$work/packages"

# ---------------------------------------------------------------------------------------------------------- programs
# Their files, and the names that update-alternatives gives to them.
declare -A program file_of
mapfile -t packages <"$work/packages"
dpkg-query -L "${packages[@]}" | grep -E '^(/usr)?/s?bin/[^/]+$' >"$work/files"
while IFS= read -r file; do
  file_of[${file#/usr}]=$file
  [[ ! -x $file ]] || program[${file##*/}]=$file
done <"$work/files"
while IFS=$'\t' read -r name link; do
  choices=("$(readlink -- "$link")")
  if [[ -z ${file_of[${choices[0]#/usr}]-} ]]; then
    mapfile -t choices < <(update-alternatives --list "$name" 2>"$work/none" || true)
  fi
  for file in "${choices[@]}"; do
    if [[ -n ${file_of[${file#/usr}]-} && -z ${program[$name]-} ]]; then program[$name]=$file; fi
  done
done < <(find /usr/bin /usr/sbin -type l -lname '/etc/alternatives/*' -printf '%f\t%l\n')

# ./dev takes Node.js from wherever it is.
for name in node npm; do
  if [[ -z ${program[$name]-} ]] && file=$(command -v "$name"); then program[$name]=$(realpath -- "$file"); fi
done

mkdir -- "$work/programs"
for name in "${!program[@]}"; do
  if [[ $name == "${program[$name]##*/}" ]]; then printf '%s\0' "${program[$name]}"; fi
done | xargs -0 ln -s -t "$work/programs" --
for name in "${!program[@]}"; do
  if [[ $name != "${program[$name]##*/}" ]]; then ln -s -- "${program[$name]}" "$work/programs/$name"; fi
done
chmod 755 "$work/programs"
rm -rf -- "$folder"
mv -T -- "$work/programs" "$folder"
printf '%d programs of %d packages\n' "${#program[@]}" "${#packages[@]}"
