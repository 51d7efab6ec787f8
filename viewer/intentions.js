// What each road user was thought to intend, over time: a strip of stacked bars, and a thin one for 1 s ahead.

const intention_order = ["FB", "LB", "RB", "stop", "LC", "RC", "cross", "M"];  // stacked from below; what is left goes on
const intention_height = 34, soon_height = 7, intention_gap = 2;
const longest_sight = 0.15;  // [s] that a judgement holds where none follows

/** The word for the likeliest in a row, with its probability; "" where nothing is known. */
function likeliest_words(of, row) {
  const best = row.indexOf(Math.max(...row));
  return best < 0 ? "" : `${intention_words[of[best]] ?? of[best]} ${percent(row[best])}`;
}

/** How far from going on somebody ever was. */
const most_active = (seen) => Math.max(0, ...seen.now.map((row) => 1 - (row[seen.of.indexOf("M")] ?? 0)));

const rows_at_first = 6;

class Intentions {
  constructor(record) {
    this.seen = [...record.intentions].sort((a, b) => (record.risk_of.get(b.actor) ?? 0) - (record.risk_of.get(a.actor) ?? 0) || most_active(b) - most_active(a));
    this.rows = [];
  }

  /** Puts one strip per road user where `strip` makes them, and the legend above them. */
  build(strip) {
    if (!this.seen.length) return;
    const used = intention_order.filter((name) => this.seen.some((one) => one.of.includes(name)));
    const legend = strip("Intentions", "thin: 1 s ahead", "intention-legend").track;
    legend.append(...used.map((name) => el("span", { class: "key" },
      el("i", { class: `swatch intends-${name}`, "aria-hidden": "true" }), intention_words[name] ?? name)));
    this.rows = this.seen.map((seen) => ({ seen, ...strip(seen.actor, "", "intentions") }));
    if (this.rows.length > rows_at_first) {
      legend.append(el("button", { type: "button", class: "link", id: "all-intentions", "aria-expanded": "false", onclick: () => this.fold(!this.folded) }));
      this.button = legend.lastChild;
      this.fold(true);
    }
  }

  /** Hides all but the first rows, or shows them all. */
  fold(folded) {
    this.folded = folded;
    this.button.setAttribute("aria-expanded", String(!folded));
    this.button.textContent = folded ? `All ${this.rows.length} road users` : `Only ${rows_at_first} road users`;
    this.rows.slice(rows_at_first).forEach(({ track }) => track.parentElement.classList.toggle("folded", folded));
  }

  layout(x, from, width) {
    for (const row of this.rows) this.draw(row, x, from, width);
  }

  draw({ seen, track }, x, from, width) {
    const height = intention_height + intention_gap + soon_height;
    const shapes = [...this.bars(seen, seen.now, 0, intention_height, x, from), ...this.bars(seen, seen.soon, intention_height + intention_gap, soon_height, x, from),
      ...this.words(seen, x, from)];
    track.replaceChildren(svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": this.summary(seen) }, shapes));
  }

  /** Until when the k-th judgement holds. */
  until(seen, k) {
    const next = seen.times[k + 1];
    return is_number(next) && next - seen.times[k] < longest_sight ? next : seen.times[k] + 0.1;
  }

  /** One path per intention: bars as wide as a judgement holds, stacked from below. */
  bars(seen, rows, top, height, x, from) {
    const path = new Map(intention_order.map((name) => [name, ""]));
    rows.forEach((row, k) => {
      const right = x(this.until(seen, k)), left = Math.max(0, x(seen.times[k]));
      if (this.until(seen, k) <= from) return;
      let below = 0;
      for (const name of intention_order) {
        const share = row[seen.of.indexOf(name)] ?? 0;
        if (share <= 0) continue;
        const low = top + height * (1 - below), high = top + height * Math.max(0, 1 - below - share);
        path.set(name, `${path.get(name)}M${left.toFixed(1)} ${low.toFixed(1)}V${high.toFixed(1)}H${right.toFixed(1)}V${low.toFixed(1)}Z`);
        below += share;
      }
    });
    return [...path].filter(([, d]) => d).map(([name, d]) => svg("path", { d, class: `intends-${name}` }));
  }

  /** Spans of time over which the same is likeliest. */
  spans(seen) {
    const all = [];
    seen.now.forEach((row, k) => {
      const name = seen.of[row.indexOf(Math.max(...row))], last = all[all.length - 1];
      if (last && last.name === name && seen.times[k] - last.to < 0.05) last.to = this.until(seen, k);
      else all.push({ name, from: seen.times[k], to: this.until(seen, k) });
    });
    return all;
  }

  /** What is likeliest stands in words where there is room: colour is never the only sign. */
  words(seen, x, from) {
    const room = (word) => 7 * word.length + 8;  // px, at 11 px
    return this.spans(seen).filter((span) => span.name !== "M").map((span) => {
      const left = Math.max(x(from), x(span.from)), word = intention_words[span.name] ?? span.name;
      return x(span.to) - left >= room(word) ? svg("text", { x: left + 4, y: intention_height - 6, class: "intention-word", text: word }) : null;
    }).filter(Boolean);
  }

  summary(seen) {
    const told = this.spans(seen).map((span) => `${intention_words[span.name] ?? span.name} from ${num(span.from, 1, "s")}`);
    return `Intentions of ${seen.actor}: ${told.slice(0, 12).join(", ")}`;
  }

  show(t) {
    for (const { seen, value } of this.rows) {
      const k = seen.times.findLastIndex((time) => time <= t + 1e-9);
      value.textContent = k >= 0 && t < this.until(seen, k) + 1e-9 ? likeliest_words(seen.of, seen.now[k]) : none;
    }
  }
}
