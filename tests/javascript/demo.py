# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Opens the page of a crowd in Chromium: every kind of body finds the pairs that the library finds, nothing fails, and people can be dragged,
also on a phone, whose screen the page fits.
Usage: demo.py FOLDER [PICTURE.png]: also takes the picture of the README."""

import functools
import http.server
import sys
import threading
import time

import bch
import numpy as np
from selenium import webdriver
from selenium.webdriver.common.actions import interaction
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.actions.pointer_input import PointerInput
from selenium.webdriver.common.by import By
from selenium.webdriver.chrome.service import Service


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def serve(folder):
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://127.0.0.1:{server.server_port}/"


def browser(width, height, is_phone=False):
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--disable-dev-shm-usage", f"--window-size={width},{height}"):
        options.add_argument(argument)
    if is_phone:
        options.add_experimental_option("mobileEmulation", {"deviceMetrics": {"width": width, "height": height, "pixelRatio": 2, "touch": True}})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))


STATE = """
const { people, found } = window.demo;
const { x, y, heading, shape } = people.agents, { clip, seconds } = people.times();
return { x: [...x], y: [...y], heading: [...heading], shape: [...shape], side: people.side, clip: [...clip], seconds: [...seconds],
  character: [...people.character], pairs: [...found.pairs] };
"""
TIMES = """
const { people, check } = window.demo;
const times = Array.from({ length: 21 }, () => {
  people.step(0.02);
  const { posing, finding } = check.run();
  return posing + finding;
});
return times.sort((a, b) => a - b)[10];
"""
CHARACTERS = [bch.default_pedestrian("male", 1.78), bch.default_pedestrian("female", 1.66)]


def outlines():
    builder = bch.ShapeSetBuilder()
    for character in CHARACTERS:
        for clip in (36, 42, 48):
            stride = np.float64(np.float32(character.clips[clip].seconds))
            builder.add_poses(character, [(clip, np.float32((phase + 0.5) / 32 * stride)) for phase in range(32)])
    return builder.finish()


def capsules():
    builder = bch.ShapeSetBuilder()
    builder.add_capsules([(0, -0.12, 0, 0.12, 0.16)], tolerance=0.001)
    return builder.finish()


def cylinders():
    builder = bch.ShapeSetBuilder()
    builder.add_cylinder(0.25)
    return builder.finish()


def spheres(state, count):
    live = bch.LiveBodies([bch.default_body(character, count) for character in CHARACTERS], np.array(state["character"], np.uint32))
    poses = np.zeros(len(state["clip"]), [("clip", np.uint32), ("seconds", np.float32)])
    poses["clip"], poses["seconds"] = state["clip"], state["seconds"]
    live.pose(poses)
    return live.bodies


def expected(state, kind):
    agents = bch.Agents(shape=np.array(state["shape"], np.uint32), **{name: np.array(state[name], float) for name in ("x", "y", "heading")})
    if kind.startswith("spheres"):
        bodies = spheres(state, int(kind[7:]))
    else:
        bodies = {"cylinder": cylinders, "capsule": capsules, "outlines": outlines}[kind]()
    return np.array(bch.Crowd(period=(state["side"], state["side"])).collisions(bodies, agents)).reshape(-1, 2)


def wait_for(driver, condition):
    for _ in range(600):
        if driver.execute_script("return " + condition):
            return
        time.sleep(0.1)
    raise AssertionError(f"{condition}: never; the page says {driver.find_element(By.TAG_NAME, 'body').text}")


def check_kinds(driver, page):
    for kind, people in (("spheres64", 1000), ("cylinder", 1000), ("capsule", 1000), ("spheres256", 300), ("outlines", 1000)):
        driver.get(f"{page}?people={people}&bodies={kind}&step=0.02")
        wait_for(driver, "window.demo && window.demo.frames > 3")
        driver.execute_script("document.getElementById('pause').checked = true")
        frames = driver.execute_script("return window.demo.frames")
        wait_for(driver, f"window.demo.frames > {frames + 1}")
        state = driver.execute_script(STATE)
        pairs = expected(state, kind)
        assert len(pairs) > 20, f"{kind}: only {len(pairs)} pairs collide"
        assert np.array_equal(pairs, np.array(state["pairs"]).reshape(-1, 2)), f"{kind}: expected {len(pairs)} pairs, found {len(state['pairs']) // 2}, or others"
        times = driver.execute_script(TIMES)
        print(f"{kind}: {people} people, {len(pairs)} pairs, {times:.1f} ms a check")


def check_dragging(driver, page, pointer):
    driver.get(f"{page}?people=100&step=0")
    wait_for(driver, "window.demo && window.demo.frames > 3")
    places = "return [...window.demo.people.agents.x, ...window.demo.people.agents.y]"
    before = driver.execute_script(places)
    width, height = driver.execute_script("return [innerWidth, innerHeight]")
    moved = []
    for at in range(-6, 7):  # until somebody stands there
        drag = ActionBuilder(driver, mouse=PointerInput(pointer, "pointer"))
        x, y = width // 2 + at * width // 40, int(0.6 * height)
        drag.pointer_action.move_to_location(x, y).pointer_down().move_to_location(x + 30, y + 40).pointer_up()
        drag.perform()
        after = driver.execute_script(places)
        moved = [i for i in range(len(before)) if before[i] != after[i]]
        if moved:
            break
    assert moved and len({i % 100 for i in moved}) == 1, f"expected one person to be moved, found {moved}"


def check_errors(driver):
    for entry in driver.get_log("browser"):
        assert entry["level"] != "SEVERE", entry["message"]


def check_phone(page):
    driver = browser(390, 844, is_phone=True)
    try:
        check_dragging(driver, page, interaction.POINTER_TOUCH)
        wide, high, page_wide = driver.execute_script("return [innerWidth, innerHeight, document.documentElement.scrollWidth]")
        panel = driver.find_element(By.ID, "panel").rect
        assert wide == page_wide == 390, f"expected a page of 390 pixels, found {page_wide} on a screen of {wide}"
        assert panel["x"] >= 0 and panel["x"] + panel["width"] <= wide and panel["y"] + panel["height"] <= high, f"the panel leaves the screen: {panel}"
        assert panel["height"] < 0.4 * high, f"the panel hides the people: {panel}"
        check_errors(driver)
    finally:
        driver.quit()


def main():
    page = serve(sys.argv[1])
    check_phone(page)
    driver = browser(1200, 700)
    try:
        check_kinds(driver, page)
        check_dragging(driver, page, interaction.POINTER_MOUSE)
        check_errors(driver)
        if len(sys.argv) > 2:
            driver.get(f"{page}?people=1000&step=0.02")
            wait_for(driver, "window.demo && window.demo.frames > 3")
            driver.execute_script("document.getElementById('panel').hidden = true")
            driver.save_screenshot(sys.argv[2])
    finally:
        driver.quit()


main()
