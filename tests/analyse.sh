#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Static analysis of src, plugin and validate by gcc's analyser and clang-tidy; any finding fails.
set -eu

# Of gcc's analyser: gcc 12 forgets elements of arrays that loops fill, and reports them as
# uninitialised or leaked; clang-tidy and the sanitizers look for those too. Not optimised: inlined
# code misleads it.
gcc_options='-O0 -fanalyzer -fdiagnostics-path-format=none'
gcc_options="$gcc_options -Wno-analyzer-use-of-uninitialized-value -Wno-analyzer-malloc-leak"

usage() {
  cat <<'END'
Example: sh tests/analyse.sh
         sh tests/analyse.sh gcc validate/

Analyses the C files of src, plugin and validate with `gcc -fanalyzer` and clang-tidy (.clang-tidy),
each file once, with the commands of build/analyse. Reports go to build/analyse/report.

  gcc, tidy         only this analyser
  PATH              only files whose path, from the project's folder, begins so
  --print-packages  only list the Debian packages needed
  --no-install      install nothing
  --help            this text

Exit status: 0 no findings; 1 findings; 2 wrong usage, or the set-up failed.
END
}

test_packages=yes # read by setup.sh
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
# shellcheck source=cmake/setup.sh
. "$root/cmake/setup.sh"

# TOOL FOLDER FILE COMMAND for each file, once, as a line of a shell script.
commands() {
  python3 - "$root" "$analysers" "$gcc_options" "$@" <<'END'
import json, os, shlex, sys
root, analysers, options, *paths = sys.argv[1:]
build = os.path.join(root, "build/analyse")
seen = set()
for entry in json.load(open(os.path.join(build, "compile_commands.json"))):
    path = os.path.relpath(entry["file"], root)
    if path in seen or not path.startswith(tuple(paths)):
        continue
    seen.add(path)
    words = shlex.split(entry["command"])
    words[words.index("-o") + 1] = "/dev/null"
    gcc = ["cd", entry["directory"], "&&", *map(shlex.quote, words), options]
    tidy = ["clang-tidy --quiet -p", shlex.quote(build), shlex.quote(entry["file"])]
    for name, command in ("gcc", gcc), ("tidy", tidy):
        if name in analysers:
            print(f"{name} {path}: " + " ".join(command))
END
}

analysers=
paths=
for argument; do
  case $argument in
  gcc | tidy) analysers="$analysers $argument" ;;
  src* | plugin* | validate*) paths="$paths $argument" ;;
  *) die "unknown argument $argument (see --help)" ;;
  esac
done
: "${analysers:=gcc tidy}" "${paths:=src/ plugin/ validate/}"
cd -- "$root"
mkdir -p build/analyse
if ! { cmake --preset analyse && cmake --build build/analyse --target kernel_tangent_header; } \
  >build/analyse/configure.log 2>&1; then
  cat build/analyse/configure.log >&2
  die "build/analyse cannot be made"
fi
report=$root/build/analyse/report
# shellcheck disable=SC2086 # a list of paths
commands $paths >"$report.commands"
[ -s "$report.commands" ] || die "no file begins with$paths"
# An analyser that fails without a finding is one.
tr '\n' '\0' <"$report.commands" |
  xargs -0 -P "$(nproc)" -n 1 sh -c 'out=$(sh -c "${1#*: }" 2>&1) && status=0 || status=$?
    printf "%s\n" "$out" | grep -E "(warning|error): " ||
      [ "$status" -eq 0 ] || printf "%s: error: status %s\n" "${1%%: *}" "$status"' analyse |
  sort -u >"$report"
cat -- "$report"
printf '%d analyses, %d findings\n' "$(wc -l <"$report.commands")" "$(wc -l <"$report")"
[ ! -s "$report" ] || exit 1
