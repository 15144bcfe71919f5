"""The numbers that docs/tutorial.md states in its prose, by the results that the page's commands wrote.

Each claim is a stretch of the page with its numbers in braces, and a function that takes them from the results. `check`
fails for a claim that is not on the page with the program's numbers, and for a number of the page that is in no claim, no
shown output and no list of given facts. `rewritten` returns the page with the program's numbers.
"""

import csv
import json
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

    def found(self, run, pattern):
        match = re.search(pattern, self.printed[run])
        if match is None:
            raise SystemExit(f"{run} did not print {pattern!r}")
        return match.groups()


ELBOW, POSTERIOR, PERSON = "tutorial_results", "elbow_posterior", "tutorial_person_results"


def minus(text):
    return text.replace("-", "−")


def scaled(estimate, scale, form):
    return [form.format(scale * estimate[key]) for key in ("estimate", "ci_low", "ci_high")]


def verdict(estimate):
    return estimate["verdict"].replace("_", " ")


def row(muscle, parameter, scale, form):
    """The numbers of one row of the last table, with both verdicts."""

    def values(r):
        one, other = r.number(ELBOW, muscle, parameter), r.number(POSTERIOR, muscle, parameter)
        return [*scaled(one, scale, form), verdict(one), *scaled(other, scale, form), verdict(other)]

    return values


def force(muscle):
    """A force at the largest EMG, by both estimators; the posterior's reason states it."""

    def values(r):
        one = r.number(ELBOW, muscle, "max_isometric_force")
        reason = r.number(POSTERIOR, muscle, "max_isometric_force")["reason"]
        low, high = re.search(r"pulls ([\d.e+]+) to ([\d.e+]+) N at the largest EMG", reason).groups()
        return [*scaled(one, 1.0, "{:.0f}"), verdict(one), f"{float(low):.0f}", f"{float(high):.0f}"]

    return values


def counts(r):
    found = r.verdicts(ELBOW)
    return [word(found[0]), str(sum(found)), word(found[1])]


def fold_scores(r):
    low, high = r.folds(ELBOW, ("r2", "identified"))
    worst, best = r.folds(ELBOW, ("r2", "literature_with_gain"))
    return [f"{low:.2f}", f"{high:.2f}", minus(f"{worst:.2f}"), f"{best:.2f}"]


def other_minima(r):
    alike, all_starts = r.found(ELBOW, r"(\d+) of (\d+) other starts of the search end at a minimum")
    biceps, own_biceps = r.found(ELBOW, r"BIC max_isometric_force ([\d.]+) instead of ([\d.]+)")
    brachialis, own_brachialis = r.found(ELBOW, r"BRA max_isometric_force ([\d.]+) instead of ([\d.]+)")
    return [all_starts, alike, *(f"{float(x):.0f}" for x in (biceps, own_biceps, brachialis, own_brachialis))]


def widths_by_posterior(r):
    found = r.verdicts(POSTERIOR)
    return [word(found[0]), str(sum(found)), word(found[1])]


def errors(r):
    low, high = r.folds(ELBOW, ("rmse_nm", "identified"))
    worst = r.folds(ELBOW, ("rmse_nm", "literature_with_gain"))
    return [f"{low:.2f}", f"{high:.2f}", f"{worst[0]:.2f}", f"{worst[1]:.2f}"]


def scores_of_both(r):
    texts = []
    for run in (ELBOW, POSTERIOR):
        for key, form in (("r2", "{:.2f}"), ("rmse_nm", "{:.2f}")):
            texts += [form.format(x) for x in r.folds(run, (key, "identified"))]
    return texts


def expected(estimate, scale, form):
    """The literature's range: two standard deviations of the prior, as a factor where the number cannot be negative."""
    mean, sd = estimate["prior_mean"], estimate["prior_sd"]
    return [form.format(scale * (mean - 1.96 * sd)), form.format(scale * (mean + 1.96 * sd))]


def length_with_literature(muscle):
    def values(r):
        posterior = r.number(POSTERIOR, muscle, "optimal_fiber_length")
        return [*scaled(posterior, 100.0, "{:.1f}")[1:], *expected(posterior, 100.0, "{:.1f}")]

    return values


def delay_row(r):
    texts = []
    for run in (ELBOW, POSTERIOR):
        estimate = next(e for e in r.torque(run)["estimates"] if e["parameter"] == "emg_delay")
        texts += [*scaled(estimate, 1000.0, "{:.0f}"), verdict(estimate)]
    return texts


