// Starts the viewer where the browser has what it needs; else the page's pictures stand for it.

const withoutViewer = (root, why) => {
  const section = root.closest('section');
  section.hidden = false;
  section.classList.add('stills');
  root.replaceChildren(element('p', { class: 'notice' }, `${why} The pictures of this page show the run.`));
};

/// What of the page is read: what the first picture takes, and all.
const pageRead = {};
pageRead.all = new Promise(done => document.readyState === 'loading' ? document.addEventListener('DOMContentLoaded', done) : done());
pageRead.first = new Promise(done => { window.gambesonFirst = done; pageRead.all.then(done); });

const startViewer = async () => {
  const root = document.getElementById('viewer');
  if (!root) return null;
  if (typeof DecompressionStream === 'undefined')
    return withoutViewer(root, 'To look around in three dimensions takes a browser of 2023 or later.');
  const library = await inflated(document.getElementById('viewer-library').textContent);
  document.head.append(element('script', {}, new TextDecoder().decode(library)));

  const colors = JSON.parse(document.getElementById('viewer-colors').textContent);
  await pageRead.first;
  const runs = [...document.querySelectorAll('script.viewer-run')].map((script, k) => new Run(JSON.parse(script.textContent), k));
  for (const run of runs) await run.loadFirst();
  const loadRest = async () => {
    await pageRead.all;
    for (const run of runs) await run.loadRest();
  };
  // Runs beside each other are shown at one moment, and each has the start of its own.
  if (runs.length > 1) await loadRest();
  root.closest('section').hidden = false;
  const viewer = new Viewer(root, runs, colors), start = runs[0].head.start;
  const named = start.field && runs[0].fieldHead(start.field) ? start.field : (runs[0].head.fields[0] || { name: '' }).name;
  viewer.time = start.time_s;
  viewer.setTime(start.time_s);
  viewer.stage.resize();
  viewer.label();
  viewer.setView(start.view);
  if (named) await viewer.setField(named); else viewer.offerRange();
  // Last: a browser that was just started is not ready to draw before, and whoever asks waits for it.
  if (!viewer.stage.begin())
    return withoutViewer(root, 'To look around in three dimensions takes WebGL, which this browser does not offer.');
  viewer.stage.drawNow();
  viewer.firstPicture_ms = performance.now();
  if (runs.length === 1) await loadRest();
  viewer.complete();
  if (named) await viewer.setField(named); else viewer.refresh();
  return viewer;
};

/// For scripts and tests: a promise of the viewer with all frames, null where there is none.
window.gambesonViewer = startViewer();
window.gambesonViewer.catch(error => {
  console.error(error);
  const root = document.getElementById('viewer');
  if (root) withoutViewer(root, `The view in three dimensions did not start: ${error.message}.`);
});
