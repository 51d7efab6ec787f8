// Light and dark, by the system or by the button; layout by size; paper.

const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
const dark_wanted = matchMedia("(prefers-color-scheme: dark)");
const is_dark = () => (document.documentElement.dataset.theme ?? (dark_wanted.matches ? "dark" : "light")) === "dark";

/** Calls `layout` when a box changes its size (of the strips only the width: their height follows from it). */
function watch_size(box, size, layout) {
  let before = size(box);
  new ResizeObserver(() => {
    if (size(box) === before) return;
    before = size(box);
    layout();
  }).observe(box);
}

/** Takes up button, system and printing. `recolour` is called when colours have changed, `layout` when the width has. */
function watch_theme(recolour, layout) {
  const root = document.documentElement;
  const show = () => { by_id("theme").textContent = is_dark() ? "Light" : "Dark"; recolour(); };
  by_id("theme").addEventListener("click", () => { root.dataset.theme = is_dark() ? "light" : "dark"; show(); });
  dark_wanted.addEventListener("change", show);
  watch_paper(root, show, layout);
  show();
}

/** Printing: light, in the width of the paper, nothing folded away. */
function watch_paper(root, show, layout) {
  let theme, folded = [];
  window.addEventListener("beforeprint", () => {
    theme = root.dataset.theme;
    folded = [...document.querySelectorAll("details:not([open])")];
    for (const box of folded) box.open = true;
    root.dataset.theme = "light";
    root.classList.add("paper");
    show();
    layout();
  });
  window.addEventListener("afterprint", () => {
    for (const box of folded) box.open = false;
    if (theme) root.dataset.theme = theme; else delete root.dataset.theme;
    root.classList.remove("paper");
    show();
    layout();
  });
}
