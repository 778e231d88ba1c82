#!/usr/bin/env python3
"""Pages on paper: a run's page, and a study's, printed on A4 by a browser. Every word of every table and title is on a page,
inside its margins; titles do not stand alone at the foot of a page; a run takes 8 pages at most. On a phone, 390 wide, no
table and no title is wider than the screen or than the frame that it can be moved in.

    printed.py GAMBESON [PAGE.html ...]

With pages: these, in place of those that it makes. 77 where there is no Chromium or no pdftotext (poppler-utils).
"""

import base64
import collections
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys

from browser import Browser, find
from common import HERE, SKIPPED, Folder, check, run, run_case

MOST_PAGES = 8
WIDTH, HEIGHT = 595.3, 841.9  # A4 [pt]
TEXTS = """(() => {
  const folded = [...document.querySelectorAll('details:not([open])')];
  folded.forEach(d => d.open = true);
  const shown = e => e.getClientRects().length && getComputedStyle(e).visibility !== 'hidden';
  const texts = s => [...document.querySelectorAll(s)].filter(shown).map(e => e.innerText);
  const all = JSON.stringify({cells: texts('th, td'), folds: texts('details'), titles: texts('h1, h2, h3, figcaption, caption')});
  folded.forEach(d => d.open = false);  // the page itself opens them for paper
  return all;
})()"""
# What reaches past the screen, or past what can be moved.
WIDE = """(() => {
  const cut = [];
  for (const e of document.querySelectorAll('h1, h2, h3, figcaption, caption, table, .sentence, .card')) {
    const box = e.getBoundingClientRect(), frame = e.closest('.scroll');
    if (!box.width) continue;
    if (frame ? frame.getBoundingClientRect().right > innerWidth + 1 : box.right > innerWidth + 1 || e.scrollWidth > e.clientWidth + 1 && e.tagName !== 'TABLE')
      cut.push(e.tagName + ' ' + e.innerText.slice(0, 60));
  }
  return JSON.stringify({cut, page: document.documentElement.scrollWidth, screen: innerWidth});
})()"""


def words_of(text):
    """Letters and digits alone: browsers part and join what stands between them as they set it."""
    return re.sub(r"[^0-9A-Za-z]+", "", text)


def pages_of(pdf):
    """For each page its words: (text, left, top, right, bottom) [pt]."""
    said = subprocess.run(["pdftotext", "-bbox", pdf, "-"], capture_output=True, text=True, check=True).stdout
    pages = []
    for page in re.findall(r"<page width.*?</page>", said, re.S):
        pages.append([(html.unescape(text), *map(float, box)) for *box, text in
                      re.findall(r'<word xMin="(.*?)" yMin="(.*?)" xMax="(.*?)" yMax="(.*?)">(.*?)</word>', page)])
    return pages


def paper(page, folder, most):
    with Browser(find()) as browser:
        browser.open(page)
        browser.call("Emulation.setEmulatedMedia", media="print")
        asked = json.loads(browser.evaluate(TEXTS))
        data = browser.call("Page.printToPDF", preferCSSPageSize=True, printBackground=True, paperWidth=8.27, paperHeight=11.69)["data"]
    pdf = folder / "page.pdf"
    pdf.write_bytes(base64.b64decode(data))
    pages = pages_of(pdf)
    on_paper = collections.Counter(words_of(text) for words in pages for text, *_ in words)
    letters = "".join(words_of(text) for words in pages for text, *_ in words)
    for kind, texts in asked.items():
        for text in texts:
            for word in filter(None, map(words_of, text.split())):
                check(on_paper[word] or word in letters, f"{page}: \"{word}\" of the {kind} \"{text}\" is not on paper")
    for number, words in enumerate(pages, 1):
        for text, left, top, right, bottom in words:
            check(left > 15 and right < WIDTH - 15 and top > 15 and bottom < HEIGHT - 15,
                  f"{page}: \"{text}\" on page {number} reaches past the margins: {left:.0f} to {right:.0f}, {top:.0f} to {bottom:.0f}")
    check(not most or len(pages) <= most, f"{page}: {len(pages)} pages (at most {most})")
    return len(pages), sum(map(len, pages))


def phone(page):
    with Browser(find(), 390, 844) as browser:
        browser.open(page)
        found = json.loads(browser.evaluate(WIDE))
    check(found["page"] <= found["screen"] + 1, f"{page}: {found['page']} px wide on a screen of {found['screen']}")
    check(not found["cut"], f"{page} on a phone: {found['cut']}")


def made(folder):
    """A run and a study of its own, each of seconds: page -> most pages."""
    run_case(HERE / "shorts.json", folder / "shorts")
    case = json.loads((HERE / "sphere.json").read_text())
    case["time"]["duration"] = "0.1 s"
    case["output"]["pictures"] = []
    (folder / "sphere.json").write_text(json.dumps(case))
    (folder / "a.study.json").write_text(json.dumps({
        "name": "Thin and thick, slick and rough", "case": "sphere.json", "pictures": [{"time": "end", "width": 200, "height": 160}],
        "axes": [{"path": "factors.thickness", "values": [0.5, 1]},
                 {"path": "contact.friction", "labels": ["slick", "rough"], "values": [0.1, 0.3]}]}))
    done = run("study", folder / "a.study.json", "--out", folder / "study")
    check(done.returncode == 0, done.stderr)
    return {folder / "shorts/report.html": MOST_PAGES, folder / "study/report.html": None}


def main():
    if find() is None or shutil.which("pdftotext") is None:
        print("skipped: needs chromium and pdftotext")
        sys.exit(SKIPPED)
    with Folder() as folder:
        for page, most in ({pathlib.Path(p).resolve(): None for p in sys.argv[2:]} or made(folder)).items():
            count, words = paper(page, folder, most)
            phone(page)
            print(f"{page.parent.name}: {count} pages, {words} words")


main()
