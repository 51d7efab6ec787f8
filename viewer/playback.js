// Time: where the cursor stands, playing, and the keys and buttons that move it.

class Playback {
  /**
   * @param start, end  of what can be shown [s]
   * @param step        of a key or a button [s]; ten times that with shift
   * @param show        called whenever the time has changed
   */
  constructor({ start, end, t = start, step, show }) {
    Object.assign(this, { start, end, t, stride: step, show });
    this.playing = false;
    this.poster = true;  // nobody has moved the cursor yet: the first play starts from the beginning
    this.next = 0;       // the animation frame that was asked for
  }

  get from() { return this.start; }  // where playing begins

  seek(t) {
    this.poster = false;
    this.t = Math.min(Math.max(t, this.start), this.end);
    this.show();
  }

  play(on) {
    if (on && (this.poster || this.t >= this.end - 1e-6)) this.seek(this.from);
    this.playing = on && this.end > this.start;
    by_id("play").textContent = this.playing ? "Pause" : "Play";
    cancelAnimationFrame(this.next);
    if (this.playing) this.next = requestAnimationFrame((now) => this.step(now, now));
  }

  step(now, before) {
    if (!this.playing) return;
    this.seek(this.t + ((now - before) / 1000) * Number(by_id("rate").value));
    if (this.t >= this.end - 1e-6) this.play(false);
    else this.next = requestAnimationFrame((next) => this.step(next, now));
  }

  on_key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const at = event.target.closest("button, input, select, summary, pre, [role=region]");  // may want the key itself
    const free = !at || at.id === "scrub" || (at.matches("button") && at.role !== "tab");
    const step = event.shiftKey ? 10 * this.stride : this.stride;
    if (event.key === " " && (!at || at.id === "scrub")) this.play(!this.playing);
    else if (event.key === "ArrowRight" && free) this.seek(this.t + step);
    else if (event.key === "ArrowLeft" && free) this.seek(this.t - step);
    else if (event.key === "Home" && free) this.seek(this.from);
    else if (event.key === "End" && free) this.seek(this.end);
    else return;
    event.preventDefault();
  }

  /** Takes up the page's buttons and keys. */
  connect() {
    for (const id of ["play", "back", "forth", "scrub", "rate"]) by_id(id).disabled = this.end <= this.start;
    by_id("play").addEventListener("click", () => this.play(!this.playing));
    by_id("back").addEventListener("click", () => this.seek(this.t - this.stride));
    by_id("forth").addEventListener("click", () => this.seek(this.t + this.stride));
    document.addEventListener("keydown", (event) => this.on_key(event));
  }
}

/** A press on `box` goes where `at` says for the pointer's event, and follows it until it is let go. */
function follow_pointer(box, wanted, at) {
  box.addEventListener("pointerdown", (event) => {
    if (!wanted(event)) return;
    const stop = () => { window.removeEventListener("pointermove", at); window.removeEventListener("pointerup", stop); window.removeEventListener("pointercancel", stop); };
    window.addEventListener("pointermove", at);
    window.addEventListener("pointerup", stop);
    window.addEventListener("pointercancel", stop);
    at(event);
  });
}
