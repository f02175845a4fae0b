#!/usr/bin/env bash
# Tables join in pandas: by group and by job, on small copies of the sweeps of configs/ and on sweeps
# over what else can be varied. usage: tables.sh GRAINSWEEP
set -euo pipefail
grainsweep=$(realpath "${1:?usage: tables.sh GRAINSWEEP}")
configs=$(realpath "$(dirname "$0")/../../configs")
readonly grainsweep configs
work=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-tables.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"

if ! /usr/bin/python3 -c 'import pandas' 2>/dev/null; then
  printf 'SKIPPED: python3-pandas is not installed\n'
  exit 77
fi

# Start positions: two beds of a sweep, with an orientation each if they are no spheres.
cat >starts.json <<'JSON'
{ "name": "starts", "replicates": 3, "base": { "accuracy": "fast",
  "box": { "length": 4, "width": 4 }, "fill": { "solid_height": 4 } } }
JSON
"$grainsweep" run starts.json --quiet --no-report --out starts || [ $? -eq 1 ]
"$grainsweep" export starts --to . >/dev/null
cp "$configs"/*.csv . # tables of sizes
mapfile -t beds < <(sed -n 's/\.csv,.*/.csv/p' index.csv)

/usr/bin/python3 - "$configs" "${beds[@]}" <<'PYTHON'
import glob, json, os, sys

def small(value, length=4, width=5):
    """The sweep with beds of a few dozen grains in such a box."""
    if isinstance(value, list):
        return [small(entry, length, width) for entry in value]
    if not isinstance(value, dict):
        return value
    limits = {name: limit for path, limit in (("fill.solid_height", 3.5), ("box.length", length),
                                              ("box.width", width), ("fill.grains", 60))
              for name in (path, path.split(".")[1])}
    narrow = {"tube.diameter": [2.5, 3.5]}  # where so few grains are high enough
    return {key: narrow[key] if key in narrow
            else [3 + width / 10 for width in entry] if key == "box.width" and isinstance(entry, list)
            else min(limits[key], entry) if key in limits and isinstance(entry, (int, float))
            else small(entry, length, width) for key, entry in value.items()}

measure = {"exclude_floor": 1, "exclude_surface": 1, "bin_width": 0.5}
for path in glob.glob(sys.argv[1] + "/*.json"):
    sweep = json.load(open(path))
    if "name" not in sweep:
        continue
    has_large_grains = any(word in json.dumps(sweep) for word in ("distribution", "cylinder"))
    if "mixture" in json.dumps(sweep):  # long grains need a wide box; two of the shares
        for block in sweep["sweep"]:
            block["grid"]["shape.mixture"] = block["grid"]["shape.mixture"][1::4]
        sweep = small(sweep, 8, 8)
    else:
        sweep = small(sweep, 6, 6) if has_large_grains else small(sweep)
    sweep.setdefault("base", {})["measure"] = measure
    varies_accuracy = "accuracy" in json.dumps(sweep.get("sweep", []))
    sweep["replicates"] = 1 if varies_accuracy else 2
    sweep["base"]["accuracy"] = {"preset": "balanced" if varies_accuracy else "fast",
                                 "max_steps": 600}
    json.dump(sweep, open(f"config-{sweep['name']}.json", "w"))

beds = sys.argv[2:]
base = {"box": {"length": 4, "width": 4}, "fill": {"solid_height": 4}, "measure": measure,
        "accuracy": "fast"}
