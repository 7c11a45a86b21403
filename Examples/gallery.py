# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Documentation/gallery.md, its images, and the sheet of all of them, from the examples of the window's menu.

    pvpython Examples/gallery.py [FOLDER [EXAMPLE...]]        (writes gallery.md and its images into it)
"""

import inspect
import os
import re
import sys
import textwrap

from PIL import Image, ImageOps

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
import schlieren_examples  # noqa: E402, which comes with the plugin
from schlieren_figure import pixels_of  # noqa: E402
from paraview import servermanager  # noqa: E402

HEAD = """# Gallery

Eight flows to open: *Schlieren > Examples* in ParaView's window, or these scripts, once the plugin is loaded. The window runs the
same lines. [Examples/gallery.py](../Examples/gallery.py) makes this page of them; where the data come from is in
[Testing/Data](../Testing/Data/README.md#examples).
"""


def title_and_text(example):
    return " ".join(inspect.getdoc(example).split()).split(". ", 1)


def script(example):
    """An example as the page prints it: a whole script that writes a figure."""
    lines = textwrap.dedent(inspect.getsource(example).split('"""')[2]).strip("\n")
    lines = re.sub(r"\b(read|data)\(", r"schlieren_examples.\1(", lines)
    lines = lines.removesuffix("\nreturn schlieren").replace("return Schlieren(", "schlieren = Schlieren(")
    lines = lines.replace("\n" + 17 * " ", "\n" + 22 * " ")  # which keeps arguments below each other
    return ("from paraview.simple import *\nimport schlieren_examples, schlieren_figure\n\n"
            f'{lines}\nschlieren_figure.save("{example.__name__}.png", schlieren)\n')


def page():
    text = HEAD
    for example in schlieren_examples.EXAMPLES:
        name, (title, paragraph) = example.__name__, title_and_text(example)
        text += f"\n## {title}\n\n![{title}](images/example_{name}.jpg)\n\n{textwrap.fill(paragraph, 130)}\n\n"
        text += f"```python\n{script(example)}```\n"
    return text


def main(folder, chosen):
    images = os.path.join(folder, "images")
    os.makedirs(images, exist_ok=True)
    for example in schlieren_examples.EXAMPLES:
        if not chosen or example.__name__ in chosen:
            schlieren = example()
            schlieren.Quality = "Fine"
            schlieren.UpdatePipeline()
            path = os.path.join(images, f"example_{example.__name__}.jpg")
            Image.fromarray(pixels_of(servermanager.Fetch(schlieren))[::-1]).save(path, quality=85)
            print("Wrote", os.path.abspath(path), flush=True)
    width, height = 320, 240
    sheet = Image.new("RGB", (4 * width - 8, 2 * height - 8), "white")
    for place, example in enumerate(schlieren_examples.EXAMPLES):
        with Image.open(os.path.join(images, f"example_{example.__name__}.jpg")) as image:
            tile = ImageOps.fit(image, (width - 8, height - 8))
        sheet.paste(tile, (place % 4 * width, place // 4 * height))
    sheet.save(os.path.join(images, "gallery.jpg"), quality=85)
    text = page()
    with open(os.path.join(folder, "gallery.md"), "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else ".", sys.argv[2:])
