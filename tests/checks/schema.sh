#!/usr/bin/env bash
# configs/sweep.schema.json is what the program prints, and fits the sweeps beside it.
# usage: schema.sh GRAINSWEEP. To mend: GRAINSWEEP schema >configs/sweep.schema.json
set -euo pipefail
grainsweep=$(realpath "${1:?usage: schema.sh GRAINSWEEP}")
readonly grainsweep
cd "$(dirname "$0")/../../configs"

shopt -s extglob
readonly sweeps=(!(*.schema|*.reference).json)

"$grainsweep" schema | cmp - sweep.schema.json
for sweep in "${sweeps[@]}"; do
  "$grainsweep" validate "$sweep"
  grep -q '"\$schema": "sweep.schema.json"' "$sweep" || {
    printf 'configs/%s: does not name its schema\n' "$sweep" >&2
    exit 1
  }
done

if ! python3 -c 'import jsonschema' 2>/dev/null; then
  printf 'SKIPPED: python3-jsonschema is not installed; sweeps were checked by the program alone\n'
  exit 77
fi
python3 - "${sweeps[@]}" <<'PYTHON'
import copy, json, re, sys
import jsonschema

schema = json.load(open("sweep.schema.json"))
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
sweeps = [json.load(open(name)) for name in sys.argv[1:]]
for sweep in sweeps:
    validator.validate(sweep)

def refuses(change):
    wrong = copy.deepcopy(sweeps[0])
    change(wrong)
    assert not validator.is_valid(wrong), change.__name__

def misspelt(sweep): sweep["base"]["bx"] = {}
def misspelt_inside(sweep): sweep["base"]["box"]["lenght"] = 5
def no_number(sweep): sweep["base"]["box"]["width"] = "5"
def no_choice(sweep): sweep["base"]["box"]["y"] = "wall"
def no_preset(sweep): sweep["base"]["accuracy"] = "quick"
def no_list(sweep): sweep["sweep"][0]["grid"]["box.width"] = 5
def seed_in_base(sweep): sweep["base"]["seed"] = 5
def no_count(sweep): sweep["sweep"][0]["random"] = {"box.width": {"uniform": [4, 5]}}
def no_name(sweep): del sweep["name"]
for change in (misspelt, misspelt_inside, no_number, no_choice, no_preset, no_list, seed_in_base,
               no_count, no_name):
    refuses(change)

# Each sweep of faulty_sweeps.txt, whose head says how it is written: what the schema refuses, what
# no schema can refuse, what is right. Of those whose fault is in the sweep itself it refuses 95 %.
# Python takes NaN and equal keys for JSON, editors do not.
def only_json(text):
    def no_number(word): raise ValueError(word)
    def once(pairs):
        if len({key for key, _ in pairs}) < len(pairs): raise ValueError("a key twice")
        return dict(pairs)
    return json.loads(text, parse_constant=no_number, object_pairs_hook=once)

def fits(text):
    try:
        return validator.is_valid(only_json(text.removeprefix("\ufeff")))
    except ValueError:
        return False

page = open("../tests/runner/sweep/faulty_sweeps.txt", encoding="utf-8").read()
elsewhere, beyond = "another file", {"two lists", "arithmetic"}
refused, missed, of_files = [], [], []
for section in re.split("^== ", page, flags=re.M)[1:]:
    if section.startswith("file "):
        continue
    head, mark, reason, said = re.split("^(--|~~)(?: (.*))?$", section, flags=re.M)
    title, text = head.split("\n", 1)
    assert fits(text) == (mark == "~~"), title
    if said.strip().split("\n")[0] == "right":
        assert mark == "~~" and reason is None, title
    elif mark == "--":
        refused.append(title)
    else:
        assert reason == elsewhere or reason in beyond, (title, reason)
        (of_files if reason == elsewhere else missed).append(title)
assert len(refused) >= 0.95 * (len(refused) + len(missed)), missed
print(f"schema: fits {len(sweeps)} sweeps and refuses {len(refused)} of {len(refused) + len(missed)} "
      f"faulty ones, and none of {len(of_files)} whose fault is in another file; not: {missed}")
PYTHON
