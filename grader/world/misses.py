"""Prints which guesses of guesses.tsv were wrong: misses.py [LIBRARIES.tsv].

The guesses were written before the table was measured. A cell is 0 (no wrong answer; at most 4 units in the last place),
s (up to one per cent; up to 1,000 units), m (more); for hits at an end of a range a (all found), n (none) or p (some);
e (an error of the library) or - (the interface cannot be asked).
"""

import csv
import pathlib
import sys

here = pathlib.Path(__file__).parent
table = sys.argv[1] if len(sys.argv) > 1 else here.parent / "cost/src/world/libraries.tsv"


def rows(path):
    return {row["row"]: row for row in csv.DictReader(open(path), delimiter="\t", quoting=csv.QUOTE_NONE)}


def kind(cell, column):
    if cell == "-" or cell.startswith("error"):
        return cell[0]
    value = float(cell)
    if column.endswith("found_pct"):
        return {0.0: "n", 100.0: "a"}.get(value, "p")
    few, many = (4, 1000) if column.endswith("ulp") else (0, 10000)
    return "0" if value <= few else "s" if value <= many else "m"


guesses, found = rows(here / "guesses.tsv"), rows(table)
count = missed = 0
for name, guess in guesses.items():
    for column, cell in found.get(name, {}).items():
        guessed = next((guess[short] for short in guess if column.startswith(short + "_")), None)
        if guessed in (None, "-") or cell == "-":
            continue
        count += 1
        if kind(cell, column) != guessed:
            missed += 1
            print(f"{name}\t{column}\tguessed {guessed}\tfound {cell}")
print(f"{missed} of {count} guesses were wrong")
