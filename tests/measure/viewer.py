#!/usr/bin/env python3
"""The viewer under a virtual screen (Xvfb, xdotool): how fast it answers, how it rests, how it bears random hands.

    viewer.py latency PROGRAM INPUT [N]         from an event to the window that shows it, ms: median and 95th percentile
    viewer.py start PROGRAM INPUT               seconds from the call to the first and to the refined picture
    viewer.py idle PROGRAM INPUT                processor time in ten seconds without events, percent
    viewer.py soak PROGRAM INPUT [N] [SEED]     N random events (10000): no report, hang or growth of memory
"""
import atexit
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
from viewer_soak import soak  # beside this file


class Viewer:
    """Of what it writes nothing is outside `folder`, which goes where `keep` is not set."""
    def __init__(self, program, path):
        self.folder = tempfile.mkdtemp()
        self.keep = False
        self.name = program
        self.work = os.path.join(self.folder, "work")
        self.state_file = os.path.join(self.folder, "state.json")
        self.errors = os.path.join(self.folder, "stderr.txt")
        self.trace = os.path.join(self.folder, "events.txt")
        os.mkdir(self.work)
        self.input = os.path.join(self.work, "phantom")
        os.symlink(os.path.abspath(path), self.input)
        os.environ["HOME"] = os.environ["XDG_CONFIG_HOME"] = os.path.join(self.folder, "home")
        # What is free is not kept for long, so that growth can be told; drivers leave blocks behind (CMakeLists.txt).
        os.environ.setdefault("ASAN_OPTIONS", "detect_leaks=0:quarantine_size_mb=8")
        os.mkdir(os.environ["HOME"])
        atexit.register(self.clear)
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x720x24", "-noreset"],
                                       pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            os.environ["DISPLAY"] = ":" + pipe.readline().strip()
        atexit.register(self.server.terminate)
        self.begin()

    def begin(self):
        if os.path.exists(self.state_file):
            os.remove(self.state_file)
        self.begun = time.time()
        with open(self.errors, "a") as errors:
            self.program = subprocess.Popen([os.path.abspath(self.name), "view", self.input, "--write-state", self.state_file,
                                             "--pictures", os.path.join(self.folder, "pictures"), "--preset", "cta-head"],
                                            cwd=self.work, stderr=errors)
        atexit.register(self.program.kill)

    def clear(self):
        if not self.keep:
            shutil.rmtree(self.folder, ignore_errors=True)

    def state(self):
        try:
            with open(self.state_file) as file:
                state = json.load(file)
                return {**state, **state.pop("live", {})}
        except (OSError, ValueError):
            return {}

    def wait(self, wanted, seconds=60):
        end = time.time() + seconds
        while time.time() < end:
            state = self.state()
            if state and wanted(state):
                return state
            time.sleep(0.005)
        sys.exit("the viewer does not come to where it should; its state: " + json.dumps(self.state())[:500])

    def refined(self):
        return self.wait(lambda s: s.get("refined"))

    def settle(self, seconds=200):
        """Until it has drawn what all events asked for: random hands are faster than it. False: it is busy still."""
        end = time.time() + seconds
        used = -1
        while time.time() < end and self.program.poll() is None:
            before, used = used, self.seconds_used()
            if used - before < 0.02:
                return True
            time.sleep(1)
        return False

    def send(self, events):
        with open(self.trace, "a") as file:
            file.write("\n".join(events) + "\n")
        subprocess.run(["xdotool", "-"], input="\n".join(events) + "\n", text=True, check=True)

    def hands(self, words):
        subprocess.run(["xdotool"] + words.split(), check=True)

    def middle(self, pane):
        x, y, width, height = self.state()["panes"][pane]
        return int(x + width / 2), int(y + height / 2)

    def memory_mb(self):
        with open(f"/proc/{self.program.pid}/status") as file:
            return next(int(line.split()[1]) / 1024 for line in file if line.startswith("VmRSS"))

    def seconds_used(self):
        with open(f"/proc/{self.program.pid}/stat") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def end(self):
        self.hands("key Escape Escape Escape ctrl+q")
        try:
            code = self.program.wait(30)
        except subprocess.TimeoutExpired:
            self.program.kill()
            code = "none: it had to be killed"
        return code


def latencies(viewer, step, count):
    """Of single events, each after the state of the one before has been written."""
    times = []
    for i in range(count):
        frames = viewer.state()["frames"]
        step(i)
        times.append(viewer.wait(lambda s: s["frames"] > frames)["latency_ms"])
    return times


def report(what, times):
    times = sorted(times)
    print(f"{what:24s} median {statistics.median(times):6.0f} ms   95th percentile {times[int(0.95 * (len(times) - 1))]:6.0f} ms"
          f"   ({len(times)} events)")


def latency(viewer, count):
    viewer.refined()
    x, y = viewer.middle("volume")
    viewer.hands(f"mousemove {x} {y} mousedown 1")
    report("turning the volume", latencies(viewer, lambda i: viewer.hands(f"mousemove {x + 3 * (i + 1)} {y + i}"), count))
    viewer.hands("mouseup 1")
    viewer.refined()
    x, y = viewer.middle("axial")
    viewer.hands(f"mousemove {x} {y}")
    time.sleep(0.5)
    report("scrolling a slice", latencies(viewer, lambda i: viewer.hands("click 4" if i % 20 < 10 else "click 5"), count))
    viewer.hands("mousedown 1")
    report("windowing", latencies(viewer, lambda i: viewer.hands(f"mousemove {x + 2 * (i + 1)} {y}"), count))
    viewer.hands("mouseup 1")
    editor = viewer.refined()["editor"]
    left, top, width, height = editor["plot"]
    low, high = editor["hu"]
    x = int(left + (350 - low) / (high - low) * width)
    y = int(top + (1 - 0.4 ** 0.5) * height)
    viewer.hands(f"mousemove {x} {y} mousedown 1")
    report("dragging a point", latencies(viewer, lambda i: viewer.hands(f"mousemove {x} {y - 1 - i % 40}"), count))
    viewer.hands("mouseup 1")


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    what, program, path = sys.argv[1:4]
    numbers = [int(word) for word in sys.argv[4:]]
    viewer = Viewer(program, path)
    if what == "latency":
        latency(viewer, numbers[0] if numbers else 60)
    elif what == "start":
        viewer.wait(lambda s: s["phase"] == "ready" and s["frames"] > 0)
        first = time.time() - viewer.begun
        viewer.refined()
        print(f"first picture {first:.2f} s, refined {time.time() - viewer.begun:.2f} s")
    elif what == "idle":
        viewer.refined()
        time.sleep(1)
        before = viewer.seconds_used()
        time.sleep(10)
        print(f"{10 * (viewer.seconds_used() - before):.2f} % of a processor")
    elif what == "soak":
        soak(viewer, numbers[0] if numbers else 10000, numbers[1] if len(numbers) > 1 else 1)
    code = viewer.end()
    print(f"exit code {code}")
    sys.exit(0 if code == 0 else 1)


if __name__ == "__main__":
    main()
