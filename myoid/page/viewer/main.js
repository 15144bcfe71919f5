// The script of both pages: a report with its workbench, and a page that shows a moving model alone.
import { startViewer } from './viewer.js';
import { startWorkbench } from './workbench.js';

const json = (id) => {
  const element = document.getElementById(id);
  return element && JSON.parse(element.textContent);
};
const scenes = json('scene');
const values = json('workbench-data');
if (values) startWorkbench(values, scenes);
else startViewer(scenes);
