#!/usr/bin/env bash
# tidy.sh ROOT BUILD [PATTERN]: clang-tidy, with the checks of .clang-tidy, has nothing to say of src/ and render/, or of
# the files that match PATTERN. It takes some seconds a file.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/tool.sh"
clang_tidy=$(tool clang-tidy)
cd "$1"
mapfile -t files < <(find src render -name '*.cpp' | grep -E "${3:-.}" | sort)
((${#files[@]})) || { echo "no file matches ${3:-.}" && exit 1; }
# Several files compiled as one have no entry of their own in the list of commands: clang-tidy gets a list where each has.
commands=$2/each-file
mapfile -t same < <(sed -nE 's/^(VTK_DIR|CMAKE_BUILD_TYPE|CHUTE_WATCH):[^=]*=(.*)/-D\1=\2/p' "$2/CMakeCache.txt")
cmake -S . -B "$commands" -G Ninja -DCMAKE_UNITY_BUILD=OFF "${same[@]}" >/dev/null
said=$(printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -n 1 "$clang_tidy" -p "$commands" --quiet \
  --extra-arg=-Wno-unknown-warning-option 2>/dev/null) || true
# Headers come once for each file that includes them.
problems=$(grep -E '^/.*(warning|error): ' <<<"$said" | sort -u) || true
if [[ $problems ]]; then
  printf '%s\n' "$problems"
  echo "$(wc -l <<<"$problems") problems"
  exit 1
fi
echo "${#files[@]} files"
