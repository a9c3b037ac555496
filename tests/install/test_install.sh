#!/usr/bin/env bash
# test_install.sh ROOT BUILD: what cmake --install makes works where ROOT and BUILD are gone, and names neither.
set -euo pipefail
unset CHUTE_SCENES  # the installed program must find its own
root=$1 build=$2 here=$(dirname "${BASH_SOURCE[0]}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*" && exit 1; }

cmake --install "$build" --prefix "$folder/first" >/dev/null
mv "$folder/first" "$folder/moved"  # a prefix is found where it lies, not where it was put
chute=$folder/moved/bin/chute
cp "$here/tiny.toml" "$here/use.sh" "$folder"

if grep -q '^CHUTE_WATCH:.*=nothing$' "$build/CMakeCache.txt" && grep -q '^CMAKE_BUILD_TYPE:.*=Release$' "$build/CMakeCache.txt"; then
  strings -a "$chute" >"$folder/strings"
  (($(wc -l <"$folder/strings") > 1000)) || fail "strings saw nothing in $chute"
  grep -F "$root" "$folder/strings" && fail "the installed program names the tree that it was built from"
fi

# The manual and the completion, as the reader's and the shell's own programs take them
page=$(gzip -dc "$folder"/moved/share/man/man1/chute.1.gz)
for verb in $("$chute" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
  for option in $("$chute" "$verb" --help | grep -oE '^  (-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+'); do
    grep -qF -- "${option//-/\\-}" <<<"$page" || fail "chute.1 does not have $option of $verb"
  done
done
if command -v man >/dev/null; then
  said=$(LC_ALL=C.UTF-8 MANROFFSEQ='' man --warnings -E UTF-8 -l -Tutf8 "$folder/moved/share/man/man1/chute.1.gz" 2>&1 >"$folder/page")
  [[ -z $said ]] || fail "man says of chute.1: $said"
  grep -q 'size-ratio' "$folder/page" || fail "man does not show the options of theory"
fi
complete_words() {
  PATH=$folder/moved/bin:$PATH bash -c '. "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _chute chute
    printf "%s\n" "${COMPREPLY[@]}"' bash "$folder/moved/share/bash-completion/completions/chute" "$@"
}
[[ $(complete_words chute ren) == render ]] || fail "bash does not complete the verb ren"
[[ $(complete_words chute run --res) == --resume ]] || fail "bash does not complete --res of run"
[[ $(complete_words chute figure fig-2-0) == fig-2-02 ]] || fail "bash does not complete the figure fig-2-0"

# In a mount namespace of its own the trees are empty folders; where there may be none, they only are not named.
use=(bash "$folder/use.sh" "$folder")
if unshare --mount --map-root-user true 2>/dev/null; then
  PATH=$folder/moved/bin:$PATH unshare --mount --map-root-user bash -c '
    set -e
    mount -t tmpfs none "$1" && shift
    mount -t tmpfs none "$1" && shift
    exec "$@"' bash "$root" "$([[ $build == "$root"/* ]] && echo /mnt || echo "$build")" "${use[@]}"
else
  PATH=$folder/moved/bin:$PATH "${use[@]}"
fi
echo "installed, moved and used"
