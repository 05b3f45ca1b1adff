#!/usr/bin/env bash
# From a bare Debian machine to pictures: installs what is missing, builds, runs a charge in a water-filled aluminium tube, about
# its axis and an octant in space, compares it with experiment and references, and draws it. Usage: scripts/run_demo.sh [folder]
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
scripts/install_packages.sh
build_preset release
echo "== ready after $(elapsed)"

mkdir -p "$(dirname "$output")"
run_start=$SECONDS
echo "== the tube in space, an octant of it at 2 mm, as shipped"
build/release/undex run cases/al_tube_fem -o "${output}_octant" -P resolution.spacing=$octant_spacing --force
octant_time=$((SECONDS - run_start))
run_start=$SECONDS
echo "== the tube about its axis at 0.5 mm: wall, water and charge named beforehand as the likeliest"
build/release/undex run cases/al_tube_fem/experiment.toml -o "$output" --force
run_time=$((SECONDS - run_start))

echo "== pictures"
for run in "${output}_octant" "$output"; do build/release/undex plot "$run"; done

echo
echo "Results:  $output (summary.json, history/, fields/ for ParaView)"
echo "Pictures: $output/pictures"
echo "Octant:   ${output}_octant"
echo "Time:     $(elapsed) in all, the tube about its axis $run_time s, the octant $octant_time s"
