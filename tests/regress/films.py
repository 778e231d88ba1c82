"""Films that `render` writes, decoded by libav itself: how many frames, how long, colours and arrows of one scale in all of
them, cameras; what does not fit is refused.

    films.py GAMBESON FILM_FRAMES
"""

import json
import pathlib
import subprocess
import sys

from common import HERE, Folder, check, run, run_case


class Film:
    def __init__(self, file):
        raw = pathlib.Path(str(file) + ".raw")
        done = subprocess.run([sys.argv[2], file, raw], capture_output=True, text=True)
        check(done.returncode == 0, f"{file} cannot be decoded: {done.stderr}")
        width, height, count, seconds, self.codec = done.stdout.split()
        self.width, self.height, self.seconds = int(width), int(height), float(seconds)
        data, size = raw.read_bytes(), 3 * self.width * self.height
        raw.unlink()
        self.frames = [data[i:i + size] for i in range(0, len(data), size)]
        check(len(self.frames) == int(count) and len(data) == size * int(count), f"{file}: {count} frames")

    def at(self, frame, x, y):
        i = 3 * (y * self.width + x)
        return tuple(self.frames[frame][i:i + 3])


def render(results, film, *options, size="480x360"):
    results = results if isinstance(results, list) else [results]
    done = run("render", *results, "-o", film, "--size", size, *options)
    check(done.returncode == 0, f"render {film.name} {' '.join(options)}: {done.stderr}")
    return Film(film)


def refused(words, *arguments):
    done = run("render", *arguments)
    check(done.returncode == 2, f"render {arguments} gave {done.returncode}: {done.stderr}")
    check(all(word in done.stderr for word in words), f"render {arguments} says: {done.stderr}")


def far(a, b):
    return max(abs(p - q) for p, q in zip(a, b))


def red(c):
    return c[0] > 140 and c[1] < 110 and c[2] < 110


def colourful(c):
    return max(c) - min(c) > 60


