# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of `gridcross report` in a browser, driven as by a reader. usage: test_browser.py GRIDCROSS"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py

try:
    from selenium import webdriver
    from selenium.common.exceptions import WebDriverException
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    print("skipped: no selenium for this Python")
    sys.exit(77)
CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
if not CHROMIUM or not DRIVER:
    print("skipped: no chromium with its driver")
    sys.exit(77)

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
TITLE = "\"'><script>hacked = 1</script><img src=x onerror=\"hacked = 1\"> `hacked` ${1} </script> %s\nsecond line"
STUDY = f"""title: {json.dumps(TITLE)}
problem: {{name: bar-neo-hookean}}
mesh: {{cells: [8, 16], particles_per_cell: 3}}
method: {{space: [standard, moving-mesh], degree: 1}}
time: {{cfl: 0.4, periods: 0.6}}
output: {{histories: 2, spectra: 4, budget: 8, snapshots: 1}}
"""
BOX = """problem: {name: axis-aligned, dimension: 2}
mesh: {cells: 6, particles_per_cell: 2}
method: {space: [standard, moving-mesh]}
time: {cfl: 0.2, periods: 0.2}
output: {snapshots: 3}
"""


def start():
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--window-size=1280,900",
                     "--disable-background-networking", "--no-first-run", "--host-resolver-rules=MAP * ~NOTFOUND"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    try:
        service = webdriver.chrome.service.Service(DRIVER)
        return webdriver.Chrome(service=service, options=options)
    except WebDriverException as error:
        print(f"skipped: chromium does not start: {error}")
        sys.exit(77)


