// The report's own figures, made alive: read off by pointing, zoomed, saved from the page.
import { el } from './element.js';
import { Plot } from './plot.js';
import { save } from './save.js';
import { curve, numbers } from './series.js';

function live(figure) {
  const place = document.getElementById(figure.id);
  const drawing = place && place.querySelector(':scope > svg');
  if (!drawing) return null;
  const plots = figure.panels.map((panel) => {
    const plot = new Plot({
      kind: figure.id.startsWith('curves_') ? 'curves' : figure.id,
      prefix: figure.id,
      title: [panel.title, panel.y.label].filter(Boolean).join(': '),
      unit: panel.y.unit,
      x: panel.x,
      height: 230,
      curves: panel.series.map((s) => curve(s, numbers(s.x).values)),
    }, {
      hover: (x) => plot.setPointer(x),
      pick: (x) => plot.setCursor(x),
      zoom: (a, b) => plot.setView([a, b]),
      reset: () => plot.setView(null),
    });
    return plot;
  });
  const box = el('div', { className: 'live-figure' }, ...plots.map((p) => p.element));
  drawing.before(box);
  // Paper and readers without script have the static drawing.
  drawing.classList.add('static');
  return { resize: () => plots.forEach((p) => p.resize(p.element.clientWidth)) };
}

/** Saves a static drawing or a table's numbers from the page itself, for a report that travels without its folder. */
function saveStatic(place) {
  const drawing = place.querySelector(':scope > svg');
  for (const link of place.querySelectorAll('.save a')) {
    if (link.textContent !== 'SVG' || !drawing) continue;
    link.addEventListener('click', (event) => {
      event.preventDefault();
      save(`${place.id}.svg`, new XMLSerializer().serializeToString(drawing), 'image/svg+xml');
    });
  }
}

export function upgradeFigures(figures) {
  for (const place of document.querySelectorAll('figure[id]')) saveStatic(place);
  const shown = figures.map(live).filter(Boolean);
  for (const figure of shown) figure.resize();
  return shown;
}
