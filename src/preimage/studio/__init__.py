"""The studio: a page in the browser, served from this machine, and the same view in a notebook."""
