// Plots over time have the moment of the picture in them, and a click on them is a moment.

class Plots {
  /// `go(time, shown)`: called with a moment that was clicked.
  constructor(go) {
    this.plots = [...document.querySelectorAll('svg[data-frame][data-time]')].map(svg => {
      const [x0, x1, y0, y1, t0, t1] = svg.dataset.frame.split(' ').map(Number);
      const line = document.createElementNS(svg.namespaceURI, 'line');
      line.setAttribute('class', 'moment');
      line.setAttribute('y1', y0);
      line.setAttribute('y2', y1);
      svg.appendChild(line);
      svg.classList.add('timed');
      svg.addEventListener('click', event => {
        const box = svg.getBoundingClientRect(), x = (event.clientX - box.left) / box.width * svg.viewBox.baseVal.width;
        if (x < x0 - 8 || x > x1 + 8) return;
        const scale = box.width / svg.viewBox.baseVal.width, peak = svg.querySelector('.peak[data-time]');
        const near = peak && Math.abs(Number(peak.getAttribute('cx')) - x) * scale < 14;
        go(near ? Number(peak.dataset.time) : t0 + (Math.max(x0, Math.min(x1, x)) - x0) / (x1 - x0) * (t1 - t0), svg);
      });
      return { svg, line, x0, x1, t0, t1, seen: true };
    });
    // Those out of sight stay as they are: browsers paint well past the screen.
    this.observer = new IntersectionObserver(entries => {
      for (const e of entries) this.plots.find(p => p.svg === e.target).seen = e.isIntersecting;
      if (this.time !== undefined) this.show(this.time);
    });
    for (const { svg } of this.plots) this.observer.observe(svg);
  }

  show(time) {
    this.time = time;
    for (const { line, x0, x1, t0, t1, seen } of this.plots) {
      if (!seen) continue;
      const x = x0 + (time - t0) / (t1 - t0) * (x1 - x0);
      line.style.display = time < t0 || time > t1 ? 'none' : '';
      line.setAttribute('x1', x);
      line.setAttribute('x2', x);
    }
  }
}