varied = {
    "spread": {"grid": {"sizes.spread": [0, 0.05, 0.1]}},
    "height": {"grid": {"fill.solid_height": [3.5, 4, 4.5], "box.width": [4, 5, 6]}},
    "angle": {"set": {"shape": {"pinacoid": {}}},
              "grid": {"shape.pinacoid.angle_deg": [50, 60]}},
    "accuracy": {"grid": {"accuracy.step": [0.2, 0.3], "accuracy.momentum": [0.8, 0.9]}},
    "duct": {"set": {"box.x": "walls"}, "zip": {"box.width": [3, 4], "box.length": [3, 4]}},
    "gaps": {"grid": {"measure.gap_tolerances": [[1e-4], [1e-3, 1e-5]]}},
    "files": {"set": {"fill": {"files": beds}}, "grid": {"sizes.size_ratio": [0.5, 0.6]}},
    "file": {"grid": {"fill.file": beds}, "replicates": 1},
}
for name, block in varied.items():
    json.dump({"name": name, "replicates": block.pop("replicates", len(beds)), "base": base,
               "sweep": [{"label": "a", **block}]}, open(f"varied-{name}.json", "w"))
PYTHON

sweeps=(config-*.json varied-*.json)
for sweep in "${sweeps[@]}"; do
  "$grainsweep" run "$sweep" --quiet --no-report --out "out-${sweep%.json}" 2>said || [ $? -eq 1 ] || {
    cat said
    exit 1
  }
done

/usr/bin/python3 - "$configs/../runner/README.md" "${sweeps[@]}" <<'PYTHON'
import sys
import pandas

recipes = [line.strip() for line in open(sys.argv.pop(1)) if line.startswith("    ") and ".merge(" in line]
assert len(recipes) == 2, recipes

by_group = ["profiles", "decays", "distributions", "sizes", "components",
            "component_profiles", "fit_points"]
joined = 0
for sweep in sys.argv[1:]:
    folder = "out-" + sweep.removesuffix(".json")
    table = {name: pandas.read_csv(f"{folder}/{name}.csv")
             for name in ["packings", "groups", "fits", *by_group]}
    packings, groups = table["packings"], table["groups"]
    varied = [column for column in groups
              if "." in column and not column.startswith("coordination_at_")]
    assert len(groups) == 1 or varied, folder
    assert not groups.duplicated(["label", *varied]).any(), f"{folder}: groups that look alike"

    def join(left, right, on):
        global joined
        both = left.merge(right, on=on, how="left", validate="m:1", indicator=True)
        assert (both["_merge"] == "both").all() and len(both) == len(left), (folder, on)
        shared = ["label", "job", "group", "family", "width", "small_share", *varied]
        for column in shared:
            if column not in left or column not in right or column == on:
                continue
            same = (both[column + "_x"] == both[column + "_y"]) | both[column + "_x"].isna()
            assert same.all() or (column == "job" and left is packings), (folder, on, column)
        joined += 1

    join(packings, groups, "group")
    join(groups, packings, "job")
    for name in by_group:
        join(table[name], groups, "group")
        join(table[name], packings, "job")
        join(table[name], groups, "job")
    walled = groups[groups["family"].isin(table["fits"]["family"])]
    for quantity, fits in table["fits"].groupby("quantity"):
        join(walled, fits, "family")
    for recipe in recipes:
        both, left = eval(recipe, table), table[recipe.split(".")[0]]
        assert both[list(left)].equals(left), (folder, recipe)
        means = both["group"].map(groups.set_index("group")["solid_fraction"])
        assert both["solid_fraction_group"].equals(means.rename("solid_fraction_group")), recipe
    columns = pandas.read_csv(f"{folder}/columns.csv")
    for name, rows in columns.groupby("file"):
        if name == "comparison.csv":  # of sweeps with published values; page.sh has one
            continue
        assert list(rows["column"]) == list(table[name.removesuffix(".csv")]), (folder, name)
    assert columns["meaning"].notna().all(), folder
    settled = packings[packings["status"] == "settled"]
    means = settled.groupby("group")["solid_fraction"].mean()
    there = groups.set_index("group")["solid_fraction"].dropna()
    assert (abs(means - there) < 1e-12).all() and len(means) == len(there), folder
print(f"tables: {joined} joins of {len(sys.argv) - 1} sweeps give each row its partner")
PYTHON
