#!/usr/bin/env python3
"""The gallery shows of each case what its report shows, says what fails, and runs nothing twice.

    gallery.py GAMBESON               a few short cases of all kinds, in a browser too where there is one
    gallery.py GAMBESON --all DIR     the whole library, into DIR (hours; the same command goes on there)
"""

import html
import json
import pathlib
import re
import sys

import browser
from common import SOURCE, Folder, check, run
from fuzz_seeds import CELL, CLOTH, PLATE

WIDTHS = (390, 1280, 1920)
PICTURE = {"time": "end", "field": "plain", "view": "front", "width": 320, "height": 240}
WORN = json.loads((SOURCE / "tests/regress/shorts.json").read_text())


def cases():
    """Small ones of every kind: name -> content."""
    cloth, plate, cell = json.loads(CLOTH % ""), json.loads(PLATE), json.loads(CELL)
    cloth.update({"name": "Cloth <falls> & flies", "description": "A sheet hangs in the air. How far does it fall?"})
    cloth["output"]["pictures"] = [PICTURE]
    plate.update({"name": "Plate with holes", "description": "A plate is bent. Its holes stay open."})
    plate["output"].pop("pictures")
    cell.update({"name": "Twill", "loads": cell["loads"][:1]})
    worn = {**WORN, "name": "Shorts that walk"}
    worn["time"] = {"duration": "20 ms"}
    worn["output"] = {"window": "5 ms", "frame": "10 ms", "pictures": [{**PICTURE, "field": "stress"}], "viewer": False}
    study = {"name": "Which sheet?", "description": "Two sheets. Which one is lighter?", "case": "cloth.json",
             "axes": [{"path": "factors.thickness", "values": [0.5, 1]}]}
    return {"cloth.json": cloth, "plate.json": plate, "cell.json": cell, "worn.json": worn, "sheets.study.json": study}


def exhibits(page):
    """Of each: the text that stands on the page."""
    return {name: html.unescape(re.sub(r"<[^>]*>", "", body))
            for name, body in re.findall(r'<article class="exhibit" id="case_([^"]*)">(.*?)</article>', page, re.S)}


def top_of(report):
    """What a report begins with: its sentence, its first picture."""
    page = report.read_text()
    sentence = html.unescape(re.search(r'<meta name="description" content="([^"]*)">', page)[1])
    picture = re.search(r'src="(data:image/png;base64,[^"]*)"', page[:page.index("</section>")])
    return sentence, picture and picture[1]


def said(text):
    return " ".join(text.split())


def shows_each(out, names):
    page = (out / "gallery.html").read_text()
    shown = exhibits(page)
    check(set(shown) == set(names), f"{sorted(shown)} are shown, not {sorted(names)}")
    for name in names:
        sentence, picture = top_of(out / name / "report.html")
        check(said(sentence) in said(shown[name]), f"{name}: {sentence!r} is not in {shown[name]!r}")
        check(f'href="{name}/report.html"' in page, f"{name} has no link to its report")
        check(picture is None or picture in page, f"the picture of {name} is missing")
        check(picture is not None or "No picture:" in shown[name], f"{name} has no picture, and nothing says so")
    return page, shown


def fits(page):
    """Whole at the width of a telephone and of a large screen; readable; in the order of the keyboard."""
    program = browser.find()
    if not program:
        print("no browser: the page was not looked at")
        return
    with browser.Browser(program) as b:
        for width in WIDTHS:
            b.size(width, 900)
            b.open(page)
            b.evaluate("document.querySelectorAll('details').forEach(d => d.open = true)")
            check(not b.errors() and not b.requests(), f"{width}: {b.errors()} {b.requests()}")
            wide = b.evaluate("document.documentElement.scrollWidth - innerWidth")
            check(wide <= 0, f"at {width} the page is {wide} px wider than its window")
            cut = b.evaluate("""[...document.querySelectorAll('main *')].filter(e => e.scrollWidth > e.clientWidth + 1 &&
                getComputedStyle(e).display !== 'inline').map(e => e.className + ': ' + e.textContent)""")
            check(not cut, f"at {width} text is cut: {cut}")
        order = b.evaluate("[...document.querySelectorAll('a[href]')].map(a => a.getBoundingClientRect().top + scrollY)")
        check(len(order) > 5 and order[0] < order[-1] and b.evaluate("document.querySelectorAll('[tabindex]:not([tabindex=\"0\"])').length") == 0,
              "the keyboard goes another way than the eye")
        dim = b.evaluate(CONTRAST)
        check(not dim, f"too little contrast: {dim}")


#: Text of less than 4.5 : 1 against the nearest ground that has a colour (WCAG 2, AA).
CONTRAST = """[...document.querySelectorAll('main *, header *')].filter(e => [...e.childNodes].some(n => n.nodeType === 3 && n.data.trim())).map(e => {
  const rgb = c => c.match(/[\\d.]+/g).map(Number), part = v => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  const light = c => 0.2126 * part(c[0]) + 0.7152 * part(c[1]) + 0.0722 * part(c[2]);
  let ground = e; while (ground && rgb(getComputedStyle(ground).backgroundColor)[3] === 0) ground = ground.parentElement;
  const a = light(rgb(getComputedStyle(e).color)), b = light(ground ? rgb(getComputedStyle(ground).backgroundColor) : [255, 255, 255]);
  return [(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), e.className, e.textContent.slice(0, 40)]; }).filter(r => r[0] < 4.5)"""


