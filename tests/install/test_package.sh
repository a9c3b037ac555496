#!/usr/bin/env bash
# test_package.sh BUILD: the Debian package installs in a bare Debian 12, with what it depends on, and works there.
set -euo pipefail
build=$1 here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for tool in mmdebstrap dpkg-shlibdeps; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit "$([[ ${CHUTE_CI:-} ]] && echo 1 || echo 77)"; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$folder" >/dev/null
package=$(echo chute_*.deb)
cp "$package" chute.deb
depends=$(dpkg-deb -f chute.deb Depends)
for needed in fonts-stix libvtk9.1 libosmesa6 libcairo2 libharfbuzz0b; do
  [[ $depends == *$needed* ]] || { echo "$package does not depend on $needed: $depends"; exit 1; }
done
[[ $(dpkg-deb -f chute.deb Recommends) == ffmpeg ]]
# licences ask that these notices go with the program
dpkg-deb --fsys-tarfile chute.deb | tar -xO ./usr/share/doc/chute/copyright >notices
for library in libcli11-dev nlohmann-json3-dev libcereal-dev; do
  grep -q "$library" notices ||
    { echo "$package has no notices of $library"; exit 1; }
done

# mmdebstrap makes the root, runs the hooks in it, and removes it; without root it uses namespaces.
mkdir -p use && cp "$here/tiny.toml" "$here/use.sh" use
mmdebstrap --quiet --variant=apt \
  --customize-hook="copy-in '$folder/chute.deb' '$folder/use' /opt" \
  --customize-hook='chroot "$1" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends /opt/chute.deb >/dev/null' \
  --customize-hook='chroot "$1" sh /opt/use/use.sh /opt/use' \
  --customize-hook="copy-out /opt/use/figures '$folder'" \
  --customize-hook='chroot "$1" sh -c "chute --version; ls /usr/share/man/man1/chute.1.gz /usr/share/bash-completion/completions/chute"' \
  --format=null bookworm /dev/null
[[ -s $folder/figures/fig-1-06.pdf ]]
echo "$package installs in a bare Debian 12 and works there"
