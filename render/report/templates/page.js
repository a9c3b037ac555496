"use strict";
// One bar moves all films: its places are the frames of the film that has most of them, and the others show what was
// there at that time.
(() => {
  const bar = document.querySelector(".bar");
  if (!bar) return;
  const films = [...document.querySelectorAll(".film[data-times]")].map((figure) => ({
    times: JSON.parse(figure.dataset.times),
    rate: Number(figure.dataset.rate),
    video: figure.querySelector("video"),
    picture: figure.querySelector(":scope > img"),
    pictures: JSON.parse(figure.querySelector("script")?.textContent || "[]"),
    label: figure.querySelector("output"),
  }));
  const leader = films.reduce((a, b) => (b.times.length > a.times.length ? b : a));
  const slider = bar.querySelector("input"), button = bar.querySelector("button"), label = bar.querySelector("output");
  const unit = bar.dataset.unit;
  const shown = (time) => Number(time.toPrecision(6)).toString() + unit;

  const frameAt = (film, time) => {
    let low = 0, high = film.times.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (film.times[middle] <= time + 1e-9 * Math.abs(time)) low = middle; else high = middle - 1;
    }
    return low;
  };
  const show = (place) => {
    const time = leader.times[place];
    slider.value = place;
    label.textContent = shown(time);
    slider.setAttribute("aria-valuetext", shown(time));
    for (const film of films) {
      const frame = frameAt(film, time);
      if (film.video) film.video.currentTime = (frame + 0.5) / film.rate;
      else film.picture.src = film.pictures[frame];
      film.label.textContent = shown(film.times[frame]);
    }
  };

  // A single film plays as its player likes best; several are moved frame by frame, so that they stay at one time.
  let timer = 0;
  const stop = () => {
    clearInterval(timer);
    timer = 0;
    button.textContent = "Play";
  };
  const play = () => {
    if (Number(slider.value) >= leader.times.length - 1) show(0);
    button.textContent = "Pause";
    timer = setInterval(() => {
      const next = Number(slider.value) + 1;
      if (next >= leader.times.length) return stop();
      if (films.every((film) => !film.video || !film.video.seeking)) show(next);
    }, 1000 / leader.rate);
  };
  button.addEventListener("click", () => (timer ? stop() : play()));
  slider.addEventListener("input", () => { stop(); show(Number(slider.value)); });
  for (const still of document.querySelectorAll(".stills button"))
    still.addEventListener("click", () => { stop(); show(frameAt(leader, Number(still.dataset.time))); });

  // Which of a film's two movies is shown follows the page's colours.
  const dark = matchMedia("(prefers-color-scheme: dark)");
  dark.addEventListener("change", () => {
    for (const { video } of films) {
      if (!video) continue;
      video.load();
      video.addEventListener("loadedmetadata", () => show(Number(slider.value)), { once: true });
    }
  });
  show(0);
})();
