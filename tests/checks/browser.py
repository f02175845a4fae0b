"""Opens pages of grainsweep in headless Chromium and says what is wrong with them.

usage: browser.py [--axe axe.min.js] PAGE.html...

Of each page: no error in the console, no dialog, no request for anything, every figure of its
folder has been drawn and is that file, the table of packings sorts and filters; a bed turns, its
slider, its colours and its forces change what is seen; with scripts off everything is there to read;
printed, a picture stands in for the bed; light and wide, dark and narrow, axe-core finds nothing. Talks to Chromium through its debugging pipe, so that nothing but Python is needed.
"""
import base64, hashlib, json, os, pathlib, re, shutil, subprocess, sys, tempfile, time

PATIENCE = 30.0  # s, for whatever a page does; a loaded machine needs some of it


class Browser:
    def __init__(self, profile):
        to_browser, self.write_end = os.pipe()
        self.read_end, from_browser = os.pipe()

        def hand_over():
            kept = os.dup(to_browser), os.dup(from_browser)
            os.dup2(kept[0], 3)
            os.dup2(kept[1], 4)

        self.process = subprocess.Popen(
            [shutil.which("chromium"), "--headless=new", "--no-sandbox", "--remote-debugging-pipe",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run",
             "--disable-background-networking", "--hide-scrollbars",
             f"--user-data-dir={profile}", "--window-size=1200,900", "about:blank"],
            preexec_fn=hand_over, close_fds=False,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.number, self.rest, self.events = 0, b"", []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.page(f"{domain}.enable")

    def call(self, method, session=None, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.write_end, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.next_message()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def next_message(self):
        while b"\0" not in self.rest:
            more = os.read(self.read_end, 1 << 20)
            if not more:
                raise RuntimeError("Chromium has gone")
            self.rest += more
        message, self.rest = self.rest.split(b"\0", 1)
        return json.loads(message)

    def page(self, method, **parameters):
        return self.call(method, self.session, **parameters)

    def open(self, path):
        self.events = []
        self.page("Page.navigate", url=pathlib.Path(path).resolve().as_uri())
        self.wait_for("document.readyState === 'complete' && location.protocol === 'file:'")

    def value(self, expression):
        answer = self.page("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def wait_for(self, expression):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if self.value(expression):
                return True
            time.sleep(0.05)
        return False

    def close(self):
        self.process.kill()
        self.process.wait()


# Different colours in a picture, an <img> or a <canvas>; a blank one has one or two.
COLOURS = """(picture) => {
  const canvas = document.createElement("canvas");
  canvas.width = 300; canvas.height = 200;
  const context = canvas.getContext("2d");
  context.drawImage(picture, 0, 0, 300, 200);
  const data = context.getImageData(0, 0, 300, 200).data;
  const seen = new Set();
  for (let k = 0; k < data.length; k += 4) seen.add(data[k] * 65536 + data[k + 1] * 256 + data[k + 2]);
  return seen.size;
}"""
# How far from the upper edge coloured pixels are, on the mean.
HEIGHT = """(canvas) => {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [300, 200];
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0, 300, 200);
  const data = context.getImageData(0, 0, 300, 200).data;
  let [sum, count] = [0, 0];
  for (let k = 0; k < data.length; k += 4) {
    const parts = [data[k], data[k + 1], data[k + 2]];
    if (Math.max(...parts) - Math.min(...parts) < 30) continue;
    sum += Math.floor(k / 1200);
    count += 1;
  }
  return sum / Math.max(count, 1);
}"""
CANVAS = "document.getElementById('bed-canvas')"


def look(browser):
    """What the canvas of the bed shows, once it has been drawn anew."""
    browser.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return hashlib.sha256(browser.value(f"{CANVAS}.toDataURL()").encode()).hexdigest()


def change(browser, element, value, event="change"):
    browser.value(f"{{ const e = document.getElementById('{element}'); e.value = '{value}';"
                  f" e.dispatchEvent(new Event('{event}')); }}")
    return look(browser)


def press(browser, key):
    browser.value(f"{CANVAS}.dispatchEvent(new KeyboardEvent('keydown', {{ {key} }}))")


def check_forces(browser, faults, seen):
    forces = change(browser, "bed-show", "forces")
    if forces in seen or browser.value(f"({COLOURS})({CANVAS})") < 50:
        faults.append("the forces between grains are not shown")
    if "m g" not in browser.value("document.getElementById('bed-key').textContent"):
        faults.append("nothing says how large the forces are")
    if change(browser, "bed-slice", 40, "input") == forces:
        faults.append("the slider does not cut the forces")
    change(browser, "bed-slice", 100, "input")
    change(browser, "bed-show", "grains")


def check_bed(browser, faults):
    if not browser.wait_for(f"!!{CANVAS} && document.getElementById('bed').classList.contains('turning')"):
        faults.append("the bed is never drawn")
        return
    first = look(browser)
    if browser.value(f"({COLOURS})({CANVAS})") < 50:
        faults.append("the canvas of the bed is blank")
    if browser.value("getComputedStyle(document.getElementById('bed-picture')).display") != "none":
        faults.append("the picture stands beside the bed that turns")
    whole = browser.value(f"({HEIGHT})({CANVAS})")
    if change(browser, "bed-slice", 40, "input") == first:
        faults.append("the slider changes nothing")
    if browser.value("document.getElementById('bed-kept').textContent") != "40 %":
        faults.append("the slider does not say how much it keeps")
    if browser.value(f"({HEIGHT})({CANVAS})") >= whole:  # what is far away stands high
        faults.append("the cut opens the side that is turned away")
    change(browser, "bed-slice", 100, "input")
    offered = "[...document.getElementById('bed-colour').options].filter((o) => !o.disabled).map((o) => o.value)"
    at_first = browser.value("document.getElementById('bed-colour').value")
    seen = {first}
    for colour in browser.value(offered):
        if colour != at_first:
            seen.add(change(browser, "bed-colour", colour))
    if len(seen) < 4 or len(seen) != len(browser.value(offered)):
        faults.append(f"the colours {browser.value(offered)} show {len(seen)} different pictures")
    check_forces(browser, faults, seen)
    change(browser, "bed-colour", at_first)
    if look(browser) != first:
        faults.append("the first view does not come back")
    press(browser, "key: 'ArrowLeft'")
    if look(browser) == first:
        faults.append("an arrow key does not turn the bed")
    press(browser, "key: '0'")
    press(browser, "key: 'ArrowLeft', shiftKey: true")
    if look(browser) == first:
        faults.append("with shift an arrow key does not move the bed")
    press(browser, "key: '0'")
    if look(browser) != first:
        faults.append("0 does not bring the first view back")
    for number in range(1, browser.value("document.getElementById('bed-choice').length")):
        before = look(browser)
        if change(browser, "bed-choice", number) == before:
            faults.append(f"bed {number} looks like the one before")


def check_phrases(browser, shown, faults):
    """What the filter finds: a whole number of the parameters, and two phrases at once."""
    titles = browser.value("[...document.querySelectorAll('#packings tbody tr')]"
                           ".map((row) => row.cells[2].textContent)")
    extents = [extent[0] if (extent := re.findall(r"[WD] = [\d.]+", title)) else ""
               for title in titles]
    for extent in set(extents) - {""}:
        for typed in (extent, extent.lower().replace(" ", "") + " , "):
            browser.value("{ const e = document.getElementById('filter');"
                          f" e.value = '{typed}'; e.dispatchEvent(new Event('input')); }}")
            if browser.value(shown) != extents.count(extent):
                faults.append(f"'{typed}' shows {browser.value(shown)} rows,"
                              f" {extents.count(extent)} have it")


def check_table(browser, faults):
    column = browser.value("[...document.querySelectorAll('#packings thead th')]"
                           ".findIndex((heading) => heading.textContent === 'Z')")
    cells = ("[...document.querySelectorAll('#packings tbody tr')]"
             f".map((row) => row.cells[{column}].textContent)")
    rows = browser.value(f"{cells}.length")
    if rows < 2:
        return
    for _ in range(2):
        browser.value(f"document.querySelectorAll('#packings thead button')[{column}].click()")
    numbers = [float(text) for text in browser.value(cells) if text != "-"]
    if numbers != sorted(numbers, reverse=True):
        faults.append("the table does not sort")
    shown = "[...document.querySelectorAll('#packings tbody tr')].filter((row) => !row.hidden).length"
    browser.value("{ const e = document.getElementById('filter'); e.value = 'no such words';"
                  " e.dispatchEvent(new Event('input')); }")
    if browser.value(shown) != 0:
        faults.append("the table does not filter")
    check_phrases(browser, shown, faults)


def check_figures(browser, path, faults):
    drawn = {file.stem: "data:image/svg+xml;base64," + base64.b64encode(file.read_bytes()).decode()
             for file in (pathlib.Path(path).parent / "figures").glob("*.svg")}
    shown = browser.value("Object.fromEntries([...document.querySelectorAll('figure img')]"
                          ".map((image) => [image.closest('figure').id.slice(7), image.src]))")
    if drawn != shown:
        faults.append(f"the page shows {sorted(shown)}, figures/ has {sorted(drawn)}, or others")
    blank = browser.value(
        f"[...document.querySelectorAll('figure img')].filter((image) => ({COLOURS})(image) < 8)"
        ".map((image) => image.closest('figure').id)")
    faults.extend(f"{name} is blank" for name in blank)
    faults.extend(browser.value(
        "[...document.querySelectorAll('figure')].filter((figure) => !figure.querySelector('img') &&"
        " !figure.textContent.includes('Not determined')).map((figure) => figure.id + ' is missing')"))
    if browser.value("[...document.querySelectorAll('img')].some((image) => !image.alt)"):
        faults.append("a picture has no words in its place")
    if browser.value("document.documentElement.scrollWidth > innerWidth"):
        faults.append("the page is wider than the window")


def check_events(browser, faults):
    for event in browser.events:
        kind, what = event.get("method"), event.get("params", {})
        if kind == "Runtime.exceptionThrown":
            faults.append(f"error: {what['exceptionDetails'].get('exception', what)}")
        elif kind == "Log.entryAdded" and what["entry"]["level"] == "error":
            faults.append(f"error in the console: {what['entry']['text']}")
        elif kind == "Runtime.consoleAPICalled" and what["type"] == "error":
            faults.append(f"error in the console: {what['args']}")
        elif kind == "Page.javascriptDialogOpening":
            faults.append(f"a dialog: {what['message']}")
        elif kind == "Network.requestWillBeSent":
            url = what["request"]["url"]
            if not url.startswith("data:") and what.get("type") != "Document":
                faults.append(f"a request: {url}")


def set_screen(browser, width, scheme="light"):
    browser.page("Emulation.setDeviceMetricsOverride", width=width, height=800, deviceScaleFactor=1,
                 mobile=width < 500)
    browser.page("Emulation.setEmulatedMedia",
                 features=[{"name": "prefers-color-scheme", "value": scheme}])


def check_access(browser, axe, faults):
    """What axe-core says that people with a disability could not use."""
    browser.page("Runtime.evaluate", expression=axe)
    for width, scheme in ((1200, "light"), (360, "dark")):
        set_screen(browser, width, scheme)
        found = json.loads(browser.value(
            "axe.run().then((report) => JSON.stringify(report.violations.map((one) =>"
            " one.impact + ': ' + one.help + ': ' + one.nodes[0].html.slice(0, 200))))"))
        faults.extend(f"{scheme}, {width} px, {one}" for one in found)
    set_screen(browser, 1200)


def check_printed(browser, faults):
    browser.page("Emulation.setEmulatedMedia", media="print")
    if browser.value(f"getComputedStyle({CANVAS}).display") != "none":
        faults.append("printed, the bed is no picture")
    if browser.value("getComputedStyle(document.getElementById('bed-picture')).display") == "none":
        faults.append("printed, there is no picture of the bed")
    browser.page("Emulation.setEmulatedMedia", media="")


CONTENT = """({ images: [...document.images].filter((image) => image.naturalWidth > 0).length,
  rows: document.querySelectorAll('tbody tr').length })"""


def check(browser, path, axe):
    faults = []
    browser.page("Emulation.setScriptExecutionDisabled", value=True)
    browser.open(path)
    plain = browser.value("document.body.innerText")
    is_report = path.endswith("report.html")
    for words in ("How this was made", "Packings", "Means") if is_report else ():
        if words not in plain:
            faults.append(f'without scripts "{words}" is not there')
    content = browser.value(CONTENT)
    controls = "document.getElementById('bed-controls')"
    if browser.value(f"!!{controls} && getComputedStyle({controls}).display !== 'none'"):
        faults.append("without scripts the controls of the bed are shown")
    browser.page("Emulation.setScriptExecutionDisabled", value=False)
    browser.open(path)
    if browser.value(CONTENT) != content:
        faults.append(f"without scripts there is only {content}")
    check_figures(browser, path, faults)
    check_table(browser, faults)
    if browser.value("!!document.getElementById('bed-stage')"):
        check_bed(browser, faults)
        check_printed(browser, faults)
    set_screen(browser, 360)
    if browser.value("document.documentElement.scrollWidth > innerWidth"):
        faults.append("on a phone the page is wider than the screen")
    if axe:
        check_access(browser, axe, faults)
    browser.page("Emulation.clearDeviceMetricsOverride")
    check_events(browser, faults)
    return faults


def main(arguments):
    axe, paths = "", arguments
    if arguments[0] == "--axe":
        axe, paths = pathlib.Path(arguments[1]).read_text(), arguments[2:]
    failed = False
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(profile)
        try:
            for path in paths:
                faults = check(browser, path, axe)
                failed = failed or bool(faults)
                for fault in faults:
                    print(f"{path}: {fault}", file=sys.stderr)
        finally:
            browser.close()
    return 1 if failed else 0


sys.exit(main(sys.argv[1:]))
