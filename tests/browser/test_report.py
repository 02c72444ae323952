"""Opens reports in a real browser: python3 test_report.py REPORT.html...

From file://, at 1280 and 390 px, light and dark, with and without JavaScript: nothing is loaded from elsewhere, nothing
complains, nothing is wider than the window, every figure is drawn with its words inside, every link leads somewhere;
and all controls work by keyboard.
"""

import pathlib
import sys

from chromium import Browser, Page, find

# What is wrong with the page as it stands, as a list of sentences.
FAULTS = r"""
(() => {
  const faults = [];
  const say = (text) => { if (faults.length < 20) faults.push(text); };
  const root = document.documentElement;
  const wide = (what) => {
    if (root.scrollWidth > innerWidth) {
      const boxed = (e) => e.closest(".scroll, pre, svg, [hidden]");
      const worst = [...document.querySelectorAll("main *, header *, nav *")]
        .filter((e) => !boxed(e) && e.getBoundingClientRect().right > innerWidth + 1)[0];
      say(`${what}: ${root.scrollWidth} px wide in ${innerWidth}, by ${worst && worst.outerHTML.slice(0, 120)}`);
    }
  };
  wide("as it opens");
  document.querySelectorAll("details").forEach((d) => { d.open = true; });
  wide("with everything open");
  const name = (svg) => (svg.querySelector("title") || svg).textContent.slice(0, 80);
  const figures = [...document.querySelectorAll("figure")];
  for (const figure of figures) {
    const svg = figure.querySelector(":scope > svg.fig");
    if (!svg) { say(`a figure without picture: ${figure.outerHTML.slice(0, 120)}`); continue; }
    const frame = svg.getBoundingClientRect();
    if (frame.width < 100 || frame.height < 40) say(`${name(svg)}: drawn ${frame.width} × ${frame.height} px`);
    const marks = [...svg.querySelectorAll("path, circle, rect, use")].filter((mark) => {
      if (mark.closest("clipPath, defs") || mark.matches(".grid, .ground, .field")) return false;
      const box = mark.getBoundingClientRect();
      return box.width + box.height > 0 && getComputedStyle(mark).display !== "none";
    });
    if (!marks.length) say(`${name(svg)}: nothing is drawn`);
    if (!figure.querySelector("figcaption").textContent.trim()) say(`${name(svg)}: no caption`);
    for (const text of svg.querySelectorAll("text")) {
      const box = text.getBoundingClientRect();
      // A pixel for what browsers round.
      if (box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 || box.bottom > frame.bottom + 1) {
        say(`${name(svg)}: "${text.textContent}" is cut off at ${innerWidth} px`);
      }
    }
  }
  for (const link of document.querySelectorAll("a[href], use[href]")) {
    const target = link.getAttribute("href");
    if (!target.startsWith("#") || !document.getElementById(decodeURIComponent(target.slice(1)))) say(`${target} leads nowhere`);
  }
  const ids = [...document.querySelectorAll("[id]")].map((e) => e.id);
  if (new Set(ids).size !== ids.length) say("two elements of one id");
  if (!document.querySelector("h1").textContent.trim()) say("no title");
  if (!figures.length) say("no figure at all");
  return faults;
})()
"""

GROUND = "getComputedStyle(document.body).backgroundColor"


def static(page):
    """What must not be there without JavaScript: controls that would do nothing."""
    dead = page.run("""[...document.querySelectorAll("button, input")]
        .filter((e) => !e.disabled && e.getBoundingClientRect().width > 0).map((e) => e.outerHTML.slice(0, 80))""")
    return [f"a dead control: {html}" for html in dead]


def keyboard(page):
    """Every control, by keyboard alone."""
    faults = []

    def expect(what, condition):
        if not page.run(condition):
            faults.append(f"by keyboard: {what}")

    def focus(selector):
        return page.run(f"(() => {{ const e = document.querySelector({selector!r}); if (!e) return false;"
                        " e.focus(); return document.activeElement === e; })()")

    page.press("Tab")
    expect("the first stop is the way past the navigation", "document.activeElement.className === 'skip'")
    before = page.run(GROUND)
    if focus("#theme"):
        page.press("Enter")
        expect("the theme changes", f"{GROUND} !== {before!r}")
        page.press("Enter")
    else:
        faults.append("by keyboard: no theme button")
    page.run("document.querySelectorAll('main details').forEach((d) => { d.open = true; })")
    for table in page.run("[...document.querySelectorAll('table.sortable')].map((t) => t.id).filter((id) => id)"):
        if not focus(f"#{table} thead th:nth-child(3) button"):
            faults.append(f"by keyboard: {table} does not sort")
            continue
        page.press("Enter")
        order = f"""(() => {{ const rows = [...document.getElementById({table!r}).tBodies[0].rows];
            const keys = rows.map((r) => r.cells[2].dataset.v === undefined ? r.cells[2].textContent : Number(r.cells[2].dataset.v));
            return keys.every((k, i) => !i || (typeof k === "string" ? keys[i - 1].localeCompare(k) <= 0 : keys[i - 1] <= k)); }})()"""
        expect(f"{table} is sorted", order)
        expect(f"{table} says so", f"document.querySelector('#{table} [aria-sort=ascending]') !== null")
    if focus(".filters[data-for=matrix] [data-filter=row]"):
        shown = "[...document.getElementById('matrix').tBodies[0].rows].filter((r) => !r.hidden)"
        wanted = page.run(f"{shown}.at(-1).cells[0].querySelector('a').textContent")
        page.type(wanted)
        expect("the scenes are filtered", f"{shown}.length >= 1 && {shown}.every((r) => r.cells[0].textContent.includes({wanted!r}))")
        page.run("(() => { const f = document.querySelector('.filters[data-for=matrix] [data-filter=row]');"
                 " f.value = ''; f.dispatchEvent(new Event('input', { bubbles: true })); })()")
        focus(".filters[data-for=matrix] [data-filter=failures]")
        page.press(" ")
        expect("only failures are left", f"{shown}.every((r) => r.querySelector('.failing'))")
        page.press(" ")
    if focus(".toggled .key"):
        page.press("Enter")
        expect("a series is hidden", "document.querySelector('.toggled [data-series].off') !== null")
        page.press("Enter")
    page.run("URL.createObjectURL = (blob) => { blob.text().then((text) => { window.saved = text; }); return '#'; }")
    for n in range(min(3, page.run("document.querySelectorAll('.save').length"))):
        page.run(f"window.saved = null; document.querySelectorAll('.save')[{n}].focus()")
        page.press("Enter")
        page.run("new Promise((done) => setTimeout(done, 100))")
        expect(f"figure {n} is saved as SVG", """window.saved !== null && !window.saved.includes("var(--") &&
            new DOMParser().parseFromString(window.saved, "image/svg+xml").documentElement.tagName === "svg" &&
            !/<use[^>]*href="#key/.test(window.saved)""")
    if focus(".player input"):
        faults += playback(page, expect, focus)
    if focus(".command .copy"):
        page.press("Enter")
        page.run("new Promise((done) => setTimeout(done, 100))")
        expect("a command is copied", "document.activeElement.textContent === document.body.dataset.copied")
    return faults


