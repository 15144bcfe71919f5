// HTML elements in one call.

export function el(tag, { attributes = {}, ...properties } = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

export function select(label, options, changed) {
  const input = el('select', { attributes: { 'aria-label': label } }, ...options.map((o, i) => el('option', { value: i, textContent: o })));
  input.addEventListener('change', () => changed(Number(input.value)));
  return input;
}
