# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""The frames a second at which the page of `bch check` plays a made-up crowd, in headless Chromium without a GPU, zoomed in step by step.

Needs Debian's chromium, chromium-driver, python3-selenium and python3-numpy.

Usage: page_rate.py PROGRAM [PEOPLE [FOLDER]]   PROGRAM: build/release/bch; FOLDER: for pictures
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import time

import discs
import numpy as np
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

FRAMES = 250
SECONDS = 2
WINDOWS = {"wide": (1400, 900), "narrow": (390, 844)}


def browser():
    options = Options()
    for argument in ["--headless=new", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars"]:
        options.add_argument(argument)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")  # which root has to do without
    return webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))


def write_page(program, people, folder):
    file, page = folder / "crowd.csv", folder / "crowd.html"
    with open(file, "w") as out:
        out.write("frame,id,x,y\n")
        for k, frame in enumerate(discs.crowd(people, FRAMES)):
            np.savetxt(out, np.c_[np.full(people, k), np.arange(people), frame], fmt="%d,%d,%.3f,%.3f")
    command = [program, "check", file, "--fps", str(discs.FPS), "--unit", "m", "--html", page]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return page


def open_page(driver, page, window, theme):
    width, height = WINDOWS[window]
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    features = [{"name": "prefers-color-scheme", "value": theme}, {"name": "prefers-reduced-motion", "value": "no-preference"}]
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
    driver.get(page.as_uri())


def rate(driver):
    """Frames a second while the page plays 62 moments of the recording a second, so that each frame of a screen draws another one."""
    driver.execute_script("bchPage.seek(0); bchPage.setSpeed(2.5); bchPage.play()")
    time.sleep(SECONDS)
    drawn = driver.execute_script("const rate = bchPage.frameRate(); bchPage.pause(); return rate")
    return drawn


def main(program, people=1000, pictures=None):
    with tempfile.TemporaryDirectory() as folder:
        page = write_page(program, people, pathlib.Path(folder))
        driver = browser()
        for window in WINDOWS:
            for theme in "light", "dark":
                open_page(driver, page, window, theme)
                for zoom in 1, 2, 4, 8:
                    if theme == "light":
                        print(f"{people} people, {window}, {zoom} times as large: {rate(driver):.0f} frames a second")
                    if pictures is not None and zoom in (1, 4):
                        driver.save_screenshot(str(pathlib.Path(pictures, f"{window}_{theme}_{zoom}.png")))
                    driver.execute_script("const v = bchPage.view(); bchPage.setView(v.x, v.y, 2 * v.scale)")
        driver.quit()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1000, sys.argv[3] if len(sys.argv) > 3 else None)
