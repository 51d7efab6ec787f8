#!/usr/bin/env bash
# Measures what docs/results.md shows. Each run of the list below leaves build/figures/NAME.json: the figures that its command
# prints, with the command, the commit of the programs, date and processor. Then they are put into docs/results.json, and the page is made.
# usage: tools/bench.sh [NAME...]    only these runs; without names all of them
# A run that is there already, of the same commit and by the same command, is not repeated: an interrupted bench goes on where
# it stopped. Remove build/figures to measure again.
# Recordings and what others have published are not in the repository (data/README.md). Runs whose command names a variable are
# left out unless it names what is there:
#   SACA_INTENTION        folder that `tools/intention.sh` leaves; default: build/intention
#   SACA_NGSIM            folder with the CommonRoad files of NGSIM
#   SACA_100CAR           folder with the release of the 100-Car study
#   SACA_AUTHORS_NETWORK  the published safe_value_params.npz
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

all_runs() {
  cat <<'END'
start                start_time.py saca 100car_9018
physics              saca physics --drift-draws 400 --json
balance_balanced     saca balance --suite balanced --count 4000 --json
balance_natural      saca balance --suite natural --count 4000 --json
oracle_t1            saca oracle intersection_t1 --at-s 5 --draws 100 --json
oracle_t1_trigger    saca oracle intersection_t1 --draws 100 --json
oracle_late_truck    saca oracle intersection_late_truck --at-s 5 --draws 100 --json
oracle_one_way       saca oracle one_way --at-s 4.2 --draws 100 --json
oracle_follower      saca oracle lead_brakes_follower --draws 100 --json
run_9018             saca run 100car_9018 --llm off --pace lockstep --no-memory --json
run_8911             saca run 100car_8911 --llm off --pace lockstep --no-memory --json
run_8676             saca run 100car_8676 --llm off --pace lockstep --no-memory --json
run_t1               saca run intersection_t1 --llm off --pace lockstep --no-memory --json
run_t2               saca run intersection_t2 --llm off --pace lockstep --no-memory --json
run_one_way          saca run one_way --llm off --pace lockstep --no-memory --json
atlas_info           saca atlas build >&2 && saca atlas info --json
atlas_check          saca atlas build >&2 && saca atlas check --scenes 1000 --json
reach_check          saca reach check --json
authors_network      saca reach solve paper_ellipse --output ellipse.h5 >&2 && saca reach compare ellipse.h5 --network "$SACA_AUTHORS_NETWORK" --json
traffic              saca suite traffic --data "$SACA_NGSIM" "$SACA_100CAR" --count 5000 --json
intent_eval          saca intent eval "$SACA_INTENTION/sequences.h5" --json
intent_motion        saca intent motion "$SACA_INTENTION/commonroad.h5" "$SACA_INTENTION/100car.h5" --json
bench_vehicle        saca bench vehicle --json
bench_decide         saca bench decide --calls 300000 --json
bench_atlas          saca bench atlas --json
bench_reach          saca bench reach --json
batch                rollout_bench --benchmark_filter=scenes --benchmark_min_time=1 --benchmark_format=json
outcome              rollout_bench --benchmark_filter='judge|slide' --benchmark_min_time=1 --benchmark_format=json
perception           sim_bench --benchmark_min_time=1 --benchmark_format=json
intent               intent_bench --benchmark_min_time=1 --benchmark_format=json
memory               memory_bench --benchmark_min_time=0.5 --benchmark_format=json
model_bench          saca model bench --runs 10 --json
model_process        GOMP_SPINCOUNT=10000 model_host_process_bench --benchmark_format=json
END
}

figures=$PWD/build/figures
export SACA_INTENTION=${SACA_INTENTION:-$PWD/build/intention}
export PATH=$PWD/build/release:$PWD/build/release/apps/model_host:$PWD/tools:$PATH
for module in rollout sim intent memory; do PATH+=:$PWD/build/release/modules/$module; done

# The last commit that changed the programs or what they read.
programs=(saca apps data scenarios models cmake CMakeLists.txt CMakePresets.json)
commit=$(git log -1 --format=%h -- "${programs[@]}")
[ -z "$(git status --porcelain -- "${programs[@]}")" ] || commit+=" with changes"

lacking() {  # COMMAND: the first variable in it that does not name what is there
  local variable
  for variable in $(grep -o 'SACA_[A-Z0-9_]*' <<<"$1" | sort -u); do
    [ -e "${!variable:-}" ] || { echo "$variable" && return; }
  done
}

measure() {  # NAME COMMAND
  local start=$SECONDS
  rm -rf "$scratch" && mkdir -p "$scratch"
  ln -s "$PWD/data" "$scratch/data"  # which benchmarks of modules read, as their tests do
  if (cd "$scratch" && bash -c "$2" </dev/null >out 2>err) &&
    tools/figures.py keep "$figures/$1.json" "$2" "$commit" $((SECONDS - start)) <"$scratch/out" 2>>"$scratch/err"; then
    echo "$((SECONDS - start)) s"
  else
    echo "failed: $(tail -n 1 "$scratch/err")"
    return 1
  fi
}

names=$(all_runs | awk '{print $1}')
for name in "$@"; do
  grep -qx "$name" <<<"$names" || {
    echo "bench: error: want one of $(tr '\n' ' ' <<<"$names"), got $name" >&2
    exit 2
  }
done

mkdir -p "$figures"
scratch=$(mktemp -d "$figures/scratch.XXXXXX")  # where the runs are at home, so that what they leave is nobody's
trap 'rm -rf "$scratch"' EXIT
there=() failed=() number=0 count=$#
[ $# -gt 0 ] || count=$(wc -l <<<"$names")
while read -r name command; do
  [ $# -eq 0 ] || [[ " $* " == *" $name "* ]] || continue
  number=$((number + 1))
  printf '[%d/%d] %s: ' "$number" "$count" "$name"
  variable=$(lacking "$command")
  if [ -n "$variable" ]; then
    echo "left out: $variable does not name what it needs (see the beginning of tools/bench.sh)"
  elif [[ $commit != *changes ]] && tools/figures.py is_there "$figures/$name.json" "$command" "$commit"; then
    echo "is there"
    there+=("$figures/$name.json")
  elif measure "$name" "$command"; then
    there+=("$figures/$name.json")
  else
    failed+=("$name")
  fi
done < <(all_runs)

[ ${#there[@]} -eq 0 ] || tools/results_page.py "${there[@]}"
[ ${#failed[@]} -eq 0 ] || {
  echo "bench: error: failed: ${failed[*]}; the figures of these runs are as they were" >&2
  exit 1
}
