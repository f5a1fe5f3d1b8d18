"""What the tests of postprocess share: the packages (or a skip that says so), invented results, and the two programs."""
import contextlib
import html
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
POSTPROCESS = ROOT / "postprocess"
sys.path.insert(0, str(POSTPROCESS))

try:
    import h5py  # noqa: F401
    import jinja2  # noqa: F401
    import matplotlib  # noqa: F401
    import numpy  # noqa: F401
    import scipy  # noqa: F401
except ModuleNotFoundError as missing:
    print(f"skipped: the Python package {missing.name} is not there (jobs/install brings it)")
    sys.exit(77)

import make_results  # noqa: E402
from freestand_post import command, style  # noqa: E402

BROWSER = shutil.which("chromium") or shutil.which("google-chrome")
_kept = tempfile.TemporaryDirectory()
_made = {}

# In each window: the tables that scroll in their place, by their first head; and what else is wider than it, with text of
# pictures (groups of paths, which have the id of their text) that lies beyond the picture's edge.
MEASURE = """<script>onload = () => { document.title = JSON.stringify([...document.querySelectorAll('iframe')].map((frame) => {
  const page = frame.contentDocument;
  page.querySelectorAll('details').forEach((d) => { d.open = true; });
  const wider = (what) => [...page.querySelectorAll(what)].filter((e) => e.scrollWidth > e.clientWidth + 1);
  const beyond = (text, edge) => text.width > 0 && (text.left < edge.left - 1 || text.right > edge.right + 1 || text.top < edge.top - 1 ||
                                                    text.bottom > edge.bottom + 1);
  const cut = [...page.querySelectorAll('svg')].flatMap((svg) => [...svg.querySelectorAll('text, g[id*=text_]')].filter(
    (text) => beyond(text.getBoundingClientRect(), svg.getBoundingClientRect())));
  return [frame.contentWindow.innerWidth, wider('.wide').map((e) => e.querySelector('th').textContent),
          [...wider('html, .picture'), ...cut].map((e) => e.id || e.tagName)];
})); };</script>"""


def browse(address, *options):
    """The document that the browser has made of a page. Its profile is its own, since tests run side by side; a browser that ends without a
    page (it may die on a busy machine) is started twice more."""
    for _ in range(3):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
            done = subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}", *options, "--dump-dom", address],
                                  capture_output=True, text=True, timeout=120, env={**os.environ, "HOME": profile})
        if "</html>" in done.stdout:
            return done.stdout
    raise AssertionError(f"{BROWSER} made no page of {address}: {done.returncode}\n{done.stderr}")


def cut_off(test, text):
    """{width: (tables that scroll, what is cut off)} of the page in windows as wide as a laptop and a telephone. Skips without a browser."""
    if not BROWSER:
        test.skipTest("no chromium is installed")
    frames = "".join(f'<iframe style="border: 0; width: {width}px; height: 900px" srcdoc="{html.escape(text)}"></iframe>' for width in (1300, 420))
    page = pathlib.Path(_kept.name) / "frames.html"
    page.write_text(f"<meta charset=\"utf-8\"><title></title>{frames}{MEASURE}", encoding="utf-8")
    title = html.unescape(re.search("<title>(.*?)</title>", browse(page.as_uri(), "--window-size=1400,1000"), re.S).group(1))
    return {width: (tables, cut) for width, tables, cut in json.loads(title)}


def sweep():
    """A finished sweep of 6000 invented samples; made once, not to be changed."""
    if "sweep" not in _made:
        _made["sweep"] = make_results.make_sweep(pathlib.Path(_kept.name) / "sweep", 6000)
    return _made["sweep"]


def sweep_copy(target):
    shutil.copytree(sweep(), target)
    return pathlib.Path(target)


def start(program, *arguments):
    """postprocess/PROGRAM as a user starts it."""
    return subprocess.run([POSTPROCESS / program, *map(str, arguments)], capture_output=True, text=True, timeout=250)


def words_alone():
    """A page has empty frames for its pictures, whose svg takes most of the time; but pictures where FREESTAND_LONG_TESTS is set."""
    if "FREESTAND_LONG_TESTS" in os.environ:
        return contextlib.nullcontext()
    return mock.patch.object(style, "svg", lambda figure: '<svg viewBox="0 0 1 1"></svg>')


def run(program, *arguments, drawn=False):
    """The same within this process, which has loaded its packages; drawn: a page with its pictures."""
    out, err = io.StringIO(), io.StringIO()
    pictures = contextlib.nullcontext() if drawn or program != "report" else words_alone()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), pictures:
        try:
            code = command.main(program, list(map(str, arguments)))
        except SystemExit as end:
            code = end.code
    return subprocess.CompletedProcess([program, *arguments], code, out.getvalue(), err.getvalue())
