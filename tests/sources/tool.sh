# tool NAME: the path of clang's tool NAME in version 14, which Debian 12 has; other versions judge otherwise. The test
# is skipped (77) where it is not installed, but fails in continuous integration, where nothing may be skipped.
tool() {
  local name
  for name in "$1-14" "$1"; do
    if command -v "$name" >/dev/null && "$name" --version | grep -q 'version 14\.'; then
      command -v "$name"
      return
    fi
  done
  echo "skipped: $1 in version 14 is not installed (Debian: $1-14)" >&2
  [[ ${CHUTE_CI:-} ]] && return 1
  return 77
}
