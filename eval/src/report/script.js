// Conveniences only: the page is complete without them.
(() => {
  const root = document.documentElement;
  const theme = document.getElementById("theme");
  theme.hidden = false;
  theme.addEventListener("click", () => {
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
  });

  // A link to a scene in a closed box opens the box.
  const reveal = () => {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    for (let box = target; box; box = box.parentElement) {
      if (box.tagName === "DETAILS" && !box.classList.contains("menu")) box.open = true;
    }
    document.querySelectorAll("details.menu").forEach((menu) => { menu.open = false; });
  };
  addEventListener("hashchange", reveal);
  reveal();
  addEventListener("beforeprint", () => document.querySelectorAll("details.settings").forEach((d) => { d.open = true; }));

  document.querySelectorAll(".toggled .key").forEach((key) => {
    key.disabled = false;
    key.setAttribute("aria-pressed", "true");
    key.addEventListener("click", () => {
      const on = key.getAttribute("aria-pressed") !== "true";
      key.setAttribute("aria-pressed", String(on));
      key.closest("figure").querySelectorAll(`[data-series="${key.dataset.toggle}"]`)
        .forEach((line) => line.classList.toggle("off", !on));
    });
  });

  // A picture for slides: with the rules and colours as they are on the page.
  const save = (svg) => {
    const copy = svg.cloneNode(true);
    const [, , width, height] = svg.getAttribute("viewBox").split(" ");
    const colours = getComputedStyle(root);
    const style = document.createElementNS(svg.namespaceURI, "style");
    style.textContent = document.querySelector("style").textContent.replace(/@media[^{]*\{(?:[^{}]*\{[^{}]*\})*\s*\}/g, "")
      .replace(/var\((--\w+)\)/g, (_, name) => colours.getPropertyValue(name));
    copy.setAttribute("style", `background:${colours.getPropertyValue("--paper")}`);
    copy.setAttribute("width", width);
    copy.setAttribute("height", height);
    copy.prepend(style);
    copy.querySelectorAll("use").forEach((use) => {
      const id = use.getAttribute("href");
      if (!copy.querySelector(id)) use.replaceWith(document.querySelector(id).cloneNode(true));
    });
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([new XMLSerializer().serializeToString(copy)], { type: "image/svg+xml" }));
    link.download = `${document.title} ${copy.querySelector("title").textContent}.svg`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  document.querySelectorAll("figure > svg.fig").forEach((svg) => {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "save";
    button.textContent = document.body.dataset.save;
    button.addEventListener("click", () => save(svg));
    svg.parentNode.append(button);
  });

  document.querySelectorAll(".command .copy").forEach((button) => {
    const words = button.textContent;
    button.hidden = false;
    button.addEventListener("click", async () => {
      const code = button.previousElementSibling;
      getSelection().selectAllChildren(code);
      // Pages from files have no clipboard in some browsers: what is selected is copied instead.
      try { await navigator.clipboard.writeText(code.textContent); } catch { document.execCommand("copy"); }
      button.textContent = document.body.dataset.copied;
      setTimeout(() => { button.textContent = words; }, 2000);
    });
  });

  // Rows by their first cell or any text, columns by their head, and only what has failures.
  document.querySelectorAll(".filters").forEach((filters) => {
    const table = document.getElementById(filters.dataset.for);
    const field = (name) => filters.querySelector(`[data-filter=${name}]`);
    const text = (name) => (field(name) ? field(name).value.trim().toLowerCase() : "");
    const heads = [...table.tHead.rows[0].cells];
    const rows = [...table.tBodies[0].rows];
    const status = filters.querySelector(".matches");
    filters.hidden = false;
    const apply = () => {
      const [any, first, column] = [text("text"), text("row"), text("column")];
      const failures = field("failures") && field("failures").checked;
      const named = heads.map((head, i) => i < 2 || head.textContent.toLowerCase().includes(column));
      const failing = (row, i) => row.cells[i].classList.contains("failing");
      const shown = rows.filter((row) => row.textContent.toLowerCase().includes(any)
        && row.cells[0].textContent.toLowerCase().includes(first)
        && (!failures || [...row.cells].some((_, i) => named[i] && failing(row, i))));
      const kept = field("column")
        ? named.map((name, i) => name && (i < 2 || !failures || shown.some((row) => failing(row, i)))) : null;
      rows.forEach((row) => { row.hidden = !shown.includes(row); });
      if (kept) [table.tHead.rows[0], ...rows].forEach((row) => [...row.cells].forEach((cell, i) => { cell.hidden = !kept[i]; }));
      if (status) status.textContent = `${document.body.dataset.matches} ${shown.length}/${rows.length}`;
    };
    filters.addEventListener("input", apply);
    apply();
  });

  document.querySelectorAll("table.sortable").forEach((table) => {
    const body = table.tBodies[0];
    const initial = [...body.rows];
    [...table.tHead.rows[0].cells].forEach((head, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => {
        // Upwards, downwards, as it was.
        const next = { ascending: "descending", descending: "none" }[head.getAttribute("aria-sort")] || "ascending";
        [...table.tHead.rows[0].cells].forEach((other) => other.removeAttribute("aria-sort"));
        if (next !== "none") head.setAttribute("aria-sort", next);
        const sign = next === "descending" ? -1 : 1;
        const key = (row) => row.cells[column].dataset.v;
        const order = next === "none" ? initial : [...initial].sort((a, b) => {
          const [x, y] = [key(a), key(b)];
          if (x === undefined) return sign * a.cells[column].textContent.localeCompare(b.cells[column].textContent);
          return x === y ? 0 : sign * (Number(x) < Number(y) ? -1 : 1);
        });
        body.append(...order);
      });
    });
  });
})();
