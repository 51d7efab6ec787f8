#!/usr/bin/env bash
# The cases that a new memory begins with: data/memory/seed.jsonl.gz. Four minutes on two cores for the suites, as many of one core for the recordings.
# usage: tools/seed_bank.sh HUNDRED_CAR [MOST]
#   HUNDRED_CAR  folder of the 100-Car study's release (docs/formats.md)
#   MOST         how many are kept (default 10000: all): the most redundant go
# Encounters of the suites `balanced` and `natural`, of the tuning split alone, their twins without risk, and recorded emergencies of the
# 100-Car study but for those that are shipped as scenarios. Numbers keep five digits: features differ by less than a thousandth of what
# makes a difference. What was done before is not done again; remove build/seed_bank to begin anew.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
hundred_car=${1:?seed_bank: error: want the folder of the 100-Car release}
most=${2:-10000}
saca=build/release/saca
work=build/seed_bank
mkdir -p "$work" data/memory
rm -f "$work/bank.sqlite" "$work/shipped.sqlite"
for suite in natural balanced; do
  [ -e "$work/$suite.jsonl" ] || "$saca" memory build "$suite" --count 3000 --draws 32 -o "$work/$suite.jsonl"
  "$saca" memory import "$work/$suite.jsonl" --keep-trust --memory "$work/bank.sqlite"
done
[ -e "$work/recorded.jsonl" ] || "$saca" cases build --hundred-car "$hundred_car" --draws 32 -o "$work/crash_cases.jsonl" \
  --for-memory "$work/recorded.jsonl"
python3 - "$work/recorded.jsonl" "$work/unshipped.jsonl" << 'EOF'
import json
import pathlib
import sys

header, *cases = [json.loads(line) for line in pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").splitlines()]
shipped = {path.stem for path in pathlib.Path("scenarios").glob("100car_*.toml")}
kept = [case for case in cases if not any(name in case["source"] for name in shipped)]
header["cases"] = len(kept)
pathlib.Path(sys.argv[2]).write_text("".join(json.dumps(line) + "\n" for line in [header, *kept]), encoding="utf-8")
EOF
"$saca" memory import "$work/unshipped.jsonl" --keep-trust --memory "$work/bank.sqlite"
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
