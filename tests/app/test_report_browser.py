"""Pages of `chute report` in a browser: test_report_browser.py CHUTE. Nothing is asked of any network and nothing said on the
console; the slider moves films, downloads arrive, dark pages are dark, and what is printed is whole."""
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import browser
from tiny_scene import TINY

if not browser.program:
    print("skipped: chromium is not installed")
    sys.exit(1 if os.environ.get("CHUTE_CI") else 77)

chute = sys.argv[1]
SCENE = TINY + "series = { every = 0.05 }\nprofiles = { from = 0.5, bin = 1 }\nimpacts = {}\n"
SHOWN = """new Promise((done) => {
  const slider = document.querySelector('.bar input');
  slider.value = %d;
  slider.dispatchEvent(new Event('input'));
  setTimeout(() => done([...document.querySelectorAll('.film')].map((film) => {
    const video = film.querySelector('video');
    return [video ? video.currentTime : film.querySelector('img').src.length,
            video ? video.videoWidth : film.querySelector('img').naturalWidth, film.querySelector('output').textContent];
  })), 1500);
})"""


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for name, scene in (("flat", SCENE), ("steep", SCENE.replace("18 deg", "26 deg"))):
            cls.make("run", cls.write(name + ".toml", scene), "-o", os.path.join(cls.folder, name))
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    @classmethod
    def write(cls, name, text):
        with open(os.path.join(cls.folder, name), "w") as file:
            file.write(text)
        return file.name

    @classmethod
    def make(cls, *arguments, **environment):
        done = subprocess.run([chute, *arguments, "--quiet"], cwd=cls.folder, capture_output=True, text=True,
                              env={**os.environ, **environment})
        assert done.returncode == 0, done.stderr

    def open(self, *runs, **environment):
        self.make("report", *runs, "-o", "page.html", "--size", "320x180", "--jobs", "1", **environment)
        self.browser.open(os.path.join(self.folder, "page.html"))

    def assert_is_quiet(self):
        self.assertEqual([c for c in self.browser.complaints()], [])
        page = "file://" + os.path.join(self.folder, "page.html")
        self.assertEqual([r for r in self.browser.requests() if r != page and not r.startswith("data:")], [])

    def test_slider_and_stills_move_the_film(self):
        for environment in ({}, {"PATH": "/nowhere"}):  # a movie; single pictures
            with self.subTest(environment=environment):
                self.open("flat", **environment)
                first, last = self.browser.run(SHOWN % 0), self.browser.run(SHOWN % 4)
                self.assertEqual((first[0][1], first[0][2], last[0][2]), (320, "0 √(d/g)", "2 √(d/g)"))
                self.assertNotEqual(first[0][0], last[0][0])
                self.browser.run("document.querySelector('.stills button:nth-child(2)').click()")
                self.assertEqual(self.browser.run("document.querySelector('.bar output').textContent"), "0.5 √(d/g)")
                self.assert_is_quiet()

    def test_play_goes_to_the_end_and_stops(self):
        self.open("flat", "steep")
        self.browser.run("document.querySelector('.bar button').click()")
        deadline = time.time() + 60
        while time.time() < deadline and self.browser.run("document.querySelector('.bar button').textContent") != "Play":
            time.sleep(0.2)
        self.assertEqual(self.browser.run("document.querySelector('.bar input').value"), "4")
        self.assertEqual({film[2] for film in self.browser.run(SHOWN % 4)}, {"2 √(d/g)"})
        self.assert_is_quiet()

    def test_every_picture_is_decoded(self):
        self.open("flat", "steep")
        self.assertEqual(self.browser.run("""Promise.all([...document.images].map((image) => image.decode().then(
            () => image.naturalWidth > 0))).then((all) => all.length > 8 && all.every((one) => one))"""), True)

    def test_numbers_are_saved(self):
        self.open("flat")
        saved = os.path.join(self.folder, "saved")
        self.browser.ask("Page.setDownloadBehavior", behavior="allow", downloadPath=saved)
        self.browser.run("document.querySelector('a[download=\"flat-series.csv\"]').click()")
        path, deadline = os.path.join(saved, "flat-series.csv"), time.time() + 60
        while not os.path.exists(path) and time.time() < deadline:
            time.sleep(0.1)
        with open(path, "rb") as file, open(os.path.join(self.folder, "flat", "series.csv"), "rb") as own:
            self.assertEqual(file.read(), own.read())
        self.assert_is_quiet()

    def test_light_and_dark(self):
        self.open("flat")
        ground = "getComputedStyle(document.documentElement).backgroundColor"
        shown = "[...document.querySelectorAll('.plot img')].filter((i) => i.offsetWidth).map((i) => i.className).join()"
        seen = {}
        for scheme in ("light", "dark"):
            self.browser.colours(scheme)
            time.sleep(1)
            seen[scheme] = (self.browser.run(ground), self.browser.run("document.querySelector('video').currentSrc.length"))
            self.assertEqual(set(self.browser.run(shown).split(",")), {scheme})
        self.assertNotEqual(seen["light"][0], seen["dark"][0])
        self.assertNotEqual(seen["light"][1], seen["dark"][1])
        self.assert_is_quiet()

    def test_print(self):
        self.browser.colours("dark")  # paper stays white
        self.open("flat", "steep")
        with open(os.path.join(self.folder, "page.pdf"), "wb") as file:
            file.write(self.browser.print())
        text = subprocess.run(["pdftotext", file.name, "-"], capture_output=True, text=True).stdout
        for words in ("2 runs compared", "What became of them", "Energy account", "Profiles over the height", "Where it comes from"):
            self.assertIn(words, text)
        drawn = subprocess.run(["pdftoppm", "-r", "20", "-gray", file.name], capture_output=True).stdout
        header, pixels = drawn[:20], drawn[20:]
        self.assertEqual(header[:2], b"P5")
        self.assertGreater(sum(byte > 230 for byte in pixels) / len(pixels), 0.75)
        self.browser.colours("light")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
