// Light and dark: the colours of roles, given by Python, as custom properties of the page and as an object.

export class Theme {
  /** `palette` maps "light" and "dark" to colours of roles; `changed` is called with the colours in use. */
  constructor(palette, changed) {
    Object.assign(this, { palette, changed });
    const system = window.matchMedia("(prefers-color-scheme: dark)");
    this.name = system.matches ? "dark" : "light";
    system.addEventListener("change", () => this.set(system.matches ? "dark" : "light"));
  }

  get colours() {
    return this.palette[this.name];
  }

  set(name) {
    if (!(name in this.palette)) return false;
    this.name = name;
    document.documentElement.dataset.theme = name;
    for (const [role, colour] of Object.entries(this.colours)) {
      document.documentElement.style.setProperty(`--${role}`, colour);
    }
    this.changed(this.colours);
    return true;
  }

  toggle() {
    this.set(this.name === "dark" ? "light" : "dark");
  }
}