def narrower(r):
    width = [e["ci_high"] - e["ci_low"]
             for e in (r.number(run, "BRD", "optimal_fiber_length") for run in (ELBOW, POSTERIOR))]  # fmt: skip
    own = r.number(ELBOW, "BRD", "optimal_fiber_length")
    return [f"{100 * own['estimate']:.1f}", own["verdict"], f"{width[1] / width[0]:.1f}"]


def person(r):
    estimate = r.number(PERSON, "BIC", "max_isometric_force")
    with open(r.folder / "tutorial_person" / "truth.csv", encoding="utf-8") as file:
        truth = next(row for row in csv.DictReader(line for line in file if not line.startswith("#"))
                     if (row["muscle"], row["parameter"]) == ("BIC", "max_isometric_force"))  # fmt: skip
    return [f"{estimate['ci_low']:.0f}", f"{estimate['ci_high']:.0f}", f"{float(truth['value']):.0f}"]


def planned(r):
    before, = r.found(ELBOW, r"median 95 % interval \+-(\d+) %")
    steps = re.findall(r"identified, \+-(\d+) %", r.printed[ELBOW])
    return [before, steps[-1]]


def moved(r):
    estimate = r.number(ELBOW, "BIC", "optimal_fiber_length")
    return [f"{100 * estimate['estimate']:.1f}", f"{100 * estimate['initial']:.1f}"]


def strengths(r):
    found = {verdict(r.number(POSTERIOR, muscle, "max_isometric_force")) for muscle in ("BIC", "BRA", "BRD", "TRI")}
    return [" and ".join(sorted(found))]


def variance_gone(r):
    return [f"{100 * r.number(POSTERIOR, 'BRD', 'optimal_fiber_length')['shrinkage']:.0f}"]


def held_back(r):
    return r.found("tutorial_prediction", r"held_back_2kg\s.*?(\d+) %")


CLAIMS = [
    ("**{} number of {} is identified**, {} more are known with a wide interval", counts),
    ("with R² from {} to {}. The literature's muscles reach {} to {}, even", fold_scores),
    ("optimal length of the biceps went from {} to {} cm", moved),
    ("Of {} other starts of the search {} end at a minimum that is as good, with {} N instead of {} N for the biceps and "
     "{} N instead of {} N for the brachialis", other_minima),
    ("interval from {} to {} %.", planned),
    ("with a 95 % band that holds {} % of it", held_back),
    ("biceps from {} to {} N; the truth is {} N", person),
    ("which identifies {} of the {} numbers and calls {} weak", widths_by_posterior),
    ("| optimal length of brachioradialis [cm] | {} ({} to {}), {} | {} ({} to {}), {} |",
     row("BRD", "optimal_fiber_length", 100.0, "{:.1f}")),
    ("| optimal length of biceps [cm] | {} ({} to {}), {} | {} ({} to {}), {} |",
     row("BIC", "optimal_fiber_length", 100.0, "{:.1f}")),
    ("| EMG delay [ms] | {} ({} to {}), {} | {} ({} to {}), {} |", delay_row),
    ("| force of biceps at the largest EMG [N] | {} ({} to {}), {} | {} to {} |", force("BIC")),
    ("| force of brachialis [N] | {} ({} to {}), {} | {} to {} |", force("BRA")),
    ("| force of brachioradialis [N] | {} ({} to {}), {} | {} to {} |", force("BRD")),
    ("| force of triceps [N] | {} ({} to {}), {} | {} to {} |", force("TRI")),
    ("| F_max of the muscles at their maximum | – | {} |", strengths),
    ("takes {} % off the variance of what was known", variance_gone),
    ("| trials left out: R², RMSE [N m] | {} to {}, {} to {} | {} to {}, {} to {} |", scores_of_both),
    ("with an error of {} to {} N m (root mean square) for trials that were not fitted. The literature's muscles with the "
     "best single gain err by {} to {} N m", errors),
    ("brachioradialis lies between {} and {} cm (95 %, posterior; the literature says {} to {} cm)",
     length_with_literature("BRD")),
    ("biceps lies between {} and {} cm (the literature says {} to {} cm)", length_with_literature("BIC")),
    ("{} cm with the narrow interval, although it is called {}: the posterior's is {} times as wide", narrower),
]  # fmt: skip


def pattern_of(claim):
    """A pattern for the claim with any words in the place of its numbers, over line breaks."""
    parts = [r"\s+".join(re.escape(text) for text in part.split(" ")) for part in claim.split("{}")]
    return re.compile(r"([−\w.]+(?: \w+)?(?: and prior dominated)?)".join(parts))


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
