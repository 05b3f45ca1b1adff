# Sourced by run_demo.sh and run_tests.sh: packages, configure, build. Not to be run by itself.
# Gives $root (the project's folder, which becomes the working folder) and build_preset NAME.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 1

# A compiler on deal.II's headers takes about 1.5 GB: no more of them at once than memory holds, nor than there are cores.
jobs=$(nproc)
memory_jobs=$(($(awk '/MemAvailable/ {print $2}' /proc/meminfo) / 1500000))
((memory_jobs >= 1)) || memory_jobs=1
((jobs <= memory_jobs)) || jobs=$memory_jobs

# build_preset NAME: configures and builds the preset of that name in build/NAME.
build_preset() {
  echo "== build ($1, $jobs at once)"
  local log
  log=$(mktemp)
  if ! cmake --preset "$1" >"$log" 2>&1; then
    cat "$log"
    rm -f "$log"
    echo "configuring the preset '$1' failed: cmake's own message stands above" >&2
    return 1
  fi
  rm -f "$log"
  cmake --build --preset "$1" -j "$jobs"
}

elapsed() { printf '%d min %02d s' $((SECONDS / 60)) $((SECONDS % 60)); }
