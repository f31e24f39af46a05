"""The site: `make docs`. Nothing is fetched, and every warning is an error."""

from __future__ import annotations

import sys
from importlib.metadata import version as version_of
from pathlib import Path

from sphinx.application import Sphinx

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

from site_reference import described, signed, write_commands, write_rooms  # noqa: E402

project = "preimage"
author = "The preimage developers"
release = version = version_of("preimage")
language = "en"

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.viewcode"]
myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 4
exclude_patterns = ["README.md"]
root_doc = "index"

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_default_options = {"members": True, "no-value": True}
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
toc_object_entries = False
suppress_warnings = ["ref.python"]  # records of one name in two rooms

html_theme = "furo"
html_title = "preimage"
html_static_path = ["site"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_extra_path = ["task.schema.json", "plan.schema.json"]
viewcode_line_numbers = True


def setup(app: Sphinx) -> None:
    """Write the pages of rooms and commands, and let docstrings say their parameters."""
    write_rooms(HERE / "reference" / "rooms")
    write_commands(HERE / "reference" / "commands.rst")
    app.connect("autodoc-process-docstring", described)
    app.connect("autodoc-process-signature", signed)
