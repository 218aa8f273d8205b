# Steps of a long run, and what is said of them at the end: for .ci/run and tests/all.sh, by `source`.

closing_lines=()
times=()
title='' began=$SECONDS

# Begins a step; what the one before took is kept for the end.
step() {
  [[ -z $title ]] || times+=("$(printf '%5d s  %s' $((SECONDS - began)) "$title")")
  title=$1 began=$SECONDS
  printf '\n=== %s (%d s)\n' "$1" "$SECONDS"
}

# Runs a command whose output ends with ctest's summary, and keeps that summary for the end.
keep_summary() {
  local title=$1 log
  shift
  log=$(mktemp)
  "$@" 2>&1 | tee "$log"
  closing_lines+=("$title:" "$(grep -E '^[0-9]+% tests passed' "$log" | tail -n 1)")
  rm -f "$log"
}

# The time of each step, and the summaries.
closing() {
  step 'These steps passed'
  printf '%s\n' "${times[@]}" "$(printf '%5d s  in all' "$SECONDS")"
  ((${#closing_lines[@]} == 0)) || printf '%s\n' "${closing_lines[@]}"
}
