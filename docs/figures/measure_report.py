#!/usr/bin/env python3
"""Measures a report in headless Chromium: size, time to the first picture, frames per second of the replay.

    docs/figures/measure_report.py REPORT.html [SECONDS [without-body]]

The page counts its own frames by requestAnimationFrame while it plays the trial that it opens first, from the second
second on: until then it has found how finely it can draw the body (`pixels` of the canvas for one of the page's).
`without-body` leaves the body undrawn, which shows what the plots alone cost. A page without a workbench, as that of a
group, has two figures: the first picture and the end of loading.
"""

import json
import sys
from pathlib import Path

from make_figures import Browser

MEASURE = """
new Promise((done) => {
  const times = [];
  const begin = performance.now();
  if (HIDDEN) myoid.canvas.hidden = true;
  myoid.toggle();
  const tick = (now) => {
    if (now - begin > 1000) times.push(now);
    if (now - begin < 1000 * (1 + SECONDS)) return requestAnimationFrame(tick);
    const pixels = myoid.replay ? myoid.replay.stage.renderer.getPixelRatio() : 0;
    const steps = times.slice(1).map((t, i) => t - times[i]).sort((a, b) => a - b);
    myoid.toggle();
    // The page's own work of a frame: plots and body, without the drawing that the browser does afterwards.
    const [from, to] = myoid.domain;
    const work = Array.from({ length: 101 }, (_, k) => {
      const start = performance.now();
      myoid.seek(from + ((to - from) * k) / 100);
      if (myoid.replay) myoid.replay.draw();
      return performance.now() - start;
    }).sort((a, b) => a - b);
    done(JSON.stringify({
      ready_s: AFTER,
      frames_per_s: (1000 * steps.length) / (times[times.length - 1] - times[0]),
      slowest_of_20_ms: steps[Math.floor(0.95 * steps.length)],
      longest_ms: steps[steps.length - 1],
      script_ms: work[50],
      pixels,
    }));
  };
  requestAnimationFrame(tick);
})
"""
READY = """
new Promise((done) => {
  const ready = () => document.body && document.body.dataset.state === 'ready';
  const look = () => (ready() ? requestAnimationFrame(() => done(performance.now() / 1000)) : setTimeout(look, 5));
  look();
})
"""
LOADED = """
new Promise((done) => {
  const look = () => (document.readyState === 'complete' ? done(performance.now() / 1000) : setTimeout(look, 5));
  look();
})
"""
FIRST_PICTURE = "performance.getEntriesByName('first-contentful-paint')[0].startTime / 1000"


def measure(page, width, seconds, hidden):
    browser = Browser()
    try:
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        browser.call("Page.navigate", url=page.resolve().as_uri())
        if b'id="workbench"' not in page.read_bytes():
            loaded = browser.value(LOADED)
            return {"first_picture_s": browser.value(FIRST_PICTURE), "loaded_s": loaded}
        ready = browser.call("Runtime.evaluate", expression=READY, awaitPromise=True, returnByValue=True)
        expression = MEASURE.replace("SECONDS", str(seconds)).replace("HIDDEN", "true" if hidden else "false")
        expression = expression.replace("AFTER", str(ready["result"]["value"]))
        found = browser.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        first = browser.call("Runtime.evaluate", expression=FIRST_PICTURE, returnByValue=True)
        return {"first_picture_s": first["result"].get("value"), **json.loads(found["result"]["value"])}
    finally:
        browser.close()


def main(page, seconds="3", body=""):
    page = Path(page)
    if not page.is_file():
        sys.exit(f"there is no page {page}")
    print(f"{page.stat().st_size / 1e6:.2f} MB")
    for width in (1280, 1920, 390):
        found = measure(page, width, float(seconds), body == "without-body")
        print(width, {name: round(value, 2) for name, value in found.items()})


if __name__ == "__main__":
    main(*sys.argv[1:])
