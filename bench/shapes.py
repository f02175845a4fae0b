"""Prints the table of bench/shapes.sh from the packings.csv of one folder or more."""

import csv
import statistics
import sys

rows = {}
for folder in sys.argv[1:]:
    with open(folder + "/packings.csv", encoding="utf-8") as table:
        for row in csv.DictReader(table):
            rows.setdefault(row["label"], []).append(row)


def values(of, column):
    return [float(row[column]) for row in of if row[column]]


print("| shape | settled | phi | Z | contacts / isostatic | static imbalance, mean and largest | ms a grain |")
print("|---|---|---|---|---|---|---|")
for label, beds in rows.items():
    rest = [row for row in beds if row["status"] == "settled"]
    cost = 1e3 * statistics.mean(float(row["cpu_seconds"]) / float(row["grains"]) for row in beds)
    cells = [label, f"{len(rest)} of {len(beds)}"]
    if rest:
        for column, digits in [("solid_fraction", 3), ("coordination", 2), ("contact_ratio", 3)]:
            of = values(rest, column)
            cells.append(f"{min(of):.{digits}f} to {max(of):.{digits}f}")
        cells.append(
            f"{statistics.mean(values(rest, 'static_imbalance_mean')):.4f}, "
            f"{max(values(rest, 'static_imbalance_max')):.2f}"
        )
    else:
        cells += ["", "", "", ""]
    print("| " + " | ".join(cells) + f" | {cost:.1f} |")
