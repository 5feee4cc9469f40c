"""Random hands for viewer.py soak: what a hand may do in the window, as lines for xdotool, and the loop that judges it."""
import os
import random
import re
import subprocess
import sys
import time

WIDTH, HEIGHT, BAR = 1280, 720, 24  # of the window; the menus' bar is left to menus()
KEYS = (["w", "c", "s", "p", "m", "x"] * 3 + list("123456789oritbhnvke") + ["plus", "minus"] +
        ["Up", "Down", "Left", "Right", "Page_Up", "Page_Down", "Home", "Escape", "Return", "space", "Delete", "Insert",
         "Tab", "shift+Tab", "BackSpace", "F1", "F4", "F6", "shift+F6", "F12", "bracketleft", "bracketright", "period",
         "comma", "shift+c", "shift+e", "shift+k", "shift+m", "shift+n", "shift+r", "shift+v", "shift+x", "alt+a",
         "alt+i", "alt+k", "alt+l", "alt+p", "alt+r", "alt+s", "alt+x", "alt+Left", "alt+Right", "alt+Up", "alt+Down",
         "shift+Up", "shift+Left", "ctrl+Right", "ctrl+Down", "ctrl+shift+Left", "ctrl+shift+Down", "ctrl+0", "ctrl+a",
         "ctrl+b", "ctrl+c", "ctrl+r", "ctrl+s", "ctrl+shift+s", "ctrl+x", "ctrl+y", "ctrl+z", "ctrl+shift+z",
         "ctrl+alt+s", "ctrl+bracketleft", "ctrl+bracketright", "ctrl+bracketright"])
COMMANDS = ["light theme", "crosshair", "clip", "whole", "delete all", "measures", "parallel", "voxels", "cine", "slab",
            "bone", "lung", "cta", "reset", "planes", "preset", "large", "text", "zz", "curve", "range"]


def typed(text):
    names = {" ": "space", "/": "slash", "-": "minus", "~": "asciitilde", "_": "underscore", ".": "period"}
    return ["key " + names.get(letter, letter) for letter in text]


