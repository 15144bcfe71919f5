"""Problem: a fit always gives numbers. Which of them does the recording determine, and how well?

    how_sure_are_we.py STUDY.toml
"""

import sys
from collections import Counter

import myoid

(study,) = sys.argv[1:]
numbers = myoid.run(study).parameters.where(method="torque")

# A row of the table: the estimate with its 95 % interval, which may be open on a side.
for row in numbers.where(parameter="max_isometric_force"):
    if row["ci_low"] is not None and row["ci_high"] is not None:
        print(f"strength of {row['muscle']}: {row['estimate']:.6g} N, "
              f"95 % interval {row['ci_low']:.6g} to {row['ci_high']:.6g} N, {row['verdict']}")  # fmt: skip

# Every number has a verdict, and every verdict but the best a reason.
for verdict, count in sorted(Counter(numbers["verdict"]).items()):
    print(f"{verdict}: {count}")
