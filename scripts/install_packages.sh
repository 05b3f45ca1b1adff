#!/usr/bin/env bash
# Installs the Debian packages that undex needs: says which are missing and asks apt for those only.
# Usage: scripts/install_packages.sh [all|program]; program: what is needed to build and use it, without the tests.
# Run as root, or as a user with sudo. Does nothing (quickly) when all are there.
set -euo pipefail

program=(
  g++                    # the compiler, C++20
  cmake                  # configures the build
  ninja-build            # builds it
  pkg-config             # finds HDF5
  git                    # the version that a run records
  libdeal.ii-dev         # finite elements: mesh and shape functions of the structure
  libhdf5-openmpi-dev    # field files; the flavour of HDF5 that deal.II links
  libxxhash-dev          # checksums of checkpoints and evidence
  libcgal-dev            # closed surfaces of triangles (STL); libdeal.ii-dev brings it too
  libeigen3-dev          # small vectors and tensors
  libtomlplusplus-dev    # scene files
  libudunits2-dev        # values with units in them
  libcli11-dev           # command line
  nlohmann-json3-dev     # summary.json
  python3                # post/: undex report and undex plot
  python3-numpy          # post/
  python3-matplotlib     # post/: pictures, colour maps, contours
  python3-h5py           # post/: reads the field files
  libjs-dygraphs         # post/: the charts of a report, copied into its page
)
tests=(
  libgtest-dev           # tests
  libnanoflann-dev       # tests: an independent neighbour search to check ours against
  libbenchmark-dev       # bench/: Google Benchmark
  clang-format           # tests: the tree is laid out as .clang-format says
  gmsh                   # tests: the meshes that docs/tasks tells how to make (33 kB: its library comes with deal.II)
  dpkg-dev               # cpack: what a Debian package depends on
  mkdocs-material        # scripts/build_site.sh: the documentation as a site (49 MB on disk)
  valgrind               # tests: counts the instructions of a step
  chromium               # tests: opens reports, headless (414 MB with what it needs)
)
case ${1:-all} in
  all) packages=("${program[@]}" "${tests[@]}") ;;
  program) packages=("${program[@]}") ;;
  *) echo "install_packages.sh: unknown word '$1'; usage: scripts/install_packages.sh [all|program]" >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install_packages.sh: this is not Debian (no dpkg or apt-get). Install what corresponds to:" >&2
  printf '  %s\n' "${packages[@]}" >&2
  exit 2
fi

# One call for all; unknown packages only make dpkg-query's exit code non-zero.
installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
  [[ $'\n'$installed$'\n' == *$'\n'"$package installed"$'\n'* ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "Debian packages: all ${#packages[@]} are installed."
  exit 0
fi
echo "Debian packages missing: ${missing[*]}"

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "install_packages.sh: installing needs root, and there is no sudo here. As root, run:" >&2
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q "$@"; }
install_missing() { apt update && apt install -y --no-install-recommends "${missing[@]}"; }
if ! install_missing; then
  echo "install_packages.sh: apt failed; once more in 5 s" >&2
  sleep 5
  if ! install_missing; then
    cat >&2 <<MESSAGE
install_packages.sh: apt could not install: ${missing[*]}
  Its own message stands above. Usual causes: no network (or a proxy that apt does not know), another apt running, or
  sources without Debian 12's "main". Mend that and run scripts/install_packages.sh again: it goes on where it stopped.
MESSAGE
    exit 1
  fi
fi
echo "Debian packages: installed ${#missing[@]}."