class Hands:
    def __init__(self, seed, viewer):
        self.random = random.Random(seed)
        self.viewer = viewer
        self.kinds = [(self.drag, 22), (self.move, 14), (self.click, 12), (self.wheel, 10), (self.key, 22),
                      (self.curve, 8), (self.measure, 4), (self.cut, 4), (self.turn_planes, 3), (self.gap, 2),
                      (self.panel, 4), (self.palette, 3), (self.menus, 2), (self.open_files, 1), (self.series, 1),
                      (self.report, 1), (self.save_preset, 1), (self.import_preset, 1), (self.compare, 2), (self.undo, 3),
                      (self.cine, 1)]

    def events(self):
        """Of one thing that a hand does; what it holds it lets go, except a button now and then."""
        kinds, weights = zip(*self.kinds)
        return self.random.choices(kinds, weights)[0]()

    def spot(self, rect=None):
        x, y, width, height = rect or (0, BAR, WIDTH, HEIGHT - BAR)
        return int(x + self.random.random() * (width - 1)), max(BAR + 1, int(y + self.random.random() * (height - 1)))

    def pane(self):
        panes = [rect for rect in self.viewer.state().get("panes", {}).values() if rect[2] > 1]
        return self.random.choice(panes) if panes else None

    def to(self, spot):
        return f"mousemove {spot[0]} {spot[1]}"

    def move(self):
        return [self.to(self.spot()) for _ in range(self.random.randint(1, 4))]

    def click(self, rect=None):
        button = self.random.choice([1, 1, 1, 1, 2, 3])
        return [self.to(self.spot(rect))] + [f"click {button}"] * self.random.choice([1, 1, 1, 2])

    def wheel(self):
        return self.held(["click " + self.random.choice("45") for _ in range(self.random.randint(1, 6))])

    def key(self):
        return ["key " + self.random.choice(KEYS)]

    def held(self, events, keys=("", "", "", "shift", "ctrl", "alt", "space", "ctrl+shift")):
        key = self.random.choice(keys)
        return [f"keydown {key}"] + events + [f"keyup {key}"] if key else events

    def drag(self, start=None, rect=None):
        button = self.random.choice([1, 1, 1, 2, 3])
        rect = rect or self.pane()
        events = [self.to(start or self.spot(rect)), f"mousedown {button}"]
        events += [self.to(self.spot(rect if self.random.random() < 0.8 else None)) for _ in range(self.random.randint(1, 6))]
        if self.random.random() < 0.15:
            events.append("key " + self.random.choice(["Escape", "ctrl+z", "Return", "x", "m"]))
        if self.random.random() < 0.95:
            events.append(f"mouseup {button}")
        return self.held(events)

    def curve(self):
        plot = self.viewer.state().get("editor", {}).get("plot")
        if not plot or plot[2] < 1:
            return ["key e"]
        x, y, width, height = plot
        wider = (x, y, width, height + 30)  # with the strip of colours and the numbers
        keys = ["e", "period", "comma", "greater", "less", "Left", "Right", "Up", "Down", "shift+Up", "Insert", "Delete",
                "ctrl+a", "plus", "minus", "shift+e", "h", "Escape"]
        return self.random.choice([lambda: self.drag(rect=wider), lambda: self.drag(rect=wider), lambda: self.click(wider),
                                   lambda: [self.to(self.spot(wider))] + self.wheel(),
                                   lambda: ["key e"] + ["key " + k for k in self.random.choices(keys, k=6)]])()

    def measure(self):
        rect = self.pane()
        start = ["key m"] * self.random.randint(1, 4)
        if self.random.random() < 0.5:
            return start + self.drag(rect=rect)
        return start + sum((self.click(rect) for _ in range(3)), [])

    def cut(self):
        """Handles lie in the middle and near the corners of what is shown."""
        rect = self.pane()
        if not rect:
            return self.key()
        x, y, width, height = rect
        start = (int(x + width * self.random.choice([0.1, 0.25, 0.5, 0.75, 0.9])),
                 int(y + height * self.random.choice([0.1, 0.25, 0.5, 0.75, 0.9])))
        return ["key x", "key " + self.random.choice(["k", "alt+x", "alt+k", "shift+k", "x", "x"])] + self.drag(start, rect)

    def turn_planes(self):
        rect = self.pane()
        if not rect:
            return self.key()
        x, y, width, height = rect
        ends = [(0.85, 0.5), (0.15, 0.5), (0.5, 0.15), (0.5, 0.85)]
        across, down = self.random.choice(ends)
        return ["key " + self.random.choice("wcs"), "key Home"] + self.drag((int(x + across * width), int(y + down * height)),
                                                                            rect)

    def gap(self):
        grips = list(self.viewer.state().get("shell", {}).get("grips", {}).values())
        return self.drag(self.spot(self.random.choice(grips)), (100, 50, 1100, 600)) if grips else self.move()

    def panel(self):
        keys = ["Tab", "Tab", "Tab", "shift+Tab", "Up", "Down", "Left", "Right", "space", "Return", "5", "BackSpace"]
        if self.random.random() < 0.5:
            return ["key " + self.random.choice(["F6", "Tab"])] + ["key " + k for k in self.random.choices(keys, k=10)] + [
                "key Escape"] * 2
        right = (900, 60, 370, 620)
        return self.random.choice([lambda: self.drag(rect=right), lambda: self.click(right)])()

    def palette(self):
        """Down no further than what the words find: one of the commands ends the program."""
        text = self.random.choice(COMMANDS)
        end = self.random.choice(["Return", "Return", "Escape"])
        return ["key ctrl+" + self.random.choice(["k", "shift+p"]), *typed(text), "key " + end, "key Escape"]

    def menus(self):
        """Not the first one, where Quit is."""
        events = ["key F10"] + ["key Right"] * self.random.randint(1, 7) + ["key Down"] * self.random.randint(1, 12)
        return events + ["key " + self.random.choice(["Return", "Escape"]), "key Escape", "key Escape"]

    def open_files(self):
        path = self.random.choice([self.viewer.input, self.viewer.work + "/", self.viewer.work + "/ph", "nothing", "~/", ""])
        events = ["key ctrl+o"] + (["key ctrl+a"] + typed(path) if path else [])
        events += ["key " + k for k in self.random.choices(["Tab", "Down", "Up", "End", "Page_Down"], k=3)]
        return events + ["key " + self.random.choice(["Return", "Return", "Escape"]), "key Escape", "key Escape"]

    def series(self):
        keys = self.random.choices(["Up", "Down", "Return", "d", "Page_Down"], k=3)
        return ["key F3"] + ["key " + k for k in keys] + ["key Escape", "key Escape"]

    def report(self):
        return ["key F2", "key ctrl+c", "key Down", "click 5", "key Page_Down", "key F2", "key Escape"]

    def save_preset(self):
        name = self.random.choice(["one", "two", "cta-head", "a/b", "x" * 80, ""])
        end = self.random.choices(["Return", "Tab", "space", "Escape"], k=2)
        return ["key ctrl+p", "key ctrl+a"] + typed(name) + ["key " + k for k in end] + [
            "key Escape"] * 2

    def import_preset(self):
        path = self.random.choice([self.viewer.work + "/bone.vp", self.viewer.input, "nothing", ""])
        events = ["key ctrl+k", *typed("import"), "key Return", "sleep 0.2", "key ctrl+a", *typed(path)]
        return events + ["key " + self.random.choice(["Return", "Return", "Escape"]), "key Escape", "key Escape"]

    def compare(self):
        return ["keydown d"] + self.random.choice([self.wheel, self.move, self.click, self.undo])() + ["keyup d"]

    def undo(self):
        return ["key " + self.random.choice(["ctrl+z", "ctrl+z", "ctrl+shift+z"]) for _ in range(self.random.randint(1, 6))]

    def cine(self):
        return ["key v", "sleep 0.3"] + self.random.choice([self.wheel, self.key, self.drag])() + ["key v"]


