// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// The module bch.wasm: its memory, the layout of the C interface's structs there, and its errors.

/** An error of the library. The message names the argument, an index and the value. */
export class BchError extends Error {}

async function bytesOf(name) {
  const url = new URL(name, import.meta.url);
  if (url.protocol === "file:" && globalThis.process?.versions?.node) {
    const { readFile } = await import("node:fs/promises");
    return readFile(url);
  }
  return new Uint8Array(await (await fetch(url)).arrayBuffer());
}

// What the C++ library asks its host for. There are no files: whoever asks for one is told that there is none.
const none = () => -1;
const host = {
  proc_exit: (code) => { throw new BchError(`the library ended with code ${code}`); },
  clock_time_get: (_, __, at) => (new DataView(wasm.memory.buffer).setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true), 0),
  getentropy: (at, count) => (crypto.getRandomValues(new Uint8Array(wasm.memory.buffer, at, count)), 0),
  fd_write: (_, __, count, written) => (new DataView(wasm.memory.buffer).setUint32(written, count, true), 0),
  environ_sizes_get: (count, bytes) => (view(Uint32Array, count, 1).fill(0), view(Uint32Array, bytes, 1).fill(0), 0),
  environ_get: () => 0,
  emscripten_notify_memory_growth: () => {},
};
// Not at once: browsers refuse that for large modules on the page's own thread.
const module = await WebAssembly.compile(await bytesOf("bch.wasm"));
const imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = host[name] ?? none;
const wasm = (await WebAssembly.instantiate(module, imports)).exports;
wasm._initialize?.();

/** Views numbers in the library's memory, until that grows. */
export function view(Type, pointer, count) {
  return new Type(wasm.memory.buffer, pointer, count);
}
export const memory = {
  allocate(bytes) {
    const pointer = wasm.malloc(bytes);
    if (pointer === 0) throw new BchError(`no memory for ${bytes} bytes`);
    return pointer;
  },
  free: (pointer) => wasm.free(pointer),
};

let scratch = null;
/** Calls `use`, and frees afterwards what array() and Struct took in it. */
export function withScratch(use) {
  if (scratch) return use();
  scratch = [];
  try {
    return use();
  } finally {
    scratch.forEach(memory.free);
    scratch = null;
  }
}
/** Copies numbers to the library's memory, or makes room for so many there, for the present call. */
export function array(Type, values) {
  if (values.buffer === wasm.memory.buffer) values = values.slice(); // which would be lost where memory grows
  const count = typeof values === "number" ? values : values.length;
  const pointer = memory.allocate(Math.max(1, count) * Type.BYTES_PER_ELEMENT);
  scratch.push(pointer);
  const to = view(Type, pointer, count);
  if (values === count) to.fill(Type === BigUint64Array ? 0n : 0);
  else to.set(values);
  return pointer;
}
/** Returns the text at a pointer. */
export function text(pointer) {
  if (pointer === 0) return "";
  const bytes = new Uint8Array(wasm.memory.buffer, pointer);
  return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}
text.of = (words) => array(Uint8Array, [...new TextEncoder().encode(words), 0]);

/** Calls a function of the C interface, and throws its error. */
export function call(name, ...given) {
  if (wasm[name](...given) !== 0) throw new BchError(text(wasm.bch_last_error()));
}
/** Calls a function whose last parameter takes a pointer, and returns it. */
export function callPointer(name, ...given) {
  return withScratch(() => {
    const to = array(Uint32Array, 1);
    call(name, ...given, to);
    return view(Uint32Array, to, 1)[0];
  });
}
export const version = text(wasm.bch_version());

// The structs of abi.txt, with their places in a memory of 32 bits.
const numbers = {
  int32_t: [4, "Int32"], uint32_t: [4, "Uint32"], size_t: [4, "Uint32"], float: [4, "Float32"], double: [8, "Float64"],
  int64_t: [8, "BigInt64"], uint64_t: [8, "BigUint64"], uint8_t: [1, "Uint8"],
};
const described = new Map();
for (const line of new TextDecoder().decode(await bytesOf("abi.txt")).split("\n")) {
  const match = /^struct (\w+): (.*)$/.exec(line);
  if (match) described.set(match[1], match[2].split("; ").slice(0, -1));
}
const layouts = new Map();
function layoutOf(name) {
  if (layouts.has(name)) return layouts.get(name);
  const members = new Map();
  let end = 0, most = 1;
  for (const member of described.get(name)) {
    const [, type, field, counts] = /^\d+ (.*?)(\w+)((?:\[\d+\])*)$/.exec(member);
    const kind = type.trim();
    const isPointer = kind.endsWith("*") || kind.startsWith("bch_progress");
    const own = isPointer ? { size: 4, align: 4, read: "Uint32" } : numbers[kind] ? { size: numbers[kind][0], align: numbers[kind][0], read: numbers[kind][1] } : layoutOf(kind);
    const count = [...counts.matchAll(/\d+/g)].reduce((product, [n]) => product * n, 1);
    end = Math.ceil(end / own.align) * own.align;
    members.set(field, { at: end, read: own.read });
    end += own.size * count;
    most = Math.max(most, own.align);
  }
  const layout = { size: Math.ceil(end / most) * most, align: most, members };
  layouts.set(name, layout);
  return layout;
}
/** A struct of the C interface in the library's memory, for the present call: zeros, its size and what is given. */
export class Struct {
  constructor(name, values = {}) {
    this.layout = layoutOf(name);
    this.pointer = array(Uint8Array, Math.ceil(this.layout.size / 8) * 8);
    if (this.layout.members.has("size")) this.set("size", this.layout.size);
    for (const [member, value] of Object.entries(values)) this.set(member, value);
  }
  set(member, value) {
    const { at, read } = this.layout.members.get(member);
    new DataView(wasm.memory.buffer)[`set${read}`](this.pointer + at, value, true);
  }
  get(member) {
    const { at, read } = this.layout.members.get(member);
    return new DataView(wasm.memory.buffer)[`get${read}`](this.pointer + at, true);
  }
}
