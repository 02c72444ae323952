"""Compares the database that OMPL's script made with runs.csv, and results.json with its schema.

Usage: interchange.py CAMPAIGN DATABASE
"""

import csv
import json
import math
import sqlite3
import statistics
import sys
from collections import defaultdict
from pathlib import Path

import jsonschema

campaign, database = Path(sys.argv[1]), sys.argv[2]

# Column of runs.csv, column of the database, the factor between their units, and the relative tolerance: seconds of
# microseconds are rounded once, all else is written in full.
COLUMNS = [
    ("length", "solution_length", 1.0, 0.0),
    ("gap", "gap_to_optimum", 1.0, 0.0),
    ("time_us", "time", 1e-6, 1e-15),
    ("evaluations", "evaluations", 1.0, 0.0),
    ("collision_checks", "collision_checks", 1.0, 0.0),
]


def value(text, valid):
    return float(text) if valid and text != "" else math.inf


ours = defaultdict(list)
with open(campaign / "runs.csv", newline="") as file:
    for row in csv.DictReader(file):
        for column, *_ in COLUMNS:
            valid = row["valid"] == "true" or column not in ("length", "gap")
            ours[row["scene"], row["planner"], column].append(value(row[column], valid))

theirs = defaultdict(list)
query = """SELECT e.name, p.name, r.* FROM runs r JOIN experiments e ON e.id = r.experimentid
           JOIN plannerConfigs p ON p.id = r.plannerid"""
cursor = sqlite3.connect(database).execute(query)
names = [column[0] for column in cursor.description]
for row in cursor:
    cells = dict(zip(names[2:], row[2:]))
    for column, name, factor, _ in COLUMNS:
        number = math.inf if cells[name] is None else cells[name] / factor
        theirs[row[0], row[1].removeprefix("geometric_"), column].append(number)

assert ours.keys() == theirs.keys(), ours.keys() ^ theirs.keys()
tolerances = {column: tolerance for column, _, _, tolerance in COLUMNS}
for key, values in ours.items():
    a, b = statistics.median(values), statistics.median(theirs[key])
    assert a == b or abs(a - b) <= 4 * tolerances[key[2]] * abs(a), (key, a, b)
print(f"{len(ours)} medians of OMPL's database are those of runs.csv")

schema = json.loads((campaign / "results.schema.json").read_text())
jsonschema.Draft202012Validator.check_schema(schema)


def refuse(name):
    raise ValueError(f"{name} in results.json")


document = json.loads((campaign / "results.json").read_text(), parse_constant=refuse)
jsonschema.validate(document, schema, cls=jsonschema.Draft202012Validator)
print(f"results.json with {len(document['runs'])} runs follows its schema")
