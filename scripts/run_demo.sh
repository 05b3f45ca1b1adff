#!/usr/bin/env bash
# From a bare Debian machine to one page to look at: installs what is missing, builds the program, runs a charge in a water-filled
# aluminium tube, about its axis and an octant in space, and compares both with the experiment. Usage: scripts/run_demo.sh [folder]
set -euo pipefail
octant_spacing=0.002  # [m] of the octant in space; the tube about its axis has 0.5 mm

case ${1:-} in
  -h | --help) sed -n '2,3s/^# //p' "$0"; exit 0 ;;
  -*) echo "run_demo.sh: unknown option '$1'; usage: scripts/run_demo.sh [folder]" >&2; exit 2 ;;
esac
output=$(realpath -m "${1:-$(dirname "${BASH_SOURCE[0]}")/../out/demo}")

SECONDS=0
# shellcheck source=scripts/build.sh
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
undex=build/program/undex

stage "packages" "one to three minutes where all are missing"
scripts/install_packages.sh program
stage "build of the program" "$jobs at once; two to four minutes at the first time on two cores"
build_preset program undex

mkdir -p "$(dirname "$output")"
stage "the tube about its axis, 0.5 mm" "the wall, water and charge that were named beforehand"
"$undex" run cases/al_tube_fem/experiment.toml -o "$output" -P output.field_interval="2 us" --force
stage "the tube in space, an octant at 2 mm" "the same wall, water and charge"
"$undex" run cases/al_tube_fem/experiment.toml -o "${output}_octant" -P dimension=3 -P 'symmetry.planes=["x", "y", "z"]' \
  -P resolution.lattice=rings -P resolution.spacing=$octant_spacing -P output.field_interval="5 us" --force
stage "the page"
"$undex" report "$output" "${output}_octant" -o "$output.html"

printf '\n'
/usr/bin/python3 scripts/demo_table.py "$output" "${output}_octant"
printf '\nTime:\n'
stage_table
printf '  %-44s %s\n' "in all" "$(elapsed)"
printf '\nOpen:  %s\n' "$output.html"
