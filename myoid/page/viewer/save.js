// Files that the reader saves from the page.

export function save(name, content, type) {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  // A test reads what was saved last.
  window.myoidSaved = { name, blob };
}

export const cell = (text) => (/^[# ]|[",;\t\n]| $/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** Curves as the program writes a figure's numbers: panel,series,role,x,y,y_upper. */
export function csv(panels) {
  const rows = ['panel,series,role,x,y,y_upper'];
  const shown = (value) => (Number.isFinite(value) ? String(Number(value.toPrecision(9))) : '');
  for (const { title, curves } of panels) {
    for (const c of curves) {
      const head = `${cell(title)},${cell(c.name)},${c.role}`;
      for (let i = 0; i < c.x.length; ++i)
        rows.push(`${head},${shown(c.x[i])},${shown(c.y[i])},${c.upper ? shown(c.upper[i]) : ''}`);
    }
  }
  return rows.join('\n') + '\n';
}

export const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);

/** A drawing as a file of its own, with its title above. */
export function svgFile(drawing, title) {
  const width = Number(drawing.getAttribute('width'));
  const height = Number(drawing.getAttribute('height'));
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height + 26}" viewBox="0 -26 ${width} ${height + 26}" ` +
    'font-family="Helvetica, Arial, sans-serif">' +
    `<rect y="-26" width="${width}" height="${height + 26}" fill="#fff"/><text x="8" y="-9" font-size="13" font-weight="bold">${escape(title)}</text>` +
    `${drawing.innerHTML}</svg>\n`
  );
}
