#!/usr/bin/env python3
"""The viewer of a report's page, in a browser without a window: it starts from the disk without an error of the console and without a
request, draws with WebGL, and what clicks find is what was recorded, within 1 % (issue 23, P1). Skipped where there is no Chromium.
`--page RESULTS` and `--study FOLDER` look at results that are there, in place of runs of its own."""

import json
import math
import pathlib
import subprocess
import sys

import browser
from common import HERE, SKIPPED, Folder, check, run, run_case

WITHIN = 0.01
# `still`: when the camera has come to where it goes, however slow the browser is.
WHERE = """const v = await gambesonViewer, still = async v => {
    for (let k = 0; k < 3 || v.stage.travels; ++k) await new Promise(done => requestAnimationFrame(done));
    await new Promise(done => setTimeout(done, 300));
};"""


def look(page, code):
    return page.evaluate("(async () => {" + WHERE + code + "})()")


class Recorded:
    """What recorded_values reads of the results."""

    def __init__(self, tool, results):
        self.tool, self.results, self.known = tool, results, {}

    def rows(self, field, time_s, body=False):
        key = (field, round(time_s, 6), body)
        if key not in self.known:
            done = subprocess.run([self.tool, self.results, field, repr(time_s)] + (["--body"] if body else []),
                                  capture_output=True, text=True, check=True)
            lines = done.stdout.splitlines()
            check(abs(float(lines[0]) - time_s) < 1e-6, f"the viewer shows {time_s} s, the recording has {lines[0]} s")
            self.known[key] = [[float(x) for x in line.split()] for line in lines[1:]]
        return self.known[key]


def near(a, b, scale):
    return abs(a - b) <= WITHIN * max(abs(b), 1e-3 * scale)


def nearest_sample(positions, x):
    best = min(range(len(positions)), key=lambda i: math.dist(positions[i], x))
    return best, math.dist(positions[best], x)


def values_are_those_recorded(page, recorded):
    """Of vertices all over the cloth, at several times."""
    units = {"stress": 1, "strain": 100, "pressure": 1e-3}
    compared = 0
    for field, scale in units.items():
        if not look(page, f"return !!v.runs[0].fieldHead('{field}');"):
            continue
        rows = look(page, f"""
            await v.setField('{field}');
            const run = v.runs[0], field = run.fields.get('{field}'), out = [];
            for (const frame of [0, Math.floor(run.times.length / 2), run.times.length - 1])
              for (const mesh of run.meshesOf('cloth'))
                for (let vertex = 0; vertex < mesh.vertices; vertex += Math.ceil(mesh.vertices / 40))
                  out.push([run.times[frame], run.position(mesh, vertex, frame), run.value(field, mesh, vertex, frame)]);
            return out;""")
        most = max(scale * r[0] for t in {r[0] for r in rows} for r in recorded.rows(field, t))
        for time_s, x, value in rows:
            positions = recorded.rows("positions", time_s)
            sample, off_m = nearest_sample(positions, x)
            check(off_m < 1e-4, f"a vertex is {1e3 * off_m:.3f} mm from where it was recorded")
            # Where seams or layers lie on each other, one of the samples there.
            here = [scale * recorded.rows(field, time_s)[i][0] for i, p in enumerate(positions) if math.dist(p, x) < 2e-4]
            check(any(near(value, there, most) for there in here), f"{field} at {time_s} s: {value}, recorded {here}")
            compared += 1
    check(compared > 100, f"only {compared} values were compared")
    return compared


def clicks_find_what_is_there(page, recorded):
    """The peak of a plot, a field, its range, a layer, the cloth itself, by the mouse."""
    # The peak: its moment in the picture.
    peak = page.evaluate("""(() => {
        const mark = document.querySelector('svg[data-time] .peak[data-time]');
        if (!mark) return null;
        mark.scrollIntoView({block: 'center'});
        const box = mark.getBoundingClientRect();
        return [box.x + box.width / 2, box.y + box.height / 2, Number(mark.dataset.time)];
    })()""")
    if peak:
        look(page, "v.setTime(v.clock[0]);")
        page.click(peak[0], peak[1])
        shown, step = look(page, "return [v.time, v.clock[1] - v.clock[0]];")
        check(abs(shown - peak[2]) <= 0.51 * step, f"a click on the peak at {peak[2]} s shows {shown} s")
    # The largest stress of this moment: seen close by, and clicked.
    found = look(page, """
        await v.setField('stress'); v.setLayer('forces', false); v.closeUp();
        v.canvas.scrollIntoView({block: 'center'});
        await still(v);
        const worst = v.found(), m = v.marked, at = v.stage.onCanvas(m.actor, m.mesh, m.vertex), box = v.canvas.getBoundingClientRect();
        v.mark(null);
        return { ...worst, at: [box.x + at[0], box.y + at[1]] };""")
    page.click(*found["at"])
    clicked = look(page, "return v.found();")
    check(clicked, "a click on the cloth finds nothing")
    check(clicked["mesh"] and clicked["unit"] == "N/m", f"a click found {clicked}")
    positions = recorded.rows("positions", clicked["time_s"])
    sample, off_m = nearest_sample(positions, clicked["position_m"])
    check(off_m < 1e-4, f"what was clicked is {1e3 * off_m:.3f} mm from where it was recorded")
    stress = recorded.rows("stress", clicked["time_s"])
    here = [stress[i][0] for i, p in enumerate(positions) if math.dist(p, positions[sample]) < 2e-4]
    check(any(near(clicked["value"], s, max(r[0] for r in stress)) for s in here), f"clicked {clicked['value']} N/m, recorded {here}")
    # The largest of the frame is the largest that was recorded.
    most = max(r[0] for r in stress)
    check(near(found["value"], most, most), f"the worst place has {found['value']} N/m, the recording {most}")
    check(str(found["part"]), "the patch has no name")
    return clicked["value"]


