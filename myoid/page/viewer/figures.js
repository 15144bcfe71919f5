// The report's own figures, made alive: read off by pointing, zoomed, saved from the page.
import { el } from './element.js';
import { Plot } from './plot.js';
import { save } from './save.js';
import { numbers } from './decode.js';
import { curve } from './series.js';

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
  return plots;
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
  const plots = new Map(figures.flatMap((figure) => live(figure) || []).map((plot) => [plot.element, plot]));
  // Each is drawn when it has a width, at the latest when its section opens; asking for widths would lay out the page.
  const observer = new ResizeObserver((entries) => entries.forEach(({ target, contentRect }) => plots.get(target).resize(contentRect.width)));
  for (const element of plots.keys()) observer.observe(element);
}
