// Whether what an address holds is a setting: its parts have their sizes, and numbers are numbers. JSON tells infinity as 1e999.

const is = (type) => (value) => typeof value === type;
const list = (length, of = Number.isFinite) => (value) => Array.isArray(value) && value.length === length && value.every(of);
const every = (of) => (value) => Array.isArray(value) && value.every(of);

/** A table whose entries are as `known` says, those that it does not know as `other` says. */
const table = (known, other = () => true) => (value) => value !== null && typeof value === "object" && !Array.isArray(value)
  && Object.entries(value).every(([name, entry]) => (Object.hasOwn(known, name) ? known[name] : other)(entry));

const vector = list(3), number = Number.isFinite, numbers = table({}, number);
const whole = (value) => Number.isSafeInteger(value) && value >= 0;
export const WIND = { on_vehicle: vector, on_bob: vector, gust_on_vehicle: number, gust_on_bob: number };
const PARTS = {
  start: table({ x: vector, x_dot: vector, R: list(3, vector), omega: vector, y: vector, y_dot: vector, random: whole }),
  law: table({ name: is("string"), gains: numbers }),
  vehicle: table({ base: is("string"), mount: is("string"), rotor_limits: list(2) }),
  plant: table({ base: is("string"), sensors: is("string"), lag: number, delay: number, seed: whole, noise: numbers, defects: numbers, wind: table(WIND) }),
  pokes: every((poke) => table({}) (poke) && number(poke.time) && is("string")(poke.on) && vector(poke.velocity)),
  duration: number,
  origin: numbers,
};

/** Whether `value`, from JSON, can be taken for a setting; a start and a law it must have. */
export const readable = (value) => table(PARTS)(value) && Object.hasOwn(value, "start") && Object.hasOwn(value, "law");