def layers_and_range(page):
    """What is switched off is not drawn, nor found; colours go by the range."""
    at = look(page, "v.setView('front'); await still(v); return v.runs[0].meshesOf('cloth').map(m => m.name);")
    button = f"document.querySelector('[data-layer=\"{at[0]}\"]')"
    box = page.evaluate(f"(() => {{ const b = {button}; b.scrollIntoView({{block: 'center'}}); const r = b.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; }})()")
    before = pixels(page)
    page.click(*box)
    off = look(page, f"return [v.runs[0].meshesOf('cloth')[0].object.visible, {button}.getAttribute('aria-pressed')];")
    check(off == [False, "false"], f"a layer that is switched off: {off}")
    after = pixels(page)
    check(before != after, "a layer was switched off and the picture is the same")
    page.click(*box)
    look(page, "v.setRange(0, v.bar.field.most);")
    wide = pixels(page)
    look(page, "v.setRange(0, 0.05 * v.bar.field.most);")
    check(wide != pixels(page), "the range was changed and the picture is the same")


def pixels(page):
    return look(page, """
        await new Promise(done => setTimeout(done, 300));
        v.stage.drawNow();
        const gl = v.stage.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, all = new Uint8Array(4 * w * h);
        gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, all);
        let hash = 0, painted = 0;
        // What is painted differs from the background, which is that of the row's first pixel.
        for (let i = 0; i < all.length; i += 4) {
          hash = (hash * 31 + all[i] + 7 * all[i + 1] + 49 * all[i + 2]) | 0;
          painted += Math.abs(all[i] - all[i - i % (4 * w)]) > 24;
        }
        if (painted < 0.01 * w * h) throw new Error('the picture is empty');
        return hash;""")


def keys(page):
    look(page, "v.setPlaying(false); v.setTime(v.clock[0]); v.canvas.focus(); return 1;")
    page.key(".")
    check(look(page, "return v.time === v.clock[1];"), "the full stop does not go to the next frame")
    before = look(page, "return v.stage.camera.position.toArray();")
    page.key("ArrowLeft")
    check(before != look(page, "return v.stage.camera.position.toArray();"), "an arrow key does not turn")


def frames_per_second(page):
    """In play, in a picture of 800 x 600."""
    return look(page, """
        const old = v.canvas.style.cssText;
        Object.assign(v.canvas.style, { width: '800px', height: '600px' });
        v.stage.resize();
        v.setPlaying(true);
        const before = v.stage.drawn, from = performance.now();
        await new Promise(done => setTimeout(done, 3000));
        const fps = (v.stage.drawn - before) / (performance.now() - from) * 1000;
        v.setPlaying(false);
        v.canvas.style.cssText = old;
        v.stage.resize();
        return fps;""")


def check_page(results, tool, page_file):
    size_MB = page_file.stat().st_size / 1e6
    with browser.Browser(browser.find()) as page:
        page.open(page_file)
        check(page.evaluate("gambesonViewer.then(v => !!v)"), "the page has no viewer that started")
        gl = look(page, "const gl = v.stage.renderer.getContext(); return gl.getParameter(gl.VERSION);")
        check("WebGL" in gl, f"the picture is drawn by {gl}")
        first_ms = look(page, "return v.firstPicture_ms;")
        recorded = Recorded(tool, results)
        pixels(page)
        stress = clicks_find_what_is_there(page, recorded)
        compared = values_are_those_recorded(page, recorded)
        layers_and_range(page)
        keys(page)
        fps = frames_per_second(page)
        check(not page.errors(), f"the console was told: {page.errors()[:3]}")
        check(not page.requests(), f"the page asked for {page.requests()[:3]}")
    print(f"page of {size_MB:.1f} MB, first picture after {first_ms:.0f} ms, {fps:.0f} frames a second at 800 x 600; "
          f"{compared} values and a click ({stress:.1f} N/m) are those recorded")