def bar_of(film, frame=0):
    """Row and ends of the colour bar: the middle one of the rows of colours in the lower left."""
    rows = []
    for y in range(film.height // 2, film.height):
        xs = [x for x in range(film.width * 3 // 10) if colourful(film.at(frame, x, y))]
        if len(xs) > 60 and xs[-1] - xs[0] + 1 == len(xs):
            rows.append((y, xs[0], xs[-1] + 1))
    check(len(rows) > 3, f"no colour bar is found ({len(rows)} rows)")
    return rows[len(rows) // 2]


def arrow_of(film, frame):
    """How long the legend's arrow is: the longest run of red pixels of a row in the left column."""
    longest = 0
    for y in range(film.height // 2, film.height):
        length = 0
        for x in range(film.width * 3 // 10):
            length = length + 1 if red(film.at(frame, x, y)) else 0
            longest = max(longest, length)
    return longest


def constant(film, within):
    """Bar and legend are the same in every frame, and the scene is not."""
    y, left, right = bar_of(film)
    lengths = [arrow_of(film, f) for f in range(len(film.frames))]
    check(min(lengths) > 15 and max(lengths) - min(lengths) <= 1, f"the arrow of the legend is {lengths} pixels long")
    for f in range(1, len(film.frames)):
        off = max(far(film.at(0, x, y), film.at(f, x, y)) for x in range(left, right))
        check(off <= within, f"a colour of the bar is {off} of 255 off in frame {f}")
    check(film.frames[0] != film.frames[-1], "nothing moves")
    return {x: film.at(0, x, y) for x in range(left + 2, right - 2)}, lengths[0]


def formats(results, folder):
    bars, arrows = {}, {}
    for ending, codec, within in ((".mp4", "h264", 6), (".webm", "vp9", 6), (".gif", "gif", 0)):
        film = render(results, folder / f"film{ending}", "--field", "pressure", "--from", "0.05", "--to", "0.4", "--fps", "20")
        check(film.codec.endswith(codec), f"{ending} is {film.codec}")
        check((film.width, film.height) == (480, 360), f"{ending} has {film.width} x {film.height} pixels")
        check(len(film.frames) == 7, f"{ending} has {len(film.frames)} frames, not 7")
        check(abs(film.seconds - 0.35) < 0.011, f"{ending} lasts {film.seconds} s, not 0.35")
        bars[ending], arrows[ending] = constant(film, within)
    for ending in (".webm", ".gif"):
        check(abs(len(bars[ending]) - len(bars[".mp4"])) <= 2, f"the bar of {ending} has another length")
        off = max(far(bars[ending][x], bars[".mp4"][x]) for x in bars[ending].keys() & bars[".mp4"].keys())
        check(off <= 16, f"colours of {ending} and .mp4 are {off} of 255 apart")
        check(abs(arrows[ending] - arrows[".mp4"]) <= 1, "arrows of two formats have not one scale")
    # Without a wish all of the motion, as recorded: 9 ms in the recording, every fourth.
    film = render(results, folder / "whole.gif", size="240x180")
    check(abs(len(film.frames) - 0.4013 / 0.036) <= 1, f"the whole motion has {len(film.frames)} frames")
    check(abs(film.seconds - 0.4013) < 0.04, f"the whole motion lasts {film.seconds} s")


def sides(results, folder):
    """Two runs beside each other: the same run twice is the same picture twice."""
    film = render([results, results], folder / "both.gif", "--from", "0", "--to", "0.2", "--fps", "10")
    for f in range(len(film.frames)):
        for y in range(0, film.height, 3):
            a, b = 3 * y * film.width, 3 * (y * film.width + film.width // 2)
            check(film.frames[f][a:a + 3 * film.width // 2] == film.frames[f][b:b + 3 * film.width // 2],
                  f"row {y} of frame {f} differs between the sides")


def middle(film, frame):
    """Of what is no paper, across the picture's right part."""
    xs = [x for y in range(0, film.height, 4) for x in range(film.width * 35 // 100, film.width, 2)
          if min(film.at(frame, x, y)) < 215]
    check(xs, "nothing is drawn")
    return sum(xs) / len(xs)


def cameras(results, folder):
    """The pelvis keeps its place where the camera follows it; a wearer who walks does not where it stands."""
    options = ("--from", "0", "--to", "0.2", "--fps", "20", "--view", "right", "--field", "plain")
    still = render(results, folder / "still.gif", *options)
    follow = render(results, folder / "follow.gif", *options, "--follow")
    goes = [middle(film, len(film.frames) - 1) - middle(film, 0) for film in (still, follow)]
    check(abs(goes[0]) > 3 * abs(goes[1]) + 3, f"the wearer goes {goes[0]} pixels, followed {goes[1]}")
    # Pictures, since palettes of films differ by what stands in the heading.
    named = render(results, folder / "named.png", "--time", "0.2", "--view", "left", "--field", "plain")
    free = render(results, folder / "free.png", "--time", "0.2", "--azimuth", "90", "--elevation", "0", "--field", "plain")
    right = named.width * 4 // 10
    for y in range(0, named.height, 5):
        a, b = 3 * (y * named.width + right), 3 * (y + 1) * named.width
        off = far(named.frames[0][a:b], free.frames[0][a:b])
        check(off <= 1, f"--azimuth 90 is not the view from the left ({off} in row {y})")
    near = render(results, folder / "near.gif", *options, "--zoom", "2")
    lengths = [arrow_of(film, 0) for film in (still, near)]
    check(abs(lengths[1] - 2 * lengths[0]) <= 3, f"the legend's arrow is {lengths[0]} pixels long, at --zoom 2 {lengths[1]}")


def ranges(results, folder):
    """Half the range, the other colours."""
    films = [render(results, folder / "range.gif", "--from", "0.3", "--to", "0.4", "--fps", "10", "--field", "pressure",
                    "--range", "0", high)
             for high in ("0.005", "5")]
    bright = [sum(colourful(film.at(0, x, y)) and film.at(0, x, y)[1] > 150 for y in range(0, film.height, 3)
                  for x in range(film.width // 2, film.width, 3)) for film in films]
    check(bright[0] > 10 * bright[1] + 10, f"--range changes nothing: {bright}")


def marks(folder):
    """Cloth 2 mm inside of a ball is magenta, with a legend, and where it lies on it nothing is. Neither case names
    pictures, so that each leaves one picture and a film."""
    magenta = []
    for low in (0.098, 0.1013):
        out, case = folder / f"{low}", json.loads((HERE / "sphere.json").read_text())
        case["garment"]["sheet"]["corner"][2] = low
        case["time"] = {"duration": "100 us"}
        case["output"] = {"window": "20 us", "frame": "20 us", "checkpoint": "20 us"}
        (folder / "marks.json").write_text(json.dumps(case))
        run_case(folder / "marks.json", out)
        pictures, film = list((out / "snapshots").glob("*.png")), Film(out / "film.mp4")
        check(len(pictures) == 1 and "plain" in pictures[0].name, f"without pictures there are {pictures}")
        check((film.width, film.height) == (800, 600) and film.frames, "the usual film is another")
        check("film.mp4" in (out / "report.html").read_text(), "the page does not speak of the film")
        above = render(out, folder / "marks.png", "--view", "top", "--field", "plain")
        magenta.append([sum(c[0] > 190 and c[1] < 90 and 80 < c[2] < 210 for x in span for y in range(above.height)
                            for c in [above.at(0, x, y)])
                        for span in (range(above.width // 3), range(above.width // 3, above.width))])
    (legend, cloth), (no_legend, dry) = magenta
    check(legend > 20 and cloth > 200, f"of what is inside {cloth} pixels are magenta, of the legend {legend}")
    check(no_legend == dry == 0, f"of what is outside {dry} pixels are magenta, of a legend {no_legend}")


def refusals(results, folder):
    for name in ("film.avi", "film.mov", "film", "film.mp4.txt"):
        refused((".png", ".mp4", ".webm", ".gif"), results, "-o", folder / name)
        check(not (folder / name).exists(), f"{name} is written")
    mp4, gif, png = folder / "x.mp4", folder / "x.gif", folder / "x.png"
    refused(("--size", "even"), results, "-o", mp4, "--size", "481x360")
    refused(("--time",), results, "-o", mp4, "--time", "peak")
    refused(("--from",), results, "-o", png, "--from", "0.1")
    refused(("--follow",), results, "-o", png, "--follow")
    refused(("--fps", "50"), results, "-o", gif, "--fps", "60")
    refused(("fps", "120"), results, "-o", mp4, "--fps", "0")
    refused(("--to", "recorded", "0.4"), results, "-o", mp4, "--to", "9")
    refused(("--to", "--from"), results, "-o", mp4, "--from", "0.3", "--to", "0.2")
    refused(("--range",), results, "-o", mp4, "--range", "5", "1")
    refused(("--range",), results, "-o", mp4, "--range", "0", "1", "--field", "plain")
    refused(("--output", "body_pressure"), results, "-o", mp4, "--field", "body_pressure")
    refused(("--follow", "human"), results, "-o", mp4, "--follow")
    refused(("zoom", "nan"), results, "-o", mp4, "--zoom", "nan")
    refused(("1 to 4",), *[results] * 5, "-o", mp4)
    check(not mp4.exists() and not gif.exists() and not png.exists(), "a refused film is written")


def main():
    with Folder() as folder:
        sphere, shorts = folder / "sphere", folder / "shorts"
        run_case(HERE / "sphere.json", sphere)
        run_case(HERE / "shorts.json", shorts)
        refusals(sphere, folder)
        formats(sphere, folder)
        sides(sphere, folder)
        ranges(sphere, folder)
        cameras(shorts, folder)
        marks(folder)
    print("films hold")


main()
