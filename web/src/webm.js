// A movie in a file: encoded frames of one track as WebM, https://www.matroska.org/technical/elements.html.

const MILLISECOND = 1_000_000; // ns, the unit of time in the file

/** The bytes of `chunks` (EncodedVideoChunk) of a `codec` such as "V_VP9", `width` by `height` pixels, `duration` ms in all. */
export function webm(chunks, { codec, width, height, duration }) {
  const head = element(0x1a45dfa3, [
    number(0x4286, 1), number(0x42f7, 1), number(0x42f2, 4), number(0x42f3, 8), text(0x4282, "webm"), number(0x4287, 4), number(0x4285, 2),
  ]);
  const information = element(0x1549a966, [number(0x2ad7b1, MILLISECOND), real(0x4489, duration), text(0x4d80, "flypend"), text(0x5741, "flypend")]);
  const video = element(0xe0, [number(0xb0, width), number(0xba, height)]);
  const track = element(0xae, [number(0xd7, 1), number(0x73c5, 1), number(0x83, 1), text(0x86, codec), video]);
  const segment = element(0x18538067, [information, element(0x1654ae6b, [track]), ...clusters(chunks)]);
  return new Blob([head, segment].flat(Infinity), { type: "video/webm" });
}

/** The frames in clusters, each from one key frame to the next. */
function clusters(chunks) {
  const starts = chunks.flatMap((chunk, i) => (chunk.type === "key" ? [i] : []));
  return starts.map((start, k) => {
    const begun = milliseconds(chunks[start]), blocks = chunks.slice(start, starts[k + 1]).map((chunk) => block(chunk, begun));
    return element(0x1f43b675, [number(0xe7, begun), ...blocks]);
  });
}

/** One frame: of track 1, at a time since the cluster `begun` (ms). */
function block(chunk, begun) {
  const bytes = new Uint8Array(4 + chunk.byteLength), view = new DataView(bytes.buffer);
  view.setUint8(0, 0x81);
  view.setInt16(1, milliseconds(chunk) - begun);
  view.setUint8(3, chunk.type === "key" ? 0x80 : 0);
  chunk.copyTo(bytes.subarray(4));
  return element(0xa3, [bytes]);
}

const milliseconds = ({ timestamp }) => Math.round(timestamp / 1000);

/** An element of EBML: its name, the size of its `parts` in eight bytes, and they. */
function element(name, parts) {
  const flat = parts.flat(Infinity), size = new Uint8Array(8);
  new DataView(size.buffer).setBigUint64(0, (1n << 56n) | BigInt(flat.reduce((sum, { length }) => sum + length, 0)));
  return [bytesOf(name), size, ...flat];
}

const number = (name, value) => element(name, [bytesOf(value)]);
const text = (name, words) => element(name, [new TextEncoder().encode(words)]);

function real(name, value) {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setFloat64(0, value);
  return element(name, [bytes]);
}

/** A positive integer, the highest byte first. */
function bytesOf(value) {
  const digits = value.toString(16);
  return Uint8Array.from(digits.padStart(digits.length + (digits.length % 2), "0").match(/../g), (pair) => parseInt(pair, 16));
}
