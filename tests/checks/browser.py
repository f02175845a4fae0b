"""Opens pages of grainsweep in headless Chromium and says what is wrong with them.

usage: browser.py PAGE.html...

Of each page: no error in the console, no request for anything, every figure has been drawn, the
table of packings sorts and filters; a bed turns, its slider and colours change what is seen; with
scripts off everything is there to read; printed, a picture stands in for the bed. Talks to Chromium
through its debugging pipe, so that nothing but Python is needed.
"""
import base64, hashlib, json, os, pathlib, shutil, subprocess, sys, tempfile, time

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
CANVAS = "document.getElementById('bed-canvas')"


def look(browser):
    """What the canvas of the bed shows, once it has been drawn anew."""
    browser.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return hashlib.sha256(browser.value(f"{CANVAS}.toDataURL()").encode()).hexdigest()


def change(browser, element, value, event="change"):
    browser.value(f"{{ const e = document.getElementById('{element}'); e.value = '{value}';"
                  f" e.dispatchEvent(new Event('{event}')); }}")
    return look(browser)


def check_bed(browser, faults):
    if not browser.wait_for(f"!!{CANVAS} && document.getElementById('bed').classList.contains('turning')"):
        faults.append("the bed is never drawn")
        return
    first = look(browser)
    if browser.value(f"({COLOURS})({CANVAS})") < 50:
        faults.append("the canvas of the bed is blank")
    if browser.value("getComputedStyle(document.getElementById('bed-picture')).display") != "none":
        faults.append("the picture stands beside the bed that turns")
    if change(browser, "bed-slice", 40, "input") == first:
        faults.append("the slider changes nothing")
    change(browser, "bed-slice", 100, "input")
    for colour in ("touching", "wall"):
        if change(browser, "bed-colour", colour) == first:
            faults.append(f"the colour {colour} changes nothing")
    change(browser, "bed-colour", "size")
    if look(browser) != first:
        faults.append("the first view does not come back")
    browser.value(f"{CANVAS}.dispatchEvent(new KeyboardEvent('keydown', {{ key: 'ArrowLeft' }}))")
    if look(browser) == first:
        faults.append("an arrow key does not turn the bed")
    for number in range(1, browser.value("document.getElementById('bed-choice').length")):
        before = look(browser)
        if change(browser, "bed-choice", number) == before:
            faults.append(f"bed {number} looks like the one before")


def check_table(browser, faults):
    cells = "[...document.querySelectorAll('#packings tbody tr')].map((row) => row.cells[7].textContent)"
    rows = browser.value(f"{cells}.length")
    if rows < 2:
        return
    for _ in range(2):
        browser.value("document.querySelectorAll('#packings thead button')[7].click()")
    numbers = [float(text) for text in browser.value(cells) if text != "-"]
    if numbers != sorted(numbers, reverse=True):
        faults.append("the table does not sort")
    shown = "[...document.querySelectorAll('#packings tbody tr')].filter((row) => !row.hidden).length"
    browser.value("{ const e = document.getElementById('filter'); e.value = 'no such words';"
                  " e.dispatchEvent(new Event('input')); }")
    if browser.value(shown) != 0:
        faults.append("the table does not filter")


def check_figures(browser, faults):
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
        elif kind == "Network.requestWillBeSent":
            url = what["request"]["url"]
            if not url.startswith("data:") and what.get("type") != "Document":
                faults.append(f"a request: {url}")


def check(browser, path):
    faults = []
    browser.page("Emulation.setScriptExecutionDisabled", value=True)
    browser.open(path)
    plain = browser.value("document.body.innerText")
    is_report = path.endswith("report.html")
    for words in ("How this was made", "Packings", "Means") if is_report else ():
        if words not in plain:
            faults.append(f'without scripts "{words}" is not there')
    has_bed = browser.value("!!document.getElementById('bed-stage')")
    if has_bed and not browser.value("document.getElementById('bed-picture').naturalWidth > 0"):
        faults.append("without scripts there is no picture of the bed")
    browser.page("Emulation.setScriptExecutionDisabled", value=False)
    browser.open(path)
    check_figures(browser, faults)
    check_table(browser, faults)
    if has_bed:
        check_bed(browser, faults)
        browser.page("Emulation.setEmulatedMedia", media="print")
        if browser.value(f"getComputedStyle({CANVAS}).display") != "none":
            faults.append("printed, the bed is no picture")
        browser.page("Emulation.setEmulatedMedia", media="")
    browser.page("Emulation.setDeviceMetricsOverride", width=360, height=700, deviceScaleFactor=2,
                 mobile=True)
    if browser.value("document.documentElement.scrollWidth > innerWidth"):
        faults.append("on a phone the page is wider than the screen")
    browser.page("Emulation.clearDeviceMetricsOverride")
    check_events(browser, faults)
    return faults


def main(paths):
    failed = False
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(profile)
        try:
            for path in paths:
                faults = check(browser, path)
                failed = failed or bool(faults)
                for fault in faults:
                    print(f"{path}: {fault}", file=sys.stderr)
        finally:
            browser.close()
    return 1 if failed else 0


sys.exit(main(sys.argv[1:]))
