#!/usr/bin/env bash
# From a bare Debian machine to pictures: installs what is missing, builds, runs a charge in a water-filled aluminium tube
# (an octant of it), compares it with experiment and references, and draws it. Usage: scripts/run_demo.sh [folder]
set -euo pipefail
demo_spacing=0.0015  # [m] particle spacing of the demo: half a minute of run; 0.001 takes two minutes
scene=cases/al_tube_fem

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

run_start=$SECONDS
mkdir -p "$(dirname "$output")"
build/release/undex run "$scene" -o "$output" -P resolution.spacing=$demo_spacing --force
run_time=$((SECONDS - run_start))

echo "== pictures"
/usr/bin/python3 scripts/plot.py "$output"

echo
echo "Results:  $output (summary.json, history/, fields/ for ParaView)"
echo "Pictures: $output/pictures"
echo "Time:     $(elapsed) in all, the run itself $run_time s, spacing $demo_spacing m"
