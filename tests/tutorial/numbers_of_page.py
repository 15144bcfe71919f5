"""The numbers that docs/tutorial.md states in its prose, by the results that the page's commands wrote.

Each claim is a stretch of the page with its numbers in braces, and a function that takes them from the results. `check`
fails for a claim that is not on the page with the program's numbers, and for a number of the page that is in no claim, no
shown output and no list of given facts. `rewritten` returns the page with the program's numbers.
"""

import csv
import json
import math
import re

WORDS = ["none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"]

# Facts of the recording, of the questions and of the commands: no results. Every entry is a whole stretch of the page.
GIVEN = [
    r"Six trials of 26 s", r"at 200 Hz", r"at 2 kHz", r"\(steps? \d+\)", r"\bStep \d+", r"\bstep \d+\b", r"## \d+\.",
    r"^\d\. ", r"75 kg is assumed", r"2\.75 and 5\.5", r"`held_mass_kg = 1\.25` and `2\.5`", r"7 cm beyond the wrist",
    r"25 cm, by the landmarks", r"Activation 1", r"95 %", r"at 11 s", r"2p75", r"5p5", r"load\w+", r"_T\d", r"R²",
    r"last lines of step 4", r"`\[[^\]]*\]`", r"!\[[^\]]*\]\([^)]*\)", r"\]\([^)]*\)", r"`[^`]*`",
]  # fmt: skip


def word(count):
    return WORDS[count] if count < len(WORDS) else str(count)


