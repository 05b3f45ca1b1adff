#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test. Usage: scripts/run_tests.sh [--checked]
#   --checked: the build with assertions, AddressSanitizer and UndefinedBehaviorSanitizer, and only the tests without the
#   label "long".
set -euo pipefail
preset=release
select=()
for argument in "$@"; do
  case $argument in
    --checked) preset=checked; select=(--label-exclude long) ;;
    -h | --help) sed -n '2,4s/^# *//p' "$0"; exit 0 ;;
    *) echo "run_tests.sh: unknown option '$argument'; the only one is --checked" >&2; exit 2 ;;
  esac
done

SECONDS=0
# shellcheck source=scripts/build.sh
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
scripts/install_packages.sh
stage "build ($preset)" "$jobs at once"
build_preset "$preset"

# Tests side by side must not also fill every core each.
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
stage "tests ($preset)"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
status=0
ctest --preset "$preset" -j "$(nproc)" --output-on-failure --no-tests=error "${select[@]}" | tee "$log" || status=$?
printf "\n== build and tests took %s\n" "$(elapsed)"
grep -a 'tests passed' "$log" | tail -n 1 || true
exit "$status"
