"""A minimal reader of C3D files, written from the tables of the C3D user guide and sharing nothing with the program.

    c3d_by_the_guide.py samples FOLDER     files of the program `c3d_samples` against what it wrote, by formula
    c3d_by_the_guide.py same A.c3d B.c3d   two files hold the same numbers (a file and what `myoid convert` made of it)

Ends with 1 and a sentence at the first word that is not as the guide or the formula has it.
"""

import os
import struct
import sys


class Bytes:
    """Numbers of one of the three processors: 84 Intel, 85 DEC, 86 SGI."""

    def __init__(self, data, processor):
        self.data, self.processor = data, processor
        self.order = ">" if processor == 86 else "<"

    def u16(self, at):
        return struct.unpack_from(self.order + "H", self.data, at)[0]

    def i16(self, at):
        return struct.unpack_from(self.order + "h", self.data, at)[0]

    def real(self, at):
        if self.processor != 85:
            return struct.unpack_from(self.order + "f", self.data, at)[0]
        first, second = struct.unpack_from("<HH", self.data, at)  # VAX F: sign and exponent are in the first word
        exponent = (first >> 7) & 0xFF
        if exponent == 0:
            return 0.0
        fraction = ((first & 0x7F) << 16) | second
        value = (0.5 + fraction / 2.0**24) * 2.0 ** (exponent - 128)
        return -value if first & 0x8000 else value


class Failure(Exception):
    pass


def need(holds, message):
    if not holds:
        raise Failure(message)


