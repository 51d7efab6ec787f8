#!/usr/bin/env bash
# The cases that a new memory begins with: data/memory/seed.jsonl.gz. Four minutes on two cores.
# usage: tools/seed_bank.sh [MOST]
#   MOST  how many are kept (default 10000: all): the most redundant go
# Encounters of the suites `balanced` and `natural`, of the tuning split alone, and their twins without risk. Numbers keep five digits:
# features differ by less than a thousandth of what makes a difference. What was done before is not done again; remove build/seed_bank
# to begin anew.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
most=${1:-10000}
saca=build/release/saca
work=build/seed_bank
mkdir -p "$work" data/memory
rm -f "$work/bank.sqlite" "$work/shipped.sqlite"
for suite in natural balanced; do
  [ -e "$work/$suite.jsonl" ] || "$saca" memory build "$suite" --count 3000 --draws 32 -o "$work/$suite.jsonl"
  "$saca" memory import "$work/$suite.jsonl" --keep-trust --memory "$work/bank.sqlite"
done
"$saca" memory thin --most "$most" --memory "$work/bank.sqlite"
"$saca" memory export "$work/seed.jsonl" --memory "$work/bank.sqlite"
python3 - "$work/seed.jsonl" data/memory/seed.jsonl.gz << 'EOF'
import gzip
import json
import sys


def rounded(value):
    if isinstance(value, float):
        return float(f"{value:.5g}")
    if isinstance(value, dict):
        return {key: rounded(each) for key, each in value.items()}
    return [rounded(each) for each in value] if isinstance(value, list) else value


with open(sys.argv[1], encoding="utf-8") as lines:
    text = "".join(json.dumps(rounded(json.loads(line)), separators=(",", ":")) + "\n" for line in lines)
with open(sys.argv[2], "wb") as file:
    file.write(gzip.compress(text.encode("utf-8"), compresslevel=9, mtime=0))
EOF
"$saca" memory import data/memory/seed.jsonl.gz --keep-trust --memory "$work/shipped.sqlite" > /dev/null
"$saca" memory verify --memory "$work/shipped.sqlite"
