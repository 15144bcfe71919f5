// Put at the end of a page with a moving model by viewer.test.cpp: uses the page as a person would,
// and leaves what it found as lines "name: value" in the last element, a <pre>.
(async () => {
  const found = {};
  const viewer = window.myoid;
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const press = (key) => window.dispatchEvent(new KeyboardEvent('keydown', { key }));

  /** The picture as it is now, as colors of pixels. */
  function picture() {
    viewer.draw();
    const copy = document.createElement('canvas');
    copy.width = viewer.canvas.width;
    copy.height = viewer.canvas.height;
    const context = copy.getContext('2d');
    context.drawImage(viewer.canvas, 0, 0);
    return context.getImageData(0, 0, copy.width, copy.height).data;
  }
  const pixels = (image, test) => {
    let count = 0;
    for (let i = 0; i < image.length; i += 4) if (test(i)) ++count;
    return count;
  };
  const different = (a, b) =>
    pixels(a, (i) => Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) + Math.abs(a[i + 2] - b[i + 2]) > 30);
  const colored = (image) => pixels(image, (i) => Math.max(image[i], image[i + 1], image[i + 2]) - Math.min(image[i], image[i + 1], image[i + 2]) > 60);

  try {
    Object.assign(found, document.body.dataset);
    found.listed = document.querySelectorAll('aside .muscles label').length;
    found.coordinates = document.querySelectorAll('aside tbody tr').length;
    found.legend = viewer.panel.legend.textContent;
    const first = picture();
    found.pixels = first.length / 4;
    found.not_background = pixels(first, (i) => Math.abs(first[i] - first[0]) + Math.abs(first[i + 1] - first[1]) + Math.abs(first[i + 2] - first[2]) > 30);

    viewer.seek(viewer.trial.duration / 2);
    const middle = picture();
    found.moved = different(first, middle);
    found.angle_shown = document.querySelector('aside tbody tr .number').textContent;
    found.angle = viewer.trial.coordinate(viewer.figure.frame, 0);

    const withMuscles = colored(middle);
    viewer.show('muscles', false);
    found.muscles_colored = withMuscles - colored(picture());
    viewer.show('muscles', true);
    found.errors_drawn = viewer.figure.errors.geometry.drawRange.count / 2;
    found.error_mm = 1000 * viewer.figure.markerError(0);

    press('1');
    const front = picture();
    press('3');
    found.views_differ = different(front, picture());

    viewer.seek(0);
    press(' ');
    found.playing = viewer.player.playing;
    await wait(300);
    found.played_s = viewer.player.seconds;
    press(' ');
    found.paused = !viewer.player.playing;
    press('End');
    viewer.draw();
    found.last = document.body.dataset.frame;

    // Point at the middle of the first muscle.
    viewer.view('side');
    viewer.draw();
    const tube = viewer.figure.tubes[0];
    const place = tube.points[0].clone().add(tube.points[1]).multiplyScalar(0.5).project(viewer.camera.camera);
    const box = viewer.canvas.getBoundingClientRect();
    const at = { clientX: box.left + ((place.x + 1) * box.width) / 2, clientY: box.top + ((1 - place.y) * box.height) / 2 };
    viewer.canvas.dispatchEvent(new PointerEvent('pointermove', at));
    found.pointed = viewer.panel.tip.hidden ? '' : viewer.panel.tip.textContent;
  } catch (error) {
    window.probeErrors.push(error.stack);
  }
  found.errors = window.probeErrors.join('; ');
  const pre = document.createElement('pre');
  pre.id = 'found';
  pre.textContent = Object.entries(found).map(([name, value]) => `${name}: ${value}`).join('\n');
  document.body.append(pre);
})();