def playback(page, expect, focus):
    """Pictures of moving scenes, set in motion by the slider and the buttons."""
    pause = "new Promise((done) => setTimeout(done, 100))"
    places = ("JSON.stringify([...document.querySelector('.player').parentElement.querySelectorAll('.body')]"
              ".map((body) => body.getAttribute('transform')))")
    now = "Number(document.querySelector('.player input').value)"
    page.run("document.querySelector('.player').scrollIntoView()")
    page.run(pause)
    written, end = page.run(places), page.run(now)
    expect("the slider begins at the end", "document.querySelector('.player input').value > 0")
    # So far that every picture moves, also of simulations that end before the others.
    for _ in range(40):
        page.press("ArrowLeft")
    expect("the slider goes back", f"{now} < {end} && {places} !== {written!r}")
    expect("the slider says the time", "/[0-9]\\ss$/.test(document.querySelector('.player input').getAttribute('aria-valuetext'))")
    page.press("Home")
    expect("the slider goes to the start", f"{now} === 0")
    expect("contacts to come are hidden", "document.querySelectorAll('.moving.under-way .hit:not(.later)').length === 0")
    focus(".player [data-step='1']")
    page.press("Enter")
    expect("a step forward", f"{now} === 50")
    focus(".player [data-step='-1']")
    page.press("Enter")
    expect("a step back", f"{now} === 0")
    focus(".player [data-speed='2']")
    page.press("Enter")
    expect("another speed", "document.querySelector('.player [data-speed=\\'2\\']').getAttribute('aria-pressed') === 'true'")
    focus(".player [data-play]")
    page.press("Enter")
    page.run("new Promise((done) => setTimeout(done, 400))")
    expect("it plays", f"{now} > 0")
    page.press("Enter")
    page.run(pause)
    halted = page.run(now)
    page.run(pause)
    expect("it halts", f"{now} === {halted}")
    focus(".player input")
    page.press("End")
    expect("the end is the picture as written", f"{places} === {written!r}")
    small = """[...document.querySelectorAll('.player button, .player input')]
        .map((e) => e.getBoundingClientRect()).filter((box) => box.width < 44 || box.height < 44).length"""
    return [f"{page.run(small)} controls of the playback are too small to touch"] if page.run(small) else []


def examine(browser, url):
    """Every way to look at one report; the faults of all."""
    faults = []
    for width in (1280, 390):
        for scheme in ("light", "dark"):
            for scripts in (True, False):
                page = Page(browser, width, scheme, scripts)
                page.open(url)
                found = page.run(FAULTS)
                found += [] if scripts else static(page)
                dark = page.run(GROUND) == "rgb(20, 23, 26)"
                if dark != (scheme == "dark"):
                    found.append("the ground does not follow the wish for light or dark")
                if scripts and (width, scheme) in ((1280, "light"), (390, "dark")):
                    page.open(url)
                    found += keyboard(page)
                page.listen()
                found += page.complaints
                found += [f"asks for {u[:100]}" for u in page.requests if not u.startswith((url, "blob:", "data:"))]
                page.close()
                way = f"{width} px, {scheme}, {'with' if scripts else 'without'} JavaScript"
                faults += [f"{way}: {fault}" for fault in found]
    return faults


def main():
    reports = [pathlib.Path(name).resolve() for name in sys.argv[1:]]
    program = find()
    if not reports or not program:
        sys.exit("usage: test_report.py REPORT.html..., with chromium installed or named by CHROMIUM")
    browser = Browser(program)
    failed = 0
    try:
        for report in reports:
            faults = examine(browser, report.as_uri())
            failed += len(faults)
            print(f"{report.name}: {'ok' if not faults else ''}", flush=True)
            for fault in faults:
                print(f"    {fault}", flush=True)
    finally:
        browser.close()
    sys.exit(1 if failed else 0)


main()
