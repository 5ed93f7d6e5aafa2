"""Turns screens of a terminal, as `tmux capture-pane -peN` prints them, into an animated GIF.

    film.py OUT.gif SHOT...

Half-blocks, eighths and Braille are drawn as what they stand for, other characters in DejaVu Sans
Mono. At most FRAMES screens are kept, evenly spaced; the last is shown for longer.
"""

import re
import sys

from PIL import Image, ImageDraw, ImageFont

CELL = (7, 14)
FRAMES = 110
MILLISECONDS = 110
FONT = "DejaVuSansMono%s.ttf"
FONTS = {bold: ImageFont.truetype(FONT % ("-Bold" if bold else ""), 12) for bold in (False, True)}
PLAIN = {"fg": (232, 238, 245), "bg": (11, 15, 23), "bold": False, "reverse": False}
BRAILLE = [(0x01, 0, 0), (0x02, 0, 1), (0x04, 0, 2), (0x08, 1, 0),
           (0x10, 1, 1), (0x20, 1, 2), (0x40, 0, 3), (0x80, 1, 3)]


def styled(style, codes):
    """The style after the codes of one SGR sequence."""
    style = dict(style)
    codes = [int(code or 0) for code in re.split("[;:]", codes)]
    while codes:
        code = codes.pop(0)
        if code == 0:
            style = dict(PLAIN)
        elif code in (1, 22):
            style["bold"] = code == 1
        elif code in (7, 27):
            style["reverse"] = code == 7
        elif code in (38, 48):
            assert codes.pop(0) == 2, "true colours only"
            style["fg" if code == 38 else "bg"] = tuple(codes[:3])
            codes = codes[3:]
        elif code in (39, 49):
            key = "fg" if code == 39 else "bg"
            style[key] = PLAIN[key]
    return style


def cells(text):
    """Rows of (character, style); styles go on from line to line."""
    style = dict(PLAIN)
    for line in text.rstrip("\n").split("\n"):
        row = []
        for codes, other, character in re.findall(r"\x1b\[([0-9;:]*)m|(\x1b[()].|[\x0e\x0f])|(.)", line):
            if character:
                row.append((character, style))
            elif not other:
                style = styled(style, codes)
        yield row


def paint(text):
    rows = list(cells(text))
    width, height = CELL
    picture = Image.new("RGB", (width * max(map(len, rows)), height * len(rows)), PLAIN["bg"])
    draw = ImageDraw.Draw(picture)
    for y, row in enumerate(rows):
        for x, (character, style) in enumerate(row):
            left, top = x * width, y * height
            right, bottom = left + width - 1, top + height - 1
            ink, ground = style["fg"], style["bg"]
            if style["reverse"]:
                ink, ground = ground, ink
            draw.rectangle([left, top, right, bottom], fill=ground)
            code = ord(character)
            if character == "▀":
                draw.rectangle([left, top, right, top + height // 2 - 1], fill=ink)
            elif character == "▌":
                draw.rectangle([left, top, left + width // 2, bottom], fill=ink)
            elif 0x2581 <= code <= 0x2588:
                draw.rectangle([left, bottom + 1 - (code - 0x2580) * height // 8, right, bottom], fill=ink)
            elif 0x2800 <= code <= 0x28FF:
                for bit, dx, dy in BRAILLE:
                    if code - 0x2800 & bit:
                        u, v = left + 1 + dx * 3, top + 1 + dy * 7 // 2
                        draw.rectangle([u, v, u + 1, v + 1], fill=ink)
            elif character != " ":
                draw.text((left, top), character, font=FONTS[style["bold"]], fill=ink)
    return picture


def main():
    out, shots = sys.argv[1], sys.argv[2:]
    texts = []
    for shot in shots:
        with open(shot, encoding="utf-8") as file:
            texts.append(file.read())
    step = max(1.0, len(texts) / FRAMES)
    chosen = [texts[int(n * step)] for n in range(int(len(texts) / step))]
    pictures = [paint(text) for text in chosen + [texts[-1]]]
    # One palette for all, from some of them, so that nothing flickers.
    sample = pictures[:: max(1, len(pictures) // 8)]
    sheet = Image.new("RGB", (pictures[0].width, sum(p.height for p in sample)))
    for n, picture in enumerate(sample):
        sheet.paste(picture, (0, n * picture.height))
    palette = sheet.quantize(128, method=Image.Quantize.MEDIANCUT)
    frames = [p.quantize(palette=palette, dither=Image.Dither.NONE) for p in pictures]
    durations = [MILLISECONDS] * (len(frames) - 1) + [2500]
    frames[0].save(out, save_all=True, append_images=frames[1:], duration=durations, loop=0, optimize=False)


main()
