// Sets the pictures of moving scenes in motion: all of one scene in step, by one slider. Nothing moves by itself.
document.querySelectorAll(".player").forEach((player) => {
  const TAIL = 1500;
  const clips = [...player.parentElement.querySelectorAll("figure.clip")].map((figure) => {
    const { origin, scale, tracks } = JSON.parse(figure.querySelector("script.tracks").textContent);
    const svg = figure.querySelector("svg.moving");
    const bodies = tracks.bodies.map((steps) => {
      const places = [];
      for (let i = 0, x = 0, y = 0; i < steps.length; i += 2) {
        x += steps[i];
        y += steps[i + 1];
        places.push([origin[0] + x * scale, origin[1] - y * scale]);
      }
      return places;
    });
    const discs = [...svg.querySelectorAll(".body")].map((disc) => {
      const own = disc.querySelector(".own");
      let tail = null;
      if (own) {
        tail = document.createElementNS(svg.namespaceURI, "path");
        tail.setAttribute("class", `line tail ${[...own.classList].find((name) => /^c\d$/.test(name))}`);
        disc.before(tail);
      }
      return { disc, tail, places: bodies[Number(disc.dataset.body)] };
    });
    return { svg, tracks, discs, hits: [...svg.querySelectorAll(".hit")], seen: true };
  });
  if (!clips.length) return;
  const end = Math.max(...clips.map((clip) => clip.tracks.end));
  const slider = player.querySelector("input");
  const output = player.querySelector("output");
  const play = player.querySelector("[data-play]");
  const shown = (ms) => `${(ms / 1000).toFixed(1)}\u00a0s`;
  let [now, speed, playing, last] = [end, 1, false, 0];

  const place = ({ places }, { step, end: over }, ms) => {
    const n = places.length - 1;
    if (ms >= over || n < 1) return [places[n], n];
    const i = Math.min(Math.floor(ms / step), n - 1);
    const share = (ms - i * step) / ((i === n - 1 ? over : (i + 1) * step) - i * step);
    return [places[i].map((v, k) => v + share * (places[i + 1][k] - v)), i];
  };
  const draw = (clip) => {
    const under = now < clip.tracks.end;
    clip.svg.classList.toggle("under-way", under);
    clip.discs.forEach((body) => {
      const [at, i] = place(body, clip.tracks, now);
      body.disc.setAttribute("transform", `translate(${at[0].toFixed(1)} ${at[1].toFixed(1)})`);
      if (!body.tail) return;
      const from = Math.max(0, Math.ceil((now - TAIL) / clip.tracks.step));
      const past = under ? [...body.places.slice(from, i + 1), at] : [];
      body.tail.setAttribute("d", past.length > 1 ? `M${past.map((p) => p.map((v) => v.toFixed(1)).join(" ")).join("L")}` : "");
    });
    clip.hits.forEach((hit) => hit.classList.toggle("later", Number(hit.dataset.ms) > now));
  };
  const show = (ms) => {
    now = Math.min(Math.max(ms, 0), end);
    slider.value = now;
    output.textContent = `${shown(now)} / ${shown(end)}`;
    slider.setAttribute("aria-valuetext", shown(now));
    clips.filter((clip) => clip.seen).forEach(draw);
  };
  const frame = (at) => {
    if (!playing) return;
    show(now + speed * (at - last));
    last = at;
    if (now >= end) return halt();
    requestAnimationFrame(frame);
  };
  const halt = () => {
    playing = false;
    delete play.dataset.playing;
    play.setAttribute("aria-label", play.dataset.playLabel);
  };
  const go = () => {
    if (now >= end) show(0);
    playing = true;
    play.dataset.playing = "";
    play.setAttribute("aria-label", play.dataset.pauseLabel);
    last = performance.now();
    requestAnimationFrame(frame);
  };
  play.addEventListener("click", () => (playing ? halt() : go()));
  slider.addEventListener("input", () => { halt(); show(Number(slider.value)); });
  player.querySelectorAll("[data-step]").forEach((button) => button.addEventListener("click", () => {
    halt();
    const step = Number(slider.step);
    show((Math.round(now / step) + Number(button.dataset.step)) * step);
  }));
  player.querySelectorAll("[data-speed]").forEach((button) => button.addEventListener("click", () => {
    speed = Number(button.dataset.speed);
    player.querySelectorAll("[data-speed]").forEach((other) => other.setAttribute("aria-pressed", String(other === button)));
  }));
  addEventListener("beforeprint", () => { halt(); show(end); });
  // What is out of sight does not move; it is brought up to date when it comes into sight.
  const sight = new IntersectionObserver((entries) => entries.forEach((entry) => {
    const clip = clips.find((other) => other.svg === entry.target);
    clip.seen = entry.isIntersecting;
    if (clip.seen) draw(clip);
  }), { rootMargin: "200px" });
  clips.forEach((clip) => sight.observe(clip.svg));
  slider.max = Math.ceil(end / Number(slider.step)) * Number(slider.step);
  player.hidden = false;
  show(end);
});