def check_study(folder, tool, page_file):
    """Variants beside each other, at one time and in one range of colours; a click on one finds what that one recorded."""
    variants = [f.parent for f in sorted(folder.glob("*/frames")) if f.is_dir()]
    with browser.Browser(browser.find()) as page:
        page.open(page_file)
        check(page.evaluate("gambesonViewer.then(v => !!v)"), "the page of the study has no viewer")
        runs = look(page, "return v.runs.map(r => r.head.label);")
        check(len(runs) == len(variants), f"{len(variants)} variants, in the viewer {runs}")
        pixels(page)
        for k in range(len(runs)):
            found = look(page, f"""
                await v.setField('stress'); v.setLayer('forces', false); v.setTime(v.clock[v.clock.length - 1]); v.setView('front');
                v.canvas.scrollIntoView({{block: 'center'}});
                await still(v);
                const [x, y, w, h] = v.stage.places()[{k}], box = v.canvas.getBoundingClientRect();
                return {{ at: [box.x + x + w / 2, box.y + v.canvas.clientHeight - y - h / 2], time: v.runs[{k}].times.at(-1) }};""")
            page.click(*found["at"])
            clicked = look(page, "return v.found();")
            check(clicked and clicked["run"] == k and clicked["kind"] == "cloth", f"a click on {runs[k]} found {clicked}")
            check(abs(clicked["time_s"] - found["time"]) < 1e-9, "the variants are not at one time")
            # Of all variants only this one has a sample there with that stress.
            right = []
            for variant in variants:
                recorded = Recorded(tool, variant)
                positions, stress = recorded.rows("positions", clicked["time_s"]), recorded.rows("stress", clicked["time_s"])
                sample, off_m = nearest_sample(positions, clicked["position_m"])
                if off_m < 1e-4 and near(clicked["value"], stress[sample][0], max(r[0] for r in stress)):
                    right.append(variant.name)
            check(len(right) == 1, f"what {runs[k]} shows was recorded by {right}")
        check(not page.errors(), f"the console was told: {page.errors()[:3]}")
        check(not page.requests(), f"the page asked for {page.requests()[:3]}")
    print(f"study of {page_file.stat().st_size / 1e6:.1f} MB: {', '.join(runs)}")


def study_of(case, folder):
    file = folder / "two.study.json"
    file.write_text(json.dumps({"name": "Two thicknesses", "case": str(case),
                                "axes": [{"name": "thickness", "path": "factors.thickness", "values": [0.5, 1]}],
                                "baseline": {"thickness": "1"}}))
    out = folder / "study"
    done = run("study", file, "--out", out)
    check(done.returncode == 0, f"the study gave {done.returncode}: {done.stderr}")
    return out


def stills_without_webgl(page_file):
    with browser.Browser(browser.find()) as page:
        page.call("Page.addScriptToEvaluateOnNewDocument", source="""
            const all = HTMLCanvasElement.prototype.getContext;
            HTMLCanvasElement.prototype.getContext = function (kind, ...more) { return kind === '2d' ? all.call(this, kind, ...more) : null; };""")
        page.open(page_file)
        check(page.evaluate("gambesonViewer.then(v => !v)"), "there is a viewer without WebGL")
        text = page.evaluate("document.getElementById('look-around').innerText")
        check("WebGL" in text, f"without WebGL the page says: {text}")
        check(page.evaluate("document.querySelectorAll('figure img').length") > 0, "without WebGL the page has no pictures")
        check(not page.errors(), f"without WebGL the console was told: {page.errors()[:3]}")


def main():
    if not browser.find():
        print("chromium is not installed")
        sys.exit(SKIPPED)
    tool = sys.argv[2] if len(sys.argv) > 2 else str(pathlib.Path(sys.argv[1]).parent / "recorded_values")
    if "--study" in sys.argv:
        folder = pathlib.Path(sys.argv[sys.argv.index("--study") + 1])
        return check_study(folder, tool, folder / "report.html")
    if "--page" in sys.argv:
        results = pathlib.Path(sys.argv[sys.argv.index("--page") + 1])
        return check_page(results, tool, results / "report.html")
    with Folder() as folder:
        out = folder / "shorts"
        run_case(HERE / "shorts.json", out)
        page_file = out / "report.html"
        check_page(out, tool, page_file)
        stills_without_webgl(page_file)
        study = study_of(HERE / "shorts.json", folder)
        check_study(study, tool, study / "report.html")
        # The same page again, and one without a viewer.
        again = folder / "again.html"
        check(run("report", out, "-o", again).returncode == 0, "report failed")
        check(again.read_bytes() == page_file.read_bytes(), "the page that report writes is another one")
        small = folder / "small"
        run_case(HERE / "shorts.json", small, "--set", "output.viewer=false")
        check("viewer-run" not in (small / "report.html").read_text(), "output.viewer=false leaves a viewer")


if __name__ == "__main__":
    main()
