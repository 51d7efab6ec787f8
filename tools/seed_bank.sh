#!/usr/bin/env bash
# The cases that a new memory begins with: data/memory/seed.jsonl.gz. Four minutes on two cores for the suites, as many of one core for the recordings.
# usage: tools/seed_bank.sh HUNDRED_CAR [MOST]
#   HUNDRED_CAR  folder of the 100-Car study's release (docs/formats.md)
#   MOST         how many are kept (default 10000: all): the most redundant go
# Encounters of the suites `balanced` and `natural`, of the tuning split alone, their twins without risk, and recorded emergencies of the
# 100-Car study but for those that are shipped as scenarios (tools/shippable_cases.py). What was done before is not done again; remove build/seed_bank to begin anew.
# Where an encounter could not be played it stops with exit code 5: cases that lack some are not taken for all of them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
hundred_car=${1:?seed_bank: error: want the folder of the 100-Car release}
most=${2:-10000}
saca=build/release/saca
work=build/seed_bank
mkdir -p "$work" data/memory
rm -f "$work/bank.sqlite" "$work/shipped.sqlite"
for suite in natural balanced; do
  [ -e "$work/$suite.jsonl" ] || {
    "$saca" memory build "$suite" --count 3000 --draws 32 -o "$work/$suite.jsonl.part"
    mv "$work/$suite.jsonl.part" "$work/$suite.jsonl"
  }
  "$saca" memory import "$work/$suite.jsonl" --keep-trust --memory "$work/bank.sqlite"
done
[ -e "$work/recorded.jsonl" ] || {
  "$saca" cases build --hundred-car "$hundred_car" --draws 32 -o "$work/crash_cases.jsonl" --for-memory "$work/recorded.jsonl.part"
  mv "$work/recorded.jsonl.part" "$work/recorded.jsonl"
}
tools/shippable_cases.py "$work/recorded.jsonl" "$work/unshipped.jsonl"
"$saca" memory import "$work/unshipped.jsonl" --keep-trust --memory "$work/bank.sqlite"
"$saca" memory thin --most "$most" --memory "$work/bank.sqlite"
"$saca" memory export "$work/seed.jsonl" --memory "$work/bank.sqlite"
tools/shippable_cases.py "$work/seed.jsonl" data/memory/seed.jsonl.gz
"$saca" memory import data/memory/seed.jsonl.gz --keep-trust --memory "$work/shipped.sqlite" > /dev/null
"$saca" memory verify --memory "$work/shipped.sqlite"
