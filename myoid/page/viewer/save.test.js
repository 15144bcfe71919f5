import { csv, escape, svgFile } from './save.js';
import { equal, test } from './testing.js';

test('numbers are saved as the program writes a figure’s', () => {
  const curves = [{ name: 'a, b', role: 'band', x: [0, 0.5], y: [1 / 3, NaN], upper: [1, 2] }];
  equal(csv([{ title: 'he said "x"', curves }]), 'panel,series,role,x,y,y_upper\n"he said ""x""","a, b",band,0,0.333333333,1\n"he said ""x""","a, b",band,0.5,,2\n');
});

test('a drawing is a file of its own', () => {
  const drawing = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  drawing.setAttribute('width', 100);
  drawing.setAttribute('height', 50);
  drawing.innerHTML = '<path d="M0 0"/>';
  const read = new DOMParser().parseFromString(svgFile(drawing, 'F < 3 & "x"'), 'image/svg+xml');
  equal(read.querySelectorAll('parsererror').length, 0);
  equal(read.querySelector('text').textContent, 'F < 3 & "x"');
  equal(escape('<&">'), '&lt;&amp;&quot;&gt;');
});
