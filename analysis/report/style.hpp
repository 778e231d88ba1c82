#pragma once
/// The page's look, and the little script that shows values under the pointer; the page is whole without it.

namespace gambeson::report {

inline constexpr const char* kStyle = R"css(
:root { --ink:#1b1f27; --soft:#555d6b; --line:#d9dde4; --paper:#ffffff; --ground:#f5f6f8; --accent:#3a2d86; --left:#1668b0; --right:#c04a0f;
  --third:#a3246b; --fourth:#6b4c9a; --good:#1b6e3c; --bad:#a61b1b; --doubt:#655847; }
* { box-sizing:border-box; }
body { margin:0; background:var(--ground); color:var(--ink); font:16px/1.5 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; }
main, header.page { max-width:1120px; margin:0 auto; padding:0 20px; }
header.page { padding-top:32px; }
h1 { font-size:1.15rem; margin:0; font-weight:600; color:var(--accent); }
header.page p { margin:4px 0 0; color:var(--soft); max-width:75ch; }
h2 { font-size:1.35rem; margin:44px 0 6px; }
h2 + p { margin-top:0; color:var(--soft); max-width:75ch; }
h3 { font-size:1rem; margin:0 0 8px; }
.headline { display:grid; grid-template-columns:minmax(0,1fr); gap:24px; margin:20px 0 0; background:var(--paper); border:1px solid var(--line); border-radius:14px; overflow:hidden; }
.headline .words { padding:26px 28px; }
.headline .sentence { font-size:1.5rem; line-height:1.3; margin:0 0 18px; font-weight:600; text-wrap:pretty; } .headline .doubted { font-size:1.05rem; font-weight:500; }
.headline img { width:100%; height:auto; max-height:720px; object-fit:contain; display:block; background:#f9fafa; }
.headline figure { margin:0; } .headline > .meaning { grid-column:1 / -1; margin:-24px 28px 24px; }
.headline figcaption { padding:6px 16px 12px; font-size:.9rem; color:var(--soft); }
dl.answers { display:grid; grid-template-columns:max-content minmax(0,1fr); gap:7px 18px; margin:0; }
dl.answers dt { color:var(--soft); }
dl.answers dd { margin:0; font-weight:600; } dl.answers .reason { font-weight:400; }
.words-mean { margin:22px 0 0; } .words-mean + .meaning { margin-top:4px; padding-top:0; border-top:0; } .meaning { margin:18px 0 0; padding-top:14px; border-top:1px solid var(--line); color:var(--soft); font-size:.95rem; }
.cards { display:grid; grid-template-columns:repeat(auto-fill,minmax(235px,1fr)); gap:14px; margin-top:14px; }
.card { background:var(--paper); border:1px solid var(--line); border-top:4px solid var(--accent); border-radius:10px; padding:14px 16px; }
.card.left { border-top-color:var(--left); } .card.right { border-top-color:var(--right); }
.card .big { font-size:1.9rem; font-weight:700; line-height:1.15; margin:2px 0 6px; }
.card .big small { font-size:1rem; font-weight:600; white-space:nowrap; }
.card h3 { margin:0; } .card h3 .tag { float:right; font-size:.75rem; font-weight:600; color:var(--accent); border:1px solid var(--accent); border-radius:99px; padding:0 8px; }
.card p { margin:0; font-size:.95rem; } .card p.soft { color:var(--soft); }
.cards.reasons { grid-template-columns:repeat(auto-fit,minmax(min(100%,430px),1fr)); } .cards.reasons .card:first-child:nth-last-child(odd) { grid-column:1 / -1; } .cards.reasons .card { border-top-color:var(--accent); } .cards.reasons p { margin-top:6px; }
.wide { margin-top:14px; }
.charts { display:grid; grid-template-columns:repeat(auto-fit,minmax(min(100%,430px),1fr)); gap:16px; margin-top:14px; align-items:start; }
.charts > .panel:only-child, .charts > .panel:has(thead th:nth-child(6)) { grid-column:1 / -1; } .charts { grid-auto-flow:row dense; }
figure.chart, .panel { margin:0; background:var(--paper); border:1px solid var(--line); border-radius:10px; padding:16px; min-width:0; }
figure.chart figcaption, .panel .caption { font-size:.9rem; color:var(--soft); margin:6px 0 0; }
svg { display:block; width:100%; height:auto; font:14px system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; fill:var(--ink); overflow:visible; }
svg .grid { stroke:#e4e7ec; } svg .zero { stroke:#8d95a3; } svg .axis, svg .mark-label { fill:var(--soft); } svg .mark-label { font-size:12px; }
svg .uncounted { fill:#e9ecf1; } svg .uncounted-label { fill:var(--soft); font-size:12px; paint-order:stroke; stroke:#e9ecf1; stroke-width:4px; }
svg .mark { stroke:#8d95a3; stroke-dasharray:3 4; } svg .peak-label { font-weight:600; paint-order:stroke; stroke:#fff; stroke-width:4px; }
svg .series { fill:none; stroke-width:2.2; stroke-linejoin:round; }
svg .left { stroke:var(--left); } svg .right { stroke:var(--right); stroke-dasharray:7 2.5; } svg .third { stroke:var(--third); } svg .fourth { stroke:var(--fourth); stroke-dasharray:2 3; } svg .fifth { stroke:var(--good); stroke-dasharray:9 3 2 3; }
svg .peak { fill:#fff; stroke-width:2.4; stroke-dasharray:none; } svg .bar { fill:var(--accent); } svg .value { font-weight:600; }
svg .published { fill:#fff; fill-opacity:.75; stroke:var(--ink); stroke-width:1.3; }
svg .point.green { fill:var(--good); } svg .point.doubtful { fill:var(--doubt); } svg .point.amber { fill:#c98500; } svg .point.red { fill:var(--bad); } svg .ring, svg .cross { fill:none; stroke-width:1.6; } svg .ring { stroke:var(--doubt); } svg .cross { stroke:var(--ink); }
svg .cursor { stroke:var(--ink); stroke-width:1; } svg .readout { font-weight:600; font-size:13px; paint-order:stroke; stroke:#fff; stroke-width:5px; }
.scroll { overflow-x:auto; container-type:inline-size; background:linear-gradient(90deg,var(--paper) 40%,transparent) 0 0/48px 100% no-repeat local, linear-gradient(270deg,var(--paper) 40%,transparent) 100% 0/48px 100% no-repeat local, linear-gradient(90deg,#0003,transparent) 0 0/16px 100% no-repeat scroll, linear-gradient(270deg,#0003,transparent) 100% 0/16px 100% no-repeat scroll; }
.panel.more::before { content:"More columns: scroll the table sideways \2192"; display:block; margin-bottom:6px; font-size:.88rem; font-weight:600; color:var(--accent); } .panel.more th:first-child { position:sticky; left:0; z-index:1; background:var(--paper); border-right:1px solid var(--line); padding-right:8px; max-width:min(45vw,16rem); } .panel.more th:first-child + * { padding-left:8px; } .panel.more tr.group th:first-child { background:var(--ground); }
.q { white-space:nowrap; }
table { border-collapse:collapse; width:100%; font-size:.95rem; }
caption { text-align:left; font-weight:600; padding-bottom:6px; } caption span { position:sticky; left:0; display:inline-block; max-width:calc(100vw - 48px); max-width:100cqw; }
th, td { text-align:left; padding:6px 12px 6px 0; border-bottom:1px solid var(--line); vertical-align:top; }
thead th { font-weight:600; color:var(--soft); font-size:.88rem; border-bottom-color:#aab1bd; }
th[scope=row] { font-weight:500; } td.number, th.number { text-align:right; font-variant-numeric:tabular-nums; white-space:nowrap; } thead th.number { white-space:normal; }
.pictures { display:grid; grid-template-columns:repeat(auto-fit,minmax(min(100%,300px),1fr)); gap:16px; margin-top:14px; align-items:start; }
.pictures figure { margin:0; background:var(--paper); border:1px solid var(--line); border-radius:10px; overflow:hidden; }
.pictures img { display:block; width:100%; height:auto; } .pictures figcaption { padding:10px 16px 14px; font-size:.95rem; }
.charts > figure.chart:only-child { max-width:640px; } .charts.single { grid-template-columns:minmax(0,1fr); }
.judged { margin:0 0 10px; padding:10px 14px; border-radius:10px; border-left:5px solid #8d95a3; background:#f1f3f6; } .judged strong { margin-right:8px; }
.judged.green { border-color:var(--good); background:#e9f5ee; } .judged.green strong { color:var(--good); }
.judged.amber { border-color:#c98500; background:#fff6df; } .judged.amber strong { color:#8a5300; }
.judged.doubtful { border-color:var(--doubt); background:repeating-linear-gradient(135deg,#f5f2ed 0 9px,#eae5dc 9px 18px); } .judged.doubtful strong { color:var(--doubt); }
.judged.red { border-color:var(--bad); background:#fdecec; } .judged.red strong { color:var(--bad); }
.judged + .answers { margin-top:18px; }
tr.group th, tr.group td { background:var(--ground); } tr.group th { padding-left:8px; font-weight:600; } td small, th small { color:var(--soft); font-size:.86rem; font-weight:400; }
.sentences { min-width:min(15rem,55vw); } ul.plain { list-style:none; margin:0; padding:0; min-width:min(16.5rem,50vw); } ul.plain li + li { margin-top:4px; }
ul.notes { margin:0; padding-left:20px; } ul.notes li + li { margin-top:4px; } .notice summary { color:inherit; } .notice[open] summary { margin-bottom:6px; } details.facts { padding:0 4px; } details.facts .about { margin:8px 0 2px; font-weight:600; } details.facts ul { color:var(--soft); font-size:.95rem; columns:2 420px; column-gap:36px; } details.facts li { break-inside:avoid; }
details { margin-top:14px; } summary { cursor:pointer; color:var(--accent); font-weight:600; }
.notice { background:#fff6df; border:1px solid #d8b25a; border-radius:8px; padding:8px 12px; margin:10px 0 0; color:#5c4300; font-size:.95rem; }
.alarm { background:#fdecec; border:2px solid var(--bad); border-radius:10px; padding:12px 16px; margin:16px 0 0; color:#6d1010; font-weight:600; }
.light { font-weight:700; white-space:nowrap; } .light.green { color:var(--good); } .light.amber { color:#8a5300; } .light.doubtful { color:var(--doubt); } .light.unknown { color:var(--soft); } .light.red { color:var(--bad); }
.good, .bad { font-weight:700; white-space:nowrap; } .good { color:var(--good); } .bad { color:var(--bad); }
ul.assumptions { margin:10px 0 0; padding-left:22px; columns:2 420px; column-gap:36px; } ul.assumptions li { break-inside:avoid; margin-bottom:6px; }
footer { color:var(--soft); font-size:.9rem; padding:36px 0 48px; }
@media (min-width:900px) { .headline.pictured { grid-template-columns:minmax(0,1fr) minmax(0,1fr); } .headline.pictured figure { display:flex; flex-direction:column; justify-content:flex-start; background:#f9fafa; border-left:1px solid var(--line); border-bottom:1px solid var(--line); } .headline > .meaning { border-top:0; padding-top:0; margin-top:0; } .headline > .meaning + .meaning { margin-top:-18px; } }
@media (max-width:560px) { main, header.page { padding-left:12px; padding-right:12px; } .headline .words { padding:18px 16px; } .headline .sentence { font-size:1.25rem; } dl.answers { grid-template-columns:minmax(0,1fr); gap:0; } dl.answers dd { margin-bottom:8px; } figure.chart, .panel { padding:12px 10px; } }
@media print { @page { margin:11mm 12mm; } html { font-size:10px; } body { background:#fff; font-size:1rem; line-height:1.4; } main, header.page { max-width:none; padding-left:0; padding-right:0; } header.page, header.page + main { padding-top:0; }
  h2 { break-after:avoid; margin-top:12px; } h2 + p { break-inside:avoid; break-after:avoid; } h3 { margin-bottom:2px; } figure, .card, .panel, .headline, tr { break-inside:avoid; }
  .headline.pictured { grid-template-columns:1fr 1fr; } .headline img { max-height:80mm; } .headline .words { padding:14px 16px; } .headline .sentence { font-size:1.3rem; margin-bottom:10px; } dl.answers { grid-template-columns:minmax(0,.7fr) minmax(0,1fr); gap:3px 12px; } .meaning { margin-top:10px; padding-top:8px; }
  .cards { grid-template-columns:repeat(4,1fr); gap:8px; } .cards:has(> :nth-child(5)) { grid-template-columns:repeat(3,1fr); } .card { padding:6px 8px; } .wide { margin-top:8px; }
  .charts, .pictures { grid-template-columns:1fr 1fr; gap:8px; margin-top:8px; } .charts { align-items:stretch; } .charts:has(> :nth-child(3)), .pictures { grid-template-columns:repeat(3,minmax(0,1fr)); } .pictures:has(> :nth-child(4)) { grid-template-columns:repeat(4,minmax(0,1fr)); }
  .charts > .panel:has(thead th:nth-child(5)), .charts > .panel:has(.sentences) { grid-column:1 / -1; } figure.chart, .panel { padding:5px 7px; } figure.chart figcaption, .panel .caption { font-size:.82rem; line-height:1.3; margin-top:3px; }
  .pictures img { max-height:62mm; object-fit:contain; } .pictures figcaption { padding:2px 6px 4px; font-size:.85rem; }
  .panel:has(tbody tr:nth-child(9)) { break-inside:auto; } thead { display:table-header-group; } caption, thead, tbody tr:first-child { break-after:avoid; } tbody tr:last-child { break-before:avoid; } table { font-size:.86rem; } thead th { font-size:.82rem; } th, td { padding:1px 8px 1px 0; } .panel.more::before { display:none; } .scroll { overflow:visible; background:none; } .panel.more th:first-child { position:static; border-right:0; }
  .panel:has(thead th:nth-child(9)) table { font-size:.8rem; } .panel:has(thead th:nth-child(9)) :is(th, td) { padding-right:6px; }
  ul.assumptions, details.facts ul { columns:2 auto; column-gap:20px; font-size:.88rem; } ul.assumptions li { margin-bottom:2px; } details { margin-top:8px; } footer { padding:12px 0 0; } * { print-color-adjust:exact; -webkit-print-color-adjust:exact; } }
)css";

/// A sign where a table is wider than its place; values under the pointer, read back from the drawn paths.
inline constexpr const char* kScript = R"js(
const fit = () => document.querySelectorAll('.scroll').forEach(s => s.parentNode.classList.toggle('more', s.scrollWidth > s.clientWidth + 1));
fit(); addEventListener('resize', fit); addEventListener('toggle', fit, true);
// Paper has no folds.
addEventListener('beforeprint', () => document.querySelectorAll('details:not([open])').forEach(d => { d.open = true; d.dataset.folded = ''; }));
addEventListener('afterprint', () => document.querySelectorAll('details[data-folded]').forEach(d => { d.open = false; delete d.dataset.folded; }));
document.querySelectorAll('svg[data-frame]').forEach(svg => {
  const [x0, x1, y0, y1, t0, t1, v0, v1] = svg.dataset.frame.split(' ').map(Number);
  const make = (name, cls) => { const e = document.createElementNS(svg.namespaceURI, name); e.setAttribute('class', cls); svg.appendChild(e); return e; };
  const cursor = make('line', 'cursor'), readout = make('text', 'readout');
  const lines = [...svg.querySelectorAll('path.series')].map(p => ({ name: p.dataset.name,
    points: p.getAttribute('d').slice(1).split(/[ML]/).map(s => s.split(' ').map(Number)) }));
  const hide = () => { cursor.style.display = readout.style.display = 'none'; };
  const show = event => {
    const box = svg.getBoundingClientRect(), x = (event.clientX - box.left) / box.width * svg.viewBox.baseVal.width;
    if (x < x0 || x > x1) return hide();
    const near = lines.map(l => ({ name: l.name, p: l.points.reduce((a, b) => Math.abs(b[0] - x) < Math.abs(a[0] - x) ? b : a) }));
    const at = near[0].p[0];
    cursor.style.display = readout.style.display = '';
    for (const [k, v] of [['x1', at], ['x2', at], ['y1', y0], ['y2', y1]]) cursor.setAttribute(k, v);
    readout.textContent = (t0 + (at - x0) / (x1 - x0) * (t1 - t0)).toFixed(2) + ' s: ' +
      near.map(n => n.name + ' ' + (v0 + (n.p[1] - y0) / (y1 - y0) * (v1 - v0)).toPrecision(3)).join(', ') + ' ' + svg.dataset.unit;
    readout.setAttribute('x', at < (x0 + x1) / 2 ? at + 6 : at - 6);
    readout.setAttribute('y', y0 - 6);
    readout.setAttribute('text-anchor', at < (x0 + x1) / 2 ? 'start' : 'end');
  };
  svg.addEventListener('pointermove', show); svg.addEventListener('pointerdown', show); svg.addEventListener('pointerleave', hide); hide();
});
)js";

}  // namespace gambeson::report
