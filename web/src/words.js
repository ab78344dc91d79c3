// How symbols and numbers are written.

/** Append `name`, such as k_d or rod_bandwidth, to `parent`: a single letter is italic, what follows it a subscript. */
export function writeSymbol(parent, name) {
  const found = /^([a-zA-Z])_(\w{1,3})$/.exec(name);
  if (!found) {
    parent.append(name.replaceAll("_", " "));
    return;
  }
  const letter = document.createElement("i"), below = document.createElement("sub");
  letter.textContent = found[1];
  below.textContent = found[2];
  parent.append(letter, below);
}

const PER = { "1/s": "s⁻¹", "1/s²": "s⁻²" };

/** How `unit` is written behind a number, with a space before it. */
export const unitOf = (unit) => unit && ` ${PER[unit] ?? unit}`;

const RAISED = Object.fromEntries([..."−0123456789"].map((sign, i) => [sign, "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"[i]]));

const minus = (text) => text.replace("-", "−");

/** A number of a tick. */
export const tick = (value) => minus(String(+value.toPrecision(4)));

/** The power of ten of a tick on a logarithmic axis. */
export const power = (exponent) => `10${[...minus(String(exponent))].map((sign) => RAISED[sign]).join("")}`;

/** The number whose decimal logarithm is `exponent`, beside a plot with such an axis. */
export function scientific(exponent) {
  if (exponent < -300) return "0";
  const [digits, of] = (10 ** exponent).toExponential(1).split("e");
  return `${digits}·${power(Number(of))}`;
}

/** A number beside a plot: two decimals, fewer where it is large. */
export function reading(value) {
  const size = Math.abs(value);
  return size >= 1e4 ? large(value) : minus(value.toFixed(size >= 1000 ? 0 : size >= 100 ? 1 : 2));
}

/** A large number with two digits and a prefix of its unit: 63 k. */
export function large(value) {
  const size = Math.abs(value);
  const [factor, prefix] = size >= 1e9 ? [1e9, "G"] : size >= 1e6 ? [1e6, "M"] : size >= 1e3 ? [1e3, "k"] : [1, ""];
  return `${minus(String(+(value / factor).toPrecision(2)))}${prefix && ` ${prefix}`}`;
}
