#!/usr/bin/env python3
"""The pictures of the README's tour: the viewer's window (Xvfb, xdotool) with the phantom, part by part.

    tour.py PROGRAM PHANTOM FOLDER      writes FOLDER/*.png
"""
import os
import sys
import time

from PIL import ImageGrab

from viewer import Viewer


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    program, phantom, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    viewer = Viewer(program, phantom)
    viewer.refined()

    def hands(words, rest=0.4):
        viewer.hands(words)
        time.sleep(rest)

    def save(name, crop=None):
        hands("mousemove_relative 1 0", 0.1)
        viewer.wait(lambda s: s["at_rest"])
        time.sleep(0.3)
        picture = ImageGrab.grab(xdisplay=os.environ["DISPLAY"])
        if crop:
            picture = picture.crop(crop)
        picture.convert("RGB").save(os.path.join(folder, name + ".png"), optimize=True)
        print(name, flush=True)

    def over(pane, dx=0, dy=0):
        x, y = viewer.middle(pane)
        hands(f"mousemove {x + dx - 2} {y + dy} mousemove {x + dx} {y + dy}", 0.2)

    def drag(x0, y0, x1, y1, button=1):
        hands(f"mousemove {x0} {y0} mousedown {button}", 0.2)
        for i in range(1, 6):
            hands(f"mousemove {x0 + (x1 - x0) * i // 5} {y0 + (y1 - y0) * i // 5}", 0.1)
        hands(f"mouseup {button}")

    # The whole window, dark and light: the head from the left front, the crosshair on the aneurysm.
    over("axial", 0, 0)
    x, y = viewer.middle("volume")
    drag(x, y, x + 70, y + 14)
    over("volume", -150, 100)
    save("window")
    hands("key ctrl+k type light")
    hands("key Return", 1)
    save("light")
    hands("key ctrl+k type light")
    hands("key Return", 1)

    # Oblique planes, a slab and a measure.
    over("axial")
    hands("key m")
    x, y = viewer.middle("axial")
    drag(x - 70, y + 40, x + 60, y + 55)
    hands("key m key m")
    drag(x - 30, y - 60, x + 25, y - 20)
    hands("key c key alt+Right key alt+Right key alt+Right", 1)
    save("slices")
    hands("key ctrl+r key w")

    # Crop box and clip plane.
    over("volume")
    hands("key x")
    x, y = viewer.middle("volume")
    hands("key k", 1)
    save("crop")
    hands("key alt+k key w")

    # The editor: several points, what a range selects.
    plot = viewer.state()["editor"]["plot"]
    left, top, width, height = (int(v) for v in plot)
    hands("key h")
    drag(left + int(0.45 * width), top + height + 4, left + int(0.62 * width), top + height + 4)
    save("editor")
    hands("key h")

    # Finding a command; the list of files.
    hands("key ctrl+k type plane", 1)
    save("commands")
    hands("key Escape key ctrl+o", 1.5)
    viewer.hands(f"key ctrl+a type {os.path.dirname(os.path.abspath(phantom))}/")
    time.sleep(1)
    save("files")
    hands("key Escape key F3", 2)
    save("series")
    hands("key F3 key F2", 1)
    save("report")
    hands("key Escape")
    sys.exit(viewer.end())


main()
