#!/usr/bin/env bash
# format.sh ROOT: all of the code is as clang-format leaves it.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/tool.sh"
clang_format=$(tool clang-format)
cd "$1"
mapfile -t files < <(find src render tests -name '*.cpp' -o -name '*.hpp' -o -name '*.c')
# A check that saw nothing is no check.
((${#files[@]} > 100)) || { echo "only ${#files[@]} files in $1" && exit 1; }
"$clang_format" --dry-run --Werror "${files[@]}" || {
  echo "Mend it with: clang-format-14 -i FILE"
  exit 1
}
echo "${#files[@]} files"
