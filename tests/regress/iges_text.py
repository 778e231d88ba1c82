"""IGES files written by hand: bounded surfaces of the sorts that OpenCASCADE's writer does not make (143 with 141, 108 with its
curve, 128 alone, 114 to 122), in any unit."""

UNITS = {"INCH": 1, "MM": 2, "FT": 4, "M": 6, "CM": 10}


class Iges:
    """Entities, each with a number that others name it by."""

    def __init__(self, unit="MM", scale=1.0):
        self.unit, self.scale, self.entities = unit, scale, []

    def add(self, kind, *parameters, form=0, physical=False):
        """`physical`: it belongs to another entity, and is none by itself."""
        self.entities.append((kind, form, physical, parameters))
        return 2 * len(self.entities) - 1

    @staticmethod
    def word(x):
        return repr(x).upper() if isinstance(x, float) else str(x)

    def text(self):
        directory, parameters = [], []
        for k, (kind, form, physical, values) in enumerate(self.entities):
            pointer, line, lines = len(parameters) + 1, f"{kind},", []
            for i, value in enumerate(values):
                word = self.word(value) + (";" if i + 1 == len(values) else ",")
                if len(line) + len(word) > 64:
                    lines.append(line)
                    line = ""
                line += word
            lines.append(line)
            for line in lines:
                parameters.append(f"{line:64}{2 * k + 1:8}P{len(parameters) + 1:7}")
            status = f"00{'01' if physical else '00'}{'05' if physical == 'uv' else '00'}00"
            directory.append(f"{kind:8}{pointer:8}{0:8}{0:8}{0:8}{0:8}{0:8}{0:8}{status:>8}D{2 * k + 1:7}")
            directory.append(f"{kind:8}{0:8}{0:8}{len(lines):8}{form:8}{'':8}{'':8}{'':8}{0:8}D{2 * k + 2:7}")
        names = {"INCH": "IN"}
        name = names.get(self.unit, self.unit)
        fields = ["1H,", "1H;", "4Htest", "8Htest.igs", "4Hhand", "4Hhand", "32", "38", "6", "308", "15", "4Htest", "1.0", str(UNITS[self.unit]),
                  f"{len(name)}H{name}", "1", "0.01", "15H20000101.000000", "1.0E-7", "1000.0", "4Hhand", "4Hhand", "11", "0", "15H20000101.000000"]
        rows, line = [], ""
        for i, field in enumerate(fields):
            word = field + (";" if i + 1 == len(fields) else ",")
            if len(line) + len(word) > 72:
                rows.append(line)
                line = ""
            line += word
        rows.append(line)
        start = [f"{'written by hand':72}S{1:7}"]
        rows = [f"{r:72}G{k + 1:7}" for k, r in enumerate(rows)]
        end = f"S{1:7}G{len(rows):7}D{len(directory):7}P{len(parameters):7}{'':40}T{1:7}"
        return "\n".join(start + rows + directory + parameters + [end]) + "\n"

    # What surfaces and their borders are made of, in units of the file.
    def line(self, a, b, physical=True):
        return self.add(110, *(self.scale * float(x) for x in (*a, *b)), physical=physical)

    def polygon(self, corners, physical=True):
        lines = [self.line(a, b, physical) for a, b in zip(corners, corners[1:] + corners[:1])]
        return self.add(102, len(lines), *lines, physical=physical), lines

    def sheet(self, corners):
        """A bilinear 128 over 0 .. 1 by 0 .. 1: corners at (0, 0), (1, 0), (0, 1), (1, 1)."""
        knots = [0.0, 0.0, 1.0, 1.0] * 2
        return self.add(128, 1, 1, 1, 1, 0, 0, 1, 0, 0, *knots, 1.0, 1.0, 1.0, 1.0, *(self.scale * float(x) for c in corners for x in c), 0.0, 1.0, 0.0, 1.0)


def files():
    """Name, text, areas [mm^2]."""
    plain = [(0, 0, 0), (200, 0, 0), (0, 300, 0), (200, 300, 0)]
    inner = [(20, 20, 0), (120, 20, 0), (120, 120, 0), (20, 120, 0)]
    outer = [(0, 0, 0), (200, 0, 0), (200, 300, 0), (0, 300, 0)]
    for unit, scale in (("MM", 1), ("INCH", 1 / 25.4), ("CM", 0.1), ("M", 1e-3)):
        bare = Iges(unit, scale)
        bare.sheet(plain)
        yield f"bare_{unit}.igs", bare.text(), [60000]
        bounded = Iges(unit, scale)
        surface = bounded.sheet(plain)
        borders = []
        for corners in (outer, inner[::-1]):
            lines = [bounded.line(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]
            parameters = [x for l in lines for x in (l, 1, 0)]
            borders.append(bounded.add(141, 0, 0, surface, len(lines), *parameters, physical=True))
        bounded.add(143, 0, surface, len(borders), *borders)
        yield f"bounded_{unit}.igs", bounded.text(), [50000]
        trimmed = Iges(unit, scale)
        surface = trimmed.sheet(plain)
        curves = []
        for corners in (outer, inner):
            space, _ = trimmed.polygon(corners)
            curves.append(trimmed.add(142, 0, surface, 0, space, 2, physical=True))
        trimmed.add(144, surface, 1, 1, curves[0], curves[1])
        yield f"trimmed_{unit}.igs", trimmed.text(), [50000]
        plane = Iges(unit, scale)
        curve, _ = plane.polygon(outer)
        plane.add(108, 0.0, 0.0, 1.0, 0.0, curve, 0.0, 0.0, 0.0, 0.0, form=1)
        yield f"plane_{unit}.igs", plane.text(), [60000]