ALL_UP = (["mouseup 1", "mouseup 2", "mouseup 3"] + ["keyup " + key for key in ["shift", "ctrl", "alt", "space", "d"]])


def calm(viewer, patience):
    """Lets go of all, closes what is open; the program must then draw what came and rest, and wake up again."""
    viewer.send(ALL_UP + ["key Escape"] * 4)
    if not viewer.settle(patience) and viewer.program.poll() is None:
        fail(viewer, f"the viewer is busy for {patience} s after the last event")
    frames = viewer.state().get("frames", 0)
    viewer.send(["mousemove 301 300", "sleep 0.1", "mousemove 300 301"])
    end = time.time() + patience
    while viewer.program.poll() is None and viewer.state().get("frames", 0) <= frames:
        if time.time() > end:
            fail(viewer, "the viewer does not draw any more")
        time.sleep(0.1)


def fail(viewer, what):
    viewer.keep = True
    with open(viewer.errors) as file:
        text = file.read()
    sys.exit(f"{what}\n{text[-6000:]}\nthe events and what was shown: {viewer.folder}")


def soak(viewer, count, seed, patience=300):
    """Memory may grow in the first third, where caches fill; after that by 32 MB at most."""
    hands, done, quits, used = Hands(seed, viewer), 0, 0, []
    subprocess.run([viewer.name, "presets", "export", "ct-bone", "-o", viewer.work + "/bone.vp"], check=True)
    viewer.refined()
    print(f"{0:6d} events   {viewer.memory_mb():.0f} MB", flush=True)
    while done < count:
        part = []
        while len(part) < count / 20 and done + len(part) < count:
            batch = hands.events()
            viewer.send(batch + [f"sleep {hands.random.choice([0, 0, 0.02, 0.1])}"])
            part += batch
            if viewer.program.poll() is not None:
                break
        done += len(part)
        calm(viewer, patience)
        if viewer.program.poll() == 0:
            quits += 1
            viewer.begin()
            viewer.refined()
        elif viewer.program.poll() is not None:
            fail(viewer, f"after {done} events the viewer has ended with code {viewer.program.returncode}")
        else:
            used.append(viewer.memory_mb())
            print(f"{done:6d} events   {used[-1]:.0f} MB", flush=True)
    third = len(used) // 3
    early, late = sorted(used[third:2 * third]), sorted(used[2 * third:])
    growth = late[len(late) // 2] - early[len(early) // 2] if third else 0
    print(f"growth {growth:+.0f} MB after the first third (medians of thirds); quits {quits}")
    with open(viewer.errors) as file:
        found = re.findall(r".*(?:Sanitizer|runtime error|Assertion).*", file.read())
    if found or (growth > 32 and not quits):
        fail(viewer, f"memory grows by {growth:.0f} MB" if not found else found[0])
