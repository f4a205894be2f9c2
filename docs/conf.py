"""Settings of Sphinx; docs/build.py calls it."""
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent / "_ext"))

project = "Plumbline"
author = "the authors of Plumbline"
extensions = ["myst_parser", "sphinx.ext.mathjax", "plumbline_docs"]
myst_enable_extensions = ["dollarmath", "deflist", "colon_fence"]
myst_heading_anchors = 4
myst_update_mathjax = False
exclude_patterns = ["_ext"]
nitpicky = True

html_theme = "furo"
html_title = "Plumbline"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False
html_show_copyright = False

# copied by build.py from Debian's libjs-mathjax: pages need no network
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {
    "tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]], "ignoreClass": "document",
                "processClass": "math"},
    "showMathMenu": False,
    "messageStyle": "none",
}

plumbline_program = pathlib.Path(os.environ["PLUMBLINE_PROGRAM"])
plumbline_root = pathlib.Path(os.environ["PLUMBLINE_ROOT"])
plumbline_folder = pathlib.Path(os.environ["PLUMBLINE_FOLDER"])
