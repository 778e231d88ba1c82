// Starts the viewer where the browser has what it needs; else the page's pictures stand for it.

const withoutViewer = (root, why) => {
  const section = root.closest('section');
  section.hidden = false;
  section.classList.add('stills');
  root.replaceChildren(element('p', { class: 'notice' }, `${why} The pictures of this page show the run.`));
};

const startViewer = async () => {
  const root = document.getElementById('viewer');
  if (!root) return null;
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('webgl', { antialias: false, alpha: true, premultipliedAlpha: true });
  if (!context)
    return withoutViewer(root, 'To look around in three dimensions takes WebGL, which this browser does not offer.');
  if (typeof DecompressionStream === 'undefined')
    return withoutViewer(root, 'To look around in three dimensions takes a browser of 2023 or later.');
  const library = new TextDecoder().decode(await inflated(document.getElementById('viewer-library').textContent));
  document.head.append(element('script', {}, library));

  const colors = JSON.parse(document.getElementById('viewer-colors').textContent), runs = [];
  for (const script of document.querySelectorAll('script.viewer-run')) {
    const blocks = [];
    for (let next = script.nextElementSibling; next && next.classList.contains('viewer-block'); next = next.nextElementSibling)
      blocks.push(next.textContent);
    runs.push(await new Run(JSON.parse(script.textContent), blocks).load());
  }
  root.closest('section').hidden = false;
  const viewer = new Viewer(root, canvas, context, runs, colors), start = runs[0].head.start;
  const named = start.field && runs[0].fieldHead(start.field) ? start.field : (runs[0].head.fields[0] || { name: '' }).name;
  viewer.time = start.time_s;
  viewer.setTime(start.time_s);
  viewer.stage.resize();
  viewer.label();
  viewer.setView(start.view);
  if (named) await viewer.setField(named); else viewer.offerRange();
  viewer.stage.drawNow();
  viewer.firstPicture_ms = performance.now();
  return viewer;
};

/// For scripts and tests: a promise of the viewer, null where there is none.
window.gambesonViewer = startViewer();
window.gambesonViewer.catch(error => {
  console.error(error);
  const root = document.getElementById('viewer');
  if (root) withoutViewer(root, `The view in three dimensions did not start: ${error.message}.`);
});
