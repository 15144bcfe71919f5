"""elbow-emg and upper-limb-optical: the studies of examples/, each trial left out, and each load of the elbow."""
import pathlib

from board import LITERATURE, Row, Trial, baselines, folds, np, storage

NEEDS = ("elbow-emg", "upper-limb-optical")
EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"


def placed(bench, study, name, change=lambda text: text):
    """The study with the folder of the recordings in place of ../../../shared/data."""
    path = bench.folder / f"{name}.toml"
    path.write_text(change((EXAMPLES / study / "study.toml").read_text().replace("../../../shared/data",
                                                                               str(bench.data))))
    return path


def trial(folder, coordinate):
    torque, angle, emg = (storage(folder / file) for file in ("id.sto", "ik.mot", "activation.sto"))
    drive = np.array([column for name, column in emg.items() if name != "time"])
    return Trial.of((torque["time"], torque[f"{coordinate}_moment"]), (angle["time"], angle[coordinate]),
                    (emg["time"], drive))


def by_fold(results, coordinate, parts):
    """A row's values for each fold: parts maps the fold's name to its trials."""
    trials = {name: trial(results / name, coordinate) for names in parts.values() for name in names}
    for name, fold in folds(results).items():
        others = {LITERATURE: fold["literature_with_gain"]["r2"]}
        of_part = [trials[n] for n in parts[name]]
        rest = [t for n, t in trials.items() if n not in parts[name]]
        joined = Trial(*(np.concatenate([getattr(t, key) for t in of_part]) for key in ("torque", "angle", "drive")),
                       of_part[0].rate_hz)
        yield name, fold["identified"]["r2"], others | baselines(rest, joined)


def rows(bench):
    results = bench.folder / "elbow"
    bench.run("run", placed(bench, "elbow_emg", "elbow"), "--out", results)
    names = sorted(folder.name for folder in results.glob("load*"))
    for name, ours, others in by_fold(results, "elbow_flexion", {name: [name] for name in names}):
        yield Row(f"elbow {name}", "R2", ours, others, asked=">= 0.92")

    def by_load(text):
        for mass, word in (("1.25", "light"), ("2.5", "heavy")):
            text = text.replace(f"held_mass_kg = {mass}\n", f'held_mass_kg = {mass}\ncondition = "{word}"\n')
        return text + '\n[identify]\nfolds = "condition"\n'

    results = bench.folder / "loads"
    bench.run("run", placed(bench, "elbow_emg", "loads", by_load), "--out", results)
    loads = {word: [name for name in names if name.startswith(key)]
             for word, key in (("light", "load2p75"), ("heavy", "load5p5"))}
    for name, ours, others in by_fold(results, "elbow_flexion", loads):
        yield Row(f"elbow, {name} load", "R2", ours, others)

    results = bench.folder / "arm"
    bench.run("run", placed(bench, "upper_limb", "arm"), "--out", results)
    for name, fold in folds(results).items():
        yield Row(f"free arm {name}", "R2", fold["identified"]["r2"],
                  {LITERATURE: fold["literature_with_gain"]["r2"]})
