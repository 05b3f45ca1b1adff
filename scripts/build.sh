# Sourced by run_demo.sh and run_tests.sh: packages, configure, build. Not to be run by itself.
# Gives $root (the project's folder, which becomes the working folder), build_preset NAME [TARGET], stage and elapsed.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 1

# A compiler on deal.II's headers takes about 1.5 GB: no more of them at once than memory holds, nor than there are cores.
jobs=$(nproc)
memory_jobs=$(($(awk '/MemAvailable/ {print $2}' /proc/meminfo) / 1500000))
((memory_jobs >= 1)) || memory_jobs=1
((jobs <= memory_jobs)) || jobs=$memory_jobs

in_words() { if (($1 < 60)); then printf '%d s' "$1"; else printf '%d min %02d s' $(($1 / 60)) $(($1 % 60)); fi; }
elapsed() { in_words "$SECONDS"; }

# stage WORDS: the stage that begins; the one before is closed with its time, which is kept for stage_table.
stage_names=()
stage_times=()
stage_start=0
close_stage() {
  if ((${#stage_names[@]} > ${#stage_times[@]})); then stage_times+=($((SECONDS - stage_start))); fi
}
stage() {
  close_stage
  stage_names+=("$1")
  stage_start=$SECONDS
  printf '\n== %s%s\n' "$1" "${2:+ ($2)}"
}
stage_table() {
  close_stage
  local k
  for k in "${!stage_names[@]}"; do printf '  %-44s %s\n' "${stage_names[k]}" "$(in_words "${stage_times[k]}")"; done
}

# Says how far ninja has come: a line that replaces itself on a terminal, one every fifteen seconds elsewhere.
watch_build() {
  local line said=$SECONDS begun=$SECONDS done all left
  while IFS= read -r line; do
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\ (.*)$ ]]; then
      done=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]} left=
      ((SECONDS - begun < 5 || done == 0)) || left=", about $(in_words $(((SECONDS - begun) * (all - done) / done))) left"
      if [[ -t 1 ]]; then
        printf '\r\033[K  compiled %d of %d%s' "$done" "$all" "$left"
      elif ((SECONDS - said >= 15 || done == all)); then
        printf '  compiled %d of %d%s\n' "$done" "$all" "$left"
        said=$SECONDS
      fi
    else
      [[ ! -t 1 ]] || printf '\r\033[K'
      printf '%s\n' "$line"  # an error, or a warning
    fi
  done
  [[ ! -t 1 ]] || printf '\r\033[K'
}

# build_preset NAME [TARGET]: configures and builds the preset of that name in build/NAME.
build_preset() {
  local log
  log=$(mktemp)
  # From nothing, modules that compute nothing are compiled in batches. A build that is there keeps what it has.
  local batches=()
  [[ $1 == program || -e build/$1/CMakeCache.txt ]] || batches=(-DUNDEX_UNITY=cold)
  if ! cmake --preset "$1" "${batches[@]}" >"$log" 2>&1; then
    cat "$log"
    rm -f "$log"
    echo "configuring the preset '$1' failed: cmake's own message stands above" >&2
    return 1
  fi
  rm -f "$log"
  NINJA_STATUS='[%f/%t] ' cmake --build --preset "$1" -j "$jobs" ${2:+--target "$2"} | watch_build
}
