#!/usr/bin/env python3
"""Holds the report of a small campaign to the aims: a box that loses every track vouches for no
wrong tube, and is of no use.

Usage: report_limits.py REPORT.csv
       report_limits.py --self-test
"""
import csv
import io
import sys

MOST_MISSED = 0.005  # share of the truly aligned fields in the moves without faults
CLEAR_STRATA = 16  # pitch x mounting x weld x speed, without faults


def wrong_in(report):
    """What of a report, given as lines, does not keep to the aims."""
    groups = {row["group"]: row for row in csv.DictReader(report)}
    clear = {name: row for name, row in groups.items() if "/none/" in name}
    if "all" not in groups or "clear" not in groups or len(clear) != CLEAR_STRATA:
        return [f"{len(clear)} strata without faults, expected {CLEAR_STRATA} and the rows of "
                "'all' and 'clear'"]
    wrong = []
    for count in ("wrong_tube", "wrong_nearest"):
        if int(groups["all"][count]) != 0:
            wrong.append(f"all: {count} is {groups['all'][count]}, expected 0")
    missed = int(groups["clear"]["missed"])
    aligned = int(groups["clear"]["truly_aligned"])
    if missed > MOST_MISSED * aligned:
        wrong.append(f"clear: {missed} of {aligned} truly aligned fields missed, expected "
                     f"{100.0 * MOST_MISSED} % at most")
    wrong += [f"{name}: no field vouched for, expected some"
              for name, row in clear.items() if int(row["vouched"]) == 0]
    return wrong


def planted(clear=None, all_moves=None, stratum=None, strata=CLEAR_STRATA):
    """The lines of a small report that is good but for what is given."""
    good = {"truly_aligned": 1000, "missed": 5, "vouched": 995, "wrong_tube": 0,
            "wrong_nearest": 0}
    rows = [{"group": "all", **good, **(all_moves or {})},
            {"group": "clear", **good, **(clear or {})}]
    rows += [{"group": f"square/none/{i}", **good, **((stratum or {}) if i == 3 else {})}
             for i in range(strata)]
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=rows[0])
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue().splitlines()


def self_test():
    cases = [
        (planted(), ""),
        (planted(clear={"missed": 6}), "6 of 1000 truly aligned"),
        (planted(all_moves={"wrong_tube": 1}), "wrong_tube is 1"),
        (planted(all_moves={"wrong_nearest": 2}), "wrong_nearest is 2"),
        (planted(stratum={"vouched": 0}), "square/none/3: no field"),
        (planted(strata=CLEAR_STRATA - 1), "15 strata"),
        ([], "0 strata"),
    ]
    failed = [f"expected '{about}', got {wrong_in(lines)}" for lines, about in cases
              if not (about in "; ".join(wrong_in(lines)) if about else wrong_in(lines) == [])]
    print("\n".join(failed) or f"{len(cases)} planted reports judged rightly")
    return 1 if failed else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    with open(arguments[0], encoding="utf-8") as report:
        wrong = wrong_in(report)
    print("\n".join(f"{arguments[0]}: {line}" for line in wrong) or "the report keeps to the aims")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
