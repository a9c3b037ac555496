#!/usr/bin/env bash
# tidy.sh ROOT BUILD [PATTERN]: clang-tidy, with the checks of .clang-tidy, has nothing to say of src/ and render/, or of
# the files that match PATTERN. Everything is looked at in the groups that are compiled as one: 22 CPU minutes where
# file by file, at 11 s each, it was an hour, nearly all of it for what they include.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/tool.sh"
clang_tidy=$(tool clang-tidy)
cd "$1"
commands=$2/tidy
together=ON
[[ ${3:-} ]] && together=OFF
mapfile -t same < <(sed -nE 's/^(VTK_DIR|CMAKE_BUILD_TYPE|CHUTE_WATCH):[^=]*=(.*)/-D\1=\2/p' "$2/CMakeCache.txt")
cmake -S . -B "$commands" -G Ninja -DCMAKE_UNITY_BUILD=$together -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 "${same[@]}" >/dev/null
cmake --build "$commands" --target chute_version >/dev/null  # writes a source
mapfile -t files < <(sed -nE 's/^ *"file": "(.*)"$/\1/p' "$commands/compile_commands.json" |
  grep -E "^($PWD|$commands)/(src|render)/" | grep -E "${3:-.}" | sort)
((${#files[@]})) || { echo "no file matches ${3:-.}" && exit 1; }
said=$(printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -n 1 "$clang_tidy" -p "$commands" --quiet \
  --checks=-bugprone-suspicious-include \
  --header-filter='/(src|render)/[^/]*/.*\.[ch]pp$' --extra-arg=-Wno-unknown-warning-option 2>/dev/null) || true
# Headers come once for each file that includes them.
problems=$(grep -E '^/.*(warning|error): ' <<<"$said" | sort -u) || true
if [[ $problems ]]; then
  printf '%s\n' "$problems"
  echo "$(wc -l <<<"$problems") problems"
  exit 1
fi
echo "${#files[@]} files"
