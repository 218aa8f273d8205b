// What tool.mjs packed into a page: Base64, which no server and no mail program changes, of LZMA or of gzip. gzip is what
// a browser unpacks by itself; LZMA makes the module smaller by a third, as much as Base64 makes it larger.

export const bytes_of_base64 = (text: string): Uint8Array<ArrayBuffer> => {
  const signs = atob(text);
  const bytes = new Uint8Array(signs.length);
  for (let k = 0; k < signs.length; ++k) bytes[k] = signs.charCodeAt(k);
  return bytes;
};

export const gunzipped = async (text: string): Promise<ArrayBuffer> => {
  const stream = new Blob([bytes_of_base64(text)]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
};

// Places of the probabilities, as the format names them; the literals follow.
const kMatch = 0;
const kRep = 192;
const kRep0 = 204;
const kRep1 = 216;
const kRep2 = 228;
const kRep0Long = 240;
const kSlot = 432;
const kSpecial = 688;
const kAlign = 803;
const kLength = 819; // choice, choice 2, low of 16 positions, middle of 16 positions, high
const kRepLength = kLength + 514;
const kLiteral = kRepLength + 514;
const kHeader = 13;
const kTop = 2 ** 24;

// A file of `xz --format=lzma` with its size in the header (Igor Pavlov, "LZMA specification", 2015).
export const unlzmaed = (from: Uint8Array): Uint8Array<ArrayBuffer> => {
  const header = new DataView(from.buffer, from.byteOffset, kHeader + 5);
  const [lc, lp, pb] = [(from[0] ?? 0) % 9, Math.floor((from[0] ?? 0) / 9) % 5, Math.floor((from[0] ?? 0) / 45)];
  const size = header.getUint32(5, true);
  const to = new Uint8Array(size);
  const p = new Uint16Array(kLiteral + (0x300 << (lc + lp))).fill(1024);
  let at = kHeader + 5;
  let range = -1 >>> 0;
  let code = header.getUint32(kHeader + 1, false);

  const bit = (place: number): number => {
    const chance = p[place] as number;
    const bound = (range >>> 11) * chance;
    let found = 0;
    if (code < bound) {
      range = bound;
      p[place] = chance + ((2048 - chance) >>> 5);
    } else {
      range -= bound;
      code -= bound;
      p[place] = chance - (chance >>> 5);
      found = 1;
    }
    if (range < kTop) {
      range = (range << 8) >>> 0;
      code = ((code << 8) | (from[at++] as number)) >>> 0;
    }
    return found;
  };
  const direct = (count: number): number => {
    let value = 0;
    for (let k = 0; k < count; ++k) {
      range >>>= 1;
      const one = code >= range ? 1 : 0;
      if (one) code -= range;
      value = value * 2 + one;
      if (range < kTop) {
        range = (range << 8) >>> 0;
        code = ((code << 8) | (from[at++] as number)) >>> 0;
      }
    }
    return value;
  };
  const tree = (place: number, bits: number): number => {
    let node = 1;
    for (let k = 0; k < bits; ++k) node = node * 2 + bit(place + node);
    return node - (1 << bits);
  };
  const reversed = (place: number, bits: number): number => {
    let node = 1;
    let value = 0;
    for (let k = 0; k < bits; ++k) {
      const one = bit(place + node);
      node = node * 2 + one;
      value |= one << k;
    }
    return value;
  };
  const length = (place: number, position: number): number => {
    if (!bit(place)) return tree(place + 2 + position * 8, 3);
    return bit(place + 1) ? 16 + tree(place + 258, 8) : 8 + tree(place + 130 + position * 8, 3);
  };

  let state = 0;
  let [rep0, rep1, rep2, rep3] = [0, 0, 0, 0];
  for (let end = 0; end < size; ) {
    const position = end & ((1 << pb) - 1);
    if (!bit(kMatch + state * 16 + position)) {
      const before = end > 0 ? (to[end - 1] as number) : 0;
      const place = kLiteral + 0x300 * (((end & ((1 << lp) - 1)) << lc) + (before >>> (8 - lc)));
      let sign = 1;
      if (state >= 7) {
        for (let match = to[end - rep0 - 1] as number; sign < 0x100; match <<= 1) {
          const of_match = (match >>> 7) & 1;
          const one = bit(place + ((1 + of_match) << 8) + sign);
          sign = sign * 2 + one;
          if (one !== of_match) break;
        }
      }
      while (sign < 0x100) sign = sign * 2 + bit(place + sign);
      to[end++] = sign;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let count: number;
    if (bit(kRep + state)) {
      if (!bit(kRep0 + state)) {
        if (!bit(kRep0Long + state * 16 + position)) {
          state = state < 7 ? 9 : 11;
          to[end] = to[end - rep0 - 1] as number;
          ++end;
          continue;
        }
      } else if (!bit(kRep1 + state)) {
        [rep0, rep1] = [rep1, rep0];
      } else if (!bit(kRep2 + state)) {
        [rep0, rep1, rep2] = [rep2, rep0, rep1];
      } else {
        [rep0, rep1, rep2, rep3] = [rep3, rep0, rep1, rep2];
      }
      count = 2 + length(kRepLength, position);
      state = state < 7 ? 8 : 11;
    } else {
      [rep1, rep2, rep3] = [rep0, rep1, rep2];
      count = 2 + length(kLength, position);
      state = state < 7 ? 7 : 10;
      const slot = tree(kSlot + 64 * Math.min(3, count - 2), 6);
      if (slot < 4) {
        rep0 = slot;
      } else {
        const bits = (slot >>> 1) - 1;
        rep0 = (2 | (slot & 1)) * 2 ** bits;
        if (slot < 14) rep0 += reversed(kSpecial + rep0 - slot, bits);
        else rep0 += direct(bits - 4) * 16 + reversed(kAlign, 4);
      }
    }
    if (rep0 >= end) throw new RangeError(); // it is not whole
    for (const last = Math.min(size, end + count); end < last; ++end) to[end] = to[end - rep0 - 1] as number;
  }
  return to;
};
