"use strict";
// Moves what the page shows of the run. No "less than" and no "and" below: the page is to be well-formed XML, too.
for (const animation of document.querySelectorAll(".animation")) {
  const run = JSON.parse(animation.dataset.run);
  const end = run.times.at(-1);
  const find = (selector) => animation.querySelector(selector);
  const [button, slider, clock, robot] = ["button", "input", "output", ".robot"].map(find);
  const [truth, estimate] = [".truth.trail", ".trail:not(.truth)"].map(find);
  const films = [...animation.querySelectorAll(".film image")];

  const newest = (times) => Math.max(0, times.findLastIndex((time) => now >= time));
  const mix = (from, to, share) => from.map((value, i) => value + share * (to[i] - value));
  const draw = (trail, places, index, head) => {
    const points = [...places.slice(0, index + 1), head].map(([x, y]) => x + " " + y);
    trail?.setAttribute("d", "M" + points.join("L"));
  };

  let now = 0;
  const show = () => {
    const index = newest(run.times);
    const next = Math.min(index + 1, run.times.length - 1);
    const share = Math.min(1, (now - run.times[index]) / Math.max(1e-6, run.times[next] - run.times[index]));
    const at = (places) => mix(places[index], places[next], share);
    const [x, y, heading] = at(run.robot);
    robot.setAttribute("transform", `translate(${x} ${y}) rotate(${heading})`);
    draw(truth, run.robot, index, [x, y]);
    draw(estimate, run.estimate, index, at(run.estimate));
    const image = newest(run.images);
    for (const film of films) {
      const { width, height } = film.ownerSVGElement.viewBox.baseVal;
      film.setAttribute("x", -width * (image % run.columns));
      film.setAttribute("y", -height * Math.floor(image / run.columns));
    }
    slider.value = now;
    clock.textContent = now.toFixed(1) + " s";
    slider.setAttribute("aria-valuetext", clock.textContent);
  };

  let last = null;
  const step = (time) => {
    if (last === null) return;
    now = Math.min(end, now + run.speed * Math.max(0, time - last) * 1e-3);
    last = time;
    show();
    if (now >= end) pause();
    else requestAnimationFrame(step);
  };
  const label = (playing) => {
    button.className = playing ? "playing" : "";
    button.setAttribute("aria-label", playing ? "Pause" : "Play");
  };
  const play = () => {
    if (now >= end) now = 0;
    last = performance.now();
    label(true);
    requestAnimationFrame(step);
  };
  const pause = () => {
    last = null;
    label(false);
  };

  slider.max = end;
  button.onclick = () => (last === null ? play() : pause());
  slider.oninput = () => {
    pause();
    now = Number(slider.value);
    show();
  };
  find(".controls").hidden = false;
  show();
  // It starts by itself, once, when it comes into view.
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) {
    const watch = new IntersectionObserver(([entry]) => {
      if (!entry.isIntersecting) return;
      watch.disconnect();
      if (now === 0) play();
    }, { threshold: 0.5 });
    watch.observe(animation);
  }
}
