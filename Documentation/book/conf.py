# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The pages as a book in HTML, by Sphinx with MyST (Debian: python3-sphinx, python3-myst-parser). Utilities/guide starts it."""

import glob
import os
import re

project = "Schlieren"
author = copyright = "Schlieren contributors"
extensions = ["myst_parser"]
root_doc = "README"
include_patterns = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "Documentation/*.md",
                    "Documentation/development/*.md", "CudaCore/README.md",
                    "Testing/Data/README.md", "Testing/Benchmarks/Results/README.md",
                    "Testing/Benchmarks/Window/README.md"]
html_theme = "alabaster"
html_theme_options = {"fixed_sidebar": True, "page_width": "1200px", "sidebar_width": "280px", "body_max_width": "none",
                      "show_powered_by": False}
html_sidebars = {"**": ["about.html", "navigation.html", "searchbox.html"]}
html_copy_source = False
html_show_sourcelink = False
highlight_language = "none"
# The anchors that links to headings have on GitHub.
myst_heading_anchors = 6


def add_contents(app, name, source):
    """The order of the pages is that of the README's links; the others follow."""
    if name == root_doc:
        pages = dict.fromkeys(re.findall(r"\]\((Documentation/[\w/]+)\.md", source[0]))
        folder = os.path.join(app.srcdir, "Documentation")
        pages.update(dict.fromkeys(sorted(os.path.relpath(name, app.srcdir)[:-3] for name in
                                          glob.glob(os.path.join(folder, "**", "*.md"), recursive=True))))
        more = ["CudaCore/README", "Testing/Data/README", "Testing/Benchmarks/Results/README",
                "Testing/Benchmarks/Window/README", "CHANGELOG", "CONTRIBUTING"]
        source[0] += "\n".join(["", "```{toctree}", ":hidden:", "", *pages, *more, "```", ""])


def folder_as_text(app, environment, node, text):
    """What a link to a folder of the sources becomes."""
    folder = os.path.join(app.srcdir, os.path.dirname(node["refdoc"]), node["reftarget"])
    return text if os.path.isdir(folder) else None


def setup(app):
    app.connect("missing-reference", folder_as_text)
    app.connect("source-read", add_contents)
    return {"parallel_read_safe": True}