def short(folder):
    for name, content in cases().items():
        (folder / name).write_text(json.dumps(content))
    out = folder / "out"
    files = list(cases())
    done = run("gallery", *files, "-o", "out", "--threads", 1, cwd=folder)
    check(done.returncode == 0, f"gave {done.returncode}: {done.stdout}{done.stderr}")
    names = [f.removesuffix(".json") for f in files]
    page, shown = shows_each(out, names)
    check("How far does it fall?" in shown["cloth"] and "A sheet hangs" not in shown["cloth"], shown["cloth"])
    check("A plate is bent." in shown["plate"] and "Its holes" not in shown["plate"], shown["plate"])
    check("Cloth &lt;falls&gt; &amp; flies" in page, "a title is not escaped")
    check(" failed" not in page, "something is said to have failed")

    # The same cases as a library: all are done, and what is no case is listed.
    library = folder / "library"
    (library / "cards").mkdir(parents=True)
    for file in files:
        (library / file).write_text((folder / file).read_text())
    (library / "cards/a_card_whose_name_is_rather_long_for_a_telephone.card.json").write_text("{}")
    (library / "notes.txt").write_text("mine")
    done = run("gallery", "--library", library, "-o", out, "--threads", 1)
    check(done.returncode == 0 and "5 of 5 are done already" in done.stdout, done.stdout + done.stderr)
    page, _ = shows_each(out, names)
    check("notes.txt: no case" in page and "telephone.card.json: a fabric card" in page, "what is no case is not listed")
    fits(out / "gallery.html")

    # Nothing runs again; a case that was changed does, and only that; what was cut off goes on.
    stamps = {name: (out / name / "summary.json").stat().st_mtime_ns for name in names if name != "sheets.study"}
    changed = cases()["plate.json"]
    changed["solver"] = {"steps": 3}
    (folder / "plate.json").write_text(json.dumps(changed))
    (out / "worn/summary.json").unlink()
    done = run("gallery", *files, "-o", "out", "--threads", 1, cwd=folder)
    check(done.returncode == 0 and "3 of 5 are done already" in done.stdout, done.stdout + done.stderr)
    again = {n for n, t in stamps.items() if (out / n / "summary.json").stat().st_mtime_ns != t}
    check(again == {"plate", "worn"}, f"{again} ran again")

    # A run that fails is listed with its message; the others are shown.
    broken = cases()["plate.json"]
    broken["solver"] = {"steps": 1, "iterations": 1}
    broken["supports"][1]["move"] = [0, 0, 1]
    (folder / "broken.json").write_text(json.dumps({**broken, "name": "A plate too far"}))
    (out / "cell/report.html").write_text("mine")  # a report that someone edited is not quoted
    done = run("gallery", "broken.json", *files, "-o", "out", "--threads", 1, cwd=folder)
    check(done.returncode == 1 and "2 of 6 failed" in done.stdout, done.stdout + done.stderr)
    page = (out / "gallery.html").read_text()
    shown = exhibits(page)
    check("The run failed:" in shown["broken"] and len(said(shown["broken"])) > 60, shown["broken"])
    check("was changed after it was written" in shown["cell"] and "mine" not in shown["cell"], shown["cell"])
    check("A plate too far" in page[:page.index("<article")], "the failure does not stand at the top")
    check(set(shown) == {"broken", *names}, sorted(shown))
    fits(out / "gallery.html")


def refused(folder):
    """Wrong input: 2, a message, nothing made."""
    (folder / "typo.json").write_text(json.dumps({**cases()["cloth.json"], "colour": 1}))
    (folder / "empty").mkdir()
    for arguments, *words in ((("typo.json", "-o", "new"), "typo.json:1: colour: unknown key"),
                              (("absent.json", "-o", "new"), "absent.json"),
                              (("cloth.json", "cloth.json", "-o", "new"), "same name"),
                              (("--library", "empty", "-o", "new"), "--library", "no cases"),
                              (("cloth.json", "--library", "empty", "-o", "new"), "--library"),
                              (("cloth.json",), "--out"),
                              (("cloth.json", "-o", "typo.json"), "typo.json is not a folder")):
        done = run("gallery", *arguments, cwd=folder)
        check(done.returncode == 2 and all(w in done.stderr for w in words), f"{arguments}: {done.returncode} {done.stderr}")
        check(not (folder / "new").exists(), f"{arguments} made a folder")
    (folder / "mine").mkdir()
    (folder / "mine/gallery.html").write_text("mine")
    done = run("gallery", "cloth.json", "-o", "mine", cwd=folder)
    check(done.returncode == 2 and "gallery.html" in done.stderr, done.stderr)
    check([f.name for f in (folder / "mine").iterdir()] == ["gallery.html"], "a refused gallery left files")


def whole(out):
    done = run("gallery", "-o", out)
    print(done.stdout, done.stderr)
    library = [f.name.removesuffix(".json") for f in (SOURCE / "cases/library").glob("*.json")
               if f.name.endswith(".study.json") or {"kind", "garment", "garments"} & set(json.loads(f.read_text()))]
    shows_each(out, library)
    check(done.returncode == 0, f"gave {done.returncode}")
    fits(out / "gallery.html")


def main():
    if "--all" in sys.argv:
        return whole(pathlib.Path(sys.argv[-1]))
    with Folder() as folder:
        short(folder)
        refused(folder)
    print("a gallery of five kinds: pictures, questions, answers, failures; nothing runs twice")


if __name__ == "__main__":
    main()
