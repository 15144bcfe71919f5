"""The damages of campaign.py: each takes the bytes of a file and a random.Random, and returns other bytes."""

import re


def flip_bits(data, chance):
    data = bytearray(data)
    for _ in range(chance.choice([1, 1, 1, 4, 40])):
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    return bytes(data)


def cut_off(data, chance):
    return data[: chance.randrange(len(data))]


def take_out(data, chance):
    at = chance.randrange(len(data))
    return data[:at] + data[at + chance.choice([1, 2, 7, 100, 5000]):]


def put_in(data, chance):
    at = chance.randrange(len(data))
    piece = chance.choice([b"\0", b"\xff" * 9, b"NaN", b"1e999", b"-", b"\t\t", b"\n\n", b"<a>" * 300, b"[" * 300,
                           b"'\"", data[at: at + 64], data[:4096], b"9" * 400, b"\xef\xbb\xbf", "é漢".encode(),
                           b"\x1b[31m"])
    return data[:at] + piece + data[at:]


def other_number(data, chance):
    found = list(re.finditer(rb"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?", data[:200_000]))
    if not found:
        return flip_bits(data, chance)
    m = chance.choice(found)
    number = chance.choice([b"0", b"-1", b"1e300", b"1e-300", b"nan", b"inf", b"4294967296", b"-2147483649", b"",
                            b"abc", b"0x10", b"1,5", b"1.5.2", m.group() + b"0000", b"-" + m.group()])
    return data[: m.start()] + number + data[m.end():]


def other_word(data, chance):
    """One word of the text becomes another one of it, or one that is odd."""
    found = list(re.finditer(rb"[A-Za-z_][\w.]*", data[:50_000]))
    if len(found) < 2:
        return flip_bits(data, chance)
    m = chance.choice(found)
    word = chance.choice([chance.choice(found).group(), chance.choice(found).group(), b"x y", b"../up", b"/", b"CON",
                          b"a" * 5000, b"{name}", b"$(touch stranger.txt)", b"%s%n"])
    return data[: m.start()] + word + data[m.end():]


def line_away(data, chance):
    lines = data.split(b"\n")
    del lines[chance.randrange(len(lines))]
    return b"\n".join(lines)


def line_twice(data, chance):
    lines = data.split(b"\n")
    lines.insert(chance.randrange(len(lines)), chance.choice(lines))
    return b"\n".join(lines)


def crlf(data, _chance):
    return data.replace(b"\r\n", b"\n").replace(b"\n", b"\r\n")


def empty(_data, _chance):
    return b""


def row_place(lines, chance):
    first = next((i for i, line in enumerate(lines) if len(re.findall(rb"[-\d.]+(?:e[-+]?\d+)?", line)) > 3), 0)
    return chance.randrange(min(first + 5, len(lines) - 3), max(len(lines) - 2, min(first + 5, len(lines) - 3) + 1))


def swap_rows(data, chance):
    lines = data.split(b"\n")
    if len(lines) < 20:
        return None
    a, b = row_place(lines, chance), row_place(lines, chance)
    if a == b:
        return None
    lines[a], lines[b] = lines[b], lines[a]
    return b"\n".join(lines)


def ragged_row(data, chance):
    lines = data.split(b"\n")
    if len(lines) < 20:
        return None
    at = row_place(lines, chance)
    cells = re.split(rb"([\t,; ]+)", lines[at].strip())
    if len(cells) < 7:
        return None
    lines[at] = b"".join(cells[: -2 * chance.randrange(1, 3)])
    return b"\n".join(lines)


def counted_rows(lines):
    """Returns the places of the rows of a storage or TRC file whose header counts them; else None."""
    for i, line in enumerate(lines[:60]):
        if line.strip() == b"endheader":
            count = next((x.split(b"=")[1] for x in lines[:i] if x.startswith(b"nRows=")), b"0")
            first = i + 2
            break
        if line.startswith(b"DataRate\tCameraRate") and i + 1 < len(lines):
            count, first = (lines[i + 1].split(b"\t") + [b"0"] * 3)[2], i + 4
            break
    else:
        return None
    places = [i for i in range(first, len(lines)) if lines[i].strip()]
    return places if count.strip().isdigit() and int(count) == len(places) > 10 else None


def row_away(data, chance):
    lines = data.split(b"\n")
    places = counted_rows(lines)
    if places is None:
        return None
    del lines[chance.choice(places)]
    return b"\n".join(lines)


def row_twice(data, chance):
    lines = data.split(b"\n")
    places = counted_rows(lines)
    if places is None:
        return None
    at = chance.choice(places)
    lines.insert(at, lines[at])
    return b"\n".join(lines)


def far_number(data, chance):
    """A number of a row becomes one that no body has."""
    lines = data.split(b"\n")
    if len(lines) < 20:
        return None
    at = row_place(lines, chance)
    cells = re.split(rb"([\t,; ]+)", lines[at])
    places = [i for i, cell in enumerate(cells) if re.fullmatch(rb"-?[\d.]+(e[-+]?\d+)?", cell)]
    if len(places) < 2:
        return None
    cells[chance.choice(places)] = chance.choice([b"1e300", b"4294967296", b"-2147483649", b"1e6"])
    lines[at] = b"".join(cells)
    return b"\n".join(lines)


def shorter_binary(data, chance):
    return data[: len(data) * chance.randrange(30, 95) // 100]


ANY = [flip_bits, flip_bits, cut_off, take_out, put_in, other_number, other_number, other_word, line_away, line_twice,
       crlf, empty]
# Damages that every reader of these files can see.
ROWS = [swap_rows, ragged_row, row_away, row_twice]
SEEN_IN = {".trc": ROWS, ".sto": ROWS, ".mot": ROWS, ".csv": [swap_rows, ragged_row],
           ".c3d": [shorter_binary], ".edf": [shorter_binary]}
# Commands that compute see numbers that no body has; others hand on what is a number.
COMPUTING = ("ik", "id", "paths", "so", "emg", "identify", "muscle", "run-tool", "run", "cohort")


def damaged(data, ending, command, chance):
    """Returns (name of the damage, whether the command has to see it, the damaged bytes)."""
    seen = SEEN_IN.get(ending.lower(), [])
    if command in COMPUTING and swap_rows in seen:
        seen = [*seen, far_number]
    # Files without rows get damages of any kind only.
    damage = chance.choice(ANY + seen * (6 // max(1, len(seen))))
    changed = damage(data, chance)
    if changed is None or changed == data:
        damage, changed = flip_bits, flip_bits(data, chance)
    if damage not in seen and chance.random() < 0.2 and changed:  # one damage more
        more = chance.choice(ANY)
        return f"{damage.__name__} and {more.__name__}", False, more(changed, chance)
    return damage.__name__, damage in seen, changed