class C3d:
    def __init__(self, path):
        data = open(path, "rb").read()
        need(len(data) >= 1024 and data[1] == 0x50, "byte 2 of the header is not 0x50")
        self.section = 512 * (data[0] - 1)
        processor = data[self.section + 3]
        need(processor in (84, 85, 86), "no processor in byte 4 of the parameter section")
        self.data, self.b = data, Bytes(data, processor)
        word = lambda n: self.b.u16(2 * (n - 1))
        self.points, self.analog_total, self.first, self.last = word(2), word(3), word(4), word(5)
        self.scale, self.data_block = self.b.real(12), word(9)
        self.ratio, self.rate = word(10), self.b.real(20)
        self.has_event_labels = word(150) == 12345
        self.parameters = self.read_parameters()

    def read_parameters(self):
        """{(GROUP, NAME): value}, by the chain of records of the guide's parameter section."""
        b, data = self.b, self.data
        at, groups, found = self.section + 4, {}, []
        while True:
            length, group = struct.unpack_from("bb", data, at)
            if length == 0:
                break
            name = data[at + 2:at + 2 + abs(length)].decode("latin-1")
            distance_at = at + 2 + abs(length)
            distance = b.u16(distance_at)
            body = distance_at + 2
            if group < 0:
                need(-group not in groups, f"two groups of number {-group}")
                groups[-group] = name
            else:
                kind = struct.unpack_from("b", data, body)[0]
                rank = data[body + 1]
                dimensions = list(data[body + 2:body + 2 + rank])
                count = 1
                for d in dimensions:
                    count *= d
                values = body + 2 + rank
                if kind == -1:
                    width = dimensions[0] if dimensions else 1
                    value = [data[values + i * width:values + (i + 1) * width].decode("utf-8").rstrip()
                             for i in range(count // width if width else 0)]
                    end = values + count
                elif kind == 1:
                    value, end = list(data[values:values + count]), values + count
                elif kind == 2:
                    value, end = [b.i16(values + 2 * i) for i in range(count)], values + 2 * count
                else:
                    need(kind == 4, f"{name}: kind {kind}")
                    value, end = [b.real(values + 4 * i) for i in range(count)], values + 4 * count
                description = end + 1 + data[end]
                need(distance == 0 or distance_at + distance == description,
                     f"{name}: the distance to the next record is not its length")
                found.append((group, name, value))
            if distance == 0:
                break
            at = distance_at + distance
        self.parameter_end = at
        for group, name, _ in found:
            need(group in groups, f"{name}: group {group} has no name")
        return {(groups[g], n): v for g, n, v in found}

    def names(self, group, name):
        found, k = [], 1
        while (group, name if k == 1 else f"{name}{k}") in self.parameters:
            found += self.parameters[(group, name if k == 1 else f"{name}{k}")]
            k += 1
        return found

    def conforms(self):
        """What the guide asks of header and parameters."""
        p = self.parameters
        blocks = self.data[self.section + 2]
        need(self.data[self.section] in (0, 1) and self.data[self.section + 1] in (0, 0x50), "parameter head")
        need(self.parameter_end < self.section + 512 * blocks, "the records reach beyond the blocks of the section")
        need(self.data_block - 1 >= self.section // 512 + blocks, "the data begin inside the parameters")
        need(len(self.data) % 512 == 0, "the file is not a whole number of blocks")
        for group, names in {"POINT": "USED FRAMES DATA_START SCALE RATE LABELS DESCRIPTIONS UNITS",
                             "ANALOG": "USED RATE GEN_SCALE SCALE OFFSET LABELS DESCRIPTIONS UNITS",
                             "FORCE_PLATFORM": "USED TYPE ZERO CORNERS ORIGIN CHANNEL"}.items():
            for name in names.split():
                need((group, name) in p, f"{group}:{name} is missing")
        one = lambda group, name: p[(group, name)][0]
        need(one("POINT", "USED") & 0xFFFF == self.points, "POINT:USED and the header")
        need(one("POINT", "DATA_START") & 0xFFFF == self.data_block, "POINT:DATA_START and the header")
        need(one("POINT", "SCALE") == self.scale, "POINT:SCALE and the header")
        need(one("POINT", "RATE") == self.rate, "POINT:RATE and the header")
        need(one("ANALOG", "USED") * self.ratio == self.analog_total, "ANALOG:USED and the header")
        if self.analog_total:
            need(abs(one("ANALOG", "RATE") - self.rate * self.ratio) < 1e-3, "ANALOG:RATE and the header")
        frames = self.last - self.first + 1
        need(one("POINT", "FRAMES") & 0xFFFF == frames, "POINT:FRAMES and the header")
        need(len(self.names("POINT", "LABELS")) == self.points, "as many POINT:LABELS as points")
        for name in ("LABELS", "UNITS", "SCALE", "OFFSET"):
            need(len(self.names("ANALOG", name)) == one("ANALOG", "USED"), f"as many ANALOG:{name} as channels")
        width = 2 if self.scale > 0 else 4
        size = 512 * (self.data_block - 1) + frames * (4 * self.points + self.analog_total) * width
        need(0 <= len(self.data) - size < 512, "the size of the file and its counts")

    def frames(self):
        """For each frame: points as (x, y, z, fourth word) in POINT:UNITS, and rows of analog samples in their units."""
        integer = self.scale > 0
        width = 2 if integer else 4
        number = self.b.i16 if integer else self.b.real
        channels = self.parameters[("ANALOG", "USED")][0] if self.analog_total else 0
        ratio = self.analog_total // channels if channels else 0
        general = self.parameters[("ANALOG", "GEN_SCALE")][0] if channels else 1.0
        scales, offsets = self.names("ANALOG", "SCALE"), self.names("ANALOG", "OFFSET")
        unsigned = self.parameters.get(("ANALOG", "FORMAT"), [""])[0].upper() == "UNSIGNED"
        at = 512 * (self.data_block - 1)
        for _ in range(self.last - self.first + 1):
            points, analog = [], []
            for _ in range(self.points):
                raw = [number(at + i * width) for i in range(4)]
                points.append(tuple(v * (self.scale if integer else 1.0) for v in raw[:3]) + (raw[3],))
                at += 4 * width
            for _ in range(ratio):
                row = []
                for c in range(channels):
                    count = number(at)
                    offset = offsets[c]
                    if unsigned and integer:
                        count &= 0xFFFF
                    if unsigned:
                        offset &= 0xFFFF
                    row.append((count - offset) * scales[c] * general)
                    at += width
                analog.append(row)
            yield points, analog


def close(a, b, what):
    """Equal to the precision of a real of 24 bits, in the order of the numbers that made it."""
    need(a == b or abs(a - b) <= 1.2e-7 * max(abs(a), abs(b)), f"{what}: found {a!r}, expected {b!r}")


def check_samples(folder):
    """The formulas are those of c3d_samples.cpp."""
    count = 0
    for processor, code in (("intel", 84), ("dec", 85), ("sgi", 86)):
        for kind in ("integer", "real"):
            path = os.path.join(folder, f"{processor}_{kind}.c3d")
            try:
                file = C3d(path)
                file.conforms()
                need(file.b.processor == code, "processor")
                need((file.scale > 0) == (kind == "integer"), "sign of the scale")
                need(abs(file.scale) == 0.25, "scale")
                need((file.points, file.ratio, file.rate, file.first, file.last) == (300, 3, 50.0, 7, 11), "counts")
                need(file.names("POINT", "LABELS") == [f"M{m + 1}" for m in range(300)], "POINT:LABELS and LABELS2")
                need(file.names("ANALOG", "LABELS") == ["Fz", "EMG µ"], "ANALOG:LABELS")
                need(file.names("ANALOG", "UNITS") == ["N", "mV"], "ANALOG:UNITS")
                need(file.names("POINT", "UNITS") == ["mm"], "POINT:UNITS")
                need(file.parameters[("EVENT", "USED")] == [1], "EVENT:USED")
                need(file.parameters[("EVENT", "LABELS")] == ["On"], "EVENT:LABELS")
                need(file.parameters[("EVENT", "TIMES")] == [0.0, 0.125], "EVENT:TIMES")
                for k, (points, analog) in enumerate(file.frames()):
                    for m, p in enumerate(points):
                        if (k + m) % 11 == 0:
                            need(p[3] == -1, f"frame {k}, point {m} is missing")
                            continue
                        for axis in range(3):
                            close(p[axis], 0.25 * ((37 * m + 11 * k + 5 * axis) % 4001 - 2000), f"frame {k}, point {m}")
                        need(p[3] == 0, f"frame {k}, point {m}: residual")
                    for i, row in enumerate(analog):
                        n = 3 * k + i
                        close(row[0], ((211 * n) % 60001 - 30000 - 12) * 0.5 * 0.125, f"sample {n} of Fz")
                        close(row[1], (-2500 * (n % 13) + 16) * -0.0625 * 0.125, f"sample {n} of EMG")
                need(k == 4, "five frames")
                count += 1
            except Failure as failure:
                raise Failure(f"{path}: {failure}") from None
    print(f"{count} files conform and hold the numbers that were written")


def check_same(first, second):
    a, b = C3d(first), C3d(second)
    b.conforms()
    need(a.points == b.points and a.rate == b.rate, "points and rate")
    need([n.strip() for n in a.names("POINT", "UNITS")] == b.names("POINT", "UNITS"), "POINT:UNITS")
    numbers = 0
    for k, ((pa, aa), (pb, ab)) in enumerate(zip(a.frames(), b.frames())):
        for m, (p, q) in enumerate(zip(pa, pb)):
            need((p[3] < 0) == (q[3] < 0), f"frame {k}, point {m}: missing in one of them")
            for axis in range(3):
                if p[3] >= 0:
                    close(p[axis], q[axis], f"frame {k}, point {m}")
                    numbers += 1
        need(len(aa) == len(ab), "analog samples a frame")
        for ra, rb in zip(aa, ab):
            need(len(ra) == len(rb), "channels")
            for c, (x, y) in enumerate(zip(ra, rb)):
                close(x, y, f"frame {k}, channel {c}")
                numbers += 1
    print(f"{numbers} numbers are the same")


if __name__ == "__main__":
    try:
        if sys.argv[1:2] == ["samples"] and len(sys.argv) == 3:
            check_samples(sys.argv[2])
        elif sys.argv[1:2] == ["same"] and len(sys.argv) == 4:
            check_same(sys.argv[2], sys.argv[3])
        else:
            sys.exit(__doc__)
    except Failure as failure:
        sys.exit(str(failure))