class Results:
    """What the commands of the page wrote and printed."""

    def __init__(self, folder, printed):
        self.folder, self.printed, self.read = folder, printed, {}

    def parameters(self, run):
        if run not in self.read:
            self.read[run] = json.loads((self.folder / run / "parameters.json").read_text(encoding="utf-8"))
        return self.read[run]

    def torque(self, run):
        return next(m for m in self.parameters(run)["methods"] if m["method"] == "torque")

    def number(self, run, muscle, parameter):
        return next(e for e in self.torque(run)["estimates"] if (e["muscle"], e["parameter"]) == (muscle, parameter))

    def verdicts(self, run):
        """How many numbers are identified, weak, prior dominated, not identifiable, non-physical and reproducible, by the
        gate that counts them."""
        gate = re.search(r"(\d+) identified, (\d+) reproducible, (\d+) weak, (\d+) prior-dominated, "
                         r"(\d+) not identifiable, (\d+) non-phys", self.printed[run])  # fmt: skip
        identified, reproducible, *others = (int(count) for count in gate.groups())
        return [identified, *others, reproducible]

    def folds(self, run, score):
        key, part = score
        values = [fold[part][key] for fold in self.parameters(run)["leave_one_trial_out"]]
        return min(values), max(values)

    def voluntary(self, run, owner):
        """The row of a muscle or of a joint's muscles in the table of greatest voluntary torques, as the report has it."""
        return next(row for row in self.table(run, "voluntary_torque") if row["muscle or joint"].startswith(owner))

    def table(self, run, name):
        """The rows of a table of the report."""
        with open(self.folder / run / "tables" / f"{name}.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def true(self, muscle, parameter):
        with open(self.folder / "tutorial_person" / "truth.csv", encoding="utf-8") as file:
            rows = csv.DictReader(line for line in file if not line.startswith("#"))
            return next(r["value"] for r in rows if (r["muscle"], r["parameter"]) == (muscle, parameter))

    def found(self, run, pattern):
        match = re.search(pattern, self.printed[run])
        if match is None:
            raise SystemExit(f"{run} did not print {pattern!r}")
        return match.groups()


ELBOW, PERSON, PREDICTION = "tutorial_results", "tutorial_person_results", "tutorial_prediction"
DEGREES = 180 / math.pi
FLEXORS, FLEXORS_ANGLE = "voluntary_torque_positive", "voluntary_torque_angle_positive"


def minus(text):
    return text.replace("-", "−")


def scaled(estimate, keys, scale, form):
    return [form.format(scale * estimate[key]) for key in keys]


def verdict(estimate):
    return estimate["verdict"].replace("_", " ")


VALUE, INTERVAL, GIVEN_INTERVAL = ["estimate"], ["ci_low", "ci_high"], ["given_ci_low", "given_ci_high"]
BOTH_READINGS = VALUE + INTERVAL + GIVEN_INTERVAL


def row(run, owner, parameter, scale=1.0, form="{:.0f}", literature=False):
    """The numbers of one row of a table: value, intervals of both readings, the literature's where asked for, verdict."""

    def values(r):
        estimate = r.number(run, owner, parameter)
        return [*scaled(estimate, BOTH_READINGS, scale, form), *(expected(estimate, scale, form) if literature else []),
                verdict(estimate)]  # fmt: skip

    return values


def with_truth(number, truth):
    """A row's numbers and the person's true value."""
    return lambda r: [*number(r), truth(r)]


def true_parameter(muscle, parameter):
    return lambda r: f"{float(r.true(muscle, parameter)):.0f}"


def true_torque(owner, column):
    return lambda r: r.voluntary(PERSON, owner)[column]


def counts(r):
    found = r.verdicts(ELBOW)
    return [word(found[0]), str(sum(found)), word(found[1])]


def flexors(r):
    torque, angle = r.number(ELBOW, "elbow_flexion", FLEXORS), r.number(ELBOW, "elbow_flexion", FLEXORS_ANGLE)
    return [*scaled(torque, VALUE + INTERVAL, 1.0, "{:.1f}"), *scaled(angle, VALUE, DEGREES, "{:.0f}")]


def fold_scores(r):
    low, high = r.folds(ELBOW, ("r2", "identified"))
    worst, best = r.folds(ELBOW, ("r2", "literature_with_gain"))
    return [f"{low:.2f}", f"{high:.2f}", minus(f"{worst:.2f}"), f"{best:.2f}"]


def errors(r):
    low, high = r.folds(ELBOW, ("rmse_nm", "identified"))
    worst = r.folds(ELBOW, ("rmse_nm", "literature_with_gain"))
    return [f"{low:.2f}", f"{high:.2f}", f"{worst[0]:.2f}", f"{worst[1]:.2f}"]


def expected(estimate, scale, form):
    """The literature's 95 %."""
    mean, sd = estimate["prior_mean"], estimate["prior_sd"]
    return [form.format(scale * (mean - 1.96 * sd)), form.format(scale * (mean + 1.96 * sd))]


def planned(r):
    before, *_, after = r.table(ELBOW, "next_recording")
    return [re.search(r"\d+", row["median interval"]).group() for row in (before, after)]


def moved(r):
    return scaled(r.number(ELBOW, "BIC", "optimal_fiber_length"), ["estimate", "ci_low"], 100.0, "{:.1f}")


def variance_gone(r):
    return [f"{100 * r.number(ELBOW, muscle, 'optimal_fiber_length')['shrinkage']:.0f}" for muscle in ("BRD", "BIC")]


def cautions(r):
    """How many gates ask for caution; a gate that failed contradicts the page."""
    if re.search(r"^FAILED", r.printed[ELBOW], re.MULTILINE):
        raise SystemExit("a gate of the recording failed; the page says that none did")
    return [word(len(re.findall(r"^caution  ", r.printed[ELBOW], re.MULTILINE)))]


def held_back(r):
    return r.found(PREDICTION, r"held_back_2kg\s.*?(\d+) %")


def length(muscle, parameter="optimal_fiber_length"):
    return row(ELBOW, muscle, parameter, 100.0, "{:.1f}", literature=True)


CLAIMS = [
    ("together make **{} N m ({} to {}) at {}°**", flexors),
    ("**{} of {} numbers is identified**, {} are known with a wide interval", counts),
    ("with R² from {} to {}. The literature's muscles reach {} to {}, even", fold_scores),
    ("optimal length of the biceps went from {} cm down to the low end of its interval, {} cm", moved),
    ("median interval would fall from {} to {} % only", planned),
    ("with a 95 % band that holds {} % of it", held_back),
    ("| greatest voluntary torque of the flexors [N m] | {} ({} to {}) | {} to {} | {} | {} |",
     with_truth(row(PERSON, "elbow_flexion", FLEXORS), true_torque("Biceps (BIC) +", "true N m"))),
    ("| the angle of that torque [°] | {} ({} to {}) | {} to {} | {} | {} |",
     with_truth(row(PERSON, "elbow_flexion", FLEXORS_ANGLE, DEGREES),
                true_torque("Biceps (BIC) +", "true angle (°)"))),
    ("| F_max of the biceps [N] | {} ({} to {}) | {} to {} | {} | {} |",
     with_truth(row(PERSON, "BIC", "max_isometric_force"), true_parameter("BIC", "max_isometric_force"))),
    ("None failed, {} ask for caution", cautions),
    ("| torque of the flexors at the largest EMG [N m] | {} ({} to {}) | {} to {} | – | {} |",
     row(ELBOW, "elbow_flexion", FLEXORS, form="{:.1f}")),
    ("| its angle [°] | {} ({} to {}) | {} to {} | – | {} |", row(ELBOW, "elbow_flexion", FLEXORS_ANGLE, DEGREES)),
    ("| optimal length of brachioradialis [cm] | {} ({} to {}) | {} to {} | {} to {} | {} |", length("BRD")),
    ("| optimal length of biceps [cm] | {} ({} to {}) | {} to {} | {} to {} | {} |", length("BIC")),
    ("| width of brachioradialis [cm] | {} ({} to {}) | {} to {} | {} to {} | {} |",
     length("BRD", "force_length_width")),
    ("| EMG delay [ms] | {} ({} to {}) | {} to {} | {} to {} | {} |",
     row(ELBOW, "subject", "emg_delay", 1000.0, literature=True)),
    ("| largest force of the biceps, F_max [N] | {} ({} to {}) | {} to {} | – | {} |",
     row(ELBOW, "BIC", "max_isometric_force")),
    ("with an error of {} to {} N m (root mean square) for trials that were not fitted. The literature's muscles with the "
     "best single gain err by {} to {} N m", errors),
    ("takes {} % off for the length of the brachioradialis, {} % for that of the biceps", variance_gone),
]  # fmt: skip


def pattern_of(claim):
    """A pattern for the claim with any words in the place of its numbers, over line breaks."""
    parts = [r"\s+".join(re.escape(text) for text in part.split(" ")) for part in claim.split("{}")]
    return re.compile(r"([−\w.]+(?: \w+)?)".join(parts))


def filled(claim, values):
    for value in values:
        claim = claim.replace("{}", value, 1)
    return claim


def prose(page):
    """The page without the output that it shows and without its commands."""
    page = re.sub(r"```text\n.*?```", "", page, flags=re.DOTALL)
    return "\n".join(line for line in page.splitlines() if not line.startswith("    "))


def faults(page, results):
    """What is wrong with the page's numbers, in sentences."""
    found, rest = [], prose(page)
    for claim, values in CLAIMS:
        match = pattern_of(claim).search(rest)
        if match is None:
            found.append(f"the page does not say {claim!r}")
            continue
        said, right = " ".join(match.group().split()), filled(claim, values(results))
        if said != right:
            found.append(f"the page says {said!r}, the program {right!r}")
        rest = rest[: match.start()] + rest[match.end() :]
    for given in GIVEN:
        rest = re.sub(given, "", rest, flags=re.MULTILINE)
    for line in rest.splitlines():
        if re.search(r"\d", line):
            found.append(f"no result and no given fact has the number in {line.strip()!r}")
    return found


def rewritten(page, results):
    """The page with the program's numbers in its claims; lines are broken where they were."""
    for claim, values in CLAIMS:
        match = pattern_of(claim).search(page)
        if match is None:
            continue
        text, new, at = match.group(), values(results), 0
        for k, value in enumerate(new):
            begin, end = match.start(k + 1) - match.start(), match.end(k + 1) - match.start()
            text = text[: begin + at] + value + text[end + at :]
            at += len(value) - (end - begin)
        page = page[: match.start()] + text + page[match.end() :]
    return page
