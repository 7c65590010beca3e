#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Looks at the page of a checked recording in a browser: python3 check_page_test.py SAMPLE FOLDER, where SAMPLE is the
program that writes a page and what it should show. Says SKIPPED where there is no selenium or no browser."""

import itertools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import unittest

try:
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
except ImportError:
    webdriver = None


def skip_reason():
    if webdriver is None:
        return "there is no selenium"
    if shutil.which("chromium") is None or shutil.which("chromedriver") is None:
        return "there is no chromium or no chromedriver"
    return None


def distance(point, begin, end):
    """Of a point from a segment, all complex."""
    along = ((point - begin) / (end - begin)).real if end != begin else 0
    return abs(point - begin - min(max(along, 0), 1) * (end - begin))


def depth(point, contours):
    """How deep a point is in the area of contours, negative outside."""
    sides = [side for contour in contours for side in zip(contour, contour[1:] + contour[:1])]
    crossed = sum((a.imag > point.imag) != (b.imag > point.imag)
                  and point.real < a.real + (point.imag - a.imag) * (b.real - a.real) / (b.imag - a.imag) for a, b in sides)
    return min(distance(point, *side) for side in sides) * (1 if crossed % 2 else -1)


def browser(folder):
    options = Options()
    options.binary_location = shutil.which("chromium")
    for argument in ["--headless=new", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
                     "--force-device-scale-factor=1", f"--user-data-dir={folder / 'profile'}"]:
        options.add_argument(argument)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")  # which root has to do without
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))


class Page(unittest.TestCase):
    sample = None
    folder = None

    @classmethod
    def write(cls, name, *arguments):
        page, expected = cls.folder / f"{name}.html", cls.folder / f"{name}.json"
        subprocess.run([cls.sample, page, expected, *map(str, arguments)], check=True)
        return page, json.loads(expected.read_text())

    @classmethod
    def setUpClass(cls):
        shutil.rmtree(cls.folder, ignore_errors=True)
        cls.folder.mkdir(parents=True)
        cls.page, cls.expected = cls.write("page", 60, 200)
        cls.browser = browser(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()

    def setUp(self):
        self.open(self.page)

    def tearDown(self):
        self.assertEqual(self.browser.get_log("browser"), [])

    def open(self, page, width=1400, height=900, phone=False, **media):
        """Opens a page in a window of a size; media are features as prefers_color_scheme="dark"."""
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 2 if phone else 1, "mobile": phone})
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
            {"name": name.replace("_", "-"), "value": value} for name, value in
            {"prefers_color_scheme": "light", "prefers_reduced_motion": "reduce", **media}.items()]})
        self.browser.get(page.as_uri())
        self.browser.execute_script("localStorage.clear()")

    def js(self, expression, *arguments):
        return self.browser.execute_script("return " + expression, *arguments)

    def find(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def press(self, *keys):
        ActionChains(self.browser).send_keys(*keys).perform()

    def wait(self, condition, what, seconds=10):
        end = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), end, what)
            time.sleep(0.02)

    def drawn(self):
        """The crowd's pixels, once what was asked for is drawn."""
        return self.browser.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => "
            "done(document.getElementById('crowd').toDataURL())))")

    def assert_people(self, shown, frame):
        self.assertEqual(len(shown), len(frame["people"]))
        for person, (identity, x, y, overlaps, in_wall) in zip(shown, frame["people"]):
            self.assertEqual((person["id"], person["overlaps"], person["inWall"]), (identity, overlaps, in_wall))
            self.assertAlmostEqual(person["x"], x, delta=0.0006)
            self.assertAlmostEqual(person["y"], y, delta=0.0006)

    def test_texts_of_the_recording_are_texts(self):
        title = "corridor <b>& pillar</b></script><script>throw 1</script>"
        self.assertEqual(self.browser.title, title)
        self.assertEqual(self.find("h1").text, title)
        self.assertEqual(self.js("document.querySelectorAll('h1 *, #facts dl * *, img').length"), 0)
        self.assertIn("</script><img src=x onerror=throw(2)>", self.find("#facts").text)

    def test_needs_nothing_else(self):
        self.assertEqual(self.js("performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).length"), 0)

    def test_shows_the_right_people_at_the_right_time(self):
        shown = self.js("arguments[0].map((seconds) => { bchPage.seek(seconds); "
                        "return [bchPage.frame(), bchPage.people()]; })",
                        [frame["seconds"] for frame in self.expected["frames"]])
        for (number, people), frame in zip(shown, self.expected["frames"]):
            self.assertEqual(number, frame["frame"])
            self.assert_people(people, frame)
        last = self.expected["frames"][-1]
        self.assertEqual(self.find("#clock-frame").text, f"frame {last['frame']}")
        self.assertEqual(self.find("#now-people").text, f"{len(last['people'])} people")
        hits = sum(overlaps or in_wall for _, _, _, overlaps, in_wall in last["people"])
        self.assertEqual(self.find("#now-hits").text, f"{hits or 'none'} overlapping")
        self.assertGreater(sum(len(f["people"]) for f in self.expected["frames"]), 10_000)

    def test_between_frames_the_earlier_one_is_shown(self):
        before = self.expected["frames"][40]
        self.js("bchPage.seek(arguments[0])", before["seconds"] + 0.035)
        self.assert_people(self.js("bchPage.people()"), before)

    def test_plays_and_stops_at_the_end(self):
        self.find("#play").click()
        self.wait(lambda: self.js("bchPage.time()") > 0.4, "time does not advance")
        self.wait(lambda: self.js("bchPage.frameRate()") > 5, "no frames are drawn")
        before = self.drawn()
        self.wait(lambda: self.drawn() != before, "people do not move")
        self.find("#play").click()
        stopped = self.js("bchPage.time()")
        time.sleep(0.1)
        self.assertEqual(self.js("bchPage.time()"), stopped)
        end = self.expected["frames"][-1]["seconds"]
        self.js("bchPage.seek(arguments[0])", end - 0.1)
        self.js("bchPage.play()")
        self.wait(lambda: not self.js("bchPage.isPlaying()"), "it does not stop")
        self.assertAlmostEqual(self.js("bchPage.time()"), end)

    def test_pixels_change_with_time(self):
        self.js("bchPage.seek(0)")
        first = self.drawn()
        self.js("bchPage.seek(4)")
        self.assertNotEqual(first, self.drawn())
        self.js("bchPage.seek(0)")
        self.assertEqual(first, self.drawn())

    def test_draws_the_outlines_at_every_zoom(self):
        frame = self.expected["frames"][len(self.expected["frames"]) // 2]
        outlines = [[[complex(*point) for point in contour] for contour in person] for person in self.expected["outlines"]]
        places = [complex(x, y) for _, x, y, _, _ in frame["people"]]
        self.js("bchPage.seek(arguments[0])", frame["seconds"])
        width, height = self.js("[document.getElementById('crowd').width, document.getElementById('crowd').height]")
        middle = min(places, key=lambda place: abs(place - sum(places) / len(places)))
        for scale in 24, 40, 100, 300:
            self.js("bchPage.setView(...arguments)", middle.real, middle.imag, scale)
            self.drawn()
            pixels, inside = [], []
            step = 7 if scale < 50 else 23
            for x, y in itertools.product(range(5, width, step), range(7, height, step)):
                point = middle + complex(x + 0.5 - width / 2, height / 2 - y - 0.5) / scale
                near = [depth(point, contours) * scale for contours, place in zip(outlines, places) if abs(place - point) < 1]
                if all(not -3.2 < d < 1.5 for d in near):  # rims, and what outlines leave out
                    pixels.append([x, y])
                    inside.append(any(d > 0 for d in near))
            opaque = self.browser.execute_script("""
                const copy = new OffscreenCanvas(arguments[1], arguments[2]).getContext("2d", {willReadFrequently: true});
                copy.drawImage(document.getElementById("crowd"), 0, 0);
                const {data, width} = copy.getImageData(0, 0, arguments[1], arguments[2]);
                return arguments[0].map(([x, y]) => data[4 * (y * width + x) + 3] > 127);""", pixels, width, height)
            self.assertEqual([pixel for pixel, *answers in zip(pixels, opaque, inside) if answers[0] != answers[1]], [], scale)
            self.assertGreater(sum(inside), 10, scale)

    def test_jumps_to_the_worst_event(self):
        events = self.expected["events"]
        worst = max(events, key=lambda event: event["depth"])
        self.find("#event-list button").click()
        self.assertAlmostEqual(self.js("bchPage.time()"), worst["worst"], places=5)
        view = self.js("bchPage.view()")
        self.assertAlmostEqual(view["x"], worst["x"], delta=0.001)
        self.assertAlmostEqual(view["y"], worst["y"], delta=0.001)
        shown = {person["id"]: person for person in self.js("bchPage.people()")}
        self.assertTrue(shown[worst["first"]]["overlaps"] and shown[worst["second"]]["overlaps"])
        self.assertEqual(self.find("#event-list [aria-current=true] .pair").text, f"{worst['first']} and {worst['second']}")
        depth = self.find("#event-list [aria-current=true] .depth").text
        self.assertAlmostEqual(float(depth.removesuffix(" cm")), 100 * worst["depth"], delta=0.051)
        lasts = self.find("#event-list [aria-current=true] .when").text.split(" for ")[1]
        self.assertAlmostEqual(float(lasts.removesuffix(" s")), worst["lasts"], delta=0.0051 if worst["lasts"] < 9.9 else 0.051)
        self.js("bchPage.jumpToEvent(arguments[0])", len(events) - 1)
        self.assertAlmostEqual(self.js("bchPage.time()"), events[-1]["worst"], places=5)

    def test_people_move_between_frames(self):
        before, after = self.expected["frames"][40:42]
        half = (before["seconds"] + after["seconds"]) / 2
        self.js("bchPage.seek(arguments[0])", half)
        there = {identity: (x, y) for identity, x, y, _, _ in after["people"]}
        moved = 0
        for (identity, x, y, _, _), standing in zip(before["people"], self.js("bchPage.standing()")):
            to = there.get(identity, (x, y))
            self.assertAlmostEqual(standing["x"], (x + to[0]) / 2, delta=0.0012)
            self.assertAlmostEqual(standing["y"], (y + to[1]) / 2, delta=0.0012)
            moved += to != (x, y)
        self.assertGreater(moved, 10)

    def test_passes_are_called_so(self):
        # The first event as if it were a pass between two frames.
        first = re.search(r'"events":\[\[(-?\d+,(?:-?\d+|null)),', self.page.read_text())
        page = self.folder / "passing.html"
        page.write_text(re.sub(r'("events":\[\[)[^\]]*\]', rf"\g<1>{first[1]},1.2,1.2,1.2173,0,0,0,1]", self.page.read_text(), count=1))
        self.open(page)
        self.js("bchPage.jumpToEvent(0)")
        self.assertAlmostEqual(self.js("bchPage.time()"), 1.2173, places=5)
        self.assertEqual(self.find("#event-list [aria-current=true] .depth").text, "pass")
        self.assertEqual(self.find("#event-list [aria-current=true] .when").text, "at 0:01.22, between two frames")
        self.assertEqual(sum(",pass,1.2000,1.2000,1.2173,0.0000," in line for line in self.js("bchPage.eventsAsCsv()").splitlines()), 1)

    def test_a_link_leads_to_a_moment(self):
        self.browser.get(self.page.as_uri() + "#t=2.5")
        self.browser.refresh()
        self.assertAlmostEqual(self.js("bchPage.time()"), 2.5)
        self.js("bchPage.seek(1.25)")
        self.press("l")
        self.assertTrue(self.browser.current_url.endswith("#t=1.25"))
        self.js("(location.hash = 't=0.5')")
        self.wait(lambda: self.js("bchPage.time()") == 0.5, "the page does not follow its address")

    def test_events_as_csv(self):
        names, *rows = [line.split(",") for line in self.js("bchPage.eventsAsCsv()").splitlines()]
        self.assertEqual(names, ["first", "second", "kind", "from", "to", "worst", "depth", "x", "y"])
        expected = sorted(self.expected["events"], key=lambda event: -event["depth"])
        self.assertEqual(len(rows), len(expected))
        for row, event in zip(rows[:50], expected):
            self.assertAlmostEqual(float(row[6]), event["depth"], delta=1e-4)
            self.assertEqual(row[2], "wall" if row[1] == "wall" else "overlap")
        self.find("#save-events").click()

    def test_fits_windows_of_every_width(self):
        for width in 860, 900, 1000, 1100, 1180, 1280:
            self.open(self.page, width, 700)
            outside = self.js("[...document.querySelectorAll('button, select, #transport p')].filter((e) => { "
                              "const box = e.getBoundingClientRect(), of = e.closest('section, aside, header, dialog').getBoundingClientRect(); "
                              "return box.width > 0 && (box.right > of.right + 1 || box.left < of.left - 1); }).map((e) => e.id || e.textContent)")
            self.assertEqual((width, outside), (width, []))

    def test_events_by_time(self):
        self.find("#by-time").click()
        times = [row.text.split()[1] for row in self.browser.find_elements(By.CSS_SELECTOR, "#event-list .when")]
        self.assertEqual(times, sorted(times))
        self.assertEqual(len(times), min(100, len(self.expected["events"])))

    def test_keys(self):
        self.press(Keys.SPACE)
        self.assertTrue(self.js("bchPage.isPlaying()"))
        self.press(Keys.SPACE)
        self.assertFalse(self.js("bchPage.isPlaying()"))
        self.press(Keys.HOME, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_LEFT, Keys.ARROW_RIGHT)
        self.assertEqual(self.js("bchPage.frame()"), self.expected["frames"][2]["frame"])
        self.press(Keys.END)
        self.assertEqual(self.js("bchPage.frame()"), self.expected["frames"][-1]["frame"])
        fitted = self.js("bchPage.view()")
        self.press("+", "+")
        self.assertAlmostEqual(self.js("bchPage.view().scale"), 2.25 * fitted["scale"])
        self.press("-")
        self.assertAlmostEqual(self.js("bchPage.view().scale"), 1.5 * fitted["scale"])
        self.press("0")
        self.assertEqual(self.js("bchPage.view()"), fitted)
        self.press(Keys.ARROW_UP)
        self.assertEqual(self.find("#speed").get_property("value"), "2")
        by_depth = sorted(self.expected["events"], key=lambda event: (-event["depth"], event["worst"]))
        self.press("n", "n", "p")
        self.assertAlmostEqual(self.js("bchPage.time()"), by_depth[0]["worst"], places=5)

    def test_help(self):
        self.press("?")
        self.assertTrue(self.find("#help").is_displayed())
        self.press(Keys.ESCAPE)
        self.assertFalse(self.find("#help").is_displayed())

    def test_timeline_jumps(self):
        timeline, end = self.find("#timeline"), self.expected["frames"][-1]["seconds"]
        ActionChains(self.browser).move_to_element_with_offset(timeline, timeline.size["width"] // 4, 0).click().perform()
        self.assertAlmostEqual(self.js("bchPage.time()"), 0.75 * end, delta=0.02 * end)

    def test_drag_and_wheel(self):
        stage, before = self.find("#stage"), self.js("bchPage.view()")
        ActionChains(self.browser).drag_and_drop_by_offset(stage, 80, 40).perform()
        after = self.js("bchPage.view()")
        self.assertAlmostEqual(before["x"] - after["x"], 80 / before["scale"], delta=2 / before["scale"])
        self.assertAlmostEqual(after["y"] - before["y"], 40 / before["scale"], delta=2 / before["scale"])
        ActionChains(self.browser).scroll_from_origin(ScrollOrigin.from_element(stage), 0, -200).perform()
        self.wait(lambda: self.js("bchPage.view().scale") > 1.2 * before["scale"], "the wheel does not zoom")

    def test_tells_who_is_under_the_pointer(self):
        identity, x, y, _, _ = self.expected["frames"][0]["people"][7]
        self.js("bchPage.setView(arguments[0], arguments[1], 120)", x, y)
        ActionChains(self.browser).move_to_element(self.find("#stage")).perform()
        self.assertEqual(self.find("#tip .who").text, f"Person {identity}")
        self.assertRegex(self.find("#tip").text, r"pedestrian\n1\.\d\d m/s, heading \d+°")
        ActionChains(self.browser).click().perform()
        self.assertEqual(self.find("#card .who").text, f"Person {identity}")
        self.press("f", Keys.END)
        follows = [p for p in self.js("bchPage.people()") if p["id"] == identity]
        view = self.js("bchPage.view()")
        if follows:
            self.assertAlmostEqual(view["x"], follows[0]["x"], delta=0.001)
        self.press(Keys.ESCAPE)
        self.assertFalse(self.find("#card").is_displayed())

    def test_controls_have_names(self):
        self.assertEqual(self.js("[...document.querySelectorAll('button, input, select')].filter((e) => "
                                 "!(e.ariaLabel || e.textContent.trim() || e.labels?.length)).map((e) => e.id)"), [])

    def test_dark_and_light(self):
        self.assertEqual(self.js("document.documentElement.dataset.theme"), "light")
        light = self.js("getComputedStyle(document.body).backgroundColor")
        self.open(self.page, prefers_color_scheme="dark")
        self.assertEqual(self.js("document.documentElement.dataset.theme"), "dark")
        self.assertNotEqual(self.js("getComputedStyle(document.body).backgroundColor"), light)
        self.find("#theme").click()
        self.assertEqual(self.js("getComputedStyle(document.body).backgroundColor"), light)

    def test_phone(self):
        self.open(self.page, 390, 844, phone=True)
        self.assertEqual(self.js("document.documentElement.scrollWidth"), 390)
        small = self.js("[...document.querySelectorAll('button, select, input')].map((e) => [e.id, e.getBoundingClientRect()])"
                        ".filter(([id, box]) => box.width > 0 && (box.width < 40 || box.height < 40)).map(([id]) => id)")
        self.assertEqual(small, [])
        self.assertLessEqual(self.js("document.querySelectorAll('#event-list button').length"), 5)
        self.find("#event-list button").click()
        worst = max(self.expected["events"], key=lambda event: event["depth"])
        self.assertAlmostEqual(self.js("bchPage.time()"), worst["worst"], places=5)
        top, bottom = self.js("(({top, bottom}) => [top, bottom])(document.getElementById('stage').getBoundingClientRect())")
        self.assertTrue(-1 < top and bottom < 845, "the picture is out of view")

    def test_view_moves_where_motion_is_welcome(self):
        self.open(self.page, prefers_reduced_motion="no-preference")
        before = self.js("bchPage.view()")
        self.find("#zoom-in").click()
        self.wait(lambda: abs(self.js("bchPage.view().scale") - 1.5 * before["scale"]) < 1e-6, "the view does not arrive")

    def test_empty_recording(self):
        page, _ = self.write("empty", 60, 0)
        self.open(page)
        self.assertEqual(self.js("bchPage.people()"), [])
        self.press(Keys.SPACE, Keys.ARROW_RIGHT, "n", "+", "0", Keys.END)
        self.assertEqual(self.find("#events-note").text, "Nobody overlaps anybody, and nobody is in a wall.")

    def test_thinned_recording(self):
        page, expected = self.write("thinned", 60, 200, 90, 300_000)
        self.assertLessEqual(page.stat().st_size, 300_000)
        self.open(page)
        step = int(re.search(r"every (\d+)(nd|th) frame shown", self.find("#summary").text)[1])
        self.assertGreater(step, 1)
        self.press(Keys.HOME, Keys.ARROW_RIGHT)
        self.assert_people(self.js("bchPage.people()"), expected["frames"][step])


if __name__ == "__main__":
    if skip_reason():
        print("SKIPPED:", skip_reason())
        sys.exit(0)
    Page.sample, Page.folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
