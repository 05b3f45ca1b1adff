#!/usr/bin/env bash
# Installs the Debian packages in a bare Debian 12 and uses them there. As root, with debootstrap and the network; some minutes, so
# not among ctest's tests (those of tests/packages install into a folder).
# Usage: scripts/test_package.sh [--libraries] [--base FOLDER] PACKAGES
#   PACKAGES      folder with undex_*.deb (and libundex-dev_*.deb), as cpack leaves them
#   --libraries   builds tests/packages/consumer there too (compiler and headers: a gigabyte more)
#   --base FOLDER a bare Debian that debootstrap has made; it is made where it is missing, and kept
set -euo pipefail
source_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
usage() { sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit "$1"; }

libraries=no base='' packages=''
while (($#)); do
  case $1 in
    -h | --help) usage 0 ;;
    --libraries) libraries=yes ;;
    --base) base=${2:?"--base needs a folder"}; shift ;;
    -*) usage 2 >&2 ;;
    *) packages=$1 ;;
  esac
  shift
done
[[ $packages ]] || usage 2 >&2
program=("$packages"/undex_*.deb)
[[ -f ${program[0]} ]] || { echo "test_package.sh: no undex_*.deb in $packages; make it by cpack -G DEB in the build folder" >&2; exit 2; }
((EUID == 0)) || { echo "test_package.sh: chroot needs root" >&2; exit 2; }
command -v debootstrap >/dev/null || { echo "test_package.sh: install debootstrap" >&2; exit 2; }

work=$(mktemp -d "${TMPDIR:-/tmp}/undex_package.XXXXXX")
root=$work/root
clean() {
  ! mountpoint -q "$root/proc" || umount "$root/proc"
  rm -rf --one-file-system "$work"
}
trap clean EXIT

begun=$SECONDS
stage() { printf '== %s (%d s)\n' "$1" $((SECONDS - begun)); }
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/tmp DEBIAN_FRONTEND=noninteractive OMP_NUM_THREADS=1 "$@"; }
# Nothing of this needs to survive a power cut: dpkg need not wait for the disk.
apt_install() {
  inside apt-get -q -y -o Dpkg::Options::=--force-unsafe-io install --no-install-recommends "$@" &>>"$work/apt.log" && return
  tail -n 20 "$work/apt.log" >&2
  exit 1
}
size() { du -sm --one-file-system "$root" | cut -f 1; }

stage "bare Debian 12"
[[ $base ]] || base=$work/base
if [[ ! -d $base/etc ]]; then debootstrap --variant=minbase bookworm "$base" http://deb.debian.org/debian >"$work/debootstrap.log"; fi
cp -a "$base" "$root"
mount -t proc proc "$root/proc"
inside apt-get -q update &>"$work/apt.log"
bare=$(size)

stage "apt-get install ${program[0]##*/}"
cp "$packages"/*.deb "$root/tmp/"
apt_install "/tmp/${program[0]##*/}"
inside apt-get clean
printf '   package %s MB, with all that it needs %d MB on disk\n' "$(du -m "${program[0]}" | cut -f 1)" $(($(size) - bare))

stage "undex version, list"
inside undex version
inside undex list >"$work/list"
if grep -o '[^ ]*/cases/[^ ]*' "$work/list" | grep -v '^/usr/share/undex/cases/'; then echo "undex list names other folders" >&2; exit 1; fi
printf '   %d scenes\n' "$(grep -c '/usr/share/undex/cases/' "$work/list")"

stage "a coarse run"
inside undex run /usr/share/undex/cases/al_tube_fem/experiment.toml -P 'resolution.spacing=2 mm' -P 'end_time=60 us' -q -o /tmp/tube
grep -q '"status": "done"' "$root/tmp/tube/summary.json"
if inside undex --help | grep -q '^ *report '; then
  stage "undex report"
  inside undex report /tmp/tube -o /tmp/tube.html
  grep -qi '</html>' "$root/tmp/tube.html"
fi

if [[ $libraries == yes ]]; then
  stage "libundex-dev, and another project that uses it"
  developer=("$packages"/libundex-dev_*.deb)
  apt_install "/tmp/${developer[0]##*/}" g++ cmake ninja-build
  printf '   with compiler and headers %d MB on disk\n' $(($(size) - bare))
  cp -r "$source_folder/tests/packages/consumer" "$root/tmp/consumer"
  inside cmake -G Ninja -S /tmp/consumer -B /tmp/built >"$work/cmake.log" || { cat "$work/cmake.log"; exit 1; }
  inside cmake --build /tmp/built | tail -n 1
  inside /tmp/built/laws
  inside /tmp/built/scene /tmp/consumer/plate.toml /tmp/plate
fi
stage "done"
