#!/usr/bin/env python3
"""usage: docs/figures/make_figures.py PROGRAM WORK [NAME...]

Makes the pictures of README, tutorial and gallery with headless Chromium, from the results that PROGRAM finds in WORK or
makes there. Pictures whose recordings are not at hand (folder of $MYOID_DATA, else ../shared/data beside the checkout)
stay as they are, and the script says so. With names only these pictures are made. Python's own library is enough; a film
needs ffmpeg, too.
The page of the demo is docs/sample.html, too.
"""

import base64
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

FIGURES = Path(__file__).resolve().parent
SOURCE = FIGURES.parents[1]
DATA = Path(os.environ.get("MYOID_DATA", SOURCE / ".." / "shared" / "data")).resolve()
MOST_BYTES, MOST_BYTES_OF_FILM = 200_000, 1_000_000
QUALITY = 82


@dataclass
class Picture:
    """A part of a page: from the top of one element to the end of another, `width` wide."""

    name: str
    page: str  # folder of results, or a page in WORK
    wishes: str = ""  # after the # of the address
    begin: str = "body"
    end: str = ""  # none: `height` below the beginning
    width: int = 1280
    height: int = 900
    script: str = ""  # a step before the picture
    film: tuple = ()  # from, to [s] and frames a second: the workbench at each time, as it plays


# Moves the first slider of the workbench, the optimal fiber length, to the low end of its interval [m].
MOVE_LENGTH = """
const slider = document.querySelector('#learn input[type=range]');
slider.value = 0.101;
slider.dispatchEvent(new Event('input'));
"""

UNFOLD = "document.querySelector('{}').closest('.folds').classList.remove('folded')"

PICTURES = [
    Picture("report_top.webp", "demo", height=1010),
    Picture("film.webp", "demo", "trial=lowering_4kg", begin="#workbench .bench",
            end="#workbench .plots > :nth-child(6)", script="myoid.replay.fit()", film=(4.6, 9.6, 8)),
    Picture("workbench.webp", "demo", "trial=lowering_4kg&t=6.2", begin="#workbench", height=920),
    Picture("group.webp", "group", height=1560),
    Picture("gait.webp", "gait", "trial=walk&t=0.55&view=oblique&hide=activation,force", begin="#workbench", height=900),
    Picture("motion_page.webp", "walk", "t=0.6&view=oblique", height=800),
    Picture("review.webp", "review", height=900),
    Picture("box_lift.webp", "box_lift", "trial=lift&t=2.3&view=oblique", begin="#workbench", height=755),
    Picture("elbow_numbers.webp", "elbow_emg", begin="#numbers", height=860),
    Picture("elbow_strength.webp", "elbow_emg", begin="figure#voluntary_torque",
            end="figure#voluntary_torque", width=800, script=UNFOLD.format("#voluntary")),
    Picture("elbow_workbench.webp", "elbow_emg", "trial=load2p75_T3&t=11", begin="#workbench", height=1042),
    Picture("elbow_what_if.webp", "elbow_emg", "trial=load2p75_T3&t=11", begin="#learn", end="#learn",
            script=MOVE_LENGTH),
    Picture("elbow_quality.webp", "elbow_emg", begin="#quality", height=610),
    Picture("elbow_next.webp", "elbow_emg", begin="#next", height=410, width=800, script=UNFOLD.format("#next")),
]  # fmt: skip


