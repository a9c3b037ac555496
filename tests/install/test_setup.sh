#!/usr/bin/env bash
# test_setup.sh ROOT: .ci/install never harms a machine. It meets an apt and a dpkg made of paper, which note what they
# are asked for; the packages that are missing, and what they would remove, are said in files.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/tree/.ci" "$folder/paper"
cp "$1/.ci/install" "$1/.ci/packages.txt" "$folder/tree/.ci"
export PAPER=$folder/paper
cat >"$PAPER/apt-get" <<'END'
#!/bin/bash
echo "$*" >>"$PAPER/asked"
if [[ $1 == download ]]; then touch "$3.deb"; fi
[[ " $* " == *' -s '* ]] || exit 0
for word in "$@"; do
  sed -n "s/^$word removes /Remv /p" "$PAPER/removes"
  if grep "^ $word :" "$PAPER/removes"; then exit 100; fi  # apt refuses, and says why
done
exit 0
END
cat >"$PAPER/dpkg-query" <<'END'
#!/bin/bash
grep -qx "${!#}" "$PAPER/missing" || echo 'install ok installed'
END
printf '#!/bin/sh\nexit 0\n' | tee "$PAPER/dpkg" >"$PAPER/sudo"
chmod +x "$PAPER"/*

# try STATUS LIST…: .ci/install ends with that status; what it said is in $said, what apt was asked to do in $asked
try() {
  local expected=$1 status=0
  : >"$PAPER/asked"
  said=$("${as[@]}" env PATH="$PAPER:$PATH" bash "$folder/tree/.ci/install" "${@:2}" 2>&1 </dev/null) || status=$?
  asked=$(grep -v -- ' -s ' "$PAPER/asked" || true)
  ((status == expected)) || fail "exit status $status, not $expected"
}
fail() {
  printf 'FAILED: %s\nit said:\n%s\napt was asked for:\n%s\n' "$*" "$said" "$(cat "$PAPER/asked")"
  exit 1
}
as=()
: >"$PAPER/removes"

: >"$PAPER/missing"
try 0 build tests
[[ -z $asked ]] || fail "nothing is missing, yet apt is called"

printf '%s\n' libfmt-dev gcovr catch2 >"$PAPER/missing"
try 0 build
grep -q -- '--no-remove .*libfmt-dev' <<<"$asked" || fail "what is missing is not installed with --no-remove"
! grep -qE 'catch2|gcovr' <<<"$asked" || fail "what only tests need is installed for chute"
try 0 build tests
grep -q catch2 <<<"$asked" || fail "what tests need is not installed for them"
! grep -q gcovr <<<"$asked" || fail "gcovr is for coverage only"

# ParaView is there: VTK's Python stays away, its headers are unpacked, and the tests do without
printf '%s\n' libvtk9-dev libglew-dev python3-vtk9 catch2 >"$PAPER/missing"
printf '%s\n' 'libvtk9-dev removes python3-paraview' 'python3-vtk9 removes python3-paraview' >"$PAPER/removes"
try 0 build tests
installed=$(grep -- ' install ' <<<"$asked")
! grep -qE 'libvtk9-dev|python3-vtk9' <<<"$installed" || fail "what removes ParaView is installed"
grep -q 'libglew-dev.*catch2' <<<"$installed" || fail "the others are not installed"
grep -q 'download.*libvtk9-dev' <<<"$asked" || fail "VTK's headers are not fetched"
grep -q 'python3-vtk9 (it would remove python3-paraview)' <<<"$said" || fail "nobody is told that tests are skipped"
: >"$PAPER/removes"
printf '%s\n' libvtk9-dev >"$PAPER/missing"
try 0 build
[[ -z $asked ]] || fail "headers that were unpacked are fetched again"
rm -r "$folder/tree/build"

# Where ParaView was asked for by its user, apt refuses instead
printf '%s\n' libvtk9-dev python3-vtk9 >"$PAPER/missing"
printf ' %s : Conflicts: python3-paraview\n' libvtk9-dev python3-vtk9 >"$PAPER/removes"
try 0 build tests
grep -q 'download.*libvtk9-dev' <<<"$asked" || fail "VTK's headers are not fetched"
grep -q 'Not installed: python3-vtk9' <<<"$said" || fail "nobody is told that tests are skipped"
rm -r "$folder/tree/build"

# A conflict that there is no way around
printf '%s\n' libfmt-dev >"$PAPER/missing"
printf '%s\n' 'libfmt-dev removes libfancy-dev' >"$PAPER/removes"
try 2 build
grep -q 'libfmt-dev: it would remove libfancy-dev' <<<"$said" || fail "the conflict is not told"
! grep -q ' install ' <<<"$asked" || fail "it installs all the same"

# Neither root nor sudo
: >"$PAPER/removes"
if ((EUID == 0)); then
  as=("$(command -v setpriv)" --reuid=65534 --clear-groups)
  chmod -R a+rwX "$folder"
fi
rm "$PAPER/sudo"
for tool in bash sh env cut sed awk grep mktemp paste tail cat rm dirname; do ln -s "$(command -v "$tool")" "$PAPER/$tool"; done
PATH=$PAPER
try 2 build
grep -q 'apt-get install --no-remove .*libfmt-dev' <<<"$said" || fail "the command for root is not told"
[[ -z $asked ]] || fail "apt is called without root"
echo "eight machines, none harmed"