class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.dir = pathlib.Path(place.name)
        for name, text in (("small", STUDY), ("box", BOX)):
            (cls.dir / f"{name}.yaml").write_text(text)
            cls.call("run", f"{name}.yaml", "-q")
            cls.call("report", f"{name}.study", "-o", f"{name}.html")
        cls.call("paper", "steffen2010/fig5", "steffen2010/table1", "-q", "-o", "items")
        cls.call("report", "items", "-o", "items.html")
        cls.driver = start()
        cls.addClassCleanup(cls.driver.quit)

    @classmethod
    def call(cls, *args):
        subprocess.run([PROGRAM, *args], cwd=cls.dir, check=True, capture_output=True)

    def setUp(self):
        self.devtools("Emulation.setEmulatedMedia", media="", features=[])
        self.devtools("Emulation.clearDeviceMetricsOverride")

    def tearDown(self):
        """Whatever was done: no error in the console, and no request but for the page itself."""
        self.assertEqual(self.driver.get_log("browser"), [])
        asked = set()
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                asked.add(message["params"]["request"]["url"].split("#")[0])
        self.assertLessEqual(asked, {"data:,", *((self.dir / f"{n}.html").as_uri() for n in ("small", "box", "items"))})
        self.assertTrue(asked)

    def devtools(self, command, **more):
        return self.driver.execute_cdp_cmd(command, more)

    def open(self, name="small"):
        self.driver.get((self.dir / f"{name}.html").as_uri())
        self.run_script("return charts.every(chart => !chart.box.isConnected || chart.plot || chart.size)", wait=True)
        return json.loads(self.run_script("return document.getElementById('data').textContent"))

    def run_script(self, text, *args, wait=False):
        if not wait:
            return self.driver.execute_script(text, *args)
        return WebDriverWait(self.driver, 60).until(lambda driver: driver.execute_script(text, *args))

    def one(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def press(self, element, *keys):
        self.run_script("arguments[0].focus()", element)
        element.send_keys(*keys)

    def click(self, element):
        self.run_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", element)
        element.click()

    def named(self, selector, text):
        return next(e for e in self.driver.find_elements(By.CSS_SELECTOR, selector) if e.text == text)

    def pixels(self, selector):
        return self.run_script("return document.querySelector(arguments[0]).toDataURL()", selector)

    def range(self, section, axis="x"):
        return self.run_script("const scale = charts.find(c => c.plot && c.box.isConnected && c.box.closest('#' + arguments[0])).plot.scales[arguments[1]];"
                               "return [scale.min, scale.max]", section, axis)

    def test_titles_stay_texts(self):
        self.open()
        self.assertEqual(self.one("h1").text, TITLE.replace("\n", " "))
        self.assertIsNone(self.run_script("return window.hacked === undefined ? null : 1"))
        self.assertIn(json.dumps(TITLE), self.one("#run-file pre").text)
        self.assertEqual([e.text for e in self.driver.find_elements(By.CSS_SELECTOR, "nav a")],
                         ["What was compared", "Side by side", "Convergence", "Work and precision", "Particles crossing cells",
                          "Histories and energy ledger", "Errors by wavenumber", "Error budget", "Every case", "The run file", "Provenance"])

    def test_policy_refuses_requests(self):
        self.open()
        self.run_script("const image = new Image(); image.src = 'https://example.org/a.png'; window.refused = null;"
                        "addEventListener('securitypolicyviolation', event => { window.refused = event.violatedDirective; })")
        self.assertEqual(self.run_script("return window.refused", wait=True), "img-src")
        self.assertTrue(any("Content Security Policy" in entry["message"] for entry in self.driver.get_log("browser")))
        messages = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        self.assertEqual([m["params"]["blockedReason"] for m in messages if m["method"] == "Network.loadingFailed"], ["csp"])
        self.open()

    def test_every_figure_is_drawn(self):
        self.open()
        blank = self.run_script("""return [...document.querySelectorAll("canvas")].filter(canvas => {
            const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
            return new Set(new Uint32Array(pixels.buffer)).size < 20;
        }).length""")
        self.assertEqual(blank, 0)
        self.assertEqual(len(self.driver.find_elements(By.TAG_NAME, "canvas")), 8)

    def test_sort(self):
        self.open()
        column = lambda: [row.text for row in self.driver.find_elements(By.CSS_SELECTOR, "#cases tbody td:nth-child(4)")]
        values = lambda: [float(text.replace("\u2212", "-")) for text in column()]
        before, head = values(), self.one("#cases th:nth-child(4) button")
        self.click(head)
        self.assertEqual(values(), sorted(before))
        self.assertNotEqual(values(), before)
        self.assertEqual(self.one("#cases th:nth-child(4)").get_attribute("aria-sort"), "ascending")
        self.press(head, Keys.ENTER)
        self.assertEqual(values(), sorted(before, reverse=True))
        self.assertEqual(self.one("#cases th:nth-child(4)").get_attribute("aria-sort"), "descending")

    def test_values_switch_off(self):
        self.open()
        rows = lambda: len(self.driver.find_elements(By.CSS_SELECTOR, "#cases tbody tr"))
        legend = lambda: len(self.driver.find_elements(By.CSS_SELECTOR, "#convergence .legend li"))
        self.assertEqual((rows(), legend()), (4, 2))
        chip = self.named("#compared .chip", "standard")
        self.click(chip)
        self.assertEqual((rows(), legend()), (2, 1))
        self.click(chip)
        self.assertEqual((rows(), legend()), (4, 2))

    def strayed(self, case, cells, last):
        """Particles in another cell of the fixed grid than at the start, from the snapshots themselves."""
        with h5py.File(self.dir / "small.study" / f"case-{case}.h5") as file:
            steps = sorted(file["data"], key=int)
            x = [file[f"data/{steps[i]}/particles/material_points/position/x"][:] for i in (0, len(steps) - 1 if last else len(steps) // 2)]
            time = file[f"data/{steps[len(steps) // 2]}"].attrs["time"]
        return time, sum(int(a * cells) != int(b * cells) for a, b in zip(*x))

    def test_scrub(self):
        data = self.open()
        row = data["cases"]["rows"][data["tracks"]["cases"][0]["case"]]
        names = [column["name"] for column in data["cases"]["columns"]]
        captions = lambda: [e.text for e in self.driver.find_elements(By.CSS_SELECTOR, "#tracks figcaption")]
        slider, canvas = self.one("#scrub"), "#tracks canvas"
        self.press(slider, Keys.END)
        at_end = self.pixels(canvas)
        crossings = int(row[4][names.index("result.crossings")])
        self.assertEqual(captions()[0], f"Fixed cells: {self.strayed(row[0], 8, True)[1]} of 24 particles in another than at the start, {crossings} crossings so far.")
        self.assertEqual(captions()[1], "Moving cells: 0 of 24 particles in another than at the start.")
        self.press(slider, Keys.HOME)
        self.assertEqual(self.one("#tracks output").text, "t = 0 s")
        self.assertEqual(captions()[0], "Fixed cells: 0 of 24 particles in another than at the start, 0 crossings so far.")
        self.assertNotEqual(self.pixels(canvas), at_end)
        time, moved = self.strayed(row[0], 8, False)
        self.run_script("const end = Math.max(...data.tracks.cases.map(c => c.time[c.time.length - 1])), slider = document.getElementById('scrub');"
                        "slider.step = 'any'; slider.value = 1000 * arguments[0] / end; slider.dispatchEvent(new Event('input'))", float(time))
        self.assertGreater(moved, 4)
        self.assertRegex(captions()[0], f"^Fixed cells: {moved} of 24 ")
        before = self.pixels(canvas)
        self.press(self.one("#tracks .plot"), "+", Keys.ARROW_DOWN)
        self.assertNotEqual(self.pixels(canvas), before)
        self.press(slider, Keys.HOME)
        self.click(self.named("#tracks button", "Play"))
        self.run_script("return document.querySelector('#tracks output').textContent !== 't = 0 s'", wait=True)
        self.click(self.named("#tracks button", "Pause"))

    def test_zoom(self):
        self.open()
        whole = self.range("convergence"), self.range("convergence", "y")
        over = self.one("#convergence .u-over")
        self.run_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", over)
        size = over.size
        chain = webdriver.ActionChains(self.driver)
        chain.move_to_element_with_offset(over, -size["width"] // 4, -size["height"] // 4).click_and_hold()
        chain.move_by_offset(size["width"] // 4, size["height"] // 4).move_by_offset(size["width"] // 8, size["height"] // 8).release().perform()
        for axis, (least, most) in zip("xy", whole):
            low, high = self.range("convergence", axis)
            self.assertGreater(low, least)
            self.assertLess(high, most)
        webdriver.ActionChains(self.driver).double_click(over).perform()
        self.assertEqual((self.range("convergence"), self.range("convergence", "y")), whole)
        plot = self.one("#convergence .plot")
        self.press(plot, "+")
        self.assertLess(self.range("convergence")[1], whole[0][1])
        self.press(plot, "0")
        self.assertEqual(self.range("convergence"), whole[0])

    def test_keys_point(self):
        self.open()
        self.press(self.one("#convergence .plot"), Keys.ARROW_RIGHT)
        first = self.one("#convergence .tip").text
        self.assertRegex(first, "^standard\nmesh.cells: 8\ndisplacement.max.rms")
        self.one("#convergence .plot").send_keys(Keys.ARROW_RIGHT)
        self.assertIn("mesh.cells: 16", self.one("#convergence .tip").text)
        self.one("#convergence .plot").send_keys(Keys.ARROW_DOWN)
        self.assertRegex(self.one("#convergence .tip").text, "^moving-mesh\n")
        self.open()
        self.one("body").send_keys(Keys.TAB)
        self.assertEqual(self.run_script("return document.activeElement.textContent"), "Skip to the results")

    def brightness(self):
        colour = self.run_script("return getComputedStyle(document.documentElement).backgroundColor")
        return sum(map(int, re.findall(r"\d+", colour)[:3])) / 3

    def test_dark(self):
        self.open()
        light = self.pixels("#convergence canvas")
        self.assertGreater(self.brightness(), 200)
        self.click(self.one("#theme"))
        self.assertLess(self.brightness(), 60)
        self.assertNotEqual(self.pixels("#convergence canvas"), light)
        self.devtools("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.open()
        self.assertLess(self.brightness(), 60)
        self.assertEqual(self.one("#theme").text, "Light")

    def test_narrow(self):
        self.devtools("Emulation.setDeviceMetricsOverride", width=400, height=800, deviceScaleFactor=2, mobile=True)
        for name in ("small", "box", "items"):
            self.open(name)
            wide = self.run_script("""return [document.documentElement.scrollWidth, ...[...document.querySelectorAll("main *")]
                .filter(e => !e.closest(".scroll, pre, .hidden, .tip") && e.getBoundingClientRect().right > 400.5).map(e => e.outerHTML.slice(0, 200))]""")
            self.assertEqual(wide, [400], name)

    def test_paper(self):
        """As wide as A4 within its margins, in inches of 96 pixels."""
        self.devtools("Emulation.setDeviceMetricsOverride", width=672, height=1000, deviceScaleFactor=1, mobile=False)
        self.open()
        self.devtools("Emulation.setEmulatedMedia", media="print")
        self.run_script("dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(self.run_script("return document.querySelectorAll('details:not([open])').length"), 0)
        self.assertLessEqual(self.run_script("return Math.max(...[...document.querySelectorAll('main *')].map(e => e.getBoundingClientRect().right))"), 672)
        self.run_script("dispatchEvent(new Event('afterprint'))")
        self.assertGreater(self.run_script("return document.querySelectorAll('details:not([open])').length"), 0)

    def test_plane(self):
        data = self.open("box")
        self.assertEqual(len(data["tracks"]["cases"]), 2)
        self.assertIn("of the row with most particles", self.one("#tracks figcaption").text)

    def test_papers_beside_the_print(self):
        data = self.open("items")
        self.assertEqual(self.one("h1").text, "Steffen 2010, recomputed")
        for item in data["paper"]:
            cells = [e.text for e in self.driver.find_elements(By.CSS_SELECTOR, f"#steffen2010-{item['item']} tbody tr")]
            self.assertEqual(len(cells), len(item["rows"]))
            for text, row in zip(cells, item["rows"]):
                self.assertIn(row["verdict"], text)
        self.assertTrue(self.driver.find_elements(By.CSS_SELECTOR, "#steffen2010-fig5 canvas"))


if __name__ == "__main__":
    unittest.main()