class Browser:
    """Headless Chromium, driven over its debugging protocol through two pipes."""

    def __init__(self):
        self._profile = tempfile.TemporaryDirectory(prefix="myoid.", ignore_cleanup_errors=True)
        to_browser, self._to = os.pipe()
        self._from, from_browser = os.pipe()

        def pipes():
            commands, answers = os.dup(to_browser), os.dup(from_browser)
            os.dup2(commands, 3)
            os.dup2(answers, 4)

        self._process = subprocess.Popen(
            ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--no-first-run", "--hide-scrollbars",
             "--remote-debugging-pipe", f"--user-data-dir={self._profile.name}", "about:blank"],
            close_fds=False, preexec_fn=pipes, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)  # fmt: skip
        os.close(to_browser)
        os.close(from_browser)
        self._received, self._last, self._session = b"", 0, None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.call("Page.enable")

    def close(self):
        os.close(self._to)
        self._process.terminate()
        self._process.wait(10)
        self._profile.cleanup()

    def call(self, method, **parameters):
        self._last += 1
        command = {"id": self._last, "method": method, "params": parameters}
        if self._session:
            command["sessionId"] = self._session
        text = json.dumps(command).encode() + b"\0"
        while text:
            text = text[os.write(self._to, text) :]
        while True:
            answer = self._message()
            if answer.get("id") == self._last:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def _message(self):
        while b"\0" not in self._received:
            read = os.read(self._from, 1 << 16)
            if not read:
                raise RuntimeError("the browser ended")
            self._received += read
        text, self._received = self._received.split(b"\0", 1)
        return json.loads(text)

    def value(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def open(self, address, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.call("Page.navigate", url="about:blank")
        self.call("Page.navigate", url=address)
        for _ in range(1500):
            if self.value(
                "location.href !== 'about:blank' && document.readyState === 'complete' && "
                "(!document.querySelector('script') || document.body.dataset.state === 'ready')"
            ):
                return
            time.sleep(0.04)
        raise RuntimeError(f"{address} is never ready")

    def picture(self, p, address):
        """The bytes of a picture."""
        self.open(address, p.width, p.height)
        # A picture reaches beyond the view, where a browser leaves sections out.
        self.value("document.querySelectorAll('main > section').forEach(s => s.style.contentVisibility = 'visible')")
        if p.script:
            self.value(f"(async () => {{{p.script}}})()")
        time.sleep(1.0)  # the body is drawn in the next frames
        top = self.value(f"scrollY + document.querySelector('{p.begin}').getBoundingClientRect().top")
        height = p.height
        if p.end:
            height = self.value(f"scrollY + document.querySelector('{p.end}').getBoundingClientRect().bottom") - top
        clip = {"x": 0, "y": top, "width": p.width, "height": height, "scale": 1}
        if p.film:
            return self.film(p, clip)
        return self.shot(clip, format=p.name.rsplit(".", 1)[1], quality=QUALITY)

    def shot(self, clip, **how):
        found = self.call("Page.captureScreenshot", clip=clip, captureBeyondViewport=True, **how)
        return base64.b64decode(found["data"])

    def film(self, p, clip):
        """The bytes of a moving picture: each frame when the page has drawn it, however slow the machine is."""
        begin, end, rate = p.film
        drawn = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
        with tempfile.TemporaryDirectory(prefix="myoid.") as work:
            for i in range(round((end - begin) * rate)):
                self.value(f"(async () => {{ myoid.seek({begin + i / rate}); await {drawn}; }})()")
                Path(work, f"{i:04}.png").write_bytes(self.shot(clip, format="png"))
            subprocess.run(["ffmpeg", "-v", "error", "-framerate", str(rate), "-i", f"{work}/%04d.png", "-vf",
                            "scale=960:-1:flags=area", "-c:v", "libwebp_anim", "-quality", "60", "-compression_level",
                            "6", "-loop", "0", f"{work}/film.webp"], check=True)  # fmt: skip
            return Path(work, "film.webp").read_bytes()


def myoid(program, *arguments, may_fail=False, place=SOURCE):
    done = subprocess.run([program, *map(str, arguments), "--quiet"], cwd=place, stdout=subprocess.DEVNULL, check=False)
    if done.returncode not in ((0, 4) if may_fail else (0,)):
        sys.exit(f"{arguments[0]} ended with {done.returncode}")


def make_demo(program, work):
    protocol = SOURCE / "examples/demo/protocol.toml"
    myoid(program, "twin", "--model", "arm4", "--protocol", protocol, "--seed", 1, "--out", work / "recording")
    myoid(program, "run", work / "recording/study.toml", "--out", work / "demo", may_fail=True)


def make_example(name):
    def make(program, work):
        myoid(program, "run", SOURCE / "examples" / name / "study.toml", "--out", work / name, may_fail=True)

    return make


def make_group(program, work):
    protocol = SOURCE / "examples/protocols/three_trials.toml"
    manifest = "name,study\n"
    for seed in range(1, 21):
        recording = work / "group_recordings" / f"P{seed:02}"
        myoid(program, "twin", "--model", "arm4", "--protocol", protocol, "--seed", seed, "--out", recording)
        manifest += f"{recording.name},{recording}/study.toml\n"
    (work / "persons.csv").write_text(manifest)
    myoid(program, "cohort", work / "persons.csv", "--out", work / "group", may_fail=True)


def make_walk(program, work):
    data, motion, forces = DATA / "gait-emg", work / "walk.mot", work / "walk_so"
    model = data / "subject_walk_scaled.osim"
    myoid(program, "ik", "--model", model, "--markers", data / "markers_walk.trc", "--out", motion)
    myoid(program, "so", "--model", model, "--motion", motion, "--loads", data / "grf_walk.xml", "--lowpass", 6,
          "--reserve", 10, "--out", forces, may_fail=True)  # fmt: skip
    myoid(program, "info", model, "--html", work / "walk.html", "--motion", motion, "--activations",
          forces / "StaticOptimization_activation.sto", "--markers", data / "markers_walk.trc")  # fmt: skip


def make_gait(program, work):
    study = work / "gait_study"
    myoid(program, "init", study, "--from", DATA / "gait-emg")
    myoid(program, "run", study / "study.toml", "--out", work / "gait", may_fail=True)


def make_review(program, work):
    myoid(program, "review", "ceinms-rt-leg", "--out", work / "review", may_fail=True, place=DATA)


# For each page: the file, how it is made, the recordings that this takes.
PAGES = {
    "demo": ("demo/report.html", make_demo, None),
    "group": ("group/report.html", make_group, None),
    "elbow_emg": ("elbow_emg/report.html", make_example("elbow_emg"), "elbow-emg"),
    "box_lift": ("box_lift/report.html", make_example("box_lift"), "box-lift"),
    "gait": ("gait/report.html", make_gait, "gait-emg"),
    "review": ("review/report.html", make_review, "ceinms-rt-leg"),
    "walk": ("walk.html", make_walk, "gait-emg"),
}


def page_of(name, program, work):
    """The page's file; made where it is not there, None without its recordings."""
    file, make, data = PAGES[name]
    if not (work / file).is_file():
        if data and not (DATA / data).is_dir():
            return None
        make(program, work)
    return work / file


def alone(text):
    """A report without the links to the files beside it."""
    return re.sub(r'<p class="save">(?:<a href="figures/[^"]*">[A-Z]+</a> ?)+</p>\n?', "", text)


def main(program, work, *names):
    unknown = set(names) - {p.name for p in PICTURES}
    if unknown:
        sys.exit(f"no picture {sorted(unknown)[0]}; there are {', '.join(p.name for p in PICTURES)}")
    if not shutil.which("chromium"):
        sys.exit("chromium is not installed (Debian: apt install chromium)")
    if not Path(program).is_file():
        sys.exit(f"there is no program {program}; build it first")
    program, work = Path(program).resolve(), Path(work).resolve()
    work.mkdir(parents=True, exist_ok=True)
    browser = Browser()
    for p in PICTURES:
        if names and p.name not in names:
            continue
        page = page_of(p.page, program, work)
        if p.page == "demo":
            (FIGURES.parent / "sample.html").write_text(alone(page.read_text(encoding="utf-8")), encoding="utf-8")
        if page is None:
            print(f"{p.name} stays as it is: there is no {DATA / PAGES[p.page][2]}")
            continue
        bytes_ = browser.picture(p, f"{page.as_uri()}#{p.wishes}")
        most = MOST_BYTES_OF_FILM if p.film else MOST_BYTES
        if len(bytes_) > most:
            sys.exit(f"{p.name} has {len(bytes_)} bytes, at most {most} are allowed")
        (FIGURES / p.name).write_bytes(bytes_)
        print(f"{p.name}: {len(bytes_) / 1000:.0f} kB")
    browser.close()


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
