#!/usr/bin/env bash
# Builds what is needed and tries for hours to make undex fail: kills, full disks, damaged checkpoints, changed scenes, fuzzers of
# all readers, memory that runs out, and the tests of the checked build.
# Usage: scripts/torture.sh --hours N [--seed S] [--parts LIST]
#   --hours N: how long in all, building aside; 0.1 is a trial.  --seed S: what is tried (default: the time).
#   --parts LIST: only these, with commas; all of kills,disks,checkpoints,scenes,in_process,fuzz,memory,checked unless given.
# Prints what each part counted; ends with 1 where anything failed. What failed is kept and named. docs/results/reliability.md says what
# each part tries. The fuzzers need clang, and the full disks root; without clang they are left out, and said to be.
set -uo pipefail
hours=''
seed=$(date +%s)
all=kills,disks,checkpoints,scenes,in_process,fuzz,memory,checked
parts=$all
while (($#)); do
  case $1 in
    --hours) hours=${2:-}; shift 2 || break ;;
    --seed) seed=${2:-}; shift 2 || break ;;
    --parts) parts=${2:-}; shift 2 || break ;;
    -h | --help) sed -n '2,8s/^# *//p' "$0"; exit 0 ;;
    *) echo "torture.sh: unknown option '$1'; see --help" >&2; exit 2 ;;
  esac
done
if ! [[ $hours =~ ^[0-9]*\.?[0-9]+$ && $seed =~ ^[0-9]+$ ]]; then
  echo "torture.sh: usage: scripts/torture.sh --hours N [--seed S] [--parts LIST]; N such as 8 or 0.5, S a whole number" >&2
  exit 2
fi
[[ ${parts//,/} ]] || { echo "torture.sh: --parts names none; known: ${all//,/, }" >&2; exit 2; }
for each in ${parts//,/ }; do
  [[ ,$all, == *,$each,* ]] || { echo "torture.sh: there is no part '$each'; known: ${all//,/, }" >&2; exit 2; }
done
wanted() { [[ ,$parts, == *,$1,* ]]; }

# shellcheck source=scripts/build.sh
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
scripts/install_packages.sh || exit 1
build_preset release || exit 1
! wanted checked || build_preset checked || exit 1
fuzzers=()
if wanted fuzz && command -v clang++ >/dev/null && build_preset fuzz; then
  fuzzers=(scene overrides study mesh reference record)
fi

python=/usr/bin/python3
[[ -x $python ]] || python=python3
export PYTHONDONTWRITEBYTECODE=1 OMP_WAIT_POLICY=passive
logs=$root/out/torture_$seed
mkdir -p "$logs"
total=$(awk "BEGIN {print int(3600 * $hours)}")
began=$SECONDS
summary=()
status=0

# share PERCENT: that share of the time [s], at least 20.
share() { local s=$((total * $1 / 100)); echo $((s > 20 ? s : 20)); }
minutes() { awk "BEGIN {print $(share "$1") / 60}"; }

# What the log of a part counted, rounds added up.
counted() {
  awk '/ read, .* refused$/ && !/:/ { scenes += $1 + $3 }
    / damaged, .* refused, / { damaged[$1] += $2 }
    /number_of_executed_units/ { inputs = $2 }
    /^(kills|disks|checkpoints|scenes), seed|tests passed/ { print }
    END {
      if (scenes) print scenes " changed scenes, overrides and studies read or refused"
      for (each in damaged) print each " " damaged[each] " damaged"
      if (inputs) print inputs " inputs"
    }' "$1"
}

# part NAME COMMAND...: runs it where it is wanted, keeps what it says in a log, and notes what it counted and whether it failed.
part() {
  wanted "${1%%_of_*}" || return 0
  local name=$1 code=0 log=$logs/$1.log counts
  shift
  echo "== $name"
  "$@" >"$log" 2>&1 || code=$?
  counts=$(counted "$log")
  if ((code != 0)); then
    status=1
    tail -n 20 "$log"
    counts="FAILED with exit code $code, see $log"$'\n'$counts
  fi
  counts=${counts:-passed}
  echo "$counts"
  summary+=("$name: ${counts//$'\n'/; }")
}

torture() { "$python" tests/robustness/torture.py build/release/undex cases "$1" --count 1000000 --seed "$seed" --minutes "$(minutes "$2")"; }

# in_process PERCENT: changed scenes and damaged files in one process, one round of them after another with other seeds.
in_process() {
  local tests=build/release/tests/robustness
  local until=$((SECONDS + $(share "$1"))) round=0
  while ((SECONDS < until)); do
    UNDEX_MUTATIONS=1000 UNDEX_SEED=$((seed % 1000000 + round)) "$tests"/test_robustness &&
      UNDEX_MUTATIONS=5000 UNDEX_SEED=$((seed % 1000000 + round)) "$tests"/test_sealed_files || return 1
    round=$((round + 1))
  done
}

# fuzz NAME PERCENT: what is new is kept in the build's corpus.
fuzz() {
  local corpus=build/fuzz/corpus
  mkdir -p "$corpus/$1.found"
  build/fuzz/fuzz_"$1" "$corpus/$1.found" "$corpus/$1" -dict="$corpus/$1.dict" -max_total_time="$(share "$2")" -timeout=20 \
    -rss_limit_mb=3000 -max_len=20000 -seed=$((seed % 1000000 + 1)) -print_final_stats=1 -verbosity=1 -artifact_prefix="$logs/${1}_"
}

part kills torture kills 20
part disks torture disks 10
part checkpoints torture checkpoints 5
part scenes torture scenes 15
part in_process in_process 15
if ((${#fuzzers[@]})); then
  "$python" tests/fuzz/corpus.py . build/fuzz/corpus
  for each in "${fuzzers[@]}"; do part "fuzz_of_$each" fuzz "$each" 4; done
elif wanted fuzz; then
  summary+=("fuzz: left out: no clang++ (apt-get install clang)")
fi
memory=build/release/tests/robustness/libundex_failing_memory.so
if [[ -f $memory ]]; then
  part memory env UNDEX_SEED=$((seed % 1000000)) "$python" tests/robustness/out_of_memory.py build/release/undex cases "$memory" \
    $((total / 100 + 5))
fi
part checked timeout --foreground $(($(share 10) + 3600)) ctest --preset checked -j "$(nproc)" --label-exclude long --no-tests=error

echo
echo "== torture, seed $seed: $(((SECONDS - began) / 60)) min"
printf '%s\n' "${summary[@]}"
((status == 0)) && echo "nothing failed" || echo "something FAILED"
exit "$status"
